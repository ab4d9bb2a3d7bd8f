#include "support/sdk.hpp"

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

std::string sdk_message(brume_context context, brume_status status)
{
    std::string message(brume_message(context, nullptr, 0), '\0');
    if (message.size() <= 1)
        return brume_status_name(status);
    brume_message(context, message.data(), message.size());
    message.pop_back();
    return message;
}

ContextHandle create_context(const std::string &backend)
{
    brume_context_desc desc = BRUME_CONTEXT_DESC_INIT;
    if (backend == "cpu")
        desc.backend = BRUME_BACKEND_CPU;
    else if (backend == "gl")
        desc.backend = BRUME_BACKEND_GL;
    else if (backend != "auto")
        throw RequestError(fmt::format("--backend '{}': expected auto, gl or cpu", backend));
    desc.log = log_to_stderr;
    brume_context context = nullptr;
    const brume_status status = brume_context_create(&desc, &context);
    if (status != BRUME_OK)
        throw RequestError(fmt::format("--backend {}: {}", backend, sdk_message(nullptr, status)));
    return ContextHandle(context);
}

void check_request(brume_context context, brume_status status, const std::string &what)
{
    if (status != BRUME_OK)
        throw RequestError(what + (what.empty() ? "" : ": ") + sdk_message(context, status));
}

brume_image host_image(void *data, int width, int height, int channels)
{
    brume_image image = BRUME_IMAGE_INIT;
    image.channels = std::uint32_t(channels);
    image.width = width;
    image.height = height;
    image.data = data;
    return image;
}

brume_layer layer_named(const char *name, const brume_image *image)
{
    brume_layer layer = BRUME_LAYER_INIT;
    layer.name = name;
    layer.image = image;
    return layer;
}

const char *backend_name(std::uint32_t backend)
{
    return backend == BRUME_BACKEND_GL ? "gl" : "cpu";
}

}  // namespace brume::tool
