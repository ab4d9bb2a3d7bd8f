#include "metrics/flip.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <numbers>

#include <oneapi/tbb/parallel_for.h>

namespace brume::tool {
namespace {

constexpr float kPixelsPerDegree = 67;
constexpr float kPi = std::numbers::pi_v<float>;

using Color = std::array<float, 3>;
using Channel = std::vector<float>;

struct Image {
    int width, height;
    std::array<Channel, 3> channels;

    Image(int w, int h) : width(w), height(h)
    {
        for (Channel &c : channels)
            c.resize(std::size_t(w) * std::size_t(h));
    }
    Color at(std::size_t i) const { return {channels[0][i], channels[1][i], channels[2][i]}; }
    void set(std::size_t i, const Color &color)
    {
        for (std::size_t c = 0; c < 3; ++c)
            channels[c][i] = color[c];
    }
};

// ---- colour: linear Rec.709, XYZ relative to the white of (1, 1, 1), YCxCz (CIELAB without its cube root), CIELAB

constexpr float kToXyz[3][3] = {{0.41238656f, 0.35759142f, 0.18045049f},
                                {0.21263682f, 0.71518298f, 0.07218020f},
                                {0.01933062f, 0.11919716f, 0.95037259f}};
constexpr float kFromXyz[3][3] = {{3.24100304f, -1.53739856f, -0.49861587f},
                                  {-0.96922419f, 1.87592986f, 0.04155422f},
                                  {0.05563941f, -0.20401119f, 1.05714897f}};

Color times(const float (&m)[3][3], const Color &v)
{
    Color out;
    for (std::size_t i = 0; i < 3; ++i)
        out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
    return out;
}

const Color &white()
{
    static const Color xyz = times(kToXyz, {1, 1, 1});
    return xyz;
}

Color relative_xyz(const Color &rgb)
{
    Color xyz = times(kToXyz, rgb);
    for (std::size_t i = 0; i < 3; ++i)
        xyz[i] /= white()[i];
    return xyz;
}

Color opponent(const Color &xyz)
{
    return {116 * xyz[1] - 16, 500 * (xyz[0] - xyz[1]), 200 * (xyz[1] - xyz[2])};
}

Color rgb_of_opponent(const Color &ycc)
{
    const float y = (ycc[0] + 16) / 116;
    return times(kFromXyz, {(y + ycc[1] / 500) * white()[0], y * white()[1], (y - ycc[2] / 200) * white()[2]});
}

/// With Hunt's effect: chroma counts less where it is dark.
Color hunt_lab(const Color &rgb)
{
    Color f = relative_xyz(rgb);
    constexpr float delta = 6.0f / 29;
    for (float &t : f)
        t = t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0f / 29;
    const Color lab = opponent(f);
    return {lab[0], 0.01f * lab[0] * lab[1], 0.01f * lab[0] * lab[2]};
}

float hyab(const Color &a, const Color &b)
{
    return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

// ---- filters

/// Beyond the border the outermost pixels go on. Sums run over whole rows, which the compiler makes vectors of.
Channel filtered(const Channel &in, int width, int height, const std::vector<float> &along_x,
                 const std::vector<float> &along_y)
{
    const std::size_t w = std::size_t(width), taps = along_x.size(), radius = taps / 2;
    Channel rows(in.size()), out(in.size());
    oneapi::tbb::parallel_for(std::size_t(0), std::size_t(height), [&](std::size_t y) {
        const float *row = in.data() + y * w;
        Channel padded(radius, row[0]);
        padded.insert(padded.end(), row, row + w);
        padded.insert(padded.end(), radius, row[w - 1]);
        for (std::size_t k = 0; k < taps; ++k)
            for (std::size_t x = 0; x < w; ++x)
                rows[y * w + x] += along_x[k] * padded[x + k];
    });
    oneapi::tbb::parallel_for(0, height, [&](int y) {
        for (std::size_t k = 0; k < taps; ++k) {
            const float *row = rows.data() + std::size_t(std::clamp(y + int(k) - int(radius), 0, height - 1)) * w;
            float *to = out.data() + std::size_t(y) * w;
            for (std::size_t x = 0; x < w; ++x)
                to[x] += along_y[k] * row[x];
        }
    });
    return out;
}

template <class Function> std::vector<float> kernel_of(int radius, Function &&function)
{
    std::vector<float> kernel;
    for (int k = -radius; k <= radius; ++k)
        kernel.push_back(function(float(k)));
    return kernel;
}

/// Weights of each sign are made to sum to 1.
void normalize(std::vector<float> &kernel)
{
    float positive = 0, negative = 0;
    for (const float v : kernel)
        (v > 0 ? positive : negative) += std::abs(v);
    for (float &v : kernel)
        v /= v > 0 ? positive : negative > 0 ? negative : 1;
}

struct Gaussian {
    float a, b;  ///< of a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees
};

/// Contrast sensitivity of an opponent channel, as a sum of Gaussians of x^2 + y^2.
Channel seen(const Channel &in, int width, int height, std::initializer_list<Gaussian> sensitivity)
{
    constexpr float widest = 0.04f;
    const int radius = int(std::ceil(3 * std::sqrt(widest / (2 * kPi * kPi)) * kPixelsPerDegree));
    Channel out(in.size(), 0.0f);
    float total = 0;
    for (const Gaussian &g : sensitivity) {
        auto kernel = kernel_of(radius, [&](float k) {
            const float x = k / kPixelsPerDegree;
            return std::exp(-kPi * kPi * x * x / g.b);
        });
        float sum = 0;
        for (const float v : kernel)
            sum += v;
        const float weight = g.a * std::sqrt(kPi / g.b) * sum * sum;
        normalize(kernel);
        const Channel part = filtered(in, width, height, kernel, kernel);
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] += weight * part[i];
        total += weight;
    }
    for (float &v : out)
        v /= total;
    return out;
}

/// As the eye resolves it at that distance; back in linear RGB, and from there in Hunt-adjusted CIELAB.
Image perceived(const Image &ycc)
{
    Image out(ycc.width, ycc.height);
    out.channels = {seen(ycc.channels[0], ycc.width, ycc.height, {{1, 0.0047f}}),
                    seen(ycc.channels[1], ycc.width, ycc.height, {{1, 0.0053f}}),
                    seen(ycc.channels[2], ycc.width, ycc.height, {{34.1f, 0.04f}, {13.5f, 0.025f}})};
    oneapi::tbb::parallel_for(std::size_t(0), std::size_t(out.height), [&](std::size_t y) {
        for (std::size_t i = y * std::size_t(out.width); i < (y + 1) * std::size_t(out.width); ++i) {
            Color rgb = rgb_of_opponent(out.at(i));
            for (float &v : rgb)
                v = std::clamp(v, 0.0f, 1.0f);
            out.set(i, hunt_lab(rgb));
        }
    });
    return out;
}

struct Features {
    Channel edges, points;  ///< magnitudes
};

Features features_of(const Image &ycc)
{
    constexpr float width_in_degrees = 0.082f, sigma = 0.5f * width_in_degrees * kPixelsPerDegree;
    const int radius = int(std::ceil(3 * sigma)), w = ycc.width, h = ycc.height;
    const auto bell = [](float k) { return std::exp(-k * k / (2 * sigma * sigma)); };
    auto smooth = kernel_of(radius, bell);
    auto first = kernel_of(radius, [&](float k) { return -k * bell(k); });
    auto second = kernel_of(radius, [&](float k) { return (k * k / (sigma * sigma) - 1) * bell(k); });
    for (auto *kernel : {&smooth, &first, &second})
        normalize(*kernel);
    Channel grey = ycc.channels[0];
    for (float &v : grey)
        v = (v + 16) / 116;
    const auto magnitude = [&](const std::vector<float> &kernel) {
        Channel x = filtered(grey, w, h, kernel, smooth);
        const Channel y = filtered(grey, w, h, smooth, kernel);
        for (std::size_t i = 0; i < x.size(); ++i)
            x[i] = std::hypot(x[i], y[i]);
        return x;
    };
    return {magnitude(first), magnitude(second)};
}

// ---- the two differences and how they join

float largest_color_difference()
{
    static const float largest = std::pow(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), 0.7f);
    return largest;
}

float color_difference(const Color &a, const Color &b)
{
    const float d = std::pow(hyab(a, b), 0.7f), knee = 0.4f * largest_color_difference();
    return d < knee ? 0.95f * d / knee : 0.95f + 0.05f * (d - knee) / (largest_color_difference() - knee);
}

/// LDR-FLIP of each pixel, kept where it is larger than what is there.
void add_ldr_flip(const Image &a, const Image &r, Channel &largest)
{
    const Image seen_a = perceived(a), seen_r = perceived(r);
    const Features of_a = features_of(a), of_r = features_of(r);
    oneapi::tbb::parallel_for(std::size_t(0), std::size_t(a.height), [&](std::size_t y) {
        for (std::size_t i = y * std::size_t(a.width); i < (y + 1) * std::size_t(a.width); ++i) {
            const float color = color_difference(seen_a.at(i), seen_r.at(i));
            const float feature =
                std::max(std::abs(of_a.edges[i] - of_r.edges[i]), std::abs(of_a.points[i] - of_r.points[i]));
            const float flip = std::pow(color, 1 - std::sqrt(std::min(1.0f, feature / std::numbers::sqrt2_v<float>)));
            largest[i] = std::max(largest[i], flip);
        }
    });
}

// ---- exposures

/// (k0 x^2 + k1 x + k2) / (k3 x^2 + k4 x + k5): ACES as fitted by Narkowicz, with his exposure of .6.
constexpr float kAces[6] = {0.6f * 0.6f * 2.51f, 0.6f * 0.03f, 0, 0.6f * 0.6f * 2.43f, 0.6f * 0.59f, 0.14f};

float tone_mapped(float x)
{
    const float y = ((kAces[0] * x + kAces[1]) * x + kAces[2]) / ((kAces[3] * x + kAces[4]) * x + kAces[5]);
    return std::clamp(y, 0.0f, 1.0f);
}

/// Where the tone mapper gives .85.
float bright()
{
    const float t = 0.85f, a = kAces[0] - t * kAces[3], b = kAces[1] - t * kAces[4], c = kAces[2] - t * kAces[5];
    return (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
}

Color radiance(const Picture &p, std::size_t i)
{
    Color rgb;
    for (std::size_t c = 0; c < 3; ++c) {
        const float v = p.rgb[3 * i + c];
        rgb[c] = std::isfinite(v) ? std::max(v, 0.0f) : 0.0f;
    }
    return rgb;
}

/// Stops at which the reference's brightest pixel and its median become bright, and those between.
std::vector<float> exposures_for(const Picture &reference)
{
    std::vector<float> luminance(reference.rgb.size() / 3);
    for (std::size_t i = 0; i < luminance.size(); ++i)
        luminance[i] = times(kToXyz, radiance(reference, i))[1];
    const auto middle = luminance.begin() + std::ptrdiff_t(luminance.size() / 2);
    std::nth_element(luminance.begin(), middle, luminance.end());
    constexpr float least = std::numeric_limits<float>::epsilon();
    const float median = std::max(*middle, least), most = std::max(*std::max_element(middle, luminance.end()), least);
    const float start = std::log2(bright() / most), stop = std::log2(bright() / median);
    const int count = std::max(2, int(std::ceil(stop - start)));
    std::vector<float> exposures;
    for (int i = 0; i < count; ++i)
        exposures.push_back(start + (stop - start) * float(i) / float(count - 1));
    return exposures;
}

Image exposed(const Picture &p, float stops)
{
    Image out(p.width, p.height);
    const float scale = std::exp2(stops);
    for (std::size_t i = 0; i < p.rgb.size() / 3; ++i) {
        Color rgb = radiance(p, i);
        for (float &v : rgb)
            v = tone_mapped(std::min(v * scale, 1e9f));
        out.set(i, opponent(relative_xyz(rgb)));
    }
    return out;
}

}  // namespace

double hdr_flip(const Picture &a, const Picture &reference)
{
    if (reference.rgb.empty())
        return 0;
    Channel largest(reference.rgb.size() / 3, 0.0f);
    for (const float stops : exposures_for(reference))
        add_ldr_flip(exposed(a, stops), exposed(reference, stops), largest);
    double sum = 0;
    for (const float v : largest)
        sum += double(v);
    return sum / double(largest.size());
}

}  // namespace brume::tool
