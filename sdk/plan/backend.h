#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <brume/brume_plugin.h>

#include "base/log.h"
#include "effects/pass_layout.h"
#include "base/progress.h"

// The plugin ABI's opaque types are the backend's classes themselves.
struct brume_plugin_image_t {
    virtual ~brume_plugin_image_t() = default;
    int32_t width = 0;
    int32_t height = 0;
    int32_t channels = 0;
    uint64_t bytes = 0;  // of its own memory; none of a caller's
};

// A pass of a plan, as one backend runs it.
struct brume_pass_t {
    virtual ~brume_pass_t() = default;
    brume::PassLayout layout;
    int entry = -1;  // the plan's, whose time it counts to
};

namespace brume {

using Image = brume_plugin_image_t;
using Pass = brume_pass_t;

// Times the passes of one plan's frames. A pass lasts from its mark to the next one; passes marked several times add up.
class FrameTimer {
public:
    virtual ~FrameTimer() = default;
    virtual void begin() = 0;
    virtual void mark(int entry) = 0;
    virtual void end() = 0;
    // Milliseconds per entry of the last ended frame, empty before one. May wait for the device.
    virtual std::vector<double> milliseconds(int entries) = 0;
};

constexpr int64_t not_counted = -1;

// Where passes run. All calls but kind(), device() and the byte counts happen inside invoke().
class Backend {
public:
    virtual ~Backend() = default;

    virtual uint32_t kind() const = 0;
    virtual std::string device() const = 0;
    virtual uint32_t threads() const = 0;
    virtual uint64_t host_bytes() const = 0;
    virtual uint64_t device_bytes() const = 0;

    // Runs `work` where this backend's calls may be made (its GL thread, or here under the state guard) and waits for it.
    // Exceptions come back to the caller.
    virtual void invoke(const std::function<void()> &work) = 0;

    // Bytes of images that it could hold at most; UINT64_MAX where only trying tells.
    virtual uint64_t memory_limit() const { return UINT64_MAX; }

    // Largest width and height of an image.
    virtual int32_t largest_size() const = 0;

    // A pooled image; it goes back to the pool when the last owner lets go.
    virtual std::shared_ptr<Image> create_image(int32_t width, int32_t height, int32_t channels, uint32_t pixel) = 0;
    // The description has been checked by layout_of(); throws Error where this backend cannot run it.
    virtual std::shared_ptr<Pass> create_pass(const brume_pass_desc &desc, PassLayout layout) = 0;
    virtual std::unique_ptr<FrameTimer> create_timer() = 0;

    // Checks that an image of the caller's is usable here as input (writable: as output); throws Error.
    virtual void check(const brume_image &image, const char *what, bool writable) = 0;

    // BRUME_PIXEL_... that passes write where this image is their output: a texture knows its own.
    virtual uint32_t pixel(const brume_image &image) { return image.pixel; }

    // The caller's image for reading: RGBA (grey is spread over RGB, alpha is 1 where there is none) or, for channels 1,
    // its first channel.
    virtual std::shared_ptr<Image> import(const brume_image &image, int32_t channels) = 0;
    // Its first channel at another size: each pixel is the one in which its centre lies (nearest_pixel()).
    virtual std::shared_ptr<Image> import_depth(const brume_image &image, int32_t width, int32_t height) = 0;
    // An image to write whose content finish() brings to the caller's. direct: the caller's own may be handed out (it is
    // no input of this frame).
    virtual std::shared_ptr<Image> begin_output(const brume_image &image, int32_t channels, bool direct) = 0;
    // Returns how many values were clamped to what halves hold, or not_counted.
    virtual int64_t finish_output(const brume_image &image, Image &written) = 0;
    // from's pixels to `to`, bit for bit where the formats are the same. Returns as finish_output() does.
    virtual int64_t copy(const brume_image &from, const brume_image &to) = 0;
    // Frees every image that nobody holds.
    virtual void trim() = 0;
    // Ends a frame: whatever the caller may do next sees what was written.
    virtual void flush() = 0;

    // images: in the order of the pass's slots, as many; constants: of the pass's size; watch: NULL where nobody does.
    virtual brume_status run(Pass &pass, const brume_plugin_image *images, const void *constants, int32_t width,
                             int32_t height, const brume_plugin_scene &scene, void *user, const Watch *watch) = 0;
};

std::unique_ptr<Backend> make_cpu_backend(uint32_t threads);

}  // namespace brume
