#include "maps/sizes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "maps/slices.h"
#include "scene_arrays.hpp"

namespace airlight::maps {

Fineness fineness_of(double max_error)
{
    if (max_error > 0.05)
        return {0.9, 0.8, 48, 64, 24, 0.4, 0.5, 0.015};
    if (max_error >= 0.005)
        return {0.5, 2, 64, 128, 64, 0.2, 0.2, 0.0016};
    return {0.35, 2.8, 128, 256, 64, 0.1, 0.12, 0.0015};
}

Sizes sizes_of(const brume_plugin_scene &scene, int width, int height, int least_cell, const Fineness &fineness,
               uint64_t most_bytes)
{
    // A Gaussian's deviation on the screen, of the tenth part that are the smallest.
    double deviation = width / 120.0;
    if (scene.gaussians && scene.gaussian_count > 0) {
        // Noise bends rays at Gaussians, by its own wavelength and not by theirs.
        const float(&noise)[4] = scene.medium->noise;
        const double of_noise = noise[0] > 0 ? 0.35 / double(noise[1]) : std::numeric_limits<double>::infinity();
        // Of pixels that are no squares the wider side.
        const double focal = double(std::min(scene.camera->focal[0], scene.camera->focal[1]));
        static thread_local std::vector<double> all;  // frames allocate nothing once warm
        all.clear();
        for (const brume_plugin_gaussian &g : brume::gaussians_in(scene)) {
            const double distance = std::hypot(g.center[0], g.center[1], g.center[2]);
            if (-g.center[2] + 2 / g.scale > 0)
                all.push_back(focal * 0.7071 / std::max(double(g.scale) * distance, 1.0) *
                              std::min(of_noise * double(g.scale), 1.0));
        }
        if (!all.empty()) {
            const auto tenth = all.begin() + std::ptrdiff_t(all.size() / 10);
            std::nth_element(all.begin(), tenth, all.end());
            deviation = *tenth;
        }
    }
    Sizes sizes{};
    sizes.slices = wanted_slices(scene, fineness);
    // Many small cells serve no one: beyond a sixtieth of the picture a lamp's own cells would be too wide.
    const double cell = std::clamp(deviation * fineness.cell, 1.0, std::max(1.0, width / 60.0));
    sizes.cell = std::max(1 << int(std::floor(std::log2(cell))), least_cell);
    auto bytes = [&] {
        const uint64_t columns = uint64_t((width + sizes.cell - 1) / sizes.cell + 1),
                       rows = uint64_t((height + sizes.cell - 1) / sizes.cell + 1);
        return columns * rows * uint64_t(sizes.slices + 1) * 32;
    };
    while ((sizes.bytes = bytes()) > most_bytes && sizes.cell < std::max(width, height))
        sizes.cell *= 2;
    sizes.fine = sizes.cell <= 1.6 * fineness.cell * deviation && sizes.slices < most_slices;
    return sizes;
}

}  // namespace airlight::maps
