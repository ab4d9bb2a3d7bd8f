#include "environment/harmonics.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include <tbb/parallel_for.h>

#include <brume/brume.h>

namespace brume::tool {
namespace {

/// Columns into which an image is divided at least, so that the middle of a cell stands for it.
constexpr int kLeastColumns = 512;

/// One row of the image, which is divided into cells^2 cells a pixel.
HarmonicsRgb project_row(const LatLong &image, int row, int cells, std::uint32_t up)
{
    HarmonicsRgb sum{};
    const double column_angle = 2 * std::numbers::pi / (double(image.width) * cells);
    const double row_angle = std::numbers::pi / (double(image.height) * cells);
    for (int j = 0; j < cells; ++j) {
        const int from_top = (image.y + row) * cells + j;
        const double upper = std::cos(from_top * row_angle), lower = std::cos((from_top + 1) * row_angle);
        const double solid_angle = column_angle * (upper - lower);
        const double v = std::acos((upper + lower) / 2) / std::numbers::pi;  // halves the cell's area
        for (int column = 0; column < image.columns; ++column) {
            const float *pixel = &image.pixels[(std::size_t(row) * std::size_t(image.columns) + std::size_t(column)) *
                                               std::size_t(image.stride)];
            std::array<double, 3> radiance;
            for (std::size_t c = 0; c < 3; ++c)
                radiance[c] = std::isfinite(pixel[c]) ? std::max(double(pixel[c]), 0.0) * solid_angle : 0.0;
            for (int i = 0; i < cells; ++i) {
                const double u = (double(image.x + column) * cells + i + 0.5) / (double(image.width) * cells);
                const auto y = harmonics(latlong_direction(u, v, up));
                for (std::size_t k = 0; k < y.size(); ++k)
                    for (std::size_t c = 0; c < 3; ++c)
                        sum[k][c] += y[k] * radiance[c];
            }
        }
    }
    return sum;
}

}  // namespace

std::array<double, kHarmonics> harmonics(const std::array<double, 3> &direction)
{
    std::array<double, kHarmonics> y;
    const double z = direction[2];
    const std::complex<double> around(direction[0], direction[1]);
    std::complex<double> power = 1.0;               // sin^m(theta) exp(i m phi)
    double first = 0.5 * std::numbers::inv_sqrtpi;  // P_mm over sin^m(theta), normalised
    for (int m = 0; m < kHarmonicOrder; ++m) {
        if (m > 0) {
            power *= around;
            first *= std::sqrt((2 * m + 1) / (2.0 * m));
        }
        double p = first, before = 0.0, factor_before = 0.0;
        for (int l = m; l < kHarmonicOrder; ++l) {
            if (l > m) {
                const double factor = std::sqrt((4.0 * l * l - 1) / double(l * l - m * m));
                const double next = factor * (z * p - factor_before * before);
                before = p;
                p = next;
                factor_before = 1 / factor;
            }
            const auto at = [&](int signed_m) -> double & { return y[std::size_t(l * (l + 1) + signed_m)]; };
            at(m) = (m == 0 ? 1.0 : std::numbers::sqrt2) * p * power.real();
            if (m > 0)
                at(-m) = std::numbers::sqrt2 * p * power.imag();
        }
    }
    return y;
}

std::array<double, 3> latlong_direction(double u, double v, std::uint32_t up)
{
    const double longitude = 2 * std::numbers::pi * (u - 0.5), colatitude = std::numbers::pi * v;
    const double right = std::sin(colatitude) * std::sin(longitude), top = std::cos(colatitude),
                 forward = std::sin(colatitude) * std::cos(longitude);
    return up == BRUME_UP_Z ? std::array{right, forward, top} : std::array{right, top, -forward};
}

HarmonicsRgb project_latlong(const LatLong &image, std::uint32_t up)
{
    const int cells = std::max(1, (kLeastColumns + image.width - 1) / image.width);
    std::vector<HarmonicsRgb> rows(std::size_t(image.rows));
    tbb::parallel_for(0, image.rows, [&](int row) { rows[std::size_t(row)] = project_row(image, row, cells, up); });
    HarmonicsRgb sum{};
    for (const HarmonicsRgb &row : rows)
        for (std::size_t k = 0; k < sum.size(); ++k)
            for (std::size_t c = 0; c < 3; ++c)
                sum[k][c] += row[k][c];
    return sum;
}

}  // namespace brume::tool
