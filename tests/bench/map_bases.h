// Ways to keep int rho dt along one ray of an attenuation map in a few values, over z from 0 to 1.
#pragma once
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

namespace map_bases {

using Values = std::vector<float>;
using Depth = std::function<float(float)>;  // optical depth at z, from 0 on
using Density = std::function<float(float)>;

struct Basis {
    std::string name;
    Values (*build)(int values, const Depth &tau, const Density &density);
    float (*transmittance)(const Values &of, float z);
};

// Cosine series over samples in the middle of as many intervals.
template <class F> float cosine(const F &sample, int samples, int k)
{
    double sum = 0;
    for (int i = 0; i < samples; ++i)
        sum += double(sample[size_t(i)]) * std::cos(std::numbers::pi * (i + 0.5) * k / samples);
    return float(sum * (k == 0 ? 1 : 2) / samples);
}

// sum of c_k cos(k x) or of c_k sin(k x) from k = 1 on, by Clenshaw's recurrence.
inline float series(const float *c, int count, float x, bool sine)
{
    const float twice = 2 * std::cos(x);
    float b1 = 0, b2 = 0;
    for (int k = count - 1; k >= 0; --k) {
        const float b = c[k] + twice * b1 - b2;
        b2 = b1;
        b1 = b;
    }
    return sine ? b1 * std::sin(x) : b1 * std::cos(x) - b2;
}

// The paper's: cosine coefficients of the transmittance.
inline Values build_dct(int values, const Depth &tau, const Density &)
{
    const int samples = 4 * values;
    Values t(static_cast<size_t>(samples)), c;
    for (int i = 0; i < samples; ++i)
        t[size_t(i)] = std::exp(-tau((float(i) + 0.5f) / float(samples)));
    for (int k = 0; k < values; ++k)
        c.push_back(cosine(t, samples, k));
    return c;
}
inline float fetch_dct(const Values &c, float z)
{
    return c[0] + series(c.data() + 1, int(c.size()) - 1, std::numbers::pi_v<float> * z, false);
}

// Optical depth as a ramp, which an even medium is, and sines of what is left.
inline Values build_dct_tau(int values, const Depth &tau, const Density &)
{
    const int samples = 4 * values;
    const float end = tau(1);
    Values rest(static_cast<size_t>(samples)), c{end};
    for (int i = 0; i < samples; ++i) {
        const float z = (float(i) + 0.5f) / float(samples);
        rest[size_t(i)] = tau(z) - end * z;
    }
    for (int k = 1; k < values; ++k) {
        double sum = 0;
        for (int i = 0; i < samples; ++i)
            sum += double(rest[size_t(i)]) * std::sin(std::numbers::pi * (i + 0.5) * k / samples);
        c.push_back(float(2 * sum / samples));
    }
    return c;
}
inline float fetch_dct_tau(const Values &c, float z)
{
    const float tau = c[0] * z + series(c.data() + 1, int(c.size()) - 1, std::numbers::pi_v<float> * z, true);
    return std::exp(-std::max(tau, 0.0f));
}

// What the effect keeps: depths at equal steps, straight between them.
inline Values build_fixed(int values, const Depth &tau, const Density &)
{
    Values nodes;
    for (int k = 0; k < values; ++k)
        nodes.push_back(tau(float(k) / float(values - 1)));
    return nodes;
}
inline float straight(const float *nodes, int count, float z)
{
    const float place = std::clamp(z, 0.0f, 1.0f) * float(count - 1);
    const int k = std::min(int(place), count - 2);
    return std::lerp(nodes[k], nodes[k + 1], place - float(k));
}
inline float fetch_fixed(const Values &v, float z)
{
    return std::exp(-straight(v.data(), int(v.size()), z));
}

// Cubic between fixed depths, slopes from the neighbours, none where that would turn.
inline float fetch_cubic(const Values &v, float z)
{
    const int count = int(v.size());
    const float place = z * float(count - 1);
    const int k = std::min(int(place), count - 2);
    const float u = place - float(k), a = v[size_t(k)], b = v[size_t(k) + 1], step = b - a,
                before = k > 0 ? a - v[size_t(k) - 1] : step, after = k < count - 2 ? v[size_t(k) + 2] - b : step;
    const float p = std::min(0.5f * (before + step), 3 * std::min(before, step)),
                q = std::min(0.5f * (step + after), 3 * std::min(step, after));
    return std::exp(-(a + u * (p + u * (3 * step - 2 * p - q + u * (p + q - 2 * step)))));
}

// Depth and density at half as many fixed nodes, cubic between them.
inline Values build_hermite(int values, const Depth &tau, const Density &density)
{
    Values v;
    for (int k = 0; k < values / 2; ++k) {
        const float z = float(k) / float(values / 2 - 1);
        v.push_back(tau(z));
        v.push_back(density(z));
    }
    return v;
}
inline float fetch_hermite(const Values &v, float z)
{
    const int count = int(v.size()) / 2;
    const float place = z * float(count - 1), h = 1 / float(count - 1);
    const int k = std::min(int(place), count - 2);
    const float *n = v.data() + 2 * k;
    const float u = place - float(k), step = n[2] - n[0], p = std::min(n[1] * h, 3 * step), q = std::min(n[3] * h, 3 * step);
    return std::exp(-(n[0] + u * (p + u * (3 * step - 2 * p - q + u * (p + q - 2 * step)))));
}

// Fixed nodes between where the ray enters and leaves the medium, which are kept too.
inline Values build_own_range(int values, const Depth &tau, const Density &)
{
    const float end = tau(1);
    auto reaches = [&](float depth) {
        float low = 0, high = 1;
        for (int i = 0; i < 20; ++i)
            (tau(0.5f * (low + high)) < depth ? low : high) = 0.5f * (low + high);
        return high;
    };
    const float from = std::max(reaches(1e-3f * end) - 1e-6f, 0.0f), to = std::max(reaches(0.999f * end), from + 1e-5f);
    Values v{from, to};
    for (int k = 0; k < values - 2; ++k)
        v.push_back(tau(std::lerp(from, to, float(k) / float(values - 3))));
    v[2] = 0;
    v.back() = end;
    return v;
}
inline float fetch_own_range(const Values &v, float z)
{
    return std::exp(-straight(v.data() + 2, int(v.size()) - 2, (z - v[0]) / (v[1] - v[0])));
}

// Pairs of z and depth, each new one where the transmittance is farthest off.
inline Values build_adaptive(int values, const Depth &tau, const Density &)
{
    constexpr int samples = 512;
    std::vector<float> depth;
    for (int i = 0; i <= samples; ++i)
        depth.push_back(tau(float(i) / samples));
    struct Span {
        int from, to, worst;
        float error;
    };
    auto span = [&](int from, int to) {
        Span s{from, to, from, -1};
        for (int i = from + 1; i < to; ++i) {
            const float between = std::lerp(depth[size_t(from)], depth[size_t(to)], float(i - from) / float(to - from));
            const float error = std::abs(std::exp(-between) - std::exp(-depth[size_t(i)]));
            if (error > s.error)
                s = {from, to, i, error};
        }
        return s;
    };
    std::vector<Span> spans{span(0, samples)};
    while (int(spans.size()) < values / 2 - 1) {
        const auto worst = std::max_element(spans.begin(), spans.end(), [](auto &a, auto &b) { return a.error < b.error; });
        if (worst->error < 0)
            break;
        const Span left = span(worst->from, worst->worst), right = span(worst->worst, worst->to);
        *worst = left;
        spans.insert(worst + 1, right);
    }
    Values v{0, 0};
    for (const Span &s : spans) {
        v.push_back(float(s.to) / samples);
        v.push_back(depth[size_t(s.to)]);
    }
    for (; int(v.size()) < values; v.push_back(depth.back()))
        v.push_back(1);
    return v;
}
inline float fetch_adaptive(const Values &v, float z)
{
    int low = 0, high = int(v.size()) / 2 - 1;
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        (v[2 * size_t(middle)] <= z ? low : high) = middle;
    }
    const float *a = v.data() + 2 * low, *b = v.data() + 2 * high;
    return std::exp(-std::lerp(a[1], b[1], std::clamp((z - a[0]) / std::max(b[0] - a[0], 1e-9f), 0.0f, 1.0f)));
}

inline const std::vector<Basis> &all()
{
    static const std::vector<Basis> bases{{"dct", build_dct, fetch_dct},
                                          {"dct_tau", build_dct_tau, fetch_dct_tau},
                                          {"fixed", build_fixed, fetch_fixed},
                                          {"fixed, cubic", build_fixed, fetch_cubic},
                                          {"fixed, with density", build_hermite, fetch_hermite},
                                          {"fixed, own range", build_own_range, fetch_own_range},
                                          {"adaptive", build_adaptive, fetch_adaptive}};
    return bases;
}

}  // namespace map_bases
