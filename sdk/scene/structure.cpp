#include "scene/structure.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace brume {
namespace {

double peak(const Number &number)
{
    double most = number.keys().front().second;
    for (const auto &key : number.keys())
        most = std::max(most, std::abs(key.second));
    return most;
}

bool grey(const Number3 &v)
{
    return v[0] == v[1] && v[1] == v[2];
}

}  // namespace

Structure::Structure(const Scene &scene, const Format &format)
{
    add("width", format.width);
    add("height", format.height);
    add("depth kind", format.depth_kind);
    add("a display window apart from the image", format.display_width != 0);
    add("lights", !scene.lights.empty());
    add("lights with a shadow map", std::any_of(scene.lights.begin(), scene.lights.end(),
                                                [](const Light &light) { return light.shadow.kind != BRUME_SHADOW_NONE; }));
    add("lights whose shadows are those of the picture's depth",
        std::any_of(scene.lights.begin(), scene.lights.end(),
                    [](const Light &light) { return light.shadow.kind == BRUME_SHADOW_SCREEN; }));
    add("environment coefficients", double(scene.environment.coefficients.size()));
    add("medium", scene.medium.has_value());
    if (!scene.medium)
        return;
    const Medium &medium = *scene.medium;
    static const char *const names[] = {
        "medium.scattering[0] above 0", "medium.scattering[1] above 0", "medium.scattering[2] above 0",
        "medium.absorption[0] above 0", "medium.absorption[1] above 0", "medium.absorption[2] above 0",
        "medium.emission[0] above 0",   "medium.emission[1] above 0",   "medium.emission[2] above 0"};
    const Number3 *const values[] = {&medium.scattering, &medium.absorption, &medium.emission};
    for (size_t i = 0; i < 9; ++i)
        add(names[i], peak((*values[i / 3])[i % 3]) > 0 || (i < 3 && medium.visibility));
    add("medium.visibility given", medium.visibility.has_value());
    add("medium.droplet_diameter given", medium.droplet_diameter.has_value());
    add("grey scattering", grey(medium.scattering) && (!medium.visibility || grey(medium.absorption)));
    add("grey absorption", grey(medium.absorption));
    bool constant = medium.density.empty() && medium.gaussians.empty() && medium.gaussian_sets.empty(), exponential = false;
    for (const DensityTerm &term : medium.density) {
        const bool varies = term.type == BRUME_DENSITY_EXPONENTIAL && peak(term.falloff) > 0;
        (varies ? exponential : constant) |= peak(term.value) > 0;
    }
    add("constant density", constant);
    add("exponential density", exponential);
    add("Gaussians", has_gaussians(scene));
}

std::string Structure::difference(const Structure &other) const
{
    for (int i = 0; i < std::max(count_, other.count_); ++i) {
        const Part &a = parts_[size_t(i)], &b = other.parts_[size_t(i)];
        if (a.value != b.value)
            return fmt::format("{}: {} when planned, {} now", a.name, a.value, b.value);
    }
    return {};
}

}  // namespace brume
