#pragma once
#include <string>
#include <utility>
#include <vector>

#include <brume/brume.h>

namespace brume {

class DeferredLog;

// The caller's log callback with its level; silent without one.
struct Log {
    brume_log_callback callback = nullptr;
    void *user = nullptr;
    uint32_t level = BRUME_LOG_WARNING;

    void operator()(uint32_t message_level, const std::string &message) const;
};

// What a thread of the library's logs while one of these lives there, for the thread of the API call to deliver.
class DeferredLog {
public:
    DeferredLog() : outer_(std::exchange(current(), this)) {}
    ~DeferredLog() { current() = outer_; }
    DeferredLog(const DeferredLog &) = delete;
    DeferredLog &operator=(const DeferredLog &) = delete;

    struct Message {
        Log log;
        uint32_t level;
        std::string text;
    };
    std::vector<Message> take() { return std::exchange(messages_, {}); }

private:
    friend struct Log;
    static DeferredLog *&current()
    {
        static thread_local DeferredLog *current = nullptr;
        return current;
    }

    DeferredLog *const outer_;
    std::vector<Message> messages_;
};

inline void Log::operator()(uint32_t message_level, const std::string &message) const
{
    if (!callback || message_level > level)
        return;
    if (DeferredLog *deferred = DeferredLog::current())
        deferred->messages_.push_back({*this, message_level, message});
    else
        callback(user, message_level, message.c_str());
}

}  // namespace brume
