// The formulas of shaders/lib against quadrature and closed forms in double, and float against double.
#include <cmath>
#include <functional>
#include <random>

#include <gtest/gtest.h>

#include "maths.hpp"

namespace f32 = brume::maths_float;
namespace f64 = brume::maths_double;

namespace {

double simpson(const std::function<double(double)> &f, double a, double b, double fa, double fm, double fb, double whole,
               double tolerance, int depth)
{
    double m = 0.5 * (a + b), l = 0.5 * (a + m), r = 0.5 * (m + b), fl = f(l), fr = f(r);
    double left = (m - a) / 6 * (fa + 4 * fl + fm), right = (b - m) / 6 * (fm + 4 * fr + fb);
    double delta = left + right - whole;
    if (depth <= 0 || std::abs(delta) <= 15 * tolerance)
        return left + right + delta / 15;
    return simpson(f, a, m, fa, fl, fm, left, tolerance / 2, depth - 1) +
           simpson(f, m, b, fm, fr, fb, right, tolerance / 2, depth - 1);
}

double quadrature(const std::function<double(double)> &f, double a, double b)
{
    double sum = 0;
    const int pieces = 64;
    for (int i = 0; i < pieces; ++i) {
        double l = a + (b - a) * i / pieces, r = a + (b - a) * (i + 1) / pieces, m = 0.5 * (l + r);
        double fl = f(l), fm = f(m), fr = f(r), whole = (r - l) / 6 * (fl + 4 * fm + fr);
        sum += simpson(f, l, r, fl, fm, fr, whole, std::abs(whole) * 1e-11 + 1e-300, 10);
    }
    return sum;
}

struct RandomMedium {
    f64::Medium wide{};
    f32::Medium narrow{};
};

RandomMedium random_medium(std::mt19937_64 &random)
{
    std::uniform_real_distribution<double> u(0, 1), s(-1, 1);
    RandomMedium m;
    m.narrow.constant = float(u(random) < 0.5 ? 0 : std::pow(10, 3 * s(random)));
    m.narrow.term_count = int(u(random) * 4);
    for (int i = 0; i < m.narrow.term_count; ++i) {
        double falloff = std::pow(10, -4 + 5 * u(random));
        f64::vec3 n = glm::normalize(f64::vec3(s(random), s(random), s(random)));
        if (u(random) < 0.2)
            n = f64::vec3(0, 1, 0);
        m.narrow.terms[i] = f32::vec4(f32::vec3(falloff * n), float(4 * s(random)));
    }
    m.wide.constant = m.narrow.constant;
    m.wide.term_count = m.narrow.term_count;
    for (int i = 0; i < m.narrow.term_count; ++i)
        m.wide.terms[i] = m.narrow.terms[i];
    return m;
}

double density_at(const f64::Medium &m, f64::vec3 direction, double t)
{
    double rho = m.constant;
    for (int i = 0; i < m.term_count; ++i)
        rho += std::exp(m.terms[i].w - t * glm::dot(f64::vec3(m.terms[i]), direction));
    return rho;
}

}  // namespace

TEST(Maths, MeanExponentialIsExactInDoubleAndFloat)
{
    double worst_wide = 0, worst_narrow = 0;
    for (double q = 1e-12; q < 1e6; q *= 1.01) {
        long double exact = -expm1l(-(long double)q) / q;
        worst_wide = std::max(worst_wide, std::abs(double(f64::mean_exponential(q) / exact - 1)));
        float qf = float(q);
        long double exact_f = -expm1l(-(long double)qf) / qf;
        worst_narrow = std::max(worst_narrow, std::abs(double(f32::mean_exponential(qf) / exact_f - 1)));
    }
    EXPECT_LT(worst_wide, 3e-8) << "truncation of the series";
    EXPECT_LT(worst_narrow, 4e-7);
    EXPECT_EQ(f32::mean_exponential(0.0f), 1.0f);
}

TEST(Maths, DensityIntegralAgreesWithQuadratureOverRandomRays)
{
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> u(0, 1), s(-1, 1);
    double worst_wide = 0, worst_narrow = 0;
    int compared = 0;
    for (int i = 0; i < 3000; ++i) {
        RandomMedium m = random_medium(random);
        f64::vec3 direction = glm::normalize(f64::vec3(s(random), s(random), s(random)));
        if (i % 7 == 0)
            direction = glm::normalize(f64::vec3(1, 1e-7 * s(random), 0));  // nearly perpendicular to a falloff
        double distance = std::pow(10, -6 + 9 * u(random));
        double exponent = 1;
        for (int k = 0; k < m.wide.term_count; ++k)
            exponent = std::max(exponent, std::abs(m.wide.terms[k].w) + distance * glm::length(f64::vec3(m.wide.terms[k])));
        if (exponent > 200)
            continue;  // saturation is another test's matter
        double exact = quadrature([&](double t) { return density_at(m.wide, direction, t); }, 0, distance);
        if (exact < 1e-30 || exact > 1e28)
            continue;
        ++compared;
        double wide = f64::density_integral(m.wide, direction, distance);
        worst_wide = std::max(worst_wide, std::abs(wide / exact - 1));
        double narrow = f32::density_integral(m.narrow, f32::vec3(direction), float(distance));
        // A ray that looks into the dense side multiplies the rounding of its exponent by that exponent.
        worst_narrow = std::max(worst_narrow, std::abs(narrow / exact - 1) / exponent);
    }
    EXPECT_GT(compared, 1500);
    EXPECT_LT(worst_wide, 1e-7);
    EXPECT_LT(worst_narrow, 1e-6) << "relative error over the largest exponent met";
}

TEST(Maths, DensityIntegralIsFiniteAndMonotoneAtTheExtremes)
{
    const float distances[] = {0, 1e-45f, 1e-38f, 1e-6f, 1, 1e6f, 1e9f, 1e30f};
    for (float falloff : {0.0f, 1e-30f, 1e-6f, 0.25f, 1e3f, 1e6f})
        for (float log_density : {-1e6f, -80.0f, 0.0f, 30.0f, 1e6f})
            for (float cosine : {-1.0f, -1e-7f, 0.0f, 1e-7f, 1.0f}) {
                f32::Medium m{};
                m.term_count = 1;
                m.terms[0] = f32::vec4(0, falloff, 0, log_density);
                f32::vec3 direction(std::sqrt(1 - cosine * cosine), cosine, 0);
                float before = 0;
                for (float d : distances) {
                    float p = f32::density_integral(m, direction, d);
                    ASSERT_TRUE(std::isfinite(p) && p >= 0) << falloff << " " << log_density << " " << cosine << " " << d;
                    ASSERT_GE(p, before * (1 - 1e-5f)) << falloff << " " << log_density << " " << cosine << " " << d;
                    before = p;
                }
            }
}

TEST(Maths, SharesOfRadianceAddUp)
{
    f32::Medium m{};
    m.scattering = f32::vec3(0.1f, 0.02f, 0);
    m.absorption = f32::vec3(0, 0.3f, 0.01f);
    m.luminance = f32::vec3(1.0f / 3);
    for (float p : {0.0f, 1e-30f, 1e-12f, 1e-4f, 1.0f, 50.0f, 1e4f, 1e30f}) {
        f32::vec3 t = f32::transmittance(m, p), s = f32::scattered_share(m, p);
        for (int c = 0; c < 3; ++c) {
            double expected = std::exp(-double(m.absorption[c]) * p);
            EXPECT_NEAR(t[c] + s[c], expected, 3e-7) << p << " channel " << c;
            double exact = -std::expm1(-double(m.scattering[c]) * p) * expected;
            EXPECT_NEAR(s[c], exact, 1e-6 * exact + 1e-37) << p << " channel " << c;
        }
        f32::vec3 e = f32::emitted(m, p);
        EXPECT_EQ(e, f32::vec3(0));
    }
}

TEST(Maths, SpreadIsEquationOneWithoutItsSingularities)
{
    f64::Medium m{};
    m.luminance = f64::vec3(1.0 / 3);
    for (double ss : {1e-4, 0.02, 3.0})
        for (double sa : {1e-9, 0.01, 2.0})
            for (double g : {-0.9, 0.0, 0.8, 0.999})
                for (double s : {1e-3, 1.0, 50.0, 1e4}) {
                    m.scattering = f64::vec3(ss);
                    m.absorption = f64::vec3(sa);
                    m.asymmetry = g;
                    double w = std::sqrt(0.5 / (2 * sa / (3 * s) + 4 / (s * s * s * ss * (1 - g))));
                    EXPECT_NEAR(f64::spread_angle(m, s) * s, w, 1e-12 * w);
                }
    f32::Medium n{};
    n.luminance = f32::vec3(1.0f / 3);
    for (float ss : {0.0f, 1e-6f, 1.0f, 1e3f})
        for (float sa : {0.0f, 1e-6f, 1e3f})
            for (float g : {-0.999f, 0.0f, 0.999f, 1.0f})
                for (float p : {0.0f, 1e-30f, 1.0f, 1e30f}) {
                    n.scattering = f32::vec3(ss);
                    n.absorption = f32::vec3(sa);
                    n.asymmetry = g;
                    f32::Camera camera{};
                    camera.focal = f32::vec2(1000);
                    float w = f32::spread_pixels(n, camera, p);
                    ASSERT_TRUE(std::isfinite(w) && w >= 0 && w <= f32::spread_limit)
                        << ss << " " << sa << " " << g << " " << p;
                }
}

TEST(Maths, DepthKindsAgreeOnTheSameSurface)
{
    f32::Camera c{};
    c.far_distance = 1e9f;
    c.metres_per_unit = 1;
    for (float planar : {0.3f, 7.0f, 90.0f}) {
        float stretch = 1.25f, near_end = 0.1f, far_end = 100;
        auto distance = [&](int kind, f32::vec2 range, float raw) {
            c.depth_kind = kind;
            c.depth_range = range;
            return f32::ray_distance(c, raw, stretch);
        };
        float expected = planar * stretch;
        EXPECT_NEAR(distance(f32::depth_planar, {0, 1}, planar), expected, 1e-5f * expected);
        EXPECT_NEAR(distance(f32::depth_ray, {0, 1}, planar * stretch), expected, 1e-5f * expected);
        EXPECT_NEAR(distance(f32::depth_inverse, {0, 1}, 1 / planar), expected, 1e-5f * expected);
        EXPECT_NEAR(distance(f32::depth_normalized, {near_end, far_end}, (planar - near_end) / (far_end - near_end)),
                    expected, 1e-4f * expected);
        float z = (1 / planar - 1 / near_end) / (1 / far_end - 1 / near_end);
        EXPECT_NEAR(distance(f32::depth_device, {1 / near_end, 1 / far_end}, z), expected, 1e-3f * expected);
        float reversed_infinite = near_end / planar;
        EXPECT_NEAR(distance(f32::depth_device, {0, 1 / near_end}, reversed_infinite), expected, 1e-4f * expected);
    }
    c.depth_kind = f32::depth_planar;
    for (float raw : {0.0f, -1.0f, -INFINITY, INFINITY, NAN, 1e9f, 1e30f, 3e38f})
        EXPECT_EQ(f32::ray_distance(c, raw, 1.5f), f32::far_away) << raw;
    c.nonpositive = f32::nonpositive_near;
    for (float raw : {0.0f, -1.0f})
        EXPECT_EQ(f32::ray_distance(c, raw, 1.5f), 0.0f) << raw;
    EXPECT_EQ(f32::ray_distance(c, NAN, 1.5f), f32::far_away);
    c.depth_kind = f32::depth_device;
    c.depth_range = {1 / 0.1f, 1 / 100.0f};
    EXPECT_EQ(f32::ray_distance(c, 1.0f, 1), f32::far_away) << "the cleared depth buffer";
    c.depth_range = {0, 1 / 0.1f};
    EXPECT_EQ(f32::ray_distance(c, 0.0f, 1), f32::far_away) << "the cleared reversed depth buffer";
}

TEST(Maths, KernelsAreNormalisedWithVariancesOfTheBinomials)
{
    for (int n : {2, 4, 6}) {
        double sum = 0, variance = 0;
        for (int i = 0; i < n; ++i) {
            double offset = i - 0.5 * (n - 1);
            sum += f64::kernel_weight(n, i);
            variance += f64::kernel_weight(n, i) * offset * offset;
        }
        EXPECT_NEAR(sum, 1, 1e-15);
        EXPECT_NEAR(variance, n == 2 ? 0.25 : n == 4 ? 0.77 : 1.25, 1e-12);
    }
    for (double f = 0; f <= 1; f += 0.01) {
        f64::vec4 w = f64::cubic_weights(f);
        EXPECT_NEAR(w.x + w.y + w.z + w.w, 1, 1e-14);
        EXPECT_NEAR(-w.x + w.z + 2 * w.w, f, 1e-14) << "reproduces linear functions";
    }
}
