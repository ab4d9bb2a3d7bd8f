#include "transfer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "airlight/quadrature.h"
#include "scene_maths.hpp"

namespace surface {

using namespace brume::maths_double;

namespace {

constexpr int degrees = transfer_degrees - 1;

// Of a transfer whose only coefficient is this one; summed over the degrees it is y_lm.
double harmonic(int coefficient, const vec3 &d)
{
    Transfer transfer{};
    transfer.of[coefficient / 3][coefficient % 3] = 1;
    const Sent sent = sent_toward(transfer, degrees, d, 0);
    if (coefficient == 0)
        return sent.of[0];
    double sum = 0;
    for (int l = 1; l < degrees; ++l)
        sum += sent.of[l];
    return sum;
}

}  // namespace

std::vector<float> environment_in_camera(const brume_plugin_scene &scene)
{
    const int order = std::min(environment_order(scene), degrees);
    const Data world = environment_of(scene);
    std::vector<float> turned(world.values.size(), 0.0f);
    const Camera camera = camera_of(scene);
    // Exact for polynomials of twice the degree.
    constexpr int around = 4 * degrees;
    for (const auto &node : brume::airlight::gauss_legendre())
        for (int k = 0; k < around; ++k) {
            const double z = 2 * node.at - 1, s = std::sqrt((1 - z) * (1 + z)), phi = 2 * std::numbers::pi * k / around;
            const vec3 d(s * std::cos(phi), s * std::sin(phi), z);
            const Degrees seen = environment_degrees(world.texture(), order, in_world(camera, d));
            vec3 sum(0);
            for (int l = 0; l < order; ++l)
                sum += seen.of[l];
            for (int i = 0; i < order * order; ++i)
                for (int c = 0; c < 3; ++c)
                    turned[size_t(4 * i + c)] +=
                        float(4 * std::numbers::pi * node.weight / around * harmonic(i, d) * sum[c]);
        }
    return turned;
}

}  // namespace surface
