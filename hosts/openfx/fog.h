// The fog of one instance: a context, and the plan for its settings and frames.
#pragma once
#include <memory>

#include <brume/brume.h>

#include "settings.h"

namespace openfx {

// The library's answer to a call. Not brume.hpp's: its classes have the names of the library's own, which this module has,
// too.
struct LibraryError : std::runtime_error {
    LibraryError(brume_status status, const std::string &message) : std::runtime_error(message), status(status) {}
    const brume_status status;
};

struct Destroy {
    void operator()(brume_context context) const { brume_context_destroy(context); }
    void operator()(brume_scene scene) const { brume_scene_destroy(scene); }
    void operator()(brume_plan plan) const { brume_plan_destroy(plan); }
};
template <class Handle> using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Destroy>;

// Where the camera's picture lies in the image that is fogged, in pixels from the image's top left, and how wide these are.
struct Frame {
    int width, height;
    int display_x, display_y, display_width, display_height;
    double pixel_aspect;
    bool operator==(const Frame &) const = default;
};

class Fog {
public:
    // On GL in the context that is current, which is the host's.
    Fog(uint32_t backend, brume_progress_callback progress, void *user);

    // Plans, unless the last plan is for these.
    void prepare(const Settings &settings, const Frame &frame);
    // Of the last plan for these settings, whatever its frames: hosts that round a region otherwise than its image cause no
    // new plan.
    bool does_nothing(const Settings &settings, const Frame &frame);
    void run(const brume_image &color, const brume_image &depth, const brume_image &output, ofx::Time time);

private:
    void check(brume_status status) const;
    bool does_nothing() const;
    Owned<brume_scene> scene_of_file(const Settings &settings, const Frame &frame) const;
    Owned<brume_scene> scene_of_parameters(const Settings &settings, const Frame &frame) const;

    Owned<brume_context> context_;
    Owned<brume_plan> plan_;
    Settings settings_{};
    Frame frame_{};
};

}  // namespace openfx
