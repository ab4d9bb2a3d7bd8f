#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "base/error.h"
#include "scene/scene.h"
#include "maths.hpp"

namespace brume {
namespace {

using Vector = std::array<double, 3>;
using Matrix = std::array<double, 16>;

constexpr Matrix identity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

double dot(const Vector &a, const Vector &b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector normalized(const Vector &v)
{
    const double length = std::sqrt(dot(v, v));
    return {v[0] / length, v[1] / length, v[2] / length};
}

Number3 numbers(const Vector &v)
{
    return {v[0], v[1], v[2]};
}

// Simpson's rule.
double integrate(const std::function<double(double)> &f, double a, double b, int intervals)
{
    const double h = (b - a) / intervals;
    double sum = f(a) + f(b);
    for (int i = 1; i < intervals; ++i)
        sum += (i % 2 ? 4.0 : 2.0) * f(a + i * h);
    return sum * h / 3.0;
}

class Random {
public:
    double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(engine_); }

    Vector direction()
    {
        std::normal_distribution<double> normal;
        return normalized({normal(engine_), normal(engine_), normal(engine_)});
    }

    Matrix pose(const Vector &position)
    {
        const Vector z = direction(), any = direction();
        const Vector x =
            normalized({any[1] * z[2] - any[2] * z[1], any[2] * z[0] - any[0] * z[2], any[0] * z[1] - any[1] * z[0]});
        const Vector y{z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]};
        return {x[0], y[0], z[0], position[0], x[1], y[1], z[1], position[1], x[2], y[2], z[2], position[2], 0, 0, 0, 1};
    }

private:
    std::mt19937_64 engine_{20260101};
};

DensityTerm exponential(double value, double falloff, const Vector &direction, const Vector &origin)
{
    DensityTerm term;
    term.type = BRUME_DENSITY_EXPONENTIAL;
    term.value = value;
    term.falloff = falloff;
    term.direction = numbers(direction);
    term.origin = numbers(origin);
    return term;
}

DensityTerm constant(double value)
{
    DensityTerm term;
    term.value = value;
    return term;
}

// The definition, at a point in metres.
double density_at(const Scene &scene, const Vector &x)
{
    double density = 0.0;
    for (const DensityTerm &term : scene.medium->density) {
        double height = 0.0;
        if (term.type == BRUME_DENSITY_EXPONENTIAL) {
            Vector n, from_origin;
            for (size_t i = 0; i < 3; ++i) {
                n[i] = term.direction[i].at(0);
                from_origin[i] = x[i] - term.origin[i].at(0) * scene.metres_per_unit;
            }
            height = dot(from_origin, normalized(n));
        }
        density += term.value.at(0) * std::exp(-term.falloff.at(0) * height);
    }
    return density;
}

maths_double::Medium in_double(const brume_plugin_medium &medium)
{
    maths_double::Medium out{};
    out.constant = medium.constant;
    out.term_count = medium.term_count;
    for (int i = 0; i < medium.term_count; ++i)
        out.terms[i] = {medium.terms[i][0], medium.terms[i][1], medium.terms[i][2], medium.terms[i][3]};
    return out;
}

// Compares the integrals of the evaluated medium with quadrature of the definition along rays of one camera. What may
// differ is the rounding of the terms to float, in the exponent.
void expect_same_integrals(const Scene &scene, const Matrix &pose, double distance, Random &random)
{
    brume_plugin_medium medium;
    evaluate_medium(scene, 0.0, pose, medium);
    const maths_double::Medium evaluated = in_double(medium);
    double exponent = 0.0;
    for (int i = 0; i < medium.term_count; ++i) {
        const float *term = medium.terms[i];
        exponent = std::max(exponent, std::abs(double(term[3])) + std::hypot(term[0], term[1], term[2]) * distance);
    }
    const double tolerance = 1e-7 + 2.0 * std::exp2(-24) * exponent;

    for (int ray = 0; ray < 20; ++ray) {
        const Vector w = random.direction();
        Vector in_camera{}, position{};
        for (size_t i = 0; i < 3; ++i) {
            position[i] = pose[4 * i + 3] * scene.metres_per_unit;
            for (size_t j = 0; j < 3; ++j)
                in_camera[j] += pose[4 * i + j] * w[i];
        }
        const auto along = [&](double t) {
            return density_at(scene, {position[0] + t * w[0], position[1] + t * w[1], position[2] + t * w[2]});
        };
        const double expected = integrate(along, 0.0, distance, 2000);
        const double got = maths_double::density_integral(evaluated, {in_camera[0], in_camera[1], in_camera[2]}, distance);
        EXPECT_NEAR(got / expected, 1.0, tolerance) << "ray " << ray << " distance " << distance;
    }
}

Scene scene_with(std::vector<DensityTerm> terms)
{
    Scene scene;
    scene.medium.emplace();
    scene.medium->density = std::move(terms);
    return scene;
}

TEST(Number, InterpolatesBetweenKeysAndHoldsOutside)
{
    const Number number({{1.0, 10.0}, {3.0, 20.0}, {4.0, 0.0}});
    EXPECT_EQ(number.at(-1e300), 10.0);
    EXPECT_EQ(number.at(1.0), 10.0);
    EXPECT_EQ(number.at(2.0), 15.0);
    EXPECT_EQ(number.at(3.0), 20.0);
    EXPECT_EQ(number.at(3.25), 15.0);
    EXPECT_EQ(number.at(4.0), 0.0);
    EXPECT_EQ(number.at(1e300), 0.0);
    EXPECT_TRUE(number.animated());
    EXPECT_EQ(Number(7.0).at(5.0), 7.0);
    EXPECT_FALSE(Number(7.0).animated());
}

TEST(Scene, KnowsWhatIsAnimated)
{
    const Number keyed({{1.0, 0.1}, {2.0, 0.2}});
    const auto with = [&](const std::function<void(Scene &)> &change) {
        Scene scene = scene_with({exponential(1, 1, {0, 1, 0}, {0, 0, 0})});
        scene.camera.camera_to_world.emplace();
        change(scene);
        return scene.animated();
    };
    EXPECT_FALSE(Scene().animated());
    EXPECT_FALSE(with([](Scene &) {}));
    EXPECT_TRUE(with([&](Scene &s) { s.medium->emission[2] = keyed; }));
    EXPECT_TRUE(with([&](Scene &s) { s.medium->visibility = keyed; }));
    EXPECT_TRUE(with([&](Scene &s) { s.medium->density[0].origin[1] = keyed; }));
    EXPECT_TRUE(with([&](Scene &s) { s.camera.vertical_fov = keyed; }));
    EXPECT_TRUE(with([&](Scene &s) { s.camera.center[1] = keyed; }));
    EXPECT_TRUE(with([&](Scene &s) { (*s.camera.camera_to_world)[3] = keyed; }));
}

TEST(Scene, PoseMattersForHeightFogOnly)
{
    EXPECT_FALSE(pose_matters(Scene()));
    EXPECT_FALSE(pose_matters(scene_with({})));
    EXPECT_FALSE(pose_matters(scene_with({constant(1)})));
    EXPECT_FALSE(pose_matters(scene_with({exponential(1, 0, {0, 1, 0}, {0, 0, 0})})));
    EXPECT_FALSE(pose_matters(scene_with({exponential(0, 1, {0, 1, 0}, {0, 0, 0})})));
    EXPECT_TRUE(pose_matters(scene_with({constant(1), exponential(1, 1e-9, {0, 1, 0}, {0, 0, 0})})));
}

TEST(EvaluateMedium, CoefficientsAndDefaults)
{
    Scene scene = scene_with({});
    brume_plugin_medium medium;
    evaluate_medium(scene, 0.0, identity, medium);
    EXPECT_EQ(medium.constant, 1.0f);
    EXPECT_EQ(medium.term_count, 0);
    EXPECT_EQ(medium.luminance[1], 0.7152f);

    scene.medium->absorption = numbers({0.1, 0.0, 0.01});
    scene.medium->visibility = 39.12;
    evaluate_medium(scene, 0.0, identity, medium);
    EXPECT_NEAR(medium.scattering[0], 0.0f, 1e-8f);
    EXPECT_FLOAT_EQ(medium.scattering[1], 0.1f);
    EXPECT_FLOAT_EQ(medium.scattering[2], 0.09f);

    scene.medium->absorption = numbers({0.5, 0.0, 0.0});
    EXPECT_THROW(evaluate_medium(scene, 0.0, identity, medium), Error)
        << "absorption alone is more than that visibility allows";
    scene.medium->visibility.reset();

    scene.medium->density = {constant(0.25), constant(0.5), exponential(2, 0, {0, 1, 0}, {0, 0, 0}),
                             exponential(0, 1, {0, 1, 0}, {0, 0, 0})};
    evaluate_medium(scene, 0.0, identity, medium);
    EXPECT_EQ(medium.constant, 2.75f);
    EXPECT_EQ(medium.term_count, 0);

    evaluate_medium(Scene(), 0.0, identity, medium);
    EXPECT_EQ(medium.constant, 0.0f);
    EXPECT_EQ(medium.luminance[0], 0.2126f);
}

TEST(EvaluateMedium, DensityIntegralsAreThoseOfTheDefinition)
{
    Random random;
    for (int i = 0; i < 10; ++i) {
        Scene scene = scene_with({constant(random.uniform(0, 1))});
        scene.metres_per_unit = i % 2 ? 0.01 : 3.0;
        const double units = 1.0 / scene.metres_per_unit;
        for (int term = 0; term < 3; ++term) {
            Vector n = random.direction(), origin;
            for (double &x : n)
                x *= 7.0;
            for (double &x : origin)
                x = random.uniform(-10, 10) * units;
            scene.medium->density.push_back(exponential(random.uniform(0.1, 2), random.uniform(0, 0.5), n, origin));
        }
        const Vector position{random.uniform(-5, 5) * units, random.uniform(-5, 5) * units, random.uniform(-5, 5) * units};
        expect_same_integrals(scene, random.pose(position), random.uniform(0.1, 60), random);
    }
}

TEST(EvaluateMedium, FarFromTheOrigin)
{
    Random random;
    const Vector far{1e6, -1e6, 1e6};
    const Vector near_camera{1e6 + 3, -1e6 + 2, 1e6 - 1};
    const Scene beside = scene_with({exponential(1, 0.25, {0, 0, 1}, near_camera), exponential(0.5, 1, {1, 1, 0}, far)});
    expect_same_integrals(beside, random.pose(far), 20.0, random);
    const Scene haze = scene_with({exponential(1, 1e-5, {0, 1, 0.5}, {0, 0, 0})});
    expect_same_integrals(haze, random.pose(far), 1e6, random);
}

// Scattering by droplets: Jendersie and d'Eon's mixture, its mean cosine taken by quadrature.
TEST(EvaluateMedium, DropletsHaveTheMeanCosineOfTheirPhaseFunction)
{
    for (double d : {5.0, 8.0, 14.0, 20.0, 35.0, 50.0}) {
        const double g_hg = std::exp(-0.0990567 / (d - 1.67154));
        const double g_draine = std::exp(-2.20679 / (d + 3.91029) - 0.428934);
        const double alpha = std::exp(3.62489 - 8.29288 / (d + 5.52825));
        const double weight = std::exp(-0.599085 / (d - 0.641583) - 0.665888);
        // In an angle that spreads the forward peak: 1 - cosine = 2 s^4.
        const auto moment = [&](double g, double a, int power) {
            const auto integrand = [&](double s) {
                const double cosine = 1.0 - 2.0 * std::pow(s, 4), jacobian = 8.0 * std::pow(s, 3);
                const double phase = (1 - g * g) / std::pow(1 + g * g - 2 * g * cosine, 1.5) * (1 + a * cosine * cosine) /
                                     (1 + a * (1 + 2 * g * g) / 3) / (4 * std::numbers::pi);
                return 2 * std::numbers::pi * phase * std::pow(cosine, power) * jacobian;
            };
            return integrate(integrand, 0.0, 1.0, 20000);
        };
        const auto mixed = [&](int power) {
            return (1 - weight) * moment(g_hg, 0.0, power) + weight * moment(g_draine, alpha, power);
        };
        EXPECT_NEAR(mixed(0), 1.0, 1e-9) << d;

        Scene scene = scene_with({});
        scene.medium->droplet_diameter = d;
        brume_plugin_medium medium;
        evaluate_medium(scene, 0.0, identity, medium);
        EXPECT_NEAR(medium.asymmetry, mixed(1), 1e-7) << d;
    }
}

std::string failure(const Scene &scene, double frame, const Matrix &pose = identity)
{
    try {
        brume_plugin_medium medium;
        evaluate_medium(scene, frame, pose, medium);
    } catch (const Error &error) {
        EXPECT_EQ(error.status(), BRUME_ERROR_ARGUMENT);
        return error.what();
    }
    return "";
}

TEST(EvaluateMedium, RefusesWhatKeysLeadTo)
{
    Scene scene = scene_with({exponential(1, 1, {0, 1, 0}, {0, 0, 0})});
    scene.medium->density[0].direction[1] = Number({{1.0, 1.0}, {3.0, -1.0}});
    EXPECT_EQ(failure(scene, 1.0), "");
    EXPECT_EQ(failure(scene, 2.0), "medium.density[0].direction: (0, 0, 0) at frame 2; expected a vector that is not zero");

    scene = scene_with({});
    scene.medium->scattering[1] = -1.0;
    EXPECT_EQ(failure(scene, 0.0), "medium.scattering[1]: -1 at frame 0; expected a number from 0 to 1e+30");
    scene.medium->scattering[1] = std::nan("");
    EXPECT_NE(failure(scene, 0.0), "");

    scene = scene_with(std::vector<DensityTerm>(17, exponential(1, 1, {0, 1, 0}, {0, 0, 0})));
    EXPECT_EQ(failure(scene, 0.0), "medium.density: more exponential terms than 16");
}

// Whatever is not refused comes out finite.
TEST(EvaluateMedium, ExtremesAreFinite)
{
    const double extremes[] = {0.0, 1e-320, 1e-200, 1e-30, 1.0, 1e6, 1e30, 1e200};
    int evaluated = 0;
    for (double value : extremes) {
        for (double falloff : extremes) {
            for (double length : extremes) {
                for (double place : extremes) {
                    for (double metres : extremes) {
                        Scene scene = scene_with(
                            {constant(value), exponential(value, falloff, {length, -length, 0}, {-place, place, place})});
                        scene.metres_per_unit = metres;
                        scene.medium->visibility = value;
                        Matrix pose = identity;
                        pose[3] = place;
                        pose[7] = -place;
                        if (!failure(scene, 0.0, pose).empty())
                            continue;
                        ++evaluated;
                        brume_plugin_medium medium;
                        evaluate_medium(scene, 0.0, pose, medium);
                        ASSERT_TRUE(is_finite(medium.scattering[0]) && is_finite(medium.constant));
                        for (float x : medium.terms[0])
                            ASSERT_TRUE(is_finite(x));
                    }
                }
            }
        }
    }
    EXPECT_GT(evaluated, 1000);
}

}  // namespace
}  // namespace brume
