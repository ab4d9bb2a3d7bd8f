#include "colour/primaries.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <ImathMatrix.h>

namespace brume::tool {
namespace {

namespace ocio = OCIO_NAMESPACE;
using Imath::M33d;
using Imath::V2f;
using Imath::V3d;

const Chromaticities kAp0{{0.7347f, 0.2653f}, {0.0f, 1.0f}, {0.0001f, -0.077f}, {0.32168f, 0.33767f}};

const Chromaticities kKnown[] = {kAp0,
                                 {{0.713f, 0.293f}, {0.165f, 0.830f}, {0.128f, 0.044f}, {0.32168f, 0.33767f}},  // AP1
                                 {{0.640f, 0.330f}, {0.300f, 0.600f}, {0.150f, 0.060f}, {0.3127f, 0.3290f}},    // Rec. 709
                                 {{0.708f, 0.292f}, {0.170f, 0.797f}, {0.131f, 0.046f}, {0.3127f, 0.3290f}},    // Rec. 2020
                                 {{0.680f, 0.320f}, {0.265f, 0.690f}, {0.150f, 0.060f}, {0.3127f, 0.3290f}},    // P3-D65
                                 {{0.640f, 0.330f}, {0.210f, 0.710f}, {0.150f, 0.060f}, {0.3127f, 0.3290f}}};   // Adobe RGB

V3d xyz_of(const V2f &xy)
{
    return V3d(double(xy.x), double(xy.y), 1 - double(xy.x) - double(xy.y)) / double(xy.y);
}

V2f xy_of(const V3d &xyz)
{
    const double sum = xyz.x + xyz.y + xyz.z;
    return {float(xyz.x / sum), float(xyz.y / sum)};
}

/// Imath's vectors are rows.
M33d bradford(const V3d &from, const V3d &to)
{
    const M33d cone = M33d(0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296).transposed();
    const V3d a = from * cone, b = to * cone;
    M33d scale;
    for (int i = 0; i < 3; ++i)
        scale[i][i] = b[i] / a[i];
    return cone * scale * cone.inverse();
}

/// With the white that ACES has, as conversions to AP0 leave them.
Chromaticities adapted(const Chromaticities &c)
{
    const M33d m = bradford(xyz_of(c.white), xyz_of(kAp0.white));
    const auto through = [&](const V2f &xy) {
        return xy_of(V3d(double(xy.x), double(xy.y), 1 - double(xy.x) - double(xy.y)) * m);
    };
    return {through(c.red), through(c.green), through(c.blue), kAp0.white};
}

double distance(const Chromaticities &a, const Chromaticities &b)
{
    return std::max(
        {(a.red - b.red).length(), (a.green - b.green).length(), (a.blue - b.blue).length(), (a.white - b.white).length()});
}

}  // namespace

std::optional<Chromaticities> primaries_of(const ocio::ConstConfigRcPtr &config, const char *space)
{
    const ocio::ConstColorSpaceRcPtr found = config->getColorSpace(space);
    if (!found || found->isData() || !config->hasRole("aces_interchange"))
        return std::nullopt;
    const auto to_ap0 = config->getProcessor(space, "aces_interchange")->getDefaultCPUProcessor();
    const M33d ap0_to_xyz =
        M33d(0.9525523959, 0, 0.0000936786, 0.3439664498, 0.7281660966, -0.0721325464, 0, 0, 1.0088251844).transposed();
    const auto xyz = [&](std::array<float, 3> rgb) {
        to_ap0->applyRGB(rgb.data());
        return V3d(double(rgb[0]), double(rgb[1]), double(rgb[2])) * ap0_to_xyz;
    };
    const V3d red = xyz({1, 0, 0}), green = xyz({0, 1, 0}), blue = xyz({0, 0, 1}), white = xyz({1, 1, 1});
    // Of a curve, the primaries at one height say nothing.
    if ((red + green + blue - white).length() > 1e-3 || (4.0 * xyz({0.25f, 0.25f, 0.25f}) - white).length() > 1e-3)
        return std::nullopt;
    const Chromaticities seen{xy_of(red), xy_of(green), xy_of(blue), xy_of(white)};
    for (const V2f &v : {seen.red, seen.green, seen.blue, seen.white})
        if (!std::isfinite(v.x) || !std::isfinite(v.y))
            return std::nullopt;
    constexpr double kSame = 2e-3;
    for (const Chromaticities &known : kKnown)
        if (distance(adapted(known), seen) < kSame)
            return known;
    return seen;
}

std::optional<LuminanceWeights> luminance_of(const Chromaticities &c)
try {
    const V3d red = xyz_of(c.red), green = xyz_of(c.green), blue = xyz_of(c.blue);
    // Each primary has the luminance 1 here, so these shares are what they add to the white's.
    const V3d shares =
        xyz_of(c.white) * M33d(red.x, red.y, red.z, green.x, green.y, green.z, blue.x, blue.y, blue.z).inverse(true);
    const double sum = shares.x + shares.y + shares.z;
    if (!(sum > 0) || !std::isfinite(sum))
        return std::nullopt;
    return LuminanceWeights{shares.x, shares.y, shares.z};
} catch (const std::exception &) {
    return std::nullopt;  // they lie on one line
}

}  // namespace brume::tool
