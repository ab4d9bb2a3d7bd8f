#pragma once
// Kernels `reference` and `paper_reference`: what the hierarchical kernels approximate, pixel against pixel, in double, on
// the CPU.
#include <memory>
#include <vector>

#include "state.h"

namespace multiscatter {

// Of both passes: the one that finds the sources writes nothing but what belongs to the Splatting.
namespace reference_pass {
enum {
    color,
    density,
    density_rgb,
    gaussian_density,
    lights,
    result,
    transmittance_out,
    optical_depth_out,
    scattered_out,
    blur_radius_out
};
}  // namespace reference_pass

// What a reference sees of a frame.
struct ReferenceFrame {
    const State &state;
    const brume_plugin_scene &scene;
    brume::maths_double::Medium medium;
    brume::maths_double::Camera camera;
    brume::maths_double::Filter filter{};
    brume::maths_double::Data lights;  // those that can be seen
    int light_count;
    const brume_plugin_pixels *slots = nullptr;  // of reference_pass

    brume::maths_double::vec3 color_at(int x, int y) const;
    brume::maths_double::Pixel pixel_at(int x, int y) const;
    size_t index(int x, int y) const { return size_t(y) * size_t(state.width) + size_t(x); }
};

// Sources first, then the light that rows of receivers get from all of them, in the same order for any split into rows.
class Splatting {
public:
    virtual ~Splatting() = default;
    virtual void find_sources(const ReferenceFrame &frame, int first, int last) = 0;
    // Between the two, once.
    virtual void prepare(const ReferenceFrame &frame) = 0;
    // Rows [first, last): sum has a value for each of their pixels.
    virtual void add_rows(const ReferenceFrame &frame, int first, int last,
                          std::vector<brume::maths_double::vec3> &sum) const = 0;
};

std::unique_ptr<Splatting> paper_splatting(const State &state);
std::unique_ptr<Splatting> calibrated_splatting(const State &state);

}  // namespace multiscatter
