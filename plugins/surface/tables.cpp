#include "tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "airlight/quadrature.h"
#include "airlight/tables.h"
#include "maths.hpp"

namespace surface {
namespace {

using brume::airlight::gauss_legendre;
using std::numbers::pi;
namespace maths = brume::maths_double;

// PSF_T sin gamma / (T e^-T), in the form that does not overflow.
double spread(double depth, double gamma)
{
    if (gamma < 1e-12)
        return 0.25;
    const std::complex<double> z = depth * (1.0 - std::exp(std::complex<double>(0, -gamma)));
    return -brume::airlight::scaled_exponential_integral(z).imag() / (2 * pi);
}

// Beyond this cosine's logarithm a lobe is below 1e-13 of its peak.
constexpr double faint = 30;

// int cos^n d phi around the lamp at gamma, of the lobe's hemisphere.
double around(double exponent, double theta, double gamma)
{
    const double a = std::cos(gamma) * std::cos(theta), b = std::sin(gamma) * std::sin(theta);
    const double most = std::cos(gamma - theta);
    if (most <= 0)
        return 0;
    if (b < 1e-12)
        return 2 * pi * std::pow(most, exponent);
    const double least = std::max(0.0, most * std::exp(-faint / exponent));
    const double end = std::acos(std::clamp((least - a) / b, -1.0, 1.0));
    double sum = 0;
    for (const auto &node : gauss_legendre())
        sum += node.weight * std::pow(std::max(a + b * std::cos(end * node.at), 0.0), exponent);
    return 2 * end * sum;
}

// Calls f(gamma, weight) for nodes of int d gamma, which crowd toward the lamp, and part where the lobe has its peak and its
// ends.
template <class Function> void for_nodes(double exponent, double theta, const Function &f)
{
    const double reach = std::acos(std::exp(-faint / exponent));
    std::array<double, 7> ends{std::max(0.0, theta - reach),
                               std::max(0.0, theta - 0.3 * reach),
                               theta,
                               std::min(pi, theta + 0.3 * reach),
                               std::min(pi, theta + reach),
                               0,
                               0};
    // Where the hemisphere begins to cut circles around the lamp.
    for (size_t i = 5; i < 7; ++i)
        ends[i] = std::clamp(i == 5 ? pi / 2 - theta : 3 * pi / 2 - theta, ends[0], ends[4]);
    std::sort(ends.begin(), ends.end());
    for (size_t i = 0; i + 1 < ends.size(); ++i) {
        const double from = std::sqrt(ends[i] / pi), width = std::sqrt(ends[i + 1] / pi) - from;
        if (width > 0)
            for (const auto &node : gauss_legendre()) {
                const double x = from + width * node.at;
                f(pi * x * x, node.weight * width * 2 * pi * x);
            }
    }
}

// spread() of all depths of the table, cubic between places that crowd toward the lamp.
class Spreads {
public:
    static constexpr int places = 256;
    static constexpr size_t depths = size_t(maths::lobe_depths);

    Spreads()
    {
        for (int i = 0; i <= places; ++i)
            for (size_t k = 0; k < depths; ++k)
                values_.push_back(
                    spread(maths::environment_thinnest * std::exp2(double(k) / 2), pi * i * i / places / places));
    }
    // Adds weight times those at gamma.
    void add(double gamma, double weight, std::array<double, depths> &sum) const
    {
        const double x = places * std::sqrt(gamma / pi);
        const int first = std::clamp(int(x) - 1, 0, places - 3);
        const double t = x - first;
        const double weights[] = {-(t - 1) * (t - 2) * (t - 3) / 6, t * (t - 2) * (t - 3) / 2, -t * (t - 1) * (t - 3) / 2,
                                  t * (t - 1) * (t - 2) / 6};
        for (int j = 0; j < 4; ++j)
            for (size_t k = 0; k < depths; ++k)
                sum[k] += weight * weights[j] * values_[size_t(first + j) * depths + k];
    }

private:
    std::vector<double> values_;
};

double angle_of(int entry)
{
    constexpr int middle = (maths::lobe_angles - 1) / 2;
    if (entry > middle)
        return pi - angle_of(2 * middle - entry);
    return pi / 2 * std::pow(std::sin(pi / 2 * std::pow(double(entry) / middle, 1.5)), 2);
}

std::vector<float> made_table()
{
    const Spreads spreads;
    std::vector<float> table;
    for (int k = 0; k < maths::lobe_exponents; ++k)
        for (int j = 0; j < maths::lobe_angles; ++j) {
            const double exponent = std::exp2(k / 3.0), theta = angle_of(j);
            std::array<double, Spreads::depths> sum{};
            for_nodes(exponent, theta, [&](double gamma, double weight) {
                spreads.add(gamma, weight * around(exponent, theta, gamma), sum);
            });
            for (double value : sum)
                table.push_back(float(std::log2((exponent + 1) / (2 * pi) * value)));
        }
    return table;
}

}  // namespace

double lobe_of_scattered(double depth, double exponent, double theta)
{
    double sum = 0;
    for_nodes(exponent, theta,
              [&](double gamma, double weight) { sum += weight * spread(depth, gamma) * around(exponent, theta, gamma); });
    return (exponent + 1) / (2 * pi) * sum;
}

const std::vector<float> &lobe_table()
{
    static const std::vector<float> table = made_table();
    return table;
}

double mean_depth_of_gaussian(double distance)
{
    // sqrt(pi) / 2 F(u) / u of Dawson's F: int exp(s^2 - u^2) ds over u, the ratio's integrand over s / u.
    const double u = distance;
    constexpr int pieces = 32;
    double sum = 0;
    for (int i = 0; i < pieces; ++i)
        for (const auto &node : gauss_legendre()) {
            const double s = (i + node.at) / pieces;
            sum += node.weight / pieces * std::exp(u * u * (s - 1) * (s + 1));
        }
    return std::sqrt(pi) / 2 * sum;
}

const std::vector<float> &psf_table()
{
    static const std::vector<float> table = [] {
        std::vector<float> values = brume::airlight::environment_table();
        for (int i = 0; i < maths::mean_depths; ++i)
            values.insert(values.end(), {float(mean_depth_of_gaussian(i / 16.0)), 0.0f, 0.0f, 0.0f});
        return values;
    }();
    return table;
}

}  // namespace surface
