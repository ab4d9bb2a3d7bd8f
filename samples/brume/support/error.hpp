#pragma once

#include <stdexcept>

namespace brume::tool {

/// The request itself is wrong, whatever the pixels are: exit status 2, nothing written.
struct RequestError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// One frame cannot be done; others may be: exit status 1.
struct FrameError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

enum ExitStatus { kDone = 0, kSomeFailed = 1, kWrongRequest = 2 };

}  // namespace brume::tool
