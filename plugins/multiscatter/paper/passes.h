#pragma once
// The passes of kernel `paper`, in the order of shaders/passes/multiscatter_*.comp.
#include "pass_tables.hpp"
#include "state.h"

namespace multiscatter {

// Of all passes; each reads what its shader declares.
struct PaperConstants {
    brume::maths_float::Filter multiscatter;
    int32_t level;
    brume::maths_float::ivec2 finer_size;
    brume::maths_float::ivec2 rows;  // first rows of the finer level and of this one in their images
    int32_t spread_channel;
    int32_t taps;  // rows alone: the shader is compiled for them
};

inline constexpr brume_constant paper_constants[] = {
    BRUME_CONSTANT_OF(PaperConstants, multiscatter, top),
    BRUME_CONSTANT_OF(PaperConstants, multiscatter, fetch),
    BRUME_CONSTANT_OF(PaperConstants, multiscatter, masking),
    BRUME_CONSTANT_OF(PaperConstants, multiscatter, density_blurring),
    BRUME_CONSTANT_OF(PaperConstants, multiscatter, separation),
    BRUME_CONSTANT_OF(PaperConstants, multiscatter, placement),
    BRUME_CONSTANT_OF(PaperConstants, multiscatter, scale),
    BRUME_CONSTANT_OF(PaperConstants, multiscatter, mask_width),
    BRUME_CONSTANT_OF(PaperConstants, multiscatter, bright),
    BRUME_CONSTANT_OF(PaperConstants, multiscatter, bright_width),
    BRUME_CONSTANT_OF(PaperConstants, multiscatter, dense),
    BRUME_CONSTANT_OF(PaperConstants, multiscatter, dense_width),
    BRUME_CONSTANT_OF(PaperConstants, multiscatter, lights),
    BRUME_CONSTANT_OF(PaperConstants, multiscatter, all_orders),
    BRUME_CONSTANT_OF(PaperConstants, multiscatter, separation_level),
    BRUME_CONSTANT(PaperConstants, level),
    BRUME_CONSTANT(PaperConstants, finer_size),
    BRUME_CONSTANT(PaperConstants, rows),
    BRUME_CONSTANT(PaperConstants, spread_channel),
};

namespace scatter_pass {
enum { color, density, density_rgb, gaussian_density, lights, radiance, separated };
inline constexpr brume_slot slots[] = {brume_passes::fetch("color"),       brume_passes::fetch("density"),
                                       brume_passes::fetch("density_rgb"), brume_passes::fetch("gaussian_density"),
                                       brume_passes::fetch("lights"),      brume_passes::write("radiance"),
                                       brume_passes::write("separated")};
}  // namespace scatter_pass

namespace downsample_pass {
enum { finer_radiance, finer_spread, finer_separated, radiance, spread, separated };
inline constexpr brume_slot slots[] = {brume_passes::fetch("finer_radiance"),  brume_passes::fetch("finer_spread"),
                                       brume_passes::fetch("finer_separated"), brume_passes::write("radiance"),
                                       brume_passes::write("spread"),          brume_passes::write("separated")};
}  // namespace downsample_pass

namespace paper_compose_pass {
enum {
    color,
    density,
    density_rgb,
    gaussian_density,
    radiance,
    radiance_stack,
    spread_stack,
    separated,
    separated_stack,
    result,
    transmittance_out,
    optical_depth_out,
    scattered_out,
    blur_radius_out
};
inline constexpr brume_slot slots[] = {brume_passes::fetch("color"),
                                       brume_passes::fetch("density"),
                                       brume_passes::fetch("density_rgb"),
                                       brume_passes::fetch("gaussian_density"),
                                       brume_passes::linear("radiance"),
                                       brume_passes::linear("radiance_stack"),
                                       brume_passes::linear("spread_stack"),
                                       brume_passes::linear("separated"),
                                       brume_passes::linear("separated_stack"),
                                       brume_passes::write("result"),
                                       brume_passes::write("transmittance_out"),
                                       brume_passes::write("optical_depth_out"),
                                       brume_passes::write("scattered_out"),
                                       brume_passes::write("blur_radius_out")};
}  // namespace paper_compose_pass

// The passes' halves for the CPU.
brume_status paper_scatter_rows(const brume_plugin_rows *call, int32_t first, int32_t last);
brume_status paper_downsample_rows(const brume_plugin_rows *call, int32_t first, int32_t last);
brume_status paper_compose_rows(const brume_plugin_rows *call, int32_t first, int32_t last);

}  // namespace multiscatter
