#include "bench/baselines.hpp"

#include <algorithm>
#include <cmath>

#include <oneapi/tbb/parallel_for.h>

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
            const float t = in.transmittance[i], *colour = fog(i);
            for (std::size_t c = 0; c < 3; ++c)
                out.rgb[3 * i + c] = t * in.image.rgb[3 * i + c] + (1 - t) * colour[c];
        }
    });
}

void gl_fog(const BaselineInput &in, Picture &out)
{
    double sum[3] = {};
    for (std::size_t i = 0; i < in.image.rgb.size(); ++i)
        if (std::isfinite(in.image.rgb[i]))
            sum[i % 3] += in.image.rgb[i];
    float mean[3];
    for (int c = 0; c < 3; ++c)
        mean[c] = float(3 * sum[c] / double(in.image.rgb.size()));
    lerp(in, out, [&](std::size_t) { return mean; });
}

void global_blur(const BaselineInput &in, Picture &out)
{
    const Picture blur = blurred(in.image, in.image.height / 20.0);
    lerp(in, out, [&](std::size_t i) { return blur.rgb.data() + 3 * i; });
}

constexpr Baseline all[] = {
    {"OpenGL fog", "T image + (1 - T) c with c the image's mean colour: GL_EXP", gl_fog},
    {"global blur", "T image + (1 - T) blur, a Gaussian blur with a deviation of a twentieth of the image's height",
     global_blur},
};

}  // namespace

std::span<const Baseline> baselines()
{
    return all;
}

}  // namespace brume::tool
