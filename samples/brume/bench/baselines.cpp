#include "bench/baselines.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <oneapi/tbb/parallel_for.h>

#include "bench/mip_pyramid.hpp"

namespace brume::tool {
namespace {

/// Half a width of the three boxes whose repeated average has nearly the Gaussian's deviation.
int box_radius(double deviation)
{
    return std::max(1, int(std::lround((std::sqrt(4 * deviation * deviation + 1) - 1) / 2)));
}

/// The average over 2 radius + 1 pixels along a line of `count` pixels, `stride` floats apart; edges repeat.
void box(const float *from, float *to, int count, std::size_t stride, int radius)
{
    const auto at = [&](int i) { return from + std::size_t(std::clamp(i, 0, count - 1)) * stride; };
    double sum[3] = {};
    for (int i = -radius; i <= radius; ++i)
        for (int c = 0; c < 3; ++c)
            sum[c] += at(i)[c];
    for (int i = 0; i < count; ++i)
        for (int c = 0; c < 3; ++c) {
            to[std::size_t(i) * stride + std::size_t(c)] = float(sum[c] / (2 * radius + 1));
            sum[c] += double(at(i + radius + 1)[c]) - at(i - radius)[c];
        }
}

/// A Gaussian blur as plug-ins approximate it: three boxes each way.
Picture blurred(const Picture &image, double deviation)
{
    Picture a = image, b = image;
    const int radius = box_radius(deviation);
    const std::size_t row = 3 * std::size_t(image.width);
    for (int pass = 0; pass < 3; ++pass) {
        oneapi::tbb::parallel_for(0, image.height, [&](int y) {
            box(a.rgb.data() + std::size_t(y) * row, b.rgb.data() + std::size_t(y) * row, image.width, 3, radius);
        });
        oneapi::tbb::parallel_for(0, image.width, [&](int x) {
            box(b.rgb.data() + 3 * std::size_t(x), a.rgb.data() + 3 * std::size_t(x), image.height, row, radius);
        });
    }
    return a;
}

/// out = T image + (1 - T) fog, in rows; `fog` gives RGB of a pixel.
template <class Fog> void lerp(const BaselineInput &in, Picture &out, const Fog &fog)
{
    const std::size_t width = std::size_t(in.image.width);
    oneapi::tbb::parallel_for(std::size_t(0), std::size_t(in.image.height), [&](std::size_t y) {
        for (std::size_t i = y * width; i < (y + 1) * width; ++i) {
            const float t = in.transmittance[i];
            const std::array<float, 3> colour = fog(i);
            for (std::size_t c = 0; c < 3; ++c)
                out.rgb[3 * i + c] = t * in.image.rgb[3 * i + c] + (1 - t) * colour[c];
        }
    });
}

std::array<float, 3> mean_colour(const Picture &image)
{
    double sum[3] = {};
    for (std::size_t i = 0; i < image.rgb.size(); ++i)
        if (std::isfinite(image.rgb[i]))
            sum[i % 3] += image.rgb[i];
    std::array<float, 3> mean;
    for (std::size_t c = 0; c < 3; ++c)
        mean[c] = float(3 * sum[c] / double(image.rgb.size()));
    return mean;
}

void gl_fog(const BaselineInput &in, Picture &out)
{
    const std::array<float, 3> mean = mean_colour(in.image);
    lerp(in, out, [&](std::size_t) { return mean; });
}

void global_blur(const BaselineInput &in, Picture &out)
{
    const Picture blur = blurred(in.image, in.image.height / 20.0);
    lerp(in, out, [&](std::size_t i) {
        return std::array<float, 3>{blur.rgb[3 * i], blur.rgb[3 * i + 1], blur.rgb[3 * i + 2]};
    });
}

void mip_blur(const BaselineInput &in, Picture &out)
{
    const std::array<float, 3> mean = mean_colour(in.image);
    const MipPyramid pyramid(in.image, 10 * (0.2126f * mean[0] + 0.7152f * mean[1] + 0.0722f * mean[2]));
    const int width = in.image.width;
    lerp(in, out, [&](std::size_t i) {
        // The variance that Premoze et al. (2004) give a pencil of light over a distance s without absorption, g 0: s^2 tau
        // / 8.
        const double tau = -std::log(std::max(in.transmittance[i], 1e-30f));
        const double deviation = in.focal * std::sqrt(tau / 8);
        return pyramid.at(int(i % std::size_t(width)), int(i / std::size_t(width)),
                          float(std::log2(std::max(deviation, 1.0))));
    });
}

void one_fetch(const BaselineInput &in, Picture &out)
{
    Picture fogged = in.image;
    gl_fog(in, fogged);
    const MipPyramid pyramid(fogged, INFINITY);
    const std::size_t width = std::size_t(in.image.width);
    oneapi::tbb::parallel_for(std::size_t(0), std::size_t(in.image.height), [&](std::size_t y) {
        for (std::size_t x = 0; x < width; ++x) {
            const std::size_t i = y * width + x;
            const std::array<float, 3> seen = pyramid.at(int(x), int(y), 2 * (1 - in.transmittance[i]));
            std::copy(seen.begin(), seen.end(), out.rgb.begin() + std::ptrdiff_t(3 * i));
        }
    });
}

constexpr Baseline all[] = {
    {"OpenGL fog", "T image + (1 - T) c with c the image's mean colour: GL_EXP", gl_fog},
    {"global blur", "T image + (1 - T) blur, a Gaussian blur with a deviation of a twentieth of the image's height",
     global_blur},
    {"one fetch",
     "OpenGL fog, then one fetch a pixel from a pyramid of it, at level 2 (1 - T): after Unity HDRP's multiple scattering "
     "at its "
     "largest intensity",
     one_fetch},
    {"mip blur",
     "T image + (1 - T) blur from a pyramid of halved images, each blurred by 5 x 5 taps, bright pixels cut to ten times "
     "the mean, "
     "at the level of the width of Premoze et al. for albedo 1 and g 0: after the public description of Unreal 5.8's "
     "experimental screen-space fog scattering",
     mip_blur},
};

}  // namespace

std::span<const Baseline> baselines()
{
    return all;
}

}  // namespace brume::tool
