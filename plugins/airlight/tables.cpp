#include "tables.h"

#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "maths.hpp"
#include "quadrature.h"

namespace brume::airlight {
namespace {

using std::numbers::pi;

// Composite, of equal pieces.
template <class Function> double integral(const Function &f, double from, double to, int pieces)
{
    double sum = 0;
    for (int i = 0; i < pieces; ++i) {
        const double a = from + (to - from) * i / pieces, width = (to - from) / pieces;
        for (const Node &node : gauss_legendre())
            sum += node.weight * width * f(a + width * node.at);
    }
    return sum;
}

}  // namespace

std::complex<double> scaled_exponential_integral(std::complex<double> z)
{
    if (std::abs(z) < 2.5) {
        std::complex<double> term = 1, sum = 0;
        for (int k = 1; k < 60 && std::abs(term) > 1e-18; ++k) {
            term *= -z / double(k);
            sum -= term / double(k);
        }
        return std::exp(z) * (sum - std::log(z) - std::numbers::egamma);
    }
    // Steed's form of the continued fraction 1 / (z + 1 - 1 / (z + 3 - 4 / (z + 5 - ...))), from its end.
    std::complex<double> tail = 0;
    for (int k = int(12 + 120 / std::abs(z)); k > 0; --k)
        tail = double(k * k) / (z + 2.0 * k + 1.0 - tail);
    return 1.0 / (z + 1.0 - tail);
}

double sun_function(double u, double v)
{
    if (u == 0)
        return v;
    if (v >= pi / 2)
        return -scaled_exponential_integral({0, u}).imag();
    // In steps that halve toward pi / 2, where e^(-u tan x) falls to zero.
    double sum = 0, from = 0;
    for (double gap = pi / 4; from < v; gap /= 2) {
        const double to = gap < 1e-6 ? v : std::min(v, pi / 2 - gap);
        sum += integral([u](double x) { return std::exp(-u * std::tan(x)); }, from, to, 1);
        from = to;
    }
    return sum;
}

const std::vector<float> &sun_table()
{
    static const std::vector<float> table = [] {
        const int n = maths_double::sun_table_size;
        std::vector<float> values;
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
                values.push_back(float(sun_function(maths_double::sun_table_limit * i / (n - 1), pi / 2 * j / (n - 1))));
        return values;
    }();
    return table;
}

std::array<double, 6> psf_coefficients(double depth)
{
    // PSF_T sin gamma / (T e^-T) is -Im E^(T (1 - e^(-i gamma))) / 2 pi; its logarithm at 0 by nodes that crowd there.
    std::array<double, 6> c{};
    for (unsigned l = 0; l < 6; ++l)
        c[l] = std::sqrt((2 * l + 1) / (4 * pi)) *
               integral(
                   [=](double x) {
                       const double gamma = pi * x * x;
                       const auto z = depth * (1.0 - std::exp(std::complex<double>(0, -gamma)));
                       return -2 * pi * x * scaled_exponential_integral(z).imag() * std::legendre(l, std::cos(gamma));
                   },
                   0, 1, 4);
    return c;
}

const std::vector<float> &environment_table()
{
    static const std::vector<float> table = [] {
        std::vector<float> values;
        for (int k = 0; k < maths_double::environment_table_size; ++k) {
            const auto c = psf_coefficients(maths_double::environment_thinnest * std::exp2(k / 4.0));
            for (unsigned l = 0; l < 8; ++l)
                values.push_back(l < 6 ? float(std::sqrt(4 * pi / (2 * l + 1)) * c[l]) : 0.0f);
        }
        return values;
    }();
    return table;
}

}  // namespace brume::airlight
