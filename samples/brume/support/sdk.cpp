#include "support/sdk.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "support/error.hpp"

namespace brume::tool {
namespace {

void log_to_stderr(void *, std::uint32_t level, const char *message)
{
    // Errors come back as statuses, and are printed where they end a frame or the run.
    if (level != BRUME_LOG_ERROR)
        fmt::print(stderr, "brume: {}\n", message);
}

}  // namespace

Context create_context(const std::string &backend, const std::string &plugins)
{
    brume_context_desc desc = BRUME_CONTEXT_DESC_INIT;
    if (backend == "cpu")
        desc.backend = BRUME_BACKEND_CPU;
    else if (backend == "gl")
        desc.backend = BRUME_BACKEND_GL;
    else if (backend != "auto")
        throw RequestError(fmt::format("--backend '{}': expected auto, gl or cpu", backend));
    desc.log = log_to_stderr;
    const std::string directory = plugins.empty() ? "" : std::filesystem::absolute(plugins).string();
    if (!plugins.empty()) {
        // The library goes on without one; who names it wants what is in it.
        if (std::error_code error; !std::filesystem::is_directory(directory, error))
            throw RequestError(fmt::format("--plugins {}: no such directory", plugins));
        desc.plugin_directory = directory.c_str();
    }
    Context context(desc);
    check_request(context, context.status(), "--backend " + backend);
    return context;
}

void check_request(const Context &context, brume_status status, const std::string &what)
{
    if (status == BRUME_OK)
        return;
    const std::string said = context.message();
    throw RequestError(what + (what.empty() ? "" : ": ") + (said.empty() ? brume_status_name(status) : said));
}

const char *backend_name(std::uint32_t backend)
{
    return backend == BRUME_BACKEND_GL ? "gl" : "cpu";
}

}  // namespace brume::tool
