#include "state.h"

#include <algorithm>
#include <cmath>

namespace multiscatter {

using namespace brume::maths_float;

namespace {

// Widest W_px at any distance: f sqrt(kappa P / (8 + 4/3 a kappa P^2)) is largest at P^2 = 6 / (a kappa). Infinite without
// absorption.
double largest_blur(const brume_plugin_scene &scene)
{
    const brume_plugin_medium &m = *scene.medium;
    auto mean = [&](const float(&v)[3]) {
        return double(v[0]) * m.luminance[0] + double(v[1]) * m.luminance[1] + double(v[2]) * m.luminance[2];
    };
    double kappa = mean(m.scattering) * (1 - m.asymmetry), a = mean(m.absorption);
    if (kappa <= 0)
        return 0;
    if (a <= 0)
        return INFINITY;
    double focal = std::sqrt(double(scene.camera->focal[0]) * scene.camera->focal[1]), p = std::sqrt(6 / (a * kappa));
    return focal * std::sqrt(kappa * p / (8 + 4.0 / 3.0 * a * kappa * p * p));
}

}  // namespace

Filter filter_of(const State &state, const brume_plugin_scene &scene, uint32_t visible_lights)
{
    Filter f = state.parameters.filter;
    f.top = state.top;
    f.lights = state.beside_lights ? int(visible_lights) : 0;
    f.all_orders = state.beside_all_orders;
    // One level more than the blur asks for, since the cubic interpolation between levels reaches that far.
    double blur = largest_blur(scene) * (f.placement ? std::sqrt(3.0) : 1.0);
    if (std::isfinite(blur))
        f.top = std::clamp(int(std::ceil(std::log2(std::max(blur, 1e-6) / f.scale))) + 2, std::min(1, state.top), state.top);
    f.separation_level = std::min(float(state.parameters.separation_fraction * state.top), float(f.top));
    return f;
}

}  // namespace multiscatter
