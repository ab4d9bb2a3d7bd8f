#pragma once
#include <memory>
#include <string>

#include "plan/context.h"
#include "scene/format.h"
#include "scene/scene.h"

struct brume_host_t;

namespace brume {

// What a plan's images take.
class ImageMemory {
public:
    void add(const std::string &label, int32_t width, int32_t height, int32_t channels);
    void take_away(uint64_t bytes) { bytes_ -= bytes; }
    uint64_t bytes() const { return bytes_; }
    // "7 images of 141.0 MB, the largest radiance: 2048 x 1024 x 4 floats, 33.6 MB"
    std::string text() const;

private:
    uint64_t bytes_ = 0, largest_bytes_ = 0;
    uint32_t count_ = 0;
    std::string largest_;
};

// Throws Error(BRUME_ERROR_MEMORY) that says what all of its images take, before the first is made where they are more than
// the process may use: a system that promises more than it has would end it as they are written.
std::unique_ptr<brume_host_t> plan_in_memory(const std::shared_ptr<Context> &context, const Scene &scene,
                                             const Format &format);

}  // namespace brume
