#pragma once
#include <span>

#include "maths.hpp"

namespace brume::airlight {

// What a reference ray looks through; in camera space, in double.
struct ReferenceScene {
    maths_double::Medium medium{};
    std::span<const maths_double::Gaussian> gaussians;
    std::span<const maths_double::Light> lights;
    maths_double::Camera camera{};  // its axes place the medium's noise
    int orders = maths_double::orders_single;
    std::span<const maths_double::Surroundings> around{};  // of each light; none: endless fog

    int shadowed = 0;  // 1: some light has a shadow map
    const maths_double::Texture *light_shadows = nullptr;
    const maths_double::Texture *shadow_maps = nullptr;
};

struct ReferenceAirlight {
    maths_double::vec3 radiance{};
    maths_double::vec3 error{};  // bound claimed by the quadrature
    int evaluations = 0;
};

// The airlight integral (shaders/lib/airlight.glsl) of lights [first_light, last_light) along the ray from the camera by
// adaptive Gauss-Kronrod quadrature, over all Gaussians, to `tolerance` of itself; distance 0 to far_away. It stops after a
// bounded number of evaluations and then says a larger error.
ReferenceAirlight reference_airlight(const ReferenceScene &scene, maths_double::vec3 direction, double distance,
                                     int first_light, int last_light, double tolerance = 1e-8);

}  // namespace brume::airlight
