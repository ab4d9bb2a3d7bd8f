#include "bench/mip_pyramid.hpp"

#include <algorithm>
#include <cmath>

#include <oneapi/tbb/parallel_for.h>

namespace brume::tool {
namespace {

const float *pixel(const Picture &p, int x, int y)
{
    x = std::clamp(x, 0, p.width - 1);
    y = std::clamp(y, 0, p.height - 1);
    return p.rgb.data() + 3 * (std::size_t(y) * std::size_t(p.width) + std::size_t(x));
}

template <class Value> Picture filled(int width, int height, const Value &value)
{
    Picture out;
    out.width = width;
    out.height = height;
    out.rgb.resize(3 * std::size_t(width) * std::size_t(height));
    oneapi::tbb::parallel_for(0, height, [&](int y) {
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c)
                out.rgb[3 * (std::size_t(y) * std::size_t(width) + std::size_t(x)) + std::size_t(c)] = value(x, y, c);
    });
    return out;
}

Picture halved(const Picture &p)
{
    return filled((p.width + 1) / 2, (p.height + 1) / 2, [&](int x, int y, int c) {
        return 0.25f * (pixel(p, 2 * x, 2 * y)[c] + pixel(p, 2 * x + 1, 2 * y)[c] + pixel(p, 2 * x, 2 * y + 1)[c] +
                        pixel(p, 2 * x + 1, 2 * y + 1)[c]);
    });
}

Picture smoothed(const Picture &p)
{
    constexpr float taps[5] = {1 / 16.f, 4 / 16.f, 6 / 16.f, 4 / 16.f, 1 / 16.f};
    const Picture across = filled(p.width, p.height, [&](int x, int y, int c) {
        float sum = 0;
        for (int i = 0; i < 5; ++i)
            sum += taps[i] * pixel(p, x + i - 2, y)[c];
        return sum;
    });
    return filled(p.width, p.height, [&](int x, int y, int c) {
        float sum = 0;
        for (int i = 0; i < 5; ++i)
            sum += taps[i] * pixel(across, x, y + i - 2)[c];
        return sum;
    });
}

Picture capped(const Picture &p, float most)
{
    Picture out = p;
    for (std::size_t i = 0; i + 2 < out.rgb.size(); i += 3) {
        float *rgb = out.rgb.data() + i;
        const float luminance = 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2];
        if (luminance > most)
            for (int c = 0; c < 3; ++c)
                rgb[c] *= most / luminance;
    }
    return out;
}

std::array<float, 3> between_pixels(const Picture &p, float x, float y)
{
    const int x0 = int(std::floor(x)), y0 = int(std::floor(y));
    const float fx = x - float(x0), fy = y - float(y0);
    const float *a = pixel(p, x0, y0), *b = pixel(p, x0 + 1, y0), *c = pixel(p, x0, y0 + 1), *d = pixel(p, x0 + 1, y0 + 1);
    std::array<float, 3> out;
    for (std::size_t i = 0; i < 3; ++i)
        out[i] = (a[i] * (1 - fx) + b[i] * fx) * (1 - fy) + (c[i] * (1 - fx) + d[i] * fx) * fy;
    return out;
}

}  // namespace

MipPyramid::MipPyramid(const Picture &image, float luminance_cap)
{
    levels_.push_back(image);
    if (image.width > 1 || image.height > 1)
        levels_.push_back(smoothed(halved(capped(image, luminance_cap))));
    while (levels_.back().width > 1 || levels_.back().height > 1)
        levels_.push_back(smoothed(halved(levels_.back())));
}

std::array<float, 3> MipPyramid::at(int x, int y, float level) const
{
    const int last = int(levels_.size()) - 1;
    const int lower = std::clamp(int(level), 0, last), upper = std::min(lower + 1, last);
    const float share = level - float(lower);
    const auto fetch = [&](int l) {
        const float scale = std::ldexp(1.f, -l);
        return between_pixels(levels_[std::size_t(l)], (float(x) + 0.5f) * scale - 0.5f, (float(y) + 0.5f) * scale - 0.5f);
    };
    std::array<float, 3> out = fetch(lower);
    if (share > 0 && upper > lower) {
        const std::array<float, 3> next = fetch(upper);
        for (std::size_t c = 0; c < 3; ++c)
            out[c] += (next[c] - out[c]) * std::min(share, 1.f);
    }
    return out;
}

}  // namespace brume::tool
