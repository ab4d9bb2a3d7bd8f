#include "compare/difference.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "exr/new_file.hpp"
#include "image/write.hpp"
#include "support/error.hpp"

namespace brume::tool {
namespace {

std::vector<float> absolute_difference(const Picture &a, const Picture &b)
{
    std::vector<float> difference(a.rgb.size());
    std::transform(a.rgb.begin(), a.rgb.end(), b.rgb.begin(), difference.begin(),
                   [](float x, float y) { return std::abs(x - y); });
    return difference;
}

void write_exr(const std::string &path, const Picture &where, const std::vector<float> &rgb)
{
    const Window window{{where.x, where.y}, {where.x + where.width - 1, where.y + where.height - 1}};
    NewPicture picture{window, window};
    for (std::size_t c = 0; c < 3; ++c)
        picture.channels.push_back({std::string(1, "RGB"[c]), SampleType::kFloat, rgb.data() + c, 3});
    write_new_exr(path, picture);
}

}  // namespace

void check_difference_name(const std::string &path)
{
    if (!path.ends_with(".exr") && !path.ends_with(".png"))
        throw RequestError(fmt::format("--difference '{}': expected a name ending in .png or .exr", path));
    if (path.ends_with(".png"))
        image_library();
}

void write_difference(const std::string &path, const Picture &a, const Picture &b, double largest)
{
    const auto difference = absolute_difference(a, b);
    if (path.ends_with(".exr"))
        return write_exr(path, a, difference);
    Display shown{a.width, a.height, std::vector<std::uint8_t>(difference.size())};
    std::transform(difference.begin(), difference.end(), shown.rgb.begin(), [&](float d) {
        if (!std::isfinite(d))
            return std::uint8_t(255);
        return std::uint8_t(std::lround(255 * std::sqrt(largest > 0 ? std::min(1.0, d / largest) : 0.0)));
    });
    write_display(shown, path);
}

}  // namespace brume::tool
