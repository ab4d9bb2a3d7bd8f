#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "bench/baselines.hpp"
#include "bench/measure.hpp"
#include "bench/mip_pyramid.hpp"
#include "bench/pareto.hpp"
#include "files.hpp"

namespace brume::tests {
namespace {

using nlohmann::json;
using namespace brume::tool;

TEST(Pareto, KeepsWhatNothingElseBeats)
{
    const Cost costs[] = {{3, 1}, {1, 5}, {2, 5}, {2, 2}, {4, 1}, {5, 0.5}};
    EXPECT_EQ(pareto_front(costs), (std::vector<std::size_t>{1, 3, 0, 5}));
}

TEST(Pareto, KeepsEqualsAndLeavesOutWhatHasNoCost)
{
    const Cost costs[] = {{1, 1}, {NAN, 0}, {1, 1}, {0.5, INFINITY}, {1, 2}};
    EXPECT_EQ(pareto_front(costs), (std::vector<std::size_t>{0, 2}));
    EXPECT_TRUE(pareto_front({}).empty());
}

TEST(Baselines, KeepAUniformPictureAndWhatNoFogCovers)
{
    BaselineInput in;
    in.image.width = 40;
    in.image.height = 20;
    in.image.rgb.assign(3 * 40 * 20, 0.25f);
    in.transmittance.assign(40 * 20, 0.3f);
    in.focal = 20;
    Picture out = in.image;
    for (const Baseline &baseline : baselines()) {
        baseline.apply(in, out);
        for (const float v : out.rgb)
            ASSERT_NEAR(v, 0.25f, 1e-5) << baseline.name;
    }
    in.image.rgb[3 * 90] = 80;
    in.transmittance.assign(in.transmittance.size(), 1);
    for (const Baseline &baseline : baselines()) {
        baseline.apply(in, out);
        EXPECT_EQ(out.rgb, in.image.rgb) << baseline.name;
    }
    in.transmittance[92] = 0;
    for (const Baseline &baseline : baselines()) {
        baseline.apply(in, out);
        EXPECT_GT(out.rgb[3 * 92], 0.25f) << baseline.name << ": the bright pixel reaches others";
    }
}

TEST(Baselines, MipPyramidKeepsMeansAndWidensByLevels)
{
    Picture point;
    point.width = point.height = 64;
    point.rgb.assign(3 * 64 * 64, 0);
    for (int c = 0; c < 3; ++c)
        point.rgb[3 * (32 * 64 + 32) + std::size_t(c)] = 100;
    const MipPyramid pyramid(point, INFINITY), capped(point, 10);
    for (const float level : {0.f, 1.f, 2.f, 2.5f}) {
        double sum = 0, variance = 0;
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) {
                const double v = pyramid.at(x, y, level)[0];
                sum += v;
                variance += v * (x - 32) * (x - 32);
            }
        EXPECT_NEAR(sum, 100, 1e-3) << level;
        if (level > 0) {
            const double deviation = std::sqrt(variance / sum);
            EXPECT_GT(deviation, 0.8 * std::exp2(level)) << level;
            EXPECT_LT(deviation, 1.6 * std::exp2(level)) << level;
        }
    }
    EXPECT_EQ(capped.at(32, 32, 0)[1], 100) << "the picture itself is not cut";
    EXPECT_NEAR(capped.at(32, 32, 1)[1], pyramid.at(32, 32, 1)[1] / 10, 1e-5);
}

class Bench : public testing::Test {
protected:
    Bench()
    {
        TestPart part{rgbz()};
        part.channels[0].value = [](int x, int y) { return x == 9 && y == 9 ? 50 : 0.2; };
        write_exr(in_, {part});
        part.channels[1].value = constant(0.3);
        write_exr(truth_, {part});
        write_text(fog_, kFog);
    }
    Result run(const fs::path &scene, std::vector<std::string> more) const
    {
        std::vector<std::string> words{"bench",  scene.string(), in_.string(), "--backend", "cpu",
                                       "--vfov", "50",           "--repeat",   "1"};
        words.insert(words.end(), more.begin(), more.end());
        return brume(words);
    }
    static json setting(const json &group, const std::string &name)
    {
        for (const json &s : group["settings"])
            if (s["name"] == name)
                return s;
        return {};
    }

    Folder folder_;
    const fs::path fog_ = folder_ / "fog.json", in_ = folder_ / "in.exr", truth_ = folder_ / "truth.exr";
};

// Of those measured, in one of the two errors.
void expect_true_front(const json &group, const char *against)
{
    int members = 0;
    for (const json &s : group["settings"]) {
        if (s.contains("refused"))
            continue;
        bool beaten = false;
        for (const json &other : group["settings"])
            if (!other.contains("refused"))
                beaten |= other["ms"] < s["ms"] && other["against"][against]["error"] < s["against"][against]["error"];
        EXPECT_FALSE(beaten && s["on_front"][against]) << s["name"];
        members += s["on_front"][against].get<bool>();
    }
    EXPECT_GT(members, 0);
}

TEST_F(Bench, MeasuresEachSettingAgainstReferenceAndTruth)
{
    const fs::path out = folder_ / "bench.json", table = folder_ / "bench.md", svg = folder_ / "bench.svg",
                   png = folder_ / "bench.png";
    const Result r = run(fog_, {"--truth", truth_.string(), "--json", out.string(), "--md", table.string(), "--svg",
                                svg.string(), "--png", png.string()});
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_EQ(r.out, read_text(table));
    EXPECT_NE(r.out.find("| 1 | calibrated |"), std::string::npos) << r.out;
    EXPECT_TRUE(read_text(svg).starts_with("<?xml"));
    EXPECT_TRUE(read_text(png).starts_with("\x89PNG"));

    const json report = json::parse(read_text(out));
    EXPECT_EQ(report["backend"], "cpu");
    EXPECT_GT(report["copy_ms"], 0);
    ASSERT_EQ(report["effects"].size(), 1u);
    const json &group = report["effects"][0];
    EXPECT_EQ(group["effect"], "multiscatter");
    EXPECT_EQ(group["reference"]["width"], kWidth);
    for (const char *name : {"calibrated", "paper 4x4 linear_bicubic", "OpenGL fog", "global blur"}) {
        const json s = setting(group, name);
        ASSERT_TRUE(s.is_object()) << name;
        EXPECT_GT(s["ms"], 0) << name;
        EXPECT_GT(s["against"]["reference"]["error"], 0) << name;
        EXPECT_GT(s["against"]["truth"]["error"], 0) << name;
        EXPECT_NEAR(std::pow(s["against"]["truth"]["error"].get<double>(), 2), s["against"]["truth"]["rel_mse"], 1e-9)
            << name;
    }
    EXPECT_EQ(setting(group, "global blur")["kind"], "baseline");
    EXPECT_EQ(setting(group, "paper 4x4 linear_bicubic")["kind"], "published");
    expect_true_front(group, "reference");
    expect_true_front(group, "truth");
}

TEST_F(Bench, ListsSettingsThatTheSceneRefuses)
{
    write_text(fog_, R"({"brume":1,"medium":{"scattering":0.02,"g":0.8},"effects":{"airlight":{}},
        "camera":{"camera_to_world":[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]},
        "lights":[{"type":"point","position":[0,0,-5],"intensity":9}]})");
    const fs::path out = folder_ / "bench.json";
    const Result r = run(fog_, {"--json", out.string(), "--scale", "1/2"});
    ASSERT_EQ(r.status, 0) << r.err;
    const json report = json::parse(read_text(out));
    ASSERT_EQ(report["effects"].size(), 1u);
    const json &group = report["effects"][0];
    EXPECT_EQ(group["effect"], "airlight");
    EXPECT_EQ(report["width"], kWidth / 2);
    EXPECT_NE(setting(group, "sun, full")["refused"].get<std::string>().find("isotropic"), std::string::npos);
    const json nodes = setting(group, "nodes 0.001, full");
    EXPECT_LT(nodes["against"]["reference"]["error"], 1e-3);
    EXPECT_TRUE(nodes["against"]["truth"].is_null());
}

// Where no effects are named, surface runs for the layers that it reads.
TEST_F(Bench, MeasuresWithTheLayersThatRunTakes)
{
    write_text(fog_, R"({"brume":1,"medium":{"scattering":0.02,"absorption":0.01},
        "camera":{"camera_to_world":[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]},
        "lights":[{"type":"point","position":[0,2,-5],"intensity":9}]})");
    const auto measured = [&](std::vector<std::string> more) {
        const fs::path out = folder_ / "bench.json";
        more.insert(more.end(), {"--json", out.string(), "--scale", "1/4"});
        const Result r = run(fog_, more);
        EXPECT_EQ(r.status, 0) << r.err;
        std::vector<std::string> names;
        const json report = r.status == 0 ? json::parse(read_text(out)) : json{{"effects", json::array()}};
        for (const json &group : report["effects"])
            names.push_back(group["effect"]);
        return names;
    };
    const std::vector<std::string> clear{"airlight", "multiscatter"}, lit{"airlight", "multiscatter", "surface"};
    EXPECT_EQ(measured({}), clear);
    TestPart part{rgbz()};
    for (const char *axis : {"X", "Y", "Z"})
        part.channels.push_back({std::string("facing.") + axis, Imf::HALF, constant(*axis == 'Z')});
    write_exr(in_, {part});
    EXPECT_EQ(measured({}), clear);
    EXPECT_EQ(measured({"--input", "normal=facing"}), lit);
    for (TestChannel &channel : part.channels)
        if (channel.name.starts_with("facing."))
            channel.name.replace(0, 6, "N");
    write_exr(in_, {part});
    EXPECT_EQ(measured({}), lit);
    const Result wrong = run(fog_, {"--input", "normal=facing"});
    EXPECT_EQ(wrong.status, 2);
    EXPECT_NE(wrong.err.find("facing"), std::string::npos) << wrong.err;
}

TEST(Samples, LightIsAveragedAndDirectionsAreTakenFromTheMiddle)
{
    const auto layer = [](const char *role, int width) {
        auto pixels = std::make_shared<std::vector<float>>();
        for (int i = 0; i < 2 * width; ++i)
            pixels->push_back(float(i));
        return InputLayer{role, width, 2, 1, pixels};
    };
    Sample sample;
    sample.format.width = 4;
    sample.format.height = 2;
    sample.channels = 3;
    sample.color.assign(3 * 8, 1);
    sample.depth.assign(8, 1);
    sample.inputs = {layer("light_group", 4), layer("normal", 4), layer("shadow", 3)};
    const Sample half = reduced(sample, 2);
    EXPECT_EQ(*half.inputs[0].pixels, (std::vector<float>{2.5f, 4.5f}));
    EXPECT_EQ(*half.inputs[1].pixels, (std::vector<float>{5, 7}));
    EXPECT_EQ(*half.inputs[2].pixels, *sample.inputs[2].pixels);
    EXPECT_EQ(half.inputs[1].width, 2);
    EXPECT_EQ(half.inputs[1].height, 1);
    EXPECT_EQ(half.inputs[2].width, 3);
}

// An effect of somebody else's, with parameters of each type.
TEST_F(Bench, MeasuresWhatAPluginSaysOfItself)
{
    fs::create_directory(folder_ / "plugins");
    fs::copy(BRUME_TEST_PLUGIN, folder_ / "plugins");
    const std::string folder = (folder_ / "plugins").string();
    brume_context_desc desc = BRUME_CONTEXT_DESC_INIT;
    desc.backend = BRUME_BACKEND_CPU;
    desc.plugin_directory = folder.c_str();
    const Context context(desc);
    ASSERT_EQ(context.status(), BRUME_OK);
    const SceneText scene{R"({"brume":1,"camera":{"vertical_fov":50},"medium":{"scattering":0.02},
        "effects":{"multiscatter":{},"well_behaved":{"masking":false}}})",
                          "fog.json",
                          {}};
    Sample sample;
    sample.name = "a picture";
    sample.format.width = sample.format.height = 8;
    sample.channels = 3;
    sample.color.assign(3 * 64, 0.5f);
    sample.depth.assign(64, 7);
    ASSERT_EQ(effects_to_measure(context, scene, sample), (std::vector<std::string>{"multiscatter", "well_behaved"}));

    const Setting reference = reference_of(context, "well_behaved");
    EXPECT_EQ(reference.parameters, (Parameters{{"kernel", "reference"}}));
    const Group group =
        measure_group(context, scene, sample, make_reference(context, scene, sample, "well_behaved", {}), 1, {});
    std::vector<std::string> names;
    for (const Row &row : group.rows)
        if (row.setting.kind == Kind::kSetting) {
            EXPECT_EQ(row.refusal, "");
            EXPECT_EQ(error_of(row.errors.reference.value()), 0) << "it copies";
            EXPECT_GE(row.ms, 0);
            names.push_back(row.setting.name);
        }
    EXPECT_EQ(names, (std::vector<std::string>{"defaults", "masking false", "kernel paper"}));

    const SceneText clear{R"({"brume":1,"effects":{"well_behaved":{}}})", "clear.json", {}};
    EXPECT_EQ(effects_to_measure(context, clear, sample), std::vector<std::string>{"well_behaved"});
    EXPECT_EQ(median_optical_depth(context, clear, sample), 0);
    const Group plain =
        measure_group(context, clear, sample, make_reference(context, clear, sample, "well_behaved", {}), 1, {});
    EXPECT_EQ(error_of(plain.without_fog.reference.value()), 0);
}

TEST_F(Bench, RefusesWhatIsNotThereOrFitsNot)
{
    const auto refused = [&](const fs::path &scene, const std::vector<std::string> &more, const std::string &what) {
        const Result r = run(scene, more);
        EXPECT_EQ(r.status, 2) << r.err;
        EXPECT_NE(r.err.find(what), std::string::npos) << r.err;
    };
    refused(folder_ / "none.json", {}, "none.json");
    refused(fog_, {"--scale", "1/3"}, "--scale '1/3': expected 1, 1/2");
    refused(fog_, {"--png", "plot.gif"}, "plot.gif");
    TestPart small{rgbz()};
    small.data = {{0, 0}, {15, 11}};
    write_exr(truth_, {small});
    refused(fog_, {"--truth", truth_.string()}, "16 x 12 pixels; expected 32 x 24");
    refused(fog_, {"--truth", (folder_ / "none.exr").string()}, "none.exr: cannot be opened");
    write_text(fog_, kClear);
    refused(fog_, {}, "nothing to measure");
    fs::remove(in_);
    refused(fog_, {}, "in.exr: no such file");
}

}  // namespace
}  // namespace brume::tests
