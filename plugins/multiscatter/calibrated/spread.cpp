#include "spread.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "maths.hpp"
#include "spread_table.h"

namespace multiscatter {
namespace {

using std::numbers::pi;
using std::numbers::sqrt2;

// Of what arrives: nothing that is turned farther is told apart.
constexpr double widest = 0.87;

// Where v lies on an axis of the Monte Carlo table.
struct Place {
    size_t below;
    double above;  // weight of the next
};

template <size_t n, class Scale> Place placed(const double (&axis)[n], double v, Scale scale)
{
    size_t i = 0;
    while (i + 2 < n && v > axis[i + 1])
        ++i;
    return {i, std::clamp((scale(v) - scale(axis[i])) / (scale(axis[i + 1]) - scale(axis[i])), 0.0, 1.0)};
}

// gamma F(gamma) of a medium that the axes have, apart from a factor.
double table_value(double asymmetry, double depth, double albedo, double angle)
{
    auto log = [](double v) { return std::log(std::max(v, 1e-30)); };
    auto same = [](double v) { return v; };
    const Place g = placed(table_asymmetries, asymmetry, same), d = placed(table_depths, depth, log),
                a = placed(table_angles, angle, log);
    const double darker = std::clamp((table_albedos[0] - albedo) / (table_albedos[0] - table_albedos[1]), 0.0, 2.0);
    double sum = 0;
    for (size_t i = 0; i < 2; ++i)
        for (size_t j = 0; j < 2; ++j)
            for (size_t k = 0; k < 2; ++k) {
                const auto &cell = spread_table[g.below + i][d.below + j];
                const size_t at = a.below + k;
                sum += (i ? g.above : 1 - g.above) * (j ? d.above : 1 - d.above) * (k ? a.above : 1 - a.above) *
                       (double(cell[0][at]) + darker * (double(cell[1][at]) - double(cell[0][at])));
            }
    return std::exp(sum);
}

}  // namespace

double light_between(const SpreadSource &s, double depth, double from, double to)
{
    to = std::min(to, widest);
    if (from >= to)
        return 0;
    const double albedo = s.scattering / (s.scattering + s.absorption);
    const double lowest = std::max(from, 1e-3 * to);
    const int steps = std::max(1, int(std::ceil(2 * std::log2(to / lowest))));
    double sum = 0, angle = lowest;
    const double ratio = std::pow(to / lowest, 1.0 / steps);
    for (int i = 0; i < steps; ++i, angle *= ratio)
        sum += table_value(s.asymmetry, depth, albedo, angle * std::sqrt(ratio)) * angle * (ratio - 1);
    return sum + (lowest - from) * table_value(s.asymmetry, depth, albedo, lowest);
}

namespace {

// Deviation of level k with its smoothing and fetch: 4^k (.77 / 3 + 1 + 1 / 6) pixels squared.
double level_angle(const SpreadSource &s, int level)
{
    return 1.19 * std::exp2(level) / s.focal;
}

// int_from^pi p(theta) dtheta of Henyey-Greenstein, apart from a factor.
double turned_beyond(double g, double from)
{
    const int steps = 48;
    const double ratio = std::pow(pi / from, 1.0 / steps);
    double sum = 0, angle = from;
    for (int i = 0; i < steps; ++i, angle *= ratio) {
        const double q = 1 + g * g - 2 * g * std::cos(angle * std::sqrt(ratio));
        sum += angle * (ratio - 1) / (q * std::sqrt(q));
    }
    return sum;
}

}  // namespace

double visible(double asymmetry, double angle, double ratio)
{
    const double g = std::clamp(asymmetry, 0.0, table_asymmetries[std::size(table_asymmetries) - 1]);
    auto behind = [&](double u) {
        return turned_beyond(g, std::clamp(pi - std::atan2(std::sin(angle), u - std::cos(angle)), angle, pi * (1 - 1e-9)));
    };
    const double all = turned_beyond(g, angle), level = all - behind(1);
    return level > 1e-12 * all ? std::clamp((all - behind(ratio)) / level, 0.0, 1.0) : 1;
}

double first_place(const SpreadSource &source)
{
    return std::log2(first_depth / source.scattering);
}

std::vector<float> spread_values(const SpreadSource &source)
{
    using namespace brume::maths_double;
    std::vector<float> values(size_t((source.top + 1) * spread_row));
    std::vector<double> share(size_t(source.top + 1));
    // The next finer level at which light stays.
    auto finer = [&](int level) { return level >= 2 * source.step ? level - source.step : level == 0 ? -1 : 0; };
    const int first = source.top < source.step ? source.top : source.step + source.top % source.step;
    const double finest = level_angle(source, first) / sqrt2, apart = std::exp2(0.5 * source.step);
    for (int place = 0; place < spread_places; ++place) {
        const double depth = first_depth * std::exp2(0.5 * place);
        double all = 0;
        for (int k = source.top; k >= 0; k = finer(k)) {
            const double angle = level_angle(source, k);
            // The ends take what is finer and coarser than the pyramid. Nowhere nothing, so that quotients exist.
            share[size_t(k)] = light_between(source, depth,
                                             k == 0          ? 0
                                             : finer(k) == 0 ? angle / sqrt2
                                                             : angle / apart,
                                             k == source.top ? widest
                                             : k == 0        ? finest
                                                             : angle * apart);
            all += share[size_t(k)];
        }
        double coarser = 0;
        for (int k = source.top; k >= 0; k = finer(k)) {
            const double s = std::max(share[size_t(k)], 1e-5 * all);
            values[size_t(k * spread_row + place)] = float(k == source.top ? 1 : k > 0 ? s / coarser : s / (s + coarser));
            coarser += s;
        }
    }
    for (int k = 0; k <= source.top; ++k)
        for (int i = 0; i < visible_places; ++i)
            values[size_t(k * spread_row + spread_places + i)] =
                float(visible(source.asymmetry, std::min(level_angle(source, k), 1.0), double(i) / (visible_places - 1)));
    return values;
}

}  // namespace multiscatter
