#include "plan/plan_memory.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "plan/plan.h"

namespace brume {
namespace {

// Plans hold fewer pictures by far: only those that could be too large are rehearsed.
constexpr uint64_t most_pictures = 64;

}  // namespace

void ImageMemory::add(const std::string &label, int32_t width, int32_t height, int32_t channels)
{
    const uint64_t bytes = uint64_t(width) * uint64_t(height) * uint64_t(channels) * 4;
    bytes_ += bytes;
    ++count_;
    if (bytes <= largest_bytes_)
        return;
    largest_bytes_ = bytes;
    largest_ = label + ": " + image_text(width, height, channels, "float", bytes);
}

std::string ImageMemory::text() const
{
    return fmt::format("{} images of {}, the largest {}", count_, bytes_text(bytes_), largest_);
}

std::unique_ptr<brume_host_t> plan_in_memory(const std::shared_ptr<Context> &context, const Scene &scene,
                                             const Format &format)
{
    const uint64_t limit = context->backend->memory_limit();
    const auto rehearsed = [&] { return brume_host_t(context, scene, format, Purpose::rehearsal).image_memory(); };
    if (uint64_t(format.width) * uint64_t(format.height) * 16 * most_pictures > limit) {
        const ImageMemory memory = rehearsed();
        if (memory.bytes() > limit)
            throw Error(BRUME_ERROR_MEMORY,
                        fmt::format("format: {} x {} takes {}; expected at most the {} that this process "
                                    "may use",
                                    format.width, format.height, memory.text(), bytes_text(limit)));
    }
    try {
        return std::make_unique<brume_host_t>(context, scene, format);
    } catch (const Error &error) {
        if (error.status() != BRUME_ERROR_MEMORY)
            throw;
        throw Error(BRUME_ERROR_MEMORY, fmt::format("{}; the plan takes {}", error.what(), rehearsed().text()));
    }
}

}  // namespace brume
