// Against path-traced scenes, where they are present: effects are held to what they reach, so that a change shows.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "exr.h"
#include "lit_scene.h"

using namespace fog;

namespace {

// The metric of the tool's `compare`: 2 x 2 box averages, a 3 x 3 box filter, then relMSE.
double rel_mse(const Picture &a, const Picture &b)
{
    auto smooth = [](const Picture &p) {
        Picture half(p.width / 2, p.height / 2, 3), out = half;
        for (int y = 0; y < half.height; ++y)
            for (int x = 0; x < half.width; ++x)
                for (int c = 0; c < 3; ++c)
                    half.at(x, y)[c] = 0.25f * (p.at(2 * x, 2 * y)[c] + p.at(2 * x + 1, 2 * y)[c] +
                                                p.at(2 * x, 2 * y + 1)[c] + p.at(2 * x + 1, 2 * y + 1)[c]);
        for (int y = 0; y < half.height; ++y)
            for (int x = 0; x < half.width; ++x)
                for (int c = 0; c < 3; ++c) {
                    float sum = 0;
                    int n = 0;
                    for (int j = std::max(0, y - 1); j <= std::min(half.height - 1, y + 1); ++j)
                        for (int i = std::max(0, x - 1); i <= std::min(half.width - 1, x + 1); ++i, ++n)
                            sum += half.at(i, j)[c];
                    out.at(x, y)[c] = sum / float(n);
                }
        return out;
    };
    Picture sa = smooth(a), sb = smooth(b);
    double mean = 0, error = 0;
    for (float v : sb.data)
        mean += v / double(sb.data.size());
    for (size_t i = 0; i < sa.data.size(); ++i) {
        double d = double(sa.data[i]) - sb.data[i];
        error += d * d / (double(sb.data[i]) * sb.data[i] + 0.0025 * mean * mean) / double(sa.data.size());
    }
    return error;
}

// Mean luminance of a over that of b.
double energy(const Picture &a, const Picture &b)
{
    auto sum = [](const Picture &p) {
        double total = 0;
        for (int y = 0; y < p.height; ++y)
            for (int x = 0; x < p.width; ++x)
                total += 0.2126 * p.at(x, y)[0] + 0.7152 * p.at(x, y)[1] + 0.0722 * p.at(x, y)[2];
        return total;
    };
    return sum(a) / sum(b);
}

class Truth : public testing::Test {
protected:
    void SetUp() override
    {
        if (std::string(BRUME_SHARED_DIR).empty() || !std::filesystem::exists(folder))
            GTEST_SKIP() << "no path-traced scenes here";
    }

    // Camera and medium of a description; no lights, no effects.
    Json scene_of(const Json &description) const
    {
        Json scene{{"brume", 1},
                   {"camera",
                    {{"horizontal_fov", description["camera"]["horizontal_fov_degrees"]},
                     {"camera_to_world", description["camera"]["camera_to_world"]}}},
                   {"medium", description["medium"]}};
        scene["medium"].erase("orders");
        return scene;
    }

    const std::filesystem::path folder = std::filesystem::path(BRUME_SHARED_DIR) / "truth";
};

}  // namespace

TEST_F(Truth, PaperKernelOnPathTracedScenes)
{
    double product = 1, unfogged = 1;
    int pairs = 0;
    for (const char *name : {"lamps", "leak"})
        for (const char *medium : {"h1", "h2", "e1"}) {
            std::string file = folder / (std::string(name) + "_" + medium);
            Json scene = scene_of(Json::parse(std::ifstream(file + ".json")));
            std::string clear = folder / (std::string(name) + "_clear.exr");
            Picture color = read_exr(clear, {"R", "G", "B", "A"}), depth = read_exr(clear, {"Z"}),
                    truth = read_exr(file + ".exr", {"R", "G", "B"});
            Picture color_rgb = read_exr(clear, {"R", "G", "B"});
            double fogged = rel_mse(run(cpu(), scene.dump(), color, depth).output, truth), none = rel_mse(color_rgb, truth);
            printf("%s %s: relMSE %.3f, without fog %.3f\n", name, medium, fogged, none);
            product *= fogged;
            unfogged *= none;
            ++pairs;
        }
    double mean = std::pow(product, 1.0 / pairs), mean_unfogged = std::pow(unfogged, 1.0 / pairs);
    printf("geometric mean: kernel paper %.3f, no fog at all %.3f\n", mean, mean_unfogged);
    EXPECT_LT(mean, 0.26) << "what a prototype of the published filter reached";
    EXPECT_LT(mean, mean_unfogged);
}

// The truth's own noise is about .003; its sources are spheres, for which the lights stand.
TEST_F(Truth, AirlightOfScenesThatScatterOnce)
{
    const struct {
        const char *name, *medium;
        double bound;  // of relMSE
        double energy_bound;
        const char *resolution;
    } cases[] = {{"dark", "h1s", 0.01, 0.03, "full"},
                 // Its floor and wall light the fog too, which the airlight of the lamps is not.
                 {"lamps", "g1s", 0.06, 0.08, "quarter"}};
    for (auto &[name, medium, bound, energy_bound, resolution] : cases) {
        const std::string file = folder / (std::string(name) + "_" + medium);
        const Json description = Json::parse(std::ifstream(file + ".json"));
        Json scene = scene_of(description);
        scene["effects"]["airlight"] = {{"resolution", resolution}};
        for (const Json &emitter : description["emitters"])
            scene["lights"].push_back({{"type", "point"},
                                       {"position", emitter["position"]},
                                       {"radius", emitter["radius"]},
                                       {"intensity", emitter["intensity"]}});
        const std::string clear = folder / (std::string(name) + "_clear.exr");
        const Picture color = read_exr(clear, {"R", "G", "B", "A"}), depth = read_exr(clear, {"Z"}),
                      truth = read_exr(file + ".exr", {"R", "G", "B"});
        for (const char *where : {"cpu", "gl"}) {
            const Picture got =
                run(backend(where), scene.dump(), color, depth, Options{{}, BRUME_OUTPUT_AIRLIGHT_ERROR}).output;
            const double error = rel_mse(got, truth), ratio = energy(got, truth);
            printf("%s %s airlight on %s: relMSE %.4f, energy %.3f, without fog %.3f\n", name, medium, where, error, ratio,
                   rel_mse(read_exr(clear, {"R", "G", "B"}), truth));
            EXPECT_LT(error, bound) << name << " " << medium << " on " << where;
            EXPECT_NEAR(ratio, 1, energy_bound) << name << " " << medium << " on " << where;
        }
    }
}
