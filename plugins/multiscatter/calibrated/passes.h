#pragma once
// The passes of kernel `calibrated`: what each reads, writes and is told, in the order of
// shaders/passes/multiscatter_*.comp.
#include "pass_tables.hpp"
#include "state.h"

namespace multiscatter {

// Of all passes; each reads what its shader declares.
struct CalibratedConstants {
    brume::maths_float::Calibrated calibrated;
    int32_t reduction;
    brume::maths_float::ivec2 image_size;
    int32_t level;
    brume::maths_float::Level own, finer;
};

inline constexpr brume_constant calibrated_constants[] = {
    BRUME_CONSTANT_OF(CalibratedConstants, calibrated, top),
    BRUME_CONSTANT_OF(CalibratedConstants, calibrated, step),
    BRUME_CONSTANT_OF(CalibratedConstants, calibrated, coverage),
    BRUME_CONSTANT_OF(CalibratedConstants, calibrated, lights),
    BRUME_CONSTANT_OF(CalibratedConstants, calibrated, all_orders),
    BRUME_CONSTANT_OF(CalibratedConstants, calibrated, sky),
    BRUME_CONSTANT_OF(CalibratedConstants, calibrated, first_sky),
    BRUME_CONSTANT_OF(CalibratedConstants, calibrated, first_place),
    BRUME_CONSTANT_OF(CalibratedConstants, calibrated, per_reach),
    BRUME_CONSTANT_OF(CalibratedConstants, calibrated, detour),
    BRUME_CONSTANT(CalibratedConstants, reduction),
    BRUME_CONSTANT(CalibratedConstants, image_size),
    BRUME_CONSTANT(CalibratedConstants, level),
    BRUME_CONSTANT_OF(CalibratedConstants, own, size),
    BRUME_CONSTANT_OF(CalibratedConstants, own, extent),
    BRUME_CONSTANT_OF(CalibratedConstants, own, row),
    BRUME_CONSTANT_OF(CalibratedConstants, finer, size),
    BRUME_CONSTANT_OF(CalibratedConstants, finer, extent),
    BRUME_CONSTANT_OF(CalibratedConstants, finer, row),
};

namespace spread_pass {
enum { color, density, density_rgb, lights, table, radiance, coverage };
inline constexpr brume_slot slots[] = {brume_passes::fetch("color"),       brume_passes::fetch("density"),
                                       brume_passes::fetch("density_rgb"), brume_passes::fetch("lights"),
                                       brume_passes::fetch("table"),       brume_passes::write("radiance"),
                                       brume_passes::write("coverage")};
}  // namespace spread_pass

namespace share_pass {
enum { finer_radiance, finer_coverage, finer_ambient, table, radiance, coverage, ambient };
inline constexpr brume_slot slots[] = {brume_passes::fetch("finer_radiance"), brume_passes::fetch("finer_coverage"),
                                       brume_passes::fetch("finer_ambient"),  brume_passes::fetch("table"),
                                       brume_passes::write("radiance"),       brume_passes::write("coverage"),
                                       brume_passes::write("ambient")};
}  // namespace share_pass

namespace smooth_pass {
enum { radiance_stack, coverage_stack, table, radiance, coverage };
inline constexpr brume_slot slots[] = {brume_passes::fetch("radiance_stack"), brume_passes::fetch("coverage_stack"),
                                       brume_passes::fetch("table"), brume_passes::write("radiance"),
                                       brume_passes::write("coverage")};
}  // namespace smooth_pass

namespace collect_pass {
enum { density, table, radiance_stack, coverage_stack, radiance, coverage };
inline constexpr brume_slot slots[] = {brume_passes::fetch("density"),         brume_passes::fetch("table"),
                                       brume_passes::linear("radiance_stack"), brume_passes::linear("coverage_stack"),
                                       brume_passes::write("radiance"),        brume_passes::write("coverage")};
}  // namespace collect_pass

namespace calibrated_compose_pass {
enum {
    color,
    density,
    density_rgb,
    lights,
    table,
    radiance,
    coverage,
    radiance_stack,
    coverage_stack,
    ambient_stack,
    sky,
    result,
    transmittance_out,
    optical_depth_out,
    scattered_out,
    blur_radius_out
};
inline constexpr brume_slot slots[] = {brume_passes::fetch("color"),
                                       brume_passes::fetch("density"),
                                       brume_passes::fetch("density_rgb"),
                                       brume_passes::fetch("lights"),
                                       brume_passes::fetch("table"),
                                       brume_passes::fetch("radiance"),
                                       brume_passes::fetch("coverage"),
                                       brume_passes::linear("radiance_stack"),
                                       brume_passes::linear("coverage_stack"),
                                       brume_passes::linear("ambient_stack"),
                                       brume_passes::fetch("sky"),
                                       brume_passes::write("result"),
                                       brume_passes::write("transmittance_out"),
                                       brume_passes::write("optical_depth_out"),
                                       brume_passes::write("scattered_out"),
                                       brume_passes::write("blur_radius_out")};
}  // namespace calibrated_compose_pass

// The passes' halves for the CPU.
struct CalibratedRows {
    brume_rows_function spread, share, smooth, collect, compose;
};
const CalibratedRows &calibrated_rows_of_this_machine();

SpreadSource source_of(const State &state, const brume_plugin_scene &scene);
brume::maths_float::Calibrated calibrated_of(const State &state, const brume_plugin_scene &scene, const SpreadSource &tabled,
                                             uint32_t visible_lights);

// Texels of a level of a picture of this size, of which `reduction` squared pixels are one texel of level 0.
brume::maths_float::Level level_at(brume::maths_float::ivec2 size, int reduction, int level);

}  // namespace multiscatter
