// spread_calibration OUT.h [PATHS]: the table behind the filter's kernel `calibrated`, by Monte Carlo.
//
// F(gamma) is the radiance that a camera sees at an angle gamma from a point light of unit intensity at a distance of 1, in
// an endless homogeneous medium, apart from the light itself. What is scattered once comes from quadrature, the rest from
// paths traced backwards with a connection to the light at each vertex. Seeded; the same on every run.
#include <cmath>
#include <fstream>
#include <random>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <glm/glm.hpp>

namespace {

using glm::dvec3;
constexpr double pi = 3.14159265358979323846;

constexpr double asymmetries[] = {0, 0.3, 0.6, 0.8, 0.9, 0.95};
constexpr double depths[] = {0.1, 0.4, 1.2, 3.6, 7};  // of scattering, to the light
constexpr double albedos[] = {1, 0.8};
constexpr double angles[] = {0.003, 0.01, 0.03, 0.1, 0.3, 0.6, 1};

struct Medium {
    double scattering, absorption, g;
    double extinction() const { return scattering + absorption; }
    double phase(double cosine) const
    {
        const double q = 1 + g * g - 2 * g * cosine;
        return (1 - g * g) / (4 * pi * q * std::sqrt(q));
    }
};

// dt / d^2 = dtheta / sin(gamma): over the angle theta by which light is turned, only the rest has to be sampled.
double scattered_once(const Medium &m, double gamma)
{
    const int steps = 4000;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double theta = gamma + (pi - gamma) * (i + 0.5) / steps;
        const double way = (std::sin(theta - gamma) + std::sin(gamma)) / std::sin(theta);
        sum += m.phase(std::cos(theta)) * std::exp(-m.extinction() * way);
    }
    return m.scattering * sum * (pi - gamma) / steps / std::sin(gamma);
}

dvec3 turned(dvec3 d, double cosine, double azimuth)
{
    const dvec3 side = glm::normalize(glm::cross(std::abs(d.x) > 0.5 ? dvec3(0, 1, 0) : dvec3(1, 0, 0), d));
    const dvec3 up = glm::cross(d, side);
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    return glm::normalize(sine * (std::cos(azimuth) * side + std::sin(azimuth) * up) + cosine * d);
}

double scattered_again(const Medium &m, double gamma, int paths, unsigned seed)
{
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    const dvec3 light(0, 0, 1);
    double sum = 0;
    for (int i = 0; i < paths; ++i) {
        dvec3 x(0), d(std::sin(gamma), 0, std::cos(gamma));
        double weight = 1;
        for (int k = 0; k < 200; ++k) {
            x += -std::log(1 - uniform(random)) / m.extinction() * d;
            weight *= m.scattering / m.extinction();
            if (k > 0) {
                const dvec3 way = light - x;
                const double d2 = glm::dot(way, way), distance = std::sqrt(d2);
                // Bounded within a hundredth of the distance, which holds a millionth of the light.
                sum += weight * m.phase(glm::dot(way, d) / distance) * std::exp(-m.extinction() * distance) /
                       std::max(d2, 1e-4);
            }
            const double xi = uniform(random);
            const double s = m.g == 0 ? 0 : (1 - m.g * m.g) / (1 - m.g + 2 * m.g * xi);
            d = turned(d, m.g == 0 ? 1 - 2 * xi : (1 + m.g * m.g - s * s) / (2 * m.g), 2 * pi * uniform(random));
            if (weight < 0.05) {
                if (uniform(random) > 0.5)
                    break;
                weight *= 2;
            }
            if (m.extinction() * glm::length(x - light) > 30)
                break;  // comes back with a weight below e^-30
        }
    }
    return sum / paths;
}

}  // namespace

int main(int argc, char **argv)
{
    if (argc < 2)
        return 2;
    const int paths = argc > 2 ? std::atoi(argv[2]) : 100000;
    std::ofstream out(argv[1]);
    fmt::print(out,
               "#pragma once\n"
               "// log(gamma F(gamma)) by Monte Carlo, made by tests/bench/spread_calibration.cpp with {} paths a value.\n\n"
               "namespace multiscatter {{\n\n",
               paths);
    auto axis = [&](const char *name, auto &values, const char *what) {
        fmt::print(out, "constexpr double {}[] = {{{}}};  // {}\n", name, fmt::join(values, ", "), what);
    };
    axis("table_asymmetries", asymmetries, "g of Henyey-Greenstein");
    axis("table_depths", depths, "scattering optical depth to the source");
    axis("table_albedos", albedos, "sigma_s / sigma_t");
    axis("table_angles", angles, "gamma, from the source");
    fmt::print(out, "constexpr float spread_table[{}][{}][{}][{}] = {{\n", std::size(asymmetries), std::size(depths),
               std::size(albedos), std::size(angles));
    for (double g : asymmetries) {
        fmt::print(out, "    {{\n");
        for (double depth : depths) {
            std::string row;
            for (double albedo : albedos) {
                const Medium m{depth, depth / albedo - depth, g};
                std::vector<double> f(std::size(angles));
                {
                    std::vector<std::jthread> threads;
                    for (size_t i = 0; i < f.size(); ++i)
                        threads.emplace_back([&, i] {
                            f[i] = scattered_once(m, angles[i]) + scattered_again(m, angles[i], paths, unsigned(i + 1));
                        });
                }
                std::string values;
                for (size_t i = 0; i < f.size(); ++i)
                    values += fmt::format("{}{:.3f}f", i ? ", " : "", std::log(angles[i] * f[i]));
                row += fmt::format("{}{{{}}}", row.empty() ? "" : ", ", values);
            }
            fmt::print(out, "        {{{}}},\n", row);
        }
        fmt::print(out, "    }},\n");
    }
    fmt::print(out, "}};\n\n}}  // namespace multiscatter\n");
}
