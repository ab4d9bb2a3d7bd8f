#include "gaussians/gaussian_columns.h"

#include <array>

#include <fmt/format.h>

#include "base/error.h"
#include "base/scene_ranges.h"
#include "base/text.h"

namespace brume {
namespace {

enum Field : size_t { x, y, z, scale, radius, amplitude, red, green, blue, field_count };

struct Name {
    const char *name;
    Field field;
};

constexpr Name known_names[] = {{"x", x},
                                {"y", y},
                                {"z", z},
                                {"scale", scale},
                                {"radius", radius},
                                {"amplitude", amplitude},
                                {"density", amplitude},
                                {"r", red},
                                {"g", green},
                                {"b", blue},
                                {"red", red},
                                {"green", green},
                                {"blue", blue}};

const Range &range_of(size_t field)
{
    if (field <= z)
        return ranges::any;
    if (field <= radius)
        return ranges::positive;
    return field == amplitude ? ranges::not_negative : ranges::fraction;
}

std::string listed(const std::vector<std::string> &names)
{
    constexpr size_t most = 12;
    std::string text;
    for (size_t i = 0; i < names.size() && i < most; ++i)
        text += (i ? ", " : "") + in_quotes(names[i]);
    return names.size() > most ? text + ", ..." : text;
}

}  // namespace

GaussianColumns::GaussianColumns(std::vector<std::string> names, const std::string &place) : names_(std::move(names))
{
    std::array<bool, field_count> present{};
    for (const std::string &name : names_) {
        std::optional<size_t> field;
        for (const Name &known : known_names)
            if (name == known.name)
                field = known.field;
        if (field && present[*field])
            throw Error(BRUME_ERROR_SCENE, fmt::format("{}: column {} is there twice", place, in_quotes(name)));
        if (field)
            present[*field] = true;
        fields_.push_back(field);
    }
    if (!present[x] || !present[y] || !present[z] || !present[amplitude] || present[scale] == present[radius])
        throw Error(
            BRUME_ERROR_SCENE,
            fmt::format("{}: columns {}; expected x, y, z, amplitude, and one of scale and radius", place, listed(names_)));
    if (present[red] != present[green] || present[red] != present[blue])
        throw Error(BRUME_ERROR_SCENE,
                    fmt::format("{}: columns {}; expected r, g and b, or none of them", place, listed(names_)));
}

bool GaussianColumns::is_colour(size_t column) const
{
    return fields_[column] && *fields_[column] >= red;
}

bool GaussianColumns::take(Gaussian &gaussian, size_t column, double value) const
{
    if (!fields_[column])
        return true;
    const size_t field = *fields_[column];
    if (!range_of(field).contains(value))
        return false;
    if (field <= z)
        gaussian.center[field] = value;
    else if (field == scale)
        gaussian.scale = value;
    else if (field == radius)
        gaussian.scale = 1.0 / value;
    else if (field == amplitude)
        gaussian.amplitude = value;
    else
        gaussian.color[field - red] = float(value);
    return true;
}

void GaussianColumns::refuse(size_t column, double value, const std::string &place) const
{
    throw Error(BRUME_ERROR_SCENE,
                fmt::format("{}: {}: {}; expected {}", place, names_[column], value, range_of(*fields_[column]).describe()));
}

}  // namespace brume
