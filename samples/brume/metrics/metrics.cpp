#include "metrics/metrics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <oneapi/tbb/parallel_for.h>

namespace brume::tool {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

struct Grid {
    int width, height;
    std::vector<double> values;  ///< three a pixel; NaN where nothing finite was there to average

    Grid(int w, int h) : width(w), height(h), values(3 * std::size_t(w) * std::size_t(h), kNone) {}
    double &at(int x, int y, int c)
    {
        return values[3 * (std::size_t(y) * std::size_t(width) + std::size_t(x)) + std::size_t(c)];
    }
    double at(int x, int y, int c) const { return const_cast<Grid *>(this)->at(x, y, c); }
};

/// Averages source over [x0,x1) x [y0,y1), skipping what is NaN.
template <class Source> double mean_of(const Source &source, int x0, int x1, int y0, int y1, int c)
{
    double sum = 0;
    int count = 0;
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x)
            if (const double v = source(x, y, c); !std::isnan(v)) {
                sum += v;
                ++count;
            }
    return count ? sum / count : kNone;
}

template <class Source, class Region> Grid averaged(int width, int height, const Source &source, Region region)
{
    Grid out(width, height);
    oneapi::tbb::parallel_for(0, height, [&](int y) {
        for (int x = 0; x < width; ++x) {
            const auto [x0, x1, y0, y1] = region(x, y);
            for (int c = 0; c < 3; ++c)
                out.at(x, y, c) = mean_of(source, x0, x1, y0, y1, c);
        }
    });
    return out;
}

/// What the metrics compare. A component that is not finite in either picture counts in neither.
Grid prepared(const Picture &picture, const Picture &other, const Mask &mask)
{
    const int w = picture.width, h = picture.height;
    const auto source = [&](int x, int y, int c) {
        if (!is_compared(mask, picture.index(x, y)))
            return kNone;
        const double a = picture.at(x, y)[c], b = other.at(x, y)[c];
        return std::isfinite(a) && std::isfinite(b) ? a : kNone;
    };
    const Grid halved = averaged((w + 1) / 2, (h + 1) / 2, source, [&](int x, int y) {
        return std::array{2 * x, std::min(2 * x + 2, w), 2 * y, std::min(2 * y + 2, h)};
    });
    const auto grid = [&](int x, int y, int c) { return halved.at(x, y, c); };
    return averaged(halved.width, halved.height, grid, [&](int x, int y) {
        return std::array{std::max(x - 1, 0), std::min(x + 2, halved.width), std::max(y - 1, 0),
                          std::min(y + 2, halved.height)};
    });
}

double luminance(const double *rgb, const LuminanceWeights &w)
{
    return w[0] * rgb[0] + w[1] * rgb[1] + w[2] * rgb[2];
}

struct Mean {
    double sum = 0;
    std::uint64_t count = 0;
    void add(double v)
    {
        if (std::isnan(v))
            return;
        sum += v;
        ++count;
    }
    double value() const { return count ? sum / double(count) : 0; }
};

void compare_pixels(const Picture &a, const Picture &r, const Mask &mask, Metrics &m)
{
    Mean signed_difference;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x) {
            if (!is_compared(mask, a.index(x, y)))
                continue;
            ++m.pixels;
            const float *p = a.at(x, y);
            const float *q = r.at(x, y);
            bool finite_a = true, finite_r = true, equal = true;
            const auto compare_values = [&](float v, float w) {
                finite_a &= std::isfinite(v);
                finite_r &= std::isfinite(w);
                m.not_finite_mismatch += !same_kind(v, w);
                equal &= v == w || (std::isnan(v) && std::isnan(w));
            };
            if (!a.alpha.empty())
                compare_values(a.alpha[a.index(x, y)], r.alpha[r.index(x, y)]);
            for (int c = 0; c < 3; ++c) {
                compare_values(p[c], q[c]);
                if (!std::isfinite(p[c]) || !std::isfinite(q[c]))
                    continue;
                const double difference = std::abs(double(p[c]) - double(q[c]));
                signed_difference.add(double(p[c]) - double(q[c]));
                if (difference > m.max_difference) {
                    m.max_difference = difference;
                    m.max_x = a.x + x;
                    m.max_y = a.y + y;
                    m.max_channel = c;
                    m.max_a = p[c];
                    m.max_reference = q[c];
                }
            }
            m.not_finite_a += !finite_a;
            m.not_finite_reference += !finite_r;
            m.different += !equal;
        }
    m.mean_difference = signed_difference.value();
}

}  // namespace

bool same_kind(float a, float b)
{
    return std::isnan(a) ? std::isnan(b) : std::isinf(a) ? a == b : std::isfinite(b);
}

Metrics measure(const Picture &a, const Picture &r, const LuminanceWeights &weights, const Mask &mask)
{
    Metrics m;
    compare_pixels(a, r, mask, m);

    const Grid fa = prepared(a, r, mask), fr = prepared(r, a, mask);
    Mean mean_r, luminance_a, luminance_r;
    for (std::size_t i = 0; i < fr.values.size(); i += 3) {
        luminance_a.add(luminance(&fa.values[i], weights));
        luminance_r.add(luminance(&fr.values[i], weights));
        for (std::size_t c = 0; c < 3; ++c)
            mean_r.add(fr.values[i + c]);
    }
    m.energy = luminance_r.value() != 0 ? luminance_a.value() / luminance_r.value() : luminance_a.value() == 0 ? 1 : kNone;

    const double floor = std::pow(0.05 * mean_r.value(), 2), scale = luminance_r.value();
    const auto log_of = [&](double v) { return std::log2((scale > 0 ? std::max(v, 0.0) / scale : 0.0) + 0.02); };
    Mean relative, logs;
    for (std::size_t i = 0; i < fr.values.size(); ++i) {
        const double x = fa.values[i], y = fr.values[i];
        if (std::isnan(x) || std::isnan(y))
            continue;
        const double squared = (x - y) * (x - y);
        relative.add(squared == 0 ? 0 : squared / (y * y + floor));
        logs.add(std::pow(log_of(x) - log_of(y), 2));
    }
    m.relative_mse = relative.value();
    m.log2_rms = std::sqrt(logs.value());
    return m;
}

Picture box_blurred(const Picture &picture, int reach)
{
    const int w = picture.width, h = picture.height;
    const auto source = [&](int x, int y, int c) {
        const double v = picture.at(x, y)[c];
        return std::isfinite(v) ? v : kNone;
    };
    const Grid blurred = averaged(w, h, source, [&](int x, int y) {
        return std::array{std::max(x - reach, 0), std::min(x + reach + 1, w), std::max(y - reach, 0),
                          std::min(y + reach + 1, h)};
    });
    Picture out = picture;
    std::copy(blurred.values.begin(), blurred.values.end(), out.rgb.begin());
    return out;
}

void crop_to_common(Picture &a, Picture &b)
{
    const int x0 = std::max(a.x, b.x), x1 = std::min(a.x + a.width, b.x + b.width);
    const int y0 = std::max(a.y, b.y), y1 = std::min(a.y + a.height, b.y + b.height);
    const auto crop = [&](const Picture &p) {
        Picture out{x0, y0, std::max(0, x1 - x0), std::max(0, y1 - y0), {}};
        if (out.width == 0 || out.height == 0)
            return Picture{x0, y0, 0, 0, {}};
        for (int y = y0; y < y1; ++y) {
            const float *row = p.at(x0 - p.x, y - p.y);
            out.rgb.insert(out.rgb.end(), row, row + 3 * out.width);
            if (!p.alpha.empty()) {
                const auto from = p.alpha.begin() + std::ptrdiff_t(p.index(x0 - p.x, y - p.y));
                out.alpha.insert(out.alpha.end(), from, from + out.width);
            }
        }
        return out;
    };
    a = crop(a);
    b = crop(b);
}

}  // namespace brume::tool
