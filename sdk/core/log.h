#pragma once
#include <string>

#include <brume/brume.h>

namespace brume {

// The caller's log callback with its level; silent without one.
struct Log {
    brume_log_callback callback = nullptr;
    void *user = nullptr;
    uint32_t level = BRUME_LOG_WARNING;

    void operator()(uint32_t message_level, const std::string &message) const
    {
        if (callback && message_level <= level)
            callback(user, message_level, message.c_str());
    }
};

}  // namespace brume
