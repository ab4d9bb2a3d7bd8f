// shaders/lib of the airlight against closed forms and quadrature in double, and float against double.
#include <random>

#include <gtest/gtest.h>

#include "airlight_world.h"

namespace f32 = brume::maths_float;
namespace f64 = brume::maths_double;
using airlight_cases::Dice;
using std::numbers::pi;

namespace {

template <class Function> double simpson(const Function &f, double from, double to, int pieces)
{
    double sum = 0;
    const double width = (to - from) / pieces;
    for (int i = 0; i < pieces; ++i) {
        const double a = from + i * width;
        sum += width / 6 * (f(a) + 4 * f(a + width / 2) + f(a + width));
    }
    return sum;
}

f64::Gaussian random_gaussian(Dice &dice, f64::vec3 direction)
{
    f64::Gaussian g{};
    g.scale = dice.logarithmic(0.01, 100);
    g.amplitude = dice.logarithmic(0.01, 100);
    g.color = f64::vec3(1);
    const f64::vec3 side = glm::normalize(glm::cross(direction, dice.direction()));
    g.center = airlight_cases::rounded(direction * (dice.uniform(-4, 8) / g.scale) + side * (dice.uniform(0, 2) / g.scale));
    return g;
}

f32::Gaussian narrowed(const f64::Gaussian &g)
{
    return {f32::vec3(g.center), float(g.scale), float(g.amplitude), f32::vec3(g.color)};
}

}  // namespace

TEST(AirlightMaths, ErrorFunctionsAreFullySingle)
{
    double erf_wide = 0, erf_narrow = 0, erfc_wide = 0, erfc_narrow = 0;
    for (double x = 1e-6; x < 12; x *= 1.003) {
        const float xf = float(x);
        erf_wide = std::max(erf_wide, std::abs(f64::erf(x) / std::erf(x) - 1));
        erf_narrow = std::max(erf_narrow, std::abs(f32::erf(xf) / std::erf(double(xf)) - 1));
        const double scaled = double(std::exp((long double)x * x) * erfcl(x));
        erfc_wide = std::max(erfc_wide, std::abs(f64::scaled_erfc(x) / scaled - 1));
        erfc_narrow = std::max(erfc_narrow, std::abs(f32::scaled_erfc(xf) / f64::scaled_erfc(double(xf)) - 1));
    }
    EXPECT_LT(erf_wide, 4e-8) << "the clamp at 3.9";
    EXPECT_LT(erf_narrow, 4e-7);
    EXPECT_LT(erfc_wide, 5e-9);
    EXPECT_LT(erfc_narrow, 4e-7);
    EXPECT_EQ(f32::erf(-1e30f), -f32::erf(1e30f));
}

TEST(AirlightMaths, GaussianIntegralsAndMomentsAgreeWithQuadrature)
{
    Dice dice(1);
    double worst_integral = 0, worst_depth = 0, worst_moment = 0;
    for (int i = 0; i < 3000; ++i) {
        const f64::vec3 direction = airlight_cases::rounded(dice.direction());
        const f64::Gaussian g = random_gaussian(dice, direction);
        const double distance = dice.logarithmic(0.01, 30) / g.scale;
        const f64::Profile p = f64::profile_along(g, f64::vec3(0), direction);
        auto rho = [&](double t) {
            return g.amplitude * std::exp(-std::pow(g.scale * glm::length(t * direction - g.center), 2));
        };
        const double exact = simpson(rho, 0, distance, 2000), whole = p.peak / p.scale * std::sqrt(pi);
        const double moment = simpson([&](double t) { return rho(t) * std::pow(1 - t / distance, 2); }, 0, distance, 2000);
        const f32::Gaussian n = narrowed(g);
        const f32::vec3 d(direction);
        const double found = f32::gaussian_integral(n, f32::vec3(0), d, 0, float(distance));
        // The exponents' rounding grows with how far out on the flank the ray passes and begins.
        const double exponent = 1 + std::pow(g.scale * glm::length(g.center), 2);
        worst_integral = std::max(worst_integral, std::abs(found / exact - 1) / exponent);
        worst_depth = std::max(
            worst_depth, std::abs(f32::profile_depth(f32::profile_along(n, f32::vec3(0), d), 0, float(distance)) - exact) /
                             whole / exponent);
        const f32::vec2 both = f32::gaussian_density_moment(n, d, float(distance));
        worst_integral = std::max(worst_integral, std::abs(both.x / exact - 1) / exponent);
        worst_moment = std::max(worst_moment, std::abs(both.y - moment) / exact / exponent);
    }
    EXPECT_LT(worst_integral, 1e-6) << "relative to itself, over the exponent";
    EXPECT_LT(worst_depth, 1e-6) << "relative to the whole line's";
    EXPECT_LT(worst_moment, 2e-4) << "relative to the integral; its terms cancel on the flanks";
}

TEST(AirlightMaths, GaussianIntegralsAreFiniteAtTheExtremes)
{
    for (float distance : {0.0f, 1e-45f, 1e-6f, 1.0f, 1e6f, 1e30f})
        for (float scale : {1e-30f, 1e-6f, 1.0f, 1e6f, 1e30f})
            for (float amplitude : {0.0f, 1e-30f, 1.0f, 1e30f})
                for (float away : {0.0f, 1e-6f, 1.0f, 1e6f, 1e15f}) {
                    const f32::Gaussian g{f32::vec3(away, 0.3f * away, -away), scale, amplitude, f32::vec3(1)};
                    const f32::vec2 m = f32::gaussian_density_moment(g, f32::vec3(0, 0, -1), distance);
                    const float p =
                        f32::profile_depth(f32::profile_along(g, f32::vec3(0), f32::vec3(0, 0, -1)), 0, distance);
                    for (float v : {m.x, m.y, p})
                        ASSERT_TRUE(std::isfinite(v) && v >= 0 && v <= f32::density_limit)
                            << v << ": D " << distance << " a " << scale << " c " << amplitude << " b " << away;
                    ASSERT_LE(m.y, m.x * 1.0001f);
                }
}

TEST(AirlightMaths, DensityBetweenPointsAndItsMomentAgreeWithQuadrature)
{
    Dice dice(2);
    double worst_between = 0, worst_moment = 0;
    for (int i = 0; i < 2000; ++i) {
        f64::Medium m{};
        m.constant = dice.chance(0.5) ? 0 : dice.logarithmic(0.01, 10);
        m.term_count = dice.count(0, 3);
        for (int k = 0; k < m.term_count; ++k)
            m.terms[k] =
                f64::vec4(airlight_cases::rounded(dice.logarithmic(1e-4, 1) * dice.direction()), dice.uniform(-2, 2));
        const f64::vec3 origin = airlight_cases::rounded(dice.uniform(0, 5) * dice.direction());
        const f64::vec3 direction = airlight_cases::rounded(dice.direction());
        const double distance = dice.logarithmic(1e-3, 30);
        auto rho = [&](f64::vec3 from) {
            return [&, from](double t) {
                double sum = m.constant;
                for (int k = 0; k < m.term_count; ++k)
                    sum += std::exp(m.terms[k].w - glm::dot(f64::vec3(m.terms[k]), from + t * direction));
                return sum;
            };
        };
        const f32::Medium n = airlight_cases::narrowed(m);
        const double between = simpson(rho(origin), 0, distance, 400);
        if (between == 0)
            continue;
        const double found =
            f32::density_between(n, f32::vec3(origin), f32::vec3(direction), float(distance), float(distance));
        worst_between = std::max(worst_between, std::abs(found / between - 1));
        auto density = rho(f64::vec3(0));
        const double moment =
            simpson([&](double t) { return density(t) * std::pow(1 - t / distance, 2); }, 0, distance, 400);
        worst_moment =
            std::max(worst_moment, std::abs(f32::density_moment(n, f32::vec3(direction), float(distance)) / moment - 1));
        EXPECT_NEAR(f32::density_at(n, f32::vec3(origin)), rho(origin)(0), 1e-5 * rho(origin)(0));
    }
    EXPECT_LT(worst_between, 1e-5) << "its exponent reaches 30";
    EXPECT_LT(worst_moment, 1e-5);
    f32::Medium m{};
    m.constant = 1;
    m.term_count = 1;
    for (float falloff : {-1e6f, -1.0f, -1e-30f, 0.0f, 1e-8f, 1e6f})
        for (float d : {0.0f, 1e-45f, 1.0f, 1e30f}) {
            m.terms[0] = f32::vec4(0, 0, -falloff, 3);
            const float moment = f32::density_moment(m, f32::vec3(0, 0, -1), d);
            EXPECT_TRUE(std::isfinite(moment) && moment >= 0) << falloff << " " << d;
        }
}

TEST(AirlightMaths, PhaseFunctionsAreNormalisedHaveTheirMeanCosineAndStayFinite)
{
    auto over_sphere = [](const f64::Medium &m, auto weight) {
        // The cosine as +-(1 - 2 x^4): peaks need the nodes there.
        const double side = m.phase.x < 0 ? -1 : 1;
        auto f = [&](double x) {
            const double cosine = side * (1 - 2 * std::pow(x, 4));
            return 2 * pi * 8 * x * x * x * f64::phase(m, cosine) * weight(cosine);
        };
        return simpson(f, 0, 1, 4000);
    };
    for (double g : {-0.9, 0.0, 0.5, 0.95, 0.99}) {
        f64::Medium m{};
        m.phase.x = g;
        EXPECT_NEAR(over_sphere(m, [](double) { return 1.0; }), 1, 1e-6) << g;
        EXPECT_NEAR(over_sphere(m, [](double c) { return c; }), g, 1e-6) << g;
        m.phase = f64::vec4(g, 0.3 * g, 5.0, 0.4);
        EXPECT_NEAR(over_sphere(m, [](double) { return 1.0; }), 1, 1e-6) << "with Draine";
    }
    for (float g : {-1.0f, -0.999f, 0.0f, 0.999f, 1.0f})
        for (float cosine : {-1.0f, -0.5f, 0.0f, 0.99999994f, 1.0f, 1.0000001f}) {
            f32::Medium m{};
            m.phase = f32::vec4(g, g, 10, 0.5f);
            const float p = f32::phase(m, cosine);
            EXPECT_TRUE(std::isfinite(p) && p >= 0) << g << " " << cosine;
        }
}

TEST(AirlightMaths, ConesAreClippedWhereTheirFactorEnds)
{
    Dice dice(3);
    int lit = 0, dark = 0;
    for (int i = 0; i < 20000; ++i) {
        f32::Light l{};
        l.type = f32::light_spot;
        l.position = f32::vec3(dice.uniform(0, 5) * dice.direction());
        l.direction = f32::vec3(dice.direction());
        const double angle = dice.chance(0.1) ? 90.0 : dice.uniform(1, 90);
        l.cos_outer = float(std::max(0.0, std::cos(angle * pi / 180)));
        l.cos_inner = 1;
        const f32::vec3 direction(dice.direction());
        const f32::vec2 part = f32::lit_interval(l, direction, 20, l.cos_outer);
        for (int k = 0; k < 10; ++k) {
            const float t = float(dice.uniform(0, 20));
            const f32::vec3 from = t * direction - l.position;
            const float cosine = glm::dot(from, l.direction) / glm::length(from);
            if (std::abs(cosine - l.cos_outer) < 1e-3f)
                continue;
            const bool inside = cosine > l.cos_outer;
            ASSERT_EQ(inside, t >= part.x && t <= part.y)
                << angle << " degrees, t " << t << " of " << part.x << " to " << part.y;
            ++(inside ? lit : dark);
        }
    }
    EXPECT_GT(lit, 20000);
    EXPECT_GT(dark, 20000);
}

TEST(AirlightMaths, OctahedralMapIsItsOwnInverseAndCoversTheSquare)
{
    Dice dice(4);
    std::vector<int> hits(64);
    for (int i = 0; i < 20000; ++i) {
        const f32::vec3 d(glm::normalize(dice.direction()));
        const f32::vec2 square = f32::octahedral(3.0f * d);
        ASSERT_TRUE(square.x >= 0 && square.x <= 1 && square.y >= 0 && square.y <= 1);
        ASSERT_LT(glm::length(f32::octahedral_direction(square) - d), 1e-6f);
        ++hits[size_t(f32::cell_of(square, 8))];
    }
    for (int h : hits)
        EXPECT_GT(h, 20000 / 64 / 4) << "cells are of like solid angle";
    for (f32::vec3 d : {f32::vec3(0), f32::vec3(0, 0, -1), f32::vec3(1, 0, 0)})
        EXPECT_TRUE(std::isfinite(f32::octahedral(d).x));
}

TEST(AirlightMaths, FluenceOfASphereIsItsSolidAngle)
{
    for (double r : {0.01, 0.5, 2.0})
        for (double d : {1.0, 1.3, 4.0, 100.0}) {
            const double angle = 2 * pi * (1 - std::sqrt(1 - 1 / (d * d)));
            EXPECT_NEAR(f64::fluence(d * r, r) * pi * r * r, angle, 1e-9 * angle + 1e-13);
        }
    EXPECT_EQ(f32::fluence(0.0f, 0.5f), 8.0f) << "constant within";
}

TEST(AirlightTables, ReferenceAgreesWithTheClosedFormOfHomogeneousMedia)
{
    // La = beta I / (2 pi h) [e^-(Tvp + Tsp) Im E(beta h (xb + i)) - e^-Tsv Im E(beta h (xa + i))], E(z) = e^z E1(z).
    Dice dice(5);
    double worst = 0;
    int compared = 0;
    while (compared < 150) {
        airlight_cases::Case c = airlight_cases::homogeneous(dice, dice.uniform(0.05, 179.9) * airlight_cases::degree,
                                                             dice.logarithmic(0.001, 8));
        c.direction = glm::normalize(c.direction);
        c.distance = std::min(c.distance, 1e6);
        c.medium.absorption = f64::vec3(0);
        const f64::Light &l = c.lights[0];
        const f64::Aspect aspect = f64::aspect_of(l, c.direction);
        const double h = aspect.height, beta = c.medium.scattering.x, near = std::hypot(aspect.foot, h),
                     w = c.distance - aspect.foot, far = std::hypot(w, h);
        auto steepness = [h](double w) { return w < 0 ? h / (std::hypot(w, h) - w) : (w + std::hypot(w, h)) / h; };
        auto im = [&](double x) { return brume::airlight::scaled_exponential_integral({beta * h * x, beta * h}).imag(); };
        const double exact =
            beta / (2 * pi * h) *
            (std::exp(-beta * (c.distance + far)) * im(steepness(w)) - std::exp(-beta * near) * im(steepness(-aspect.foot)));
        if (exact < 1e-20)
            continue;
        const auto found =
            brume::airlight::reference_airlight({c.medium, {}, c.lights}, c.direction, c.distance, 0, 1, 1e-11);
        worst = std::max(worst, std::abs(found.radiance.x / exact - 1));
        ++compared;
    }
    EXPECT_LT(worst, 1e-8);
}

TEST(AirlightTables, SunTableIsTheImaginaryPartOfAnExponentialIntegral)
{
    // F(u, v) = Im { e^(iu) [E1(u tan v + i u) - E1(i u)] }.
    for (double u : {1e-3, 0.1, 1.0, 4.0, 10.0})
        for (double v : {0.1, 0.7, 1.2, 1.5}) {
            const std::complex<double> i(0, 1), z = u * std::tan(v) + i * u;
            auto e1 = [](std::complex<double> x) { return std::exp(-x) * brume::airlight::scaled_exponential_integral(x); };
            EXPECT_NEAR(brume::airlight::sun_function(u, v), (std::exp(i * u) * (e1(z) - e1(i * u))).imag(), 1e-12);
        }
    EXPECT_DOUBLE_EQ(brume::airlight::sun_function(0, 1), 1);
    const std::vector<float> &table = brume::airlight::sun_table();
    const f32::Texture image{table.data(), 1024, 1024, 4, 1};
    double worst = 0;
    for (double u = 0; u <= 10; u += 0.037)
        for (double v = 0; v <= pi / 2; v += 0.0173) {
            const double error =
                std::abs(f32::sun_function(image, float(u), float(v)) - brume::airlight::sun_function(u, v));
            worst = std::max(worst, error);
            EXPECT_LE(error, f32::sun_function_error(float(u), float(v)) + 1e-6) << u << " " << v;
        }
    EXPECT_LT(worst, 0.05) << "64 x 64 entries, bilinear; it is u log u at u = 0, v = pi / 2";
}

TEST(AirlightTables, SpreadCoefficientsAreThoseOfThePaperAtDepthOne)
{
    const double paper[] = {0.332818, 0.332488, 0.302428, 0.275773, 0.254051, 0.236333};
    const auto c = brume::airlight::psf_coefficients(1);
    for (size_t l = 0; l < 6; ++l)
        EXPECT_NEAR(c[l], paper[l], 2e-4 * paper[l]) << "l " << l;
    // Other depths, from the definition by quadrature: PSF_T(g) = T e^(-T cos g) / (2 pi sin g) int_(g/2)^(pi/2) e^(-T sin g
    // tan x) dx.
    for (double depth : {0.05, 0.5, 4.0}) {
        auto psf_sine = [depth](double g) {
            const double u = depth * std::sin(g);
            auto inner = [=](double y) {  // x = pi/2 - y^2
                return y <= 0 ? 0.0 : 2 * y * std::exp(-u / std::tan(y * y));
            };
            return depth * std::exp(-depth * std::cos(g)) / (2 * pi) * simpson(inner, 0, std::sqrt(pi / 2 - g / 2), 2000);
        };
        const auto found = brume::airlight::psf_coefficients(depth);
        for (unsigned l : {0u, 1u, 5u}) {
            const double exact = simpson(
                                     [&](double x) {
                                         const double g = pi * x * x;
                                         return 2 * pi * x * 2 * pi * psf_sine(g) * std::sqrt((2 * l + 1) / (4 * pi)) *
                                                std::legendre(l, std::cos(g));
                                     },
                                     0, 1, 300) /
                                 (depth * std::exp(-depth));
            EXPECT_NEAR(found[l], exact, 1e-4 * exact) << "T " << depth << " l " << l;
        }
    }
}

TEST(AirlightEnvironment, IsTheConvolutionWithTheMediumsSpread)
{
    const std::vector<float> &table = brume::airlight::environment_table();
    const f32::Texture table_image{table.data(), 1024 * 4, 1024, 1, 4};
    f32::Camera camera{};
    camera.right = {0, 0, -1};  // turned, so that a mixed up frame shows
    camera.up = {0, 1, 0};
    camera.back = {1, 0, 0};
    f32::Medium m{};
    m.scattering = f32::vec3(1, 0.5f, 0.1f);
    m.absorption = f32::vec3(0, 0.5f, 0);
    Dice dice(6);
    for (int index = 0; index < 36; ++index) {
        std::vector<float> values(1024 * 4);
        for (int c = 0; c < 3; ++c)
            values[size_t(4 * index + c)] = 1;
        const f32::Texture image{values.data(), 1024 * 4, 1024, 1, 4};
        const unsigned l = unsigned(std::sqrt(index));
        const int order = index - int(l * l) - int(l);
        for (int k = 0; k < 20; ++k) {
            const f64::vec3 d = glm::normalize(dice.direction());
            const f64::vec3 world = d.x * f64::vec3(0, 0, -1) + d.y * f64::vec3(0, 1, 0) + d.z * f64::vec3(1, 0, 0);
            const unsigned am = unsigned(std::abs(order));
            double norm = (2 * l + 1) / (4 * pi) * (order ? 2 : 1);
            for (unsigned f = l - am + 1; f <= l + am; ++f)
                norm /= f;
            const double phi = std::atan2(world.y, world.x);
            const double y = std::sqrt(norm) * std::assoc_legendre(l, am, world.z) *
                             (order < 0 ? std::sin(am * phi) : std::cos(am * phi));
            const double p = dice.logarithmic(1e-6, 30);
            const f32::vec3 found = f32::environment_airlight(m, camera, image, table_image, 6, 0, f32::vec3(d), float(p));
            for (int c = 0; c < 3; ++c) {
                const double depth = (m.scattering[c] + m.absorption[c]) * p,
                             albedo = m.scattering[c] / (m.scattering[c] + m.absorption[c]);
                const double factor =
                    std::sqrt(4 * pi / (2 * l + 1)) * brume::airlight::psf_coefficients(depth)[l] * depth * std::exp(-depth);
                EXPECT_NEAR(found[c], std::max(0.0, albedo * factor * y), 3e-3 * factor)
                    << "l " << l << " m " << order << " T " << depth;
            }
        }
    }
    std::vector<float> constant(1024 * 4);
    for (int c = 0; c < 3; ++c)
        constant[size_t(c)] = float(std::sqrt(4 * pi));
    const f32::Texture image{constant.data(), 1024 * 4, 1024, 1, 4};
    for (float p : {0.0f, 1e-30f, 1e-12f, 1e4f, 1e30f}) {
        const f32::vec3 l = f32::environment_airlight(m, camera, image, table_image, 1, 0, f32::vec3(0, 0, -1), p);
        EXPECT_TRUE(std::isfinite(l.x) && l.x >= 0 && l.x <= 1) << p;
    }
}

TEST(AirlightShadow, ListsFindTheDensityOfAllGaussians)
{
    Dice dice(7);
    for (int trial = 0; trial < 20; ++trial) {
        airlight_cases::Case c = airlight_cases::bank(dice, 40);
        c.lights.push_back(c.lights[0]);
        c.lights[1].type = f64::light_directional;
        c.lights[1].position = f64::vec3(0);
        c.lights[1].direction = airlight_cases::rounded(glm::normalize(dice.direction()));
        airlight_cases::World world(c);
        for (int k = 0; k < 50; ++k) {
            const f64::vec3 x =
                airlight_cases::rounded(dice.uniform(0, 2) * c.lights[0].position + dice.uniform(0, 1) * dice.direction());
            for (int l = -1; l < 2; ++l) {
                double exact = 0, whole = 0;
                for (const f64::Gaussian &g : c.gaussians) {
                    const f64::vec3 way = l < 0 ? -x : l == 0 ? c.lights[0].position - x : -c.lights[1].direction;
                    const double d = l == 1 ? 1e4 : glm::length(way);
                    exact += f64::gaussian_integral(g, x, glm::normalize(way), 0, d);
                    whole += g.amplitude / g.scale;
                }
                EXPECT_NEAR(world.shadow(l, x), exact, 1e-5 * exact + 4e-6 * whole / 40) << "light " << l;
            }
        }
    }
}
