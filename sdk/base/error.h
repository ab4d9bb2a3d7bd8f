#pragma once
#include <stdexcept>
#include <string>

#include <brume/brume.h>

namespace brume {

// Every failure inside the library; sdk/api turns it into a status and a message.
class Error : public std::runtime_error {
public:
    Error(brume_status status, const std::string &message) : std::runtime_error(message), status_(status) {}
    brume_status status() const { return status_; }

private:
    brume_status status_;
};

}  // namespace brume
