#pragma once

#include <string>

// The tool's failures are RequestError and FrameError, which say of what option, file or frame.
#define BRUME_HPP_NO_EXCEPTIONS
#include <brume/brume.hpp>

namespace brume::tool {

/// `backend` is auto, gl or cpu; `plugins` a directory of further effects, or empty. Throws RequestError.
Context create_context(const std::string &backend, const std::string &plugins = "");

/// Throws RequestError where the library refuses: for what comes from the command line or the scene file.
void check_request(const Context &context, brume_status status, const std::string &what);

const char *backend_name(std::uint32_t backend);

}  // namespace brume::tool
