#include "scene/scene_check.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/scene_ranges.h"
#include "scene/fields.h"

namespace brume {
namespace {

constexpr double rigid_tolerance = 1e-3;

[[noreturn]] void refuse(double value, const Range &range, const std::string &name)
{
    throw Error(BRUME_ERROR_ARGUMENT, fmt::format("{}: {}; expected {}", name, value, range.describe()));
}

void check(double value, const Range &range, const ValueName &name)
{
    if (!range.contains(value))
        refuse(value, range, name.text());
}

template <class T> void check_fields(const T &value, Fields<T> fields, uint32_t kind, const ValueName &prefix)
{
    each_number(value, fields, kind, [&](const Field<T> &field, const Number &number, int index) {
        const double unit = field.has(degrees) ? degree : 1.0;
        const Range range{field.range.minimum * unit, field.range.maximum * unit, field.range.open};
        for (const auto &key : number.keys())
            if (!range.contains(key.second))
                refuse(key.second, range, prefix.text() + field.key + (index < 0 ? "" : fmt::format("[{}]", index)));
    });
}

void check_direction(const Number3 &direction, const ValueName &name)
{
    if (std::all_of(direction.begin(), direction.end(), [](const Number &n) { return n.at(0) == 0; }))
        throw Error(BRUME_ERROR_ARGUMENT, name.text() + ": (0, 0, 0); expected a direction");
}

}  // namespace

std::string rigid_defect(const std::array<double, 16> &m)
{
    for (size_t column = 0; column < 4; ++column)
        if (m[12 + column] != (column == 3 ? 1.0 : 0.0))
            return fmt::format("last row {} {} {} {}", m[12], m[13], m[14], m[15]);
    for (size_t a = 0; a < 3; ++a) {
        for (size_t b = a; b < 3; ++b) {
            const double product = m[a] * m[b] + m[4 + a] * m[4 + b] + m[8 + a] * m[8 + b];
            if (!(std::abs(product - (a == b)) <= rigid_tolerance))
                return a == b ? fmt::format("column {} has length {:.6g}", a, std::sqrt(product))
                              : fmt::format("columns {} and {} have the product {:.6g}", a, b, product);
        }
    }
    const double determinant =
        m[0] * (m[5] * m[10] - m[6] * m[9]) - m[1] * (m[4] * m[10] - m[6] * m[8]) + m[2] * (m[4] * m[9] - m[5] * m[8]);
    return determinant > 0.0 ? "" : "it mirrors: its determinant is negative";
}

void check_medium(const Medium &medium)
{
    check_fields(medium, medium_fields, ~0u, "medium.");
    check_fields(medium.noise, noise_fields, ~0u, "medium.noise_");
    size_t exponential = 0;
    for (size_t i = 0; i < medium.density.size(); ++i) {
        const DensityTerm &term = medium.density[i];
        const ValueName name("medium.terms", int64_t(i));
        if (term.type != BRUME_DENSITY_CONSTANT && term.type != BRUME_DENSITY_EXPONENTIAL)
            throw Error(BRUME_ERROR_ARGUMENT,
                        fmt::format("{}.type: {}; expected a BRUME_DENSITY_...", name.text(), term.type));
        check_fields(term, density_fields, 1u << term.type, name.of("."));
        if (term.type != BRUME_DENSITY_EXPONENTIAL)
            continue;
        ++exponential;
        check_direction(term.direction, name.of(".direction"));
    }
    if (exponential > BRUME_MAX_DENSITY_TERMS)
        throw Error(BRUME_ERROR_ARGUMENT, fmt::format("medium.terms: {} exponential ones; expected at most {}", exponential,
                                                      BRUME_MAX_DENSITY_TERMS));
}

void check_gaussian(const Gaussian &gaussian, const ValueName &name)
{
    static constexpr std::string_view centers[] = {".center[0]", ".center[1]", ".center[2]"},
                                      colors[] = {".color[0]", ".color[1]", ".color[2]"};
    for (size_t i = 0; i < 3; ++i) {
        check(gaussian.center[i], ranges::any, name.of(centers[i]));
        check(double(gaussian.color[i]), ranges::fraction, name.of(colors[i]));
    }
    check(gaussian.scale, ranges::positive, name.of(".scale"));
    check(gaussian.amplitude, ranges::not_negative, name.of(".amplitude"));
}

namespace {

void check_range(const LightShadow &shadow, const ValueName &name)
{
    const auto [first, last] = shadow.range;
    const bool parallel = shadow.kind == BRUME_SHADOW_ORTHOGRAPHIC;
    const bool right = parallel ? std::isfinite(first) && std::isfinite(last) : first > 0 && last > 0;
    if (!right || !(first < last || first > last))
        throw Error(BRUME_ERROR_ARGUMENT,
                    fmt::format("{}.shadow_range: ({}, {}); expected {}", name.text(), first, last,
                                parallel ? "two finite distances that differ" : "two distances above 0 that differ"));
}

void check_shadow(const Light &light, const ValueName &name)
{
    const LightShadow &shadow = light.shadow;
    if (shadow.kind == BRUME_SHADOW_NONE)
        return;
    const bool parallel = light.type == BRUME_LIGHT_DIRECTIONAL;
    const bool around = shadow.kind == BRUME_SHADOW_LATLONG;
    if (shadow.kind == BRUME_SHADOW_SCREEN && !parallel)
        return;
    if (shadow.kind != (parallel ? BRUME_SHADOW_ORTHOGRAPHIC : BRUME_SHADOW_PERSPECTIVE) && (parallel || !around))
        throw Error(BRUME_ERROR_ARGUMENT,
                    fmt::format("{}.shadow_kind: {}; expected BRUME_SHADOW_NONE or {}", name.text(), shadow.kind,
                                parallel ? "_ORTHOGRAPHIC for a directional light"
                                         : "_PERSPECTIVE, _LATLONG or _SCREEN for a point or spot light"));
    if (shadow.depth != BRUME_DEPTH_PLANAR && shadow.depth != BRUME_DEPTH_RAY && shadow.depth != BRUME_DEPTH_DEVICE)
        throw Error(BRUME_ERROR_ARGUMENT, fmt::format("{}.shadow_depth: {}; expected BRUME_DEPTH_PLANAR, _RAY or _DEVICE",
                                                      name.text(), shadow.depth));
    if (shadow.depth == BRUME_DEPTH_DEVICE)
        check_range(shadow, name);
    if (around && shadow.depth != BRUME_DEPTH_RAY)
        throw Error(BRUME_ERROR_ARGUMENT, fmt::format("{}.shadow_depth: {}; expected BRUME_DEPTH_RAY of a map all around",
                                                      name.text(), shadow.depth));
    if (!around)
        check(shadow.extent.at(0), parallel ? ranges::positive : ranges::shadow_angle, name.of(".shadow_extent"));
    std::array<double, 16> matrix;
    for (size_t i = 0; i < 16; ++i) {
        matrix[i] = shadow.to_world[i].at(0);
        if (!ranges::any.contains(matrix[i]))
            refuse(matrix[i], ranges::any, fmt::format("{}.shadow_to_world[{}]", name.text(), i));
    }
    if (const std::string defect = rigid_defect(matrix); !defect.empty())
        throw Error(BRUME_ERROR_ARGUMENT,
                    fmt::format("{}.shadow_to_world: {}; expected a rigid motion", name.text(), defect));
}

}  // namespace

void check_light(const Light &light, const ValueName &name)
{
    check_shadow(light, name);
    if (light.surfaces > BRUME_SURFACES_UNLIT)
        throw Error(BRUME_ERROR_ARGUMENT,
                    fmt::format("{}.surfaces: {}; expected a BRUME_SURFACES_...", name.text(), light.surfaces));
    if (light.type > BRUME_LIGHT_DIRECTIONAL)
        throw Error(BRUME_ERROR_ARGUMENT, fmt::format("{}.type: {}; expected a BRUME_LIGHT_...", name.text(), light.type));
    check_fields(light, light_fields, 1u << light.type, name.of("."));
    if (light.type != BRUME_LIGHT_POINT)
        check_direction(light.direction, name.of(".direction"));
}

void check_environment(const Environment &environment)
{
    const auto &coefficients = environment.coefficients;
    for (size_t i = 0; i < coefficients.size(); ++i)
        for (size_t channel = 0; channel < 3; ++channel)
            if (!ranges::any.contains(coefficients[i][channel]))
                refuse(coefficients[i][channel], ranges::any, fmt::format("environment[{}][{}]", i, channel));
}

}  // namespace brume
