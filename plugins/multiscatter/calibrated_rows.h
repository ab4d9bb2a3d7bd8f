#pragma once
#include "state.h"

namespace multiscatter {

// What the loops of kernel `calibrated` on the CPU share during one frame.
struct CalibratedFrame {
    const State &state;
    const brume_plugin_scene &scene;
    brume::maths_float::Calibrated calibrated;
    brume::maths_float::Medium medium;
    brume::maths_float::Camera camera;
    brume_plugin_pixels color{}, depth{}, gaussian_density{}, lights{}, output{}, radiance{}, radiance_stack{}, coverage{},
        coverage_stack{}, smooth_radiance{}, smooth_coverage{}, ambient_stack{}, table{}, transmittance{}, optical_depth{},
        scattered{}, blur_radius{};
};

// The passes' loops over rows `first` to `last` (exclusive), for one set of instructions.
struct CalibratedRows {
    void (*spread)(const CalibratedFrame &frame, int first, int last);
    void (*share)(const CalibratedFrame &frame, int level, int first, int last);
    void (*smooth)(const CalibratedFrame &frame, int level, int first, int last);
    void (*collect)(const CalibratedFrame &frame, int first, int last);
    void (*compose)(const CalibratedFrame &frame, int first, int last);
};

}  // namespace multiscatter
