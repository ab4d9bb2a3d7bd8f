#include <cmath>

#include <ImfChannelList.h>
#include <ImfFloatAttribute.h>
#include <ImfStandardAttributes.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "files.hpp"

namespace brume::tests {
namespace {

using nlohmann::json;

class Tool : public testing::Test {
protected:
    Tool()
    {
        write_text(fog_, kFog);
        write_text(clear_, kClear);
    }
    Result run(const fs::path &scene, std::vector<std::string> more) const
    {
        std::vector<std::string> words{"run", scene.string(), in_.string(), "-o", out_.string(), "--backend", "cpu"};
        words.insert(words.end(), more.begin(), more.end());
        return brume(words);
    }

    Folder folder_;
    const fs::path fog_ = folder_ / "fog.json", clear_ = folder_ / "clear.json", in_ = folder_ / "in.exr",
                   out_ = folder_ / "out.exr";
};

TEST_F(Tool, ASceneWithoutMediumReturnsThePictureBitForBit)
{
    TestPart part{rgbz()};
    part.channels[1].value = [](int x, int y) { return x == 3 && y == 3 ? NAN : 1e-7 * x; };
    write_exr(in_, {part});
    ASSERT_EQ(run(clear_, {}).status, 0);
    for (const char *c : {"R", "B", "Z"})
        EXPECT_EQ(read_plane(in_, c), read_plane(out_, c));
    const auto g = read_plane(out_, "G");
    EXPECT_TRUE(std::isnan(g[3 * kWidth + 3]));
    EXPECT_EQ(g[3 * kWidth + 4], read_plane(in_, "G")[3 * kWidth + 4]);
}

TEST_F(Tool, FogAttenuatesAndLayersSayHow)
{
    write_text(fog_, R"({"brume":1,"medium":{"scattering":[0,0,0],"absorption":[0.1,0.05,0]}})");
    write_exr(in_, {{rgbz()}});
    ASSERT_EQ(run(fog_, {"--depth-kind", "ray", "--vfov", "50", "--layers", "transmittance,optical_depth"}).status, 0);
    const auto z = read_plane(in_, "Z"), before = read_plane(in_, "R"), after = read_plane(out_, "R");
    const auto t = read_plane(out_, "brume.transmittance.R"), tau = read_plane(out_, "brume.optical_depth.G");
    for (std::size_t i = 0; i < z.size(); i += 37) {
        EXPECT_NEAR(t[i], std::exp(-0.1 * z[i]), 1e-3);
        EXPECT_NEAR(tau[i], 0.05 * z[i], 1e-6 * z[i]);
        EXPECT_NEAR(after[i], before[i] * std::exp(-0.1 * z[i]), 1e-3 * before[i]);
    }
    EXPECT_EQ(read_plane(in_, "B"), read_plane(out_, "B"));
}

TEST_F(Tool, OnlyTheViewAskedForIsFogged)
{
    write_text(fog_, R"({"brume":1,"medium":{"scattering":[0,0,0],"absorption":[0.1,0.1,0.1]}})");
    TestPart part{rgbz()};
    for (auto &c : rgb("left."))
        part.channels.push_back(c);
    part.channels.push_back({"left.Z", Imf::HALF, constant(4)});
    part.edit = [](Imf::Header &h) { Imf::addMultiView(h, {"right", "left"}); };
    write_exr(in_, {part});
    ASSERT_EQ(run(fog_, {"--depth-kind", "ray", "--vfov", "50", "--view", "left", "--layers", "transmittance"}).status, 0);
    EXPECT_EQ(read_plane(in_, "R"), read_plane(out_, "R"));
    EXPECT_NEAR(read_plane(out_, "left.G")[9], read_plane(in_, "left.G")[9] * std::exp(-0.4), 1e-3);
    EXPECT_NEAR(read_plane(out_, "brume.transmittance.left.G")[9], std::exp(-0.4), 1e-3);
}

TEST_F(Tool, GreyPicturesStayGrey)
{
    write_text(fog_, R"({"brume":1,"medium":{"scattering":[0,0,0],"absorption":[0.1,0.1,0.1]}})");
    write_exr(in_, {{{{"Y", Imf::FLOAT, [](int x, int) { return x; }}, {"Z", Imf::FLOAT, constant(5)}}}});
    ASSERT_EQ(run(fog_, {"--depth-kind", "ray", "--vfov", "50"}).status, 0);
    EXPECT_EQ(read_header(out_).channels().findChannel("R"), nullptr);
    EXPECT_NEAR(read_plane(out_, "Y")[20], 20 * std::exp(-0.5), 1e-4);
}

TEST_F(Tool, AMissingCameraIsAnErrorOnlyWhereItMatters)
{
    write_exr(in_, {{rgbz()}});
    const Result r = run(fog_, {});
    EXPECT_EQ(r.status, 2);
    EXPECT_NE(r.err.find("field of view"), std::string::npos) << r.err;
    EXPECT_FALSE(fs::exists(out_));
    EXPECT_EQ(run(clear_, {}).status, 0);
    write_text(folder_ / "camera.json", R"({"vertical_fov":50})");
    EXPECT_EQ(run(fog_, {"--camera", (folder_ / "camera.json").string()}).status, 0);
    const std::string by_file = read_text(out_);
    EXPECT_EQ(run(fog_, {"--vfov", "50"}).status, 0);
    EXPECT_TRUE(read_text(out_) == by_file);
}

TEST_F(Tool, CameraOptionsGoBeforeTheSceneAndTheSceneBeforeMetadata)
{
    TestPart part{rgbz()};
    part.edit = [](Imf::Header &h) { h.insert("cameraFov", Imf::FloatAttribute(20)); };
    write_exr(in_, {part});
    const auto source = [&](const fs::path &scene, std::vector<std::string> more) {
        more.insert(more.end(), {"--stats", (folder_ / "s.json").string()});
        EXPECT_EQ(run(scene, more).status, 0);
        return json::parse(read_text(folder_ / "s.json"))["frames"][0]["resolved"]["camera"].get<std::string>();
    };
    const fs::path with_camera = folder_ / "camera-fog.json";
    write_text(with_camera, R"({"brume":1,"camera":{"vertical_fov":40},"medium":{"scattering":[0.02,0.02,0.02]}})");
    EXPECT_NE(source(fog_, {}).find("cameraFov"), std::string::npos);
    EXPECT_NE(source(with_camera, {}).find("field of view: scene file"), std::string::npos);
    EXPECT_NE(source(with_camera, {"--vfov", "50"}).find("--vfov"), std::string::npos);
}

TEST_F(Tool, WrongRequestsAreRefusedBeforeAnythingIsWritten)
{
    write_exr(in_, {{rgbz()}});
    const std::vector<std::vector<std::string>> wrong{{"--nonsense"},
                                                      {"--depth", "nope"},
                                                      {"--depth-kind", "cubic"},
                                                      {"--depth-kind", "normalized:5,1"},
                                                      {"--far", "-1"},
                                                      {"--sky", "clamp:0"},
                                                      {"--vfov", "180"},
                                                      {"--vfov", "x"},
                                                      {"--camera", "/no/such.json"},
                                                      {"--layers", "shadows"},
                                                      {"--set", "multiscatter"},
                                                      {"--set", "multiscatter.kernle=paper"},
                                                      {"--set", "fog.kernel=paper"},
                                                      {"--backend", "metal"},
                                                      {"--frames", "1-3"},
                                                      {"--jobs", "0"},
                                                      {"--mem", "0"},
                                                      {"--input-space", "no such space"},
                                                      {"--color", "x"},
                                                      {"--part", "x"},
                                                      {"--view", "x"}};
    for (const auto &more : wrong) {
        const Result r = run(fog_, more);
        EXPECT_EQ(r.status, 2) << more.front() << ' ' << r.err;
        EXPECT_FALSE(r.err.empty() && r.out.empty()) << more.front();
        EXPECT_FALSE(fs::exists(out_)) << more.front();
    }
    EXPECT_EQ(brume({}).status, 2);
    EXPECT_EQ(brume({"run"}).status, 2);
    EXPECT_EQ(brume({"run", fog_.string(), "/no/such.exr", "-o", out_.string()}).status, 2);
    EXPECT_EQ(brume({"run", "/no/such.json", in_.string(), "-o", out_.string()}).status, 2);
    write_text(fog_, R"({"brume":1,"medum":{}})");
    const Result r = run(fog_, {});
    EXPECT_EQ(r.status, 2);
    EXPECT_NE(r.err.find("medium"), std::string::npos) << "names the nearest key: " << r.err;
}

TEST_F(Tool, ADamagedFileIsAFailedFrame)
{
    write_exr(in_, {{rgbz()}});
    const std::string whole = read_text(in_);
    for (std::size_t size = 0; size < whole.size(); size += std::max<std::size_t>(1, whole.size() / 12)) {
        write_text(in_, whole.substr(0, size));
        const Result r = run(fog_, {"--vfov", "50"});
        EXPECT_EQ(r.status, 1) << size;
        EXPECT_NE(r.err.find("in.exr"), std::string::npos) << r.err;
        EXPECT_FALSE(fs::exists(out_));
    }
}

TEST_F(Tool, HugeClaimsAreRefusedCheaply)
{
    write_exr(in_, {{rgbz()}});
    std::string bytes = read_text(in_);
    const auto at = bytes.find("dataWindow") + std::string("dataWindow\0box2i\0", 17).size() + 4 + 8;
    bytes[at + 2] = 0x10;  // the right edge moves by a million
    write_text(in_, bytes);
    const Result r = run(fog_, {"--vfov", "50"});
    EXPECT_EQ(r.status, 1);
    EXPECT_NE(r.err.find("65536"), std::string::npos) << r.err;
}

TEST_F(Tool, DepthMayHaveAFileOfItsOwn)
{
    write_exr(in_, {{rgb()}});
    write_exr(folder_ / "z.exr", {{{{"depth.Z", Imf::FLOAT, [](int, int y) { return y + 1.0; }}}}});
    ASSERT_EQ(run(fog_, {"--vfov", "50", "--depth", (folder_ / "z.exr:depth.Z").string()}).status, 0);
    const auto red = read_plane(out_, "R");
    write_exr(in_, {{rgbz()}});
    ASSERT_EQ(run(fog_, {"--vfov", "50"}).status, 0);
    EXPECT_EQ(read_plane(out_, "R"), red);
}

TEST_F(Tool, InfoSaysWhatWasResolved)
{
    TestPart part{rgbz()};
    part.channels[3].value = [](int x, int y) { return y ? 2.0 + y : x == 0 ? NAN : x == 1 ? 1e10 : x == 2 ? 0 : 2; };
    part.edit = [](Imf::Header &h) { h.insert("cameraFov", Imf::FloatAttribute(90)); };
    write_exr(in_, {part});
    const Result r = brume({"info", in_.string(), "--json"});
    ASSERT_EQ(r.status, 0) << r.err;
    const json info = json::parse(r.out);
    EXPECT_EQ(info["color"]["channels"], "R,G,B");
    EXPECT_EQ(info["depth"]["channel"], "Z");
    EXPECT_EQ(info["depth"]["kind"], "planar");
    EXPECT_EQ(info["depth"]["far_pixels"], 3);
    EXPECT_EQ(info["depth"]["nan_pixels"], 1);
    EXPECT_EQ(info["depth"]["nearest"], 2);
    EXPECT_NEAR(info["camera"]["vertical_fov"].get<double>(), 2 * std::atan(24.0 / 32) * 180 / M_PI, 1e-4);
    EXPECT_EQ(info["display_window"]["width"], kWidth);
    EXPECT_EQ(brume({"info", in_.string()}).status, 0);
    EXPECT_EQ(brume({"info", in_.string(), "--depth", "nope"}).status, 2);
    EXPECT_EQ(brume({"info", fog_.string()}).status, 1) << "not an EXR";
}

TEST_F(Tool, CompareMeasuresAndShows)
{
    TestPart a{rgbz()}, b{rgbz()};
    b.channels[0].value = [](int x, int y) { return x == 5 && y == 7 ? 9.5 : 0.25; };
    a.channels[0].value = constant(0.25);
    write_exr(in_, {a});
    write_exr(folder_ / "b.exr", {b});
    const Result r = brume(
        {"compare", in_.string(), (folder_ / "b.exr").string(), "--json", "--difference", (folder_ / "d.exr").string()});
    ASSERT_EQ(r.status, 0) << r.err;
    const json m = json::parse(r.out);
    EXPECT_EQ(m["max_difference"]["value"], 9.25);
    EXPECT_EQ(m["max_difference"]["x"], 5);
    EXPECT_EQ(m["max_difference"]["y"], 7);
    EXPECT_EQ(m["different_pixels"], 1);
    EXPECT_GT(m["rel_mse"].get<double>(), 0);
    EXPECT_EQ(read_plane(folder_ / "d.exr", "R")[7 * kWidth + 5], 9.25);
    EXPECT_EQ(brume({"compare", in_.string(), in_.string(), "-d", (folder_ / "d.png").string()}).status, 0);
    EXPECT_EQ(read_text(folder_ / "d.png").substr(1, 3), "PNG");
    a.data = {{100, 100}, {101, 101}};
    write_exr(folder_ / "b.exr", {a});
    EXPECT_EQ(brume({"compare", in_.string(), (folder_ / "b.exr").string()}).status, 1) << "no pixel in common";
}

TEST_F(Tool, ColourSpacesGoThereAndBack)
{
    write_exr(in_, {{[] {
                  auto c = rgb("", Imf::FLOAT);
                  c.push_back({"Z", Imf::FLOAT});
                  return c;
              }()}});
    ASSERT_EQ(run(clear_, {"--input-space", "ACEScg"}).status, 0);
    const auto before = read_plane(in_, "R"), after = read_plane(out_, "R");
    for (std::size_t i = 0; i < before.size(); ++i)
        ASSERT_NEAR(before[i], after[i], 1e-5 * before[i]);
    ASSERT_EQ(run(clear_, {"--input-space", "ACEScg", "--output-space", "Linear Rec.709"}).status, 0);
    EXPECT_GT(std::abs(read_plane(out_, "R")[7] - before[7]), 1e-2);
}

TEST_F(Tool, PlanEffectsAndSchemaExplainThemselves)
{
    write_exr(in_, {{rgbz()}});
    const Result plan = brume({"plan", fog_.string(), in_.string(), "--vfov", "50", "--backend", "cpu", "--json"});
    ASSERT_EQ(plan.status, 0) << plan.err;
    EXPECT_FALSE(json::parse(plan.out)["entries"].empty());
    EXPECT_EQ(brume({"plan", fog_.string(), in_.string(), "--vfov", "50", "--backend", "cpu"}).status, 0);
    EXPECT_NE(brume({"effects"}).out.find("multiscatter"), std::string::npos);
    EXPECT_NE(brume({"effects", "multiscatter"}).out.find("(also kernel)"), std::string::npos);
    const auto planned = [&](const std::string &set) {
        return brume({"plan", fog_.string(), in_.string(), "--vfov", "50", "--backend", "cpu", "--json", "--set", set}).out;
    };
    EXPECT_EQ(planned("multiscatter.kernel=paper"), planned("multiscatter.method=paper"));
    EXPECT_NE(planned("multiscatter.kernel=paper"), planned("multiscatter.method=calibrated"));
    EXPECT_EQ(brume({"effects", "nope"}).status, 2);
    EXPECT_TRUE(json::parse(brume({"schema"}).out).is_object());
    EXPECT_EQ(brume({"--help"}).status, 0);
    EXPECT_EQ(brume({"--version"}).status, 0);
}

// Effects of a directory that the command line names, and of no other.
TEST_F(Tool, FindsEffectsInADirectory)
{
    const fs::path plugins = folder_ / "plugins";
    fs::create_directory(plugins);
    fs::copy(BRUME_TEST_PLUGIN, plugins);
    write_text(fog_, R"({"brume":1,"effects":{"well_behaved":{}}})");
    write_exr(in_, {{rgbz()}});
    const std::string in = in_.string(), fog = fog_.string();
    const std::vector<std::string> commands[] = {{"effects", "well_behaved"},
                                                 {"run", fog, in, "-o", out_.string(), "--backend", "cpu"},
                                                 {"plan", fog, in, "--backend", "cpu"},
                                                 {"bench", fog, in, "--backend", "cpu", "--repeat", "1"}};
    for (std::vector<std::string> command : commands) {
        EXPECT_EQ(brume(command).status, 2) << command[0];
        command.insert(command.end(), {"--plugins", fs::relative(plugins).string()});
        const Result r = brume(command);
        EXPECT_EQ(r.status, 0) << command[0] << ": " << r.err;
        command.back() = in;
        const Result refused = brume(command);
        EXPECT_EQ(refused.status, 2) << command[0];
        EXPECT_NE(refused.err.find("--plugins " + in + ": no such directory"), std::string::npos) << refused.err;
    }
    EXPECT_EQ(brume({"schema"}).out.find("well_behaved"), std::string::npos);
    EXPECT_NE(brume({"schema", "--plugins", plugins.string()}).out.find("well_behaved"), std::string::npos);
}

}  // namespace
}  // namespace brume::tests
