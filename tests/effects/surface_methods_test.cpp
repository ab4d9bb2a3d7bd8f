// The published methods of effect surface.
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "../bench/surface_tables.h"
#include "lit_scene.h"
#include "maths.hpp"
#include "relit.h"
#include "surface/hemisphere.h"
#include "tables.h"

using namespace fog;

namespace {

namespace f64 = brume::maths_double;
using std::numbers::pi;
using surface_tables::degrees;
using surface_tables::lobes;

// Sun et al.'s G_n as it stands in the paper, around the lamp with F by its own quadrature.
double published_g(double depth, double exponent, double theta)
{
    const int steps = 800, turns = 400;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double x = (i + 0.5) / steps, gamma = pi * x * x, u = depth * std::sin(gamma);
        const double spread = std::exp(-depth * std::cos(gamma)) *
                              (brume::airlight::sun_function(u, pi / 2) - brume::airlight::sun_function(u, gamma / 2));
        double around = 0;
        for (int k = 0; k < turns; ++k) {
            const double cosine =
                std::cos(gamma) * std::cos(theta) + std::sin(gamma) * std::sin(theta) * std::cos(pi * (k + 0.5) / turns);
            around += cosine > 0 ? 2 * pi / turns * std::pow(cosine, exponent) : 0;
        }
        sum += 2 * pi * x / steps * spread * around;
    }
    return sum;
}

}  // namespace

TEST(SunMethod, LobesAreThePapersG)
{
    for (double depth : {0.01, 0.3, 2.0, 8.0})
        for (double exponent : {1.0, 5.0, 40.0})
            for (double theta : {0.0, 0.7, 1.5, 2.2, 3.1}) {
                const double got = surface::lobe_of_scattered(depth, exponent, theta) * depth * std::exp(-depth);
                const double want = depth * (exponent + 1) / (4 * pi * pi) * published_g(depth, exponent, theta);
                EXPECT_NEAR(got, want, 4e-4 * want) << "T " << depth << ", n " << exponent << ", theta " << theta;
            }
}

TEST(SunMethod, TheTableIsWithinAThousandthOfQuadrature)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> u(0, 1);
    double worst[3] = {};
    for (int i = 0; i < 3000; ++i) {
        const double depth = 0.01 * std::pow(800, u(random)), theta = pi * u(random);
        const double exponent = i % 3 == 0 ? 1 : i % 3 == 1 ? std::pow(100, u(random)) : 100 * std::pow(80, u(random));
        const double want = surface::lobe_of_scattered(depth, exponent, theta) * depth * std::exp(-depth);
        const double got = f64::sun_lobe(lobes(), depth, exponent, std::cos(theta));
        worst[i % 3] = std::max(worst[i % 3], std::abs(got / want - 1));
    }
    printf("table against quadrature, worst: n 1 %.1e, n 1 to 100 %.1e, n 100 to 8000 %.1e\n", worst[0], worst[1], worst[2]);
    EXPECT_LT(worst[0], 1e-4);
    EXPECT_LT(worst[1], 1e-3);
    EXPECT_LT(worst[2], 2e-3);
}

TEST(PsfMethod, DegreesOfALobeAreItsLegendreIntegrals)
{
    for (double exponent : {1.0, 2.5, 5.0, 100.0})
        for (unsigned l = 0; l < 6; ++l) {
            double sum = 0;
            const int steps = 20000;
            for (int i = 0; i < steps; ++i) {
                const double x = (i + 0.5) / steps;
                sum += (exponent + 1) / steps * std::pow(x, exponent) * std::legendre(l, x);
            }
            EXPECT_NEAR(f64::lobe_degree(int(l), exponent), sum, 1e-5) << "n " << exponent << ", l " << l;
        }
}

// Zhou et al. par. 4: the six coefficients as printed, at the only depth where they hold.
TEST(PsfMethod, HasThePapersCoefficientsAtDepthOne)
{
    const double printed[] = {0.332818, 0.332488, 0.302428, 0.275773, 0.254051, 0.236333};
    for (double exponent : {1.0, 5.0})
        for (double theta : {0.0, 1.0, 2.0, 3.0}) {
            double sum = 0;
            for (unsigned l = 0; l < 6; ++l)
                sum += std::exp(-1.0) * printed[l] * std::sqrt((2 * l + 1) / (4 * pi)) * f64::lobe_degree(int(l), exponent) *
                       std::legendre(l, std::cos(theta));
            EXPECT_NEAR(f64::psf_lobe(degrees(), 1, exponent, std::cos(theta)), std::max(sum, 0.0), 2e-4)
                << "n " << exponent << ", theta " << theta;
        }
}

// The reference's rays and directions against the published G, on Lambert and Phong, and against itself with twice the nodes
// on GGX.
TEST(SurfaceReference, IsItsClosedFormWhereThereIsOne)
{
    using namespace surface_reference;
    for (double depth : {0.02, 0.5, 4.0})
        for (double theta : {0.0, 0.9, 1.6, 2.7}) {
            brume::airlight::ReferenceScene scene;
            scene.medium.constant = 1;
            scene.medium.scattering = vec3(depth / 2);
            const Light lamp{vec3(2 * std::sin(theta), 0, 2 * std::cos(theta)), 0, vec3(0), 0, vec3(4), 0, light_point, 0};
            scene.lights = {&lamp, 1};
            const vec3 up(0, 0, 1);
            auto closed = [&](double exponent) {
                return surface::lobe_of_scattered(depth, exponent, theta) * depth * std::exp(-depth);
            };
            EXPECT_NEAR(reflected_once(scene, lambert(up)).x / closed(1), 1, 1e-4) << depth << ", " << theta;
            for (double exponent : {5.0, 100.0})
                EXPECT_NEAR(reflected_once(scene, phong(up, exponent)).x / closed(exponent), 1, 1e-4)
                    << depth << ", " << theta;
            const Reflection rough = ggx(up, glm::normalize(vec3(0.3, -0.6, 0.8)), 0.3);
            EXPECT_NEAR(reflected_once(scene, rough).x / reflected_once(scene, rough, 4).x, 1, 2e-4)
                << depth << ", " << theta;
        }
}

// A Lambert surface needs few degrees: there the two methods are the same light.
TEST(PsfMethod, AgreesWithSunOnLambertSurfaces)
{
    double worst = 0;
    for (double depth : {0.05, 0.5, 2.0, 8.0})
        for (double theta = 0; theta < 1.6; theta += 0.1) {
            const double sun = f64::sun_lobe(lobes(), depth, 1, std::cos(theta));
            worst = std::max(worst, std::abs(f64::psf_lobe(degrees(), depth, 1, std::cos(theta)) / sun - 1));
        }
    printf("six degrees against the table on Lambert surfaces: worst %.3f\n", worst);
    EXPECT_LT(worst, 0.07);
}

TEST(PsfMethod, MeanDepthIsTheMeanOverAllDirections)
{
    for (double distance : {0.0, 0.3, 1.0, 2.4, 5.0, 7.0, 30.0}) {
        double sum = 0;
        const int rings = 400, steps = 4000;
        const double reach = distance + 7;
        for (int i = 0; i < rings; ++i) {
            const double x = (i + 0.5) / rings, cosine = -1 + 2 * x * x * x;
            for (int k = 0; k < steps; ++k) {
                const double t = reach * (k + 0.5) / steps;
                sum +=
                    3 * x * x * reach / steps / rings * std::exp(-(distance * distance + 2 * distance * t * cosine + t * t));
            }
        }
        EXPECT_NEAR(f64::mean_depth_of_gaussian(degrees(), distance), sum, 2e-3 * sum) << distance;
    }
}

namespace {

class SurfaceMethodOn : public testing::TestWithParam<std::tuple<const char *, const char *>> {
protected:
    brume_context context() const { return backend(std::get<0>(GetParam())); }
    const char *method() const { return std::get<1>(GetParam()); }
    Json scene(const Json &medium, const Json &lights) const
    {
        Json scene = lit_scene(medium, lights);
        scene["effects"] = {{"surface", {{"method", method()}}}};
        return scene;
    }
};
INSTANTIATE_TEST_SUITE_P(All, SurfaceMethodOn,
                         testing::Combine(testing::ValuesIn(backend_names), testing::Values("calibrated", "sun", "psf")),
                         [](auto &info) { return std::get<0>(info.param) + std::string(std::get<1>(info.param)); });

// A wall 5 m ahead that faces the camera, seen through a pinhole so that all pixels are the middle.
struct Wall {
    Picture color{3, 3, 3, 1}, depth{3, 3, 1, 5};
    std::map<std::string, Picture> material{{"albedo", Picture(3, 3, 3, 0.5f)}};
};

std::string why(const Plan &plan, const std::string &name)
{
    brume_plan_info info = BRUME_PLAN_INFO_INIT;
    brume_plan_get_info(plan, &info);
    for (uint32_t i = 0; i < info.entry_count; ++i) {
        brume_plan_entry entry = BRUME_PLAN_ENTRY_INIT;
        brume_plan_get_entry(plan, i, &entry);
        if (entry.name == name)
            return entry.reason;
    }
    return {};
}

}  // namespace

TEST_P(SurfaceMethodOn, ThePlanSaysWhichMethodRuns)
{
    const Plan plan(context(), scene({{"scattering", 0.1}, {"g", 0.5}}, Json::array({point_light({0, 2, -2}, 10)})).dump(),
                    8, 8);
    EXPECT_NE(why(plan, "compose").find(std::string("method ") + method()), std::string::npos) << why(plan, "compose");
    EXPECT_EQ(why(plan, "phase").empty(), std::string(method()) == "calibrated");
}

// What comes straight is dimmed and what has been scattered comes back, in colours.
TEST_P(SurfaceMethodOn, GivesALambertWallWhatItsFormulaSays)
{
    const Wall wall;
    const double scattering[] = {0.02, 0.1, 0.5}, absorption[] = {0.01, 0, 0.2};
    for (const Vector &at : {Vector{0, 0, -2}, Vector{3, 0, -4}, Vector{0, 2, -8}}) {
        Json s =
            scene({{"scattering", scattering}, {"absorption", absorption}, {"g", 0.6}}, Json::array({point_light(at, 40)}));
        const Picture got = relit(context(), s, wall.color, wall.depth, wall.material, {wall.color});
        const double distance = std::hypot(at[0], at[1], at[2] + 5), cosine = (at[2] + 5) / distance;
        for (int c = 0; c < 3; ++c) {
            const double out = scattering[c] * distance, gone = absorption[c] * distance, depth = out + gone;
            double along = std::exp(-depth), aside = 0;
            if (std::string(method()) == "calibrated") {
                const f64::Received r = f64::received(out, gone, 0.6, cosine);
                along = r.along;
                aside = r.aside / pi * std::exp(2 * f64::rescattered(out, gone, 0.6).cosine * std::min(cosine, 0.0));
            } else {
                aside = out / depth *
                        (std::string(method()) == "sun" ? f64::sun_lobe(lobes(), depth, 1, cosine)
                                                        : f64::psf_lobe(degrees(), depth, 1, cosine));
            }
            const double want = along + 0.5 * 40 / (distance * distance) * aside;
            EXPECT_NEAR(got.at(1, 1)[c], want, 1e-3 * want) << at[2] << ", colour " << c;
        }
    }
}

// Finite whatever the medium, and in clear air as they are. Roughness goes from column to column.
TEST_P(SurfaceMethodOn, FiniteAtTheExtremes)
{
    Wall wall;
    wall.material["specular"] = Picture(3, 3, 3, 0.4f);
    Picture &roughness = wall.material["roughness"] = Picture(3, 3, 1, 0.3f);
    for (int y = 0; y < 3; ++y) {
        roughness.at(0, y)[0] = 0;
        roughness.at(2, y)[0] = 1;
    }
    for (auto [extinction, g] : {std::pair(1e-12, 0.99), {1e-6, 0.0}, {1.0, 0.99}, {1e4, 0.0}, {1e4, 0.99}})
        for (const Vector &at :
             {Vector{0, 0, -5}, Vector{0, 0, -1}, Vector{1e5, 0, -5}, Vector{1, 0, -4.9999}, Vector{0, 0, -6}}) {
            Json s = scene({{"scattering", extinction}, {"absorption", {0, extinction, 1e-3 * extinction}}, {"g", g}},
                           Json::array({point_light(at, 40)}));
            s["environment"]["sh"] = {{1, 2, 3}, {0.1, 0, 0}, {0, -5, 0}, {0, 0, 0.2}};
            const Picture got = relit(context(), s, wall.color, wall.depth, wall.material);
            for (float v : got.data)
                ASSERT_TRUE(std::isfinite(v) && v >= 0) << extinction << ", g " << g << ", lamp " << at[0] << " " << at[2];
            if (extinction == 1e-12 && std::abs(at[2] + 5) > 0.1) {
                EXPECT_LT(compare(got, wall.color, 0.05).error, 1e-5);
            }
        }
}

// An environment that is alike everywhere gives a wall in the middle of a Gaussian pi (e^-T + albedo T e^-T 4 pi NPSF_0) of
// its 1, and as a layer what two streams have.
TEST_P(SurfaceMethodOn, TheEnvironmentsPart)
{
    const Wall wall;
    Json s = scene({{"scattering", 0.3}, {"absorption", 0.1}, {"density", Json::array({gaussian({0, 0, -5}, 0.7, 1.5)})}},
                   Json::array());
    s["environment"]["sh"] = {{3.5449077, 3.5449077, 3.5449077}};
    s["lights"] = Json::array({point_light({0, 0, -100}, 1e-9)});
    const double depth = 0.4 * 1.5 / 0.7 * std::sqrt(pi) / 2;
    const double c0 = brume::airlight::psf_coefficients(depth)[0];
    const bool psf = std::string(method()) == "psf", calibrated = std::string(method()) == "calibrated";
    using brume::maths_double::slab_field, brume::maths_double::vec2;
    const double want = psf          ? std::exp(-depth) + 0.5 * 0.75 * std::sqrt(4 * pi) * c0 * depth * std::exp(-depth)
                        : calibrated ? slab_field(vec2(0.75 * depth), vec2(0.25 * depth), 0, 0, 1, 0.2).down
                                     : 1;
    const Picture got = relit(context(), s, wall.color, wall.depth, wall.material);
    EXPECT_NEAR(got.at(1, 1)[0], want, 2e-3);
    s["lights"] = Json::array();
    EXPECT_NEAR(relit(context(), s, wall.color, wall.depth, wall.material).at(1, 1)[0], want, 2e-3) << "without lamps";
    s["medium"]["density"].push_back(constant(1e-9));
    EXPECT_EQ(relit(context(), s, wall.color, wall.depth, wall.material).at(1, 1)[0], 1) << "density without an end";
}

TEST(SurfaceMethod, OthersAreRefusedByName)
{
    Json s = lit_scene({{"scattering", 0.1}}, Json::array({point_light({0, 2, -2}, 10)}));
    s["effects"] = {{"surface", {{"method", "fogshop"}}}};
    try {
        const Plan plan(cpu(), s.dump(), 8, 8);
        FAIL() << "taken";
    } catch (const Failure &e) {
        for (const char *part : {"method", "fogshop", "calibrated", "sun", "psf"})
            EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
    }
}

// The reference is the only one that knows phase functions; where there is none, sun's tables are the same light.
TEST(SurfaceMethod, ReferenceIsWhatSunHasTabulated)
{
    Wall wall;
    wall.material["specular"] = Picture(3, 3, 3, 0.3f);
    wall.material["roughness"] = Picture(3, 3, 1, 0.5f);
    for (const Vector &at : {Vector{0, 0, -2}, Vector{3, 0, -4}, Vector{0, 2, -8}})
        for (bool known : {true, false}) {
            Json s = lit_scene({{"scattering", {0.02, 0.1, 0.5}}, {"absorption", {0.01, 0, 0.2}}},
                               Json::array({point_light(at, 40)}));
            auto by = [&](const char *method, double g, const std::vector<Picture> &groups) {
                s["medium"]["g"] = g;
                s["effects"] = {{"surface", {{"method", method}}}};
                return relit(cpu(), s, wall.color, wall.depth, known ? wall.material : std::map<std::string, Picture>{},
                             groups);
            };
            const Picture want = by("sun", 0, {});
            const Worst worst = compare(by("reference", 0, {}), want, 0.01),
                        grouped = compare(by("reference", 0, {wall.color}), by("sun", 0, {wall.color}), 0.01);
            EXPECT_LT(worst.error, 1e-3) << at[2] << ": " << worst.describe();
            EXPECT_LT(grouped.error, 1e-3) << at[2] << ": " << grouped.describe();
            if (known) {
                EXPECT_GT(compare(by("reference", 0.7, {}), want, 0.01).error, 0.02);
            }
        }
}

// A lamp behind a cloud: the cloud scatters from where it is.
TEST(SurfaceMethod, ReferenceIsFiniteAndSeesClouds)
{
    const Wall wall;
    Picture last;
    for (double away : {1.5, 0.0, -4.0}) {
        Json s = lit_scene({{"scattering", 1}, {"density", Json::array({gaussian({0, away, -3}, 1, 0.8)})}},
                           Json::array({point_light({0, 0, -1}, 40)}));
        s["effects"] = {{"surface", {{"method", "reference"}}}};
        const Picture got = relit(cpu(), s, Picture(1, 1, 3, 1), Picture(1, 1, 1, 5), {{"albedo", Picture(1, 1, 3, 0.5f)}});
        ASSERT_TRUE(std::isfinite(got.data[0]));
        if (away == 0) {
            EXPECT_LT(got.data[0], 0.8 * last.data[0]);
        } else if (away == -4) {
            EXPECT_NEAR(got.data[0], 1, 0.01);
        }
        last = got;
    }
    for (double extinction : {1e-12, 1e-6, 1e4})
        for (const Vector &at : {Vector{0, 0, -5}, Vector{1e5, 0, -5}, Vector{1, 0, -4.9999}}) {
            Json s = lit_scene({{"scattering", extinction}, {"g", 0.99}}, Json::array({point_light(at, 40)}));
            s["effects"] = {{"surface", {{"method", "reference"}}}};
            const Picture got =
                relit(cpu(), s, Picture(1, 1, 3, 1), Picture(1, 1, 1, 5), {{"albedo", Picture(1, 1, 3, 0.5f)}});
            EXPECT_TRUE(std::isfinite(got.data[0]) && got.data[0] >= 0) << extinction << ", " << at[0] << ", " << at[2];
        }
}

#ifdef BRUME_GL
TEST(SurfaceMethod, ReferenceRunsOnTheCpuAlone)
{
    Json s = lit_scene({{"scattering", 0.1}}, Json::array({point_light({0, 2, -2}, 10)}));
    s["effects"] = {{"surface", {{"method", "reference"}}}};
    EXPECT_THROW(Plan(backend("gl"), s.dump(), 8, 8), Failure);
    EXPECT_NE(why(Plan(cpu(), s.dump(), 8, 8), "compose").find("method reference"), std::string::npos);
}

TEST(SurfaceMethod, BackendsAgree)
{
    const Frame frame = lit_frame(40, 32);
    std::mt19937 random(5);
    std::uniform_real_distribution<float> u(0, 1);
    auto picture = [&](int channels) {
        Picture p(40, 32, channels);
        for (float &v : p.data)
            v = u(random);
        return p;
    };
    const std::map<std::string, Picture> material{
        {"albedo", picture(3)}, {"specular", picture(3)}, {"roughness", picture(1)}};
    // Each scene with a method and a material, another pair than the scene before: software OpenGL compiles programs for
    // each.
    int pair = 0;
    for (const NamedScene &named : lit_scenes())
        for (bool more : {false, true}) {
            const bool known = (pair + more) % 2 != 0;
            const char *method = (pair / 2 + more) % 2 ? "psf" : "sun";
            Json s = named.scene;
            s["effects"] = {{"surface", {{"method", method}}}};
            const auto &layers = known ? material : std::map<std::string, Picture>{};
            const Worst worst = compare(relit(backend("gl"), s, frame.color, frame.depth, layers),
                                        relit(cpu(), s, frame.color, frame.depth, layers), 0.05);
            EXPECT_LT(worst.error, 1e-3) << named.name << ", method " << method << ": " << worst.describe();
            pair += more;
        }
}
#endif
