// The effect airlight against what physics says without it: exhaustive quadrature in double, the homogeneous limit, energy.
#include <gtest/gtest.h>

#include "lit_scene.h"

using namespace fog;

namespace {

class AirlightPhysics : public testing::TestWithParam<const char *> {
protected:
    brume_context context() { return backend(GetParam()); }

    Result lit(const Json &scene, const Picture &depth)
    {
        const Picture black(depth.width, depth.height, 4);
        return run(context(), scene.dump(), black, depth, Options{{}, {"transmittance", "airlight"}});
    }
};

INSTANTIATE_TEST_SUITE_P(All, AirlightPhysics, testing::ValuesIn(fog::backend_names),
                         [](auto &info) { return std::string(info.param); });

Json with_airlight(Json scene, const char *parameter, const Json &value)
{
    scene["effects"]["airlight"][parameter] = value;
    return scene;
}

// Of some of a frame's pixels, and what exhaustive quadrature says there.
struct Sampled {
    struct Pixel {
        int x, y;
        Exhaustive::vec3 exact;
    };
    std::vector<Pixel> pixels;
    double brightest = 0;

    Sampled(const Json &scene, const Frame &frame, int count)
    {
        const Exhaustive exhaustive(scene, frame.depth.width, frame.depth.height);
        std::mt19937 random(8);
        for (int i = 0; i < count; ++i) {
            const int x = int(random() % unsigned(frame.depth.width)), y = int(random() % unsigned(frame.depth.height));
            pixels.push_back({x, y, exhaustive.airlight(exhaustive.ray(x, y, frame.depth.at(x, y)[0]))});
            for (int c = 0; c < 3; ++c)
                brightest = std::max(brightest, pixels.back().exact[c]);
        }
    }

    // |got - exact| over what is exact, or a hundredth of the brightest pixel; sorted.
    std::vector<double> errors(const Picture &got) const
    {
        std::vector<double> all;
        for (const Pixel &p : pixels)
            for (int c = 0; c < 3; ++c)
                all.push_back(std::abs(got.at(p.x, p.y)[c] - p.exact[c]) / std::max(p.exact[c], 0.01 * brightest));
        std::sort(all.begin(), all.end());
        return all;
    }
};

}  // namespace

TEST_P(AirlightPhysics, AgreesWithExhaustiveQuadrature)
{
    const Frame frame = lit_frame(36, 24);
    for (const auto &[name, scene, tiers] : lit_scenes()) {
        if (scene.contains("environment"))
            continue;
        const Sampled sampled(scene, frame, 60);
        for (double max_error : {0.01, 0.0005}) {
            const auto errors = sampled.errors(lit(with_airlight(scene, "max_error", max_error), frame.depth).airlight);
            const double median = errors[errors.size() / 2], p95 = errors[errors.size() * 95 / 100], worst = errors.back();
            printf("%s, nodes, max_error %g: median %.2g, p95 %.2g, worst %.2g\n", name, max_error, median, p95, worst);
            EXPECT_LT(median, 0.5 * max_error) << name;
            EXPECT_LT(p95, 2 * max_error) << name;
        }
    }
}

// Its tile lists Gaussians that most of its rays do not meet.
TEST_P(AirlightPhysics, RaysThatPassTheListedGaussiansBySeeTheRest)
{
    const Json blobs{constant(0.1), gaussian({-2.3, 2.2, -6}, 4, 3), gaussian({-2.5, 2.4, -6.5}, 4, 3)};
    const Json scene =
        lit_scene({{"scattering", 0.3}, {"density", blobs}}, Json::array({point_light({1, 0.5, -8}, 10, 0.1)}));
    const Frame frame = lit_frame(16, 16);
    EXPECT_LT(Sampled(scene, frame, 60).errors(lit(scene, frame.depth).airlight)[170], 0.01);
}

// A lamp with a radius that the picture does not show: its light has kinks where rays enter its ball and leave it.
TEST_P(AirlightPhysics, RaysThroughALampsBallAreAsNear)
{
    const Picture depth(40, 30, 1, 50);
    for (double g : {0.0, 0.5, 0.9})
        for (double radius : {0.6, 2.4}) {
            const Json scene =
                lit_scene({{"scattering", 0.2}, {"g", g}}, Json::array({point_light({0, 0, -6}, 10, radius)}));
            const Exhaustive exhaustive(scene, depth.width, depth.height);
            const Result r = lit(scene, depth);
            double worst = 0;
            for (int y = 0; y < depth.height; ++y)
                for (int x = 0; x < depth.width; ++x) {
                    const double exact = exhaustive.airlight(exhaustive.ray(x, y, 50))[1];
                    worst = std::max(worst, std::abs(r.airlight.at(x, y)[1] / exact - 1));
                }
            printf("g %g, a ball of %g m at 6 m: worst pixel off by %.2g\n", g, radius, worst);
            EXPECT_LT(worst, 0.01);
        }
}

// Few Gaussians are integrated as one density already, in cells that are much wider than these beams.
TEST_P(AirlightPhysics, BeamsAmongFewGaussiansAreWhole)
{
    const Frame frame = lit_frame(64, 40);
    for (double angle : {8.0, 25.0})
        for (double haze : {0.0, 0.2}) {
            Json density{gaussian({-1, 0.4, -7}, 0.7, 1.5), gaussian({1.2, -0.5, -8}, 0.6, 1)};
            if (haze > 0)
                density.push_back(constant(haze));
            const Json spot{{"type", "spot"},
                            {"position", {0.6, 3, -7}},
                            {"direction", {-0.2, -1, -0.1}},
                            {"intensity", 50},
                            {"angle", angle}};
            const Json scene = lit_scene({{"scattering", 0.3}, {"density", density}}, Json::array({spot}));
            const Picture exact = lit(with_airlight(scene, "max_error", 0.0005), frame.depth).airlight,
                          got = lit(scene, frame.depth).airlight;
            double off = 0, all = 0;
            for (int y = 0; y < got.height; ++y)
                for (int x = 0; x < got.width; ++x) {
                    off += std::abs(got.at(x, y)[1] - exact.at(x, y)[1]);
                    all += exact.at(x, y)[1];
                }
            printf("a beam of %g degrees, haze %g: off by %.2g of its light\n", angle, haze, off / all);
            EXPECT_LT(off / all, 0.02);
        }
}

TEST(AirlightReference, IsTheExhaustiveQuadrature)
{
    const Frame frame = lit_frame(5, 4);
    for (const auto &[name, scene, tiers] : lit_scenes()) {
        if (scene.contains("environment"))
            continue;
        const Result r = run(cpu(), with_airlight(scene, "tier", "reference").dump(), frame.color, frame.depth,
                             Options{{}, {"airlight"}});
        EXPECT_LT(Sampled(scene, frame, 20).errors(r.airlight).back(), 1e-4) << name;
        if (gl()) {
            EXPECT_THROW(run(*gl(), with_airlight(scene, "tier", "reference").dump(), frame.color, frame.depth), Failure);
        }
    }
}

// |estimate| >= |error| nearly everywhere, and no uselessly large one.
TEST(AirlightErrorEstimate, BoundsTheError)
{
    const Frame frame = lit_frame(36, 24);
    int bounded = 0, all = 0;
    std::vector<double> excess;
    for (const auto &[name, scene, tiers] : lit_scenes()) {
        if (scene.contains("environment"))
            continue;
        const Result r = run(cpu(), scene.dump(), frame.color, frame.depth, Options{{}, {"airlight", "airlight_error"}});
        const Sampled sampled(scene, frame, 120);
        for (const auto &p : sampled.pixels)
            for (int c = 0; c < 3; ++c) {
                const double error = std::abs(r.airlight.at(p.x, p.y)[c] - p.exact[c]),
                             estimate = r.airlight_error.at(p.x, p.y)[c], rounding = 2e-6 * p.exact[c];
                ++all;
                bounded += error <= estimate + rounding;
                if (error > rounding)
                    excess.push_back(estimate / error);
            }
    }
    std::sort(excess.begin(), excess.end());
    const double share = double(bounded) / all, median = excess[excess.size() / 2];
    printf("the error estimate bounds the error in %.1f %% of pixels; the median of their ratio is %.2g\n", 100 * share,
           median);
    EXPECT_GE(share, 0.95);
    EXPECT_LE(median, 10);
}

// A lattice of Gaussians a spacing apart, wider and wider: what its Fourier series leaves of the ripple falls as
// e^(-pi^2 / (a s)^2).
TEST_P(AirlightPhysics, ManyWideGaussiansApproachTheConstantMedium)
{
    const double spacing = 2.5, density = 0.08;
    const Json lights{point_light({-1, 0.7, -5}, 4, 0.1), point_light({1.5, 0, -3}, 2)};
    const Picture depth(9, 5, 1, 7);
    const Result constant_one =
        lit(lit_scene({{"scattering", {0.7, 1, 1.3}}, {"density", {constant(density)}}}, lights), depth);
    double before = 1;
    std::vector<double> spreads{1.7, 1.3};
    // Mesa's software GL ends loops over more of them early, and a warning says so.
    if (std::string(GetParam()) == "cpu")
        spreads.push_back(1.0);
    for (double as : spreads) {
        Json medium{{"scattering", {0.7, 1, 1.3}}, {"density", Json::array()}};
        const double a = as / spacing, reach = 4 / a, amplitude = density * std::pow(as / std::sqrt(3.14159265358979), 3);
        const int across = int(std::ceil((4 + reach) / spacing)), ahead = int(std::ceil((8 + reach) / spacing)),
                  behind = int(std::ceil(reach / spacing));
        for (int x = -across; x <= across; ++x)
            for (int y = -across; y <= across; ++y)
                for (int z = -ahead; z <= behind; ++z)
                    medium["density"].push_back(gaussian({x * spacing, y * spacing, z * spacing}, a, amplitude));
        const Result lattice = lit(lit_scene(medium, lights), depth);
        const Worst airlight = compare(lattice.airlight, constant_one.airlight, 1e-4),
                    t = compare(lattice.transmittance, constant_one.transmittance, 1e-2);
        printf("%zu Gaussians, a s = %.1f: airlight %.2g, transmittance %.2g from the constant medium's\n",
               medium["density"].size(), as, airlight.error, t.error);
        EXPECT_LT(airlight.error, before) << as;
        before = airlight.error;
        if (as < 1.5) {
            EXPECT_LT(airlight.error, 0.01) << airlight.describe();
            EXPECT_LT(t.error, as == 1.0 ? 1e-3 : 1e-2) << t.describe();
        }
    }
}

// What a light within a ball of fog sends to the camera after one scattering, over all directions of view, is the volume
// integral in spherical coordinates about the light.
TEST_P(AirlightPhysics, EnergyOfALightWithinABallOfFogAddsUp)
{
    const double away = 15, intensity = 10;
    for (double peak : {0.0005, 0.8})
        for (double offset : {0.0, 0.5}) {
            Json scene = lit_scene({{"scattering", peak},
                                    {"g", peak < 0.1 ? 0 : 0.3},
                                    {"density", {gaussian({offset, 0.3 * offset, -away}, 1, 1)}}},
                                   Json::array({point_light({0, 0, -away}, intensity)}));
            scene["camera"]["vertical_fov"] = 30;
            auto seen_at = [&](int size) {
                const Exhaustive rays(scene, size, size);
                const Result r = lit(scene, Picture(size, size, 1, INFINITY));
                const double pixel = 2 * std::tan(15 * 3.14159265358979 / 180) / size;
                double sum = 0;
                for (int y = 0; y < size; ++y)
                    for (int x = 0; x < size; ++x) {
                        const double cosine = -rays.ray(x, y, 1).direction.z;
                        sum += r.airlight.at(x, y)[0] * pixel * pixel * cosine * cosine * cosine;
                    }
                return sum;
            };
            // The peak about the light falls as 1 / angle, of which samples at pixel centres miss a part that shrinks with
            // the pixels.
            const double seen = 2 * seen_at(64) - seen_at(32);

            const glm::dvec3 light(0, 0, -away), center(offset, 0.3 * offset, -away);
            auto density = [&](glm::dvec3 from, glm::dvec3 to) {
                const double length = glm::length(to - from);
                return Exhaustive::density({center - from, 1, 1, glm::dvec3(1)}, {(to - from) / length, length});
            };
            const int radii = 80, heights = 60, turns = 60;
            const double reach = 6;
            double volume = 0;
            for (int i = 0; i < radii; ++i)
                for (int j = 0; j < heights; ++j)
                    for (int k = 0; k < turns; ++k) {
                        const double d = reach * (i + 0.5) / radii, z = 2 * (j + 0.5) / heights - 1,
                                     phi = 2 * 3.14159265358979 * (k + 0.5) / turns, s = std::sqrt(1 - z * z);
                        const glm::dvec3 way(s * std::cos(phi), s * std::sin(phi), z), x = light + d * way;
                        const double rho = std::exp(-glm::dot(x - center, x - center)),
                                     mu = glm::dot(way, -x) / glm::length(x), g = peak < 0.1 ? 0 : 0.3;
                        const double phase = (1 - g * g) / (4 * 3.14159265358979 * std::pow(1 + g * g - 2 * g * mu, 1.5));
                        volume += peak * rho * phase * std::exp(-peak * (density(light, x) + density(x, {0, 0, 0}))) /
                                  glm::dot(x, x);
                    }
            volume *= intensity * 4 * 3.14159265358979 * reach / (double(radii) * heights * turns);
            printf("peak %g, light %.1f off the centre: seen / sent %.4f\n", peak, offset, seen / volume);
            EXPECT_NEAR(seen / volume, 1, 0.01) << "peak " << peak << ", offset " << offset;
            if (peak < 0.1 && offset == 0) {
                // Thin: I tau, seen from afar.
                const double sent = intensity * peak * 0.886226925 / (away * away);
                EXPECT_NEAR(seen / sent, 1, 0.01);
            }
        }
}
