// Layers that the library is given: another renderer's fog, and what effects read of the surfaces.
#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "image/resolve_input.hpp"
#include "files.hpp"
#include "support/error.hpp"

namespace brume::tests {
namespace {

using nlohmann::json;
using namespace brume::tool;

double tau_at(int x, int y)
{
    return 0.9 * (x + 1) / kWidth * (y + 1) / kHeight;
}

std::vector<TestChannel> three(
    const std::string &layer, const std::function<double(double)> &of = [](double tau) { return tau; })
{
    std::vector<TestChannel> channels;
    for (const char *base : {"R", "G", "B"})
        channels.push_back({layer + "." + base, Imf::HALF, [of](int x, int y) { return of(tau_at(x, y)); }});
    return channels;
}

class Inputs : public testing::Test {
protected:
    /// Float colour, and a depth such that a medium of extinction 0.03 has the optical depth of tau_at().
    static std::vector<TestChannel> picture()
    {
        std::vector<TestChannel> channels = rgb("", Imf::FLOAT);
        channels.push_back({"Z", Imf::FLOAT, [](int x, int y) { return tau_at(x, y) / 0.03; }});
        return channels;
    }
    static std::vector<TestChannel> with(std::vector<TestChannel> more)
    {
        std::vector<TestChannel> channels = picture();
        channels.insert(channels.end(), more.begin(), more.end());
        return channels;
    }
    Result command(const std::string &name, const fs::path &scene, std::vector<std::string> more) const
    {
        std::vector<std::string> words{name,           scene.string(), in_.string(), "--backend", "cpu",
                                       "--depth-kind", "ray",          "--vfov",     "50"};
        words.insert(words.end(), more.begin(), more.end());
        return brume(words);
    }
    Result run(const fs::path &scene, std::vector<std::string> more) const
    {
        more.insert(more.end(), {"-o", out_.string()});
        return command("run", scene, more);
    }
    std::vector<double> fogged(const fs::path &scene, std::vector<std::string> more, const std::string &channel = "G") const
    {
        const Result r = run(scene, more);
        EXPECT_EQ(r.status, 0) << r.err;
        return r.status == 0 ? read_plane(out_, channel) : std::vector<double>();
    }
    static void expect_close(const std::vector<double> &a, const std::vector<double> &b)
    {
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t i = 0; i < a.size(); ++i)
            ASSERT_NEAR(a[i], b[i], 1e-3 * std::abs(b[i])) << i;
    }
    void expect_refused(const std::vector<std::string> &more, const std::vector<std::string> &words)
    {
        fs::remove(out_);
        const Result r = run(fog_, more);
        EXPECT_EQ(r.status, 2) << more[1];
        for (const std::string &word : words)
            EXPECT_NE(r.err.find(word), std::string::npos) << word << " in " << r.err;
        EXPECT_FALSE(fs::exists(out_));
    }

    Inputs()
    {
        write_text(fog_, kFog);
        // The same material, but nine times too much of it.
        write_text(wrong_, R"({"brume":1,"medium":{"scattering":[0.02,0.02,0.02],"absorption":[0.01,0.01,0.01],"g":0.8,
                               "density":[{"type":"constant","value":9}]}})");
    }

    Folder folder_;
    const fs::path fog_ = folder_ / "fog.json", wrong_ = folder_ / "wrong.json", in_ = folder_ / "in.exr",
                   out_ = folder_ / "out.exr";
};

TEST_F(Inputs, LightGroupsAreThoseThatTheSceneNames)
{
    const auto scene = [&](const std::string &more) {
        write_text(fog_, R"({"brume":1, "camera": {"camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]},
            "medium": {"scattering": 0.01, "absorption": 0.05}, "lights": [
            {"type": "point", "position": [0,2,0], "intensity": 9)" +
                             more + R"(},
            {"type": "point", "position": [1,0,-9], "intensity": 5}]})");
        return fog_;
    };
    write_exr(in_, {{with(three("L0", [](double tau) { return 0.2 * tau; }))}});
    const auto plain = fogged(scene(""), {}), own = fogged(scene(R"(, "group": "L0")"), {});
    EXPECT_NE(plain, own);
    const Result plan = command("plan", scene(R"(, "group": "L0")"), {"--json"});
    ASSERT_EQ(plan.status, 0) << plan.err;
    const json said = json::parse(plan.out);
    EXPECT_EQ(said["inputs"]["light_group0"], "L0.R,L0.G,L0.B: the scene's lights[0].group");
    scene(R"(, "group": "L1")");
    expect_refused({"--sky", "fog"}, {"lights[0].group \"L1\"", "nearest is 'L0'"});
}

TEST_F(Inputs, LayersOfTheSameFileAreTheMedium)
{
    auto channels = with(three("fog.tau"));
    for (const TestChannel &c : three("fog.T", [](double tau) { return std::exp(-tau); }))
        channels.push_back(c);
    channels.push_back({"grey", Imf::HALF, tau_at});
    write_exr(in_, {{channels}});
    const auto expected = fogged(fog_, {});
    const auto wrong = fogged(wrong_, {});
    ASSERT_GT(std::abs(wrong.back() - expected.back()), 0.1 * expected.back()) << "the scene's own density would show";
    expect_close(fogged(wrong_, {"--input", "optical_depth=fog.tau"}), expected);
    expect_close(fogged(wrong_, {"--input", "transmittance=fog.T"}), expected);
    expect_close(fogged(wrong_, {"--input", "optical_depth=grey"}), expected);
}

TEST_F(Inputs, LayersOfFilesOfTheirOwnAreTheMediumOfTheirFrames)
{
    write_exr(folder_ / "s.0001.exr", {{picture()}});
    write_exr(folder_ / "s.0002.exr", {{picture()}});
    write_exr(folder_ / "fog.0001.exr", {{with(three("tau"))}});
    write_exr(folder_ / "fog.0002.exr", {{with(three("tau", [](double) { return 0.0; }))}});
    write_exr(in_, {{picture()}});
    const auto expected = fogged(fog_, {});
    const Result r = brume({"run", wrong_.string(), (folder_ / "s.####.exr").string(), "-o",
                            (folder_ / "o.####.exr").string(), "--backend", "cpu", "--depth-kind", "ray", "--vfov", "50",
                            "--input", "optical_depth=" + (folder_ / "fog.####.exr:tau").string()});
    ASSERT_EQ(r.status, 0) << r.err;
    expect_close(read_plane(folder_ / "o.0001.exr", "G"), expected);
    expect_close(read_plane(folder_ / "o.0002.exr", "G"), read_plane(in_, "G"));
}

TEST_F(Inputs, OpticalDepthThatTheToolWroteIsTheSameFogAgain)
{
    write_exr(in_, {{picture()}});
    const auto expected = fogged(fog_, {"--layers", "optical_depth"});
    fs::rename(out_, folder_ / "layers.exr");
    expect_close(fogged(wrong_, {"--input", "optical_depth=" + (folder_ / "layers.exr:brume.optical_depth").string()}),
                 expected);
}

TEST_F(Inputs, AnotherDataWindowIsPlaced)
{
    TestPart own{three("tau", [](double) { return 1.0; })};
    own.data = {{8, 6}, {15, 11}};
    write_exr(folder_ / "small.exr", {own});
    write_exr(in_, {{picture()}});
    write_text(fog_, R"({"brume":1,"medium":{"absorption":[0.1,0.1,0.1]}})");
    const fs::path stats = folder_ / "stats.json";
    const auto g =
        fogged(fog_, {"--input", "optical_depth=" + (folder_ / "small.exr:tau").string(), "--stats", stats.string()});
    const auto before = read_plane(in_, "G");
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const bool inside = x >= 8 && x <= 15 && y >= 6 && y <= 11;
            const auto i = std::size_t(y * kWidth + x);
            ASSERT_NEAR(g[i], before[i] * (inside ? std::exp(-1.0) : 1), 1e-5) << x << ' ' << y;
        }
    const json frame = json::parse(read_text(stats))["frames"][0];
    EXPECT_NE(frame["resolved"]["inputs"]["optical_depth"].get<std::string>().find("tau.R,tau.G,tau.B"), std::string::npos);
    EXPECT_NE(frame["warnings"].dump().find(std::to_string(kWidth * kHeight - 48) + " pixels are outside"),
              std::string::npos);
}

TEST_F(Inputs, WrongRequestsNameWhatThereIs)
{
    write_exr(in_, {{with(three("tau"))}});
    expect_refused({"--input", "optical_dept=tau"}, {"'optical_dept'", "nearest is 'optical_depth'", "transmittance"});
    expect_refused({"--input", "optical_depth=tua"},
                   {"in.exr", "optical_depth=tua", "nearest is 'tau'", "tau.R,tau.G,tau.B"});
    expect_refused({"--input", "optical_depth"}, {"ROLE=LAYER"});
    expect_refused({"--input", "optical_depth=fog.exr:"}, {"ROLE=FILE:LAYER"});
    expect_refused({"--input", "optical_depth=" + (folder_ / "none.exr").string() + ":tau"}, {"none.exr", "no such file"});
    expect_refused({"--input", "optical_depth=tau", "--input", "optical_depth=Z"}, {"twice"});
    expect_refused({"--input", "optical_depth=tau", "--input", "transmittance=tau"}, {"optical_depth", "transmittance"});
    expect_refused({"--layers", "transmitance"}, {"'transmitance'", "nearest is 'transmittance'", "blur_radius"});
}

TEST_F(Inputs, SeveralLayersOfThatNameAreListed)
{
    TestPart color{picture()}, one{three("tau")}, other{three("tau")};
    color.name = "beauty";
    one.name = "near";
    other.name = "far";
    write_exr(in_, {color, one, other});
    expect_refused({"--input", "optical_depth=tau"}, {"2 layers", "(near)", "(far)"});
    EXPECT_EQ(run(fog_, {"--input", "optical_depth=near.tau"}).status, 0);
}

TEST_F(Inputs, ADisplayWindowThatIsNotThePicturesIsRefused)
{
    write_exr(in_, {{picture()}});
    write_exr(folder_ / "half.exr", {{three("tau"), {{0, 0}, {15, 11}}}}, {{0, 0}, {15, 11}});
    expect_refused({"--input", "optical_depth=" + (folder_ / "half.exr:tau").string()}, {"half.exr", "16 x 12", "32 x 24"});
}

TEST_F(Inputs, InfoAndPlanSayWhatWasChosen)
{
    write_exr(in_, {{with(three("tau"))}});
    const Result plan = command("plan", fog_, {"--input", "optical_depth=tau", "--json"});
    ASSERT_EQ(plan.status, 0) << plan.err;
    const std::string chosen = "tau.R,tau.G,tau.B: as asked by --input";
    EXPECT_EQ(json::parse(plan.out)["inputs"]["optical_depth"], chosen);
    EXPECT_NE(command("plan", fog_, {"--input", "optical_depth=tau"}).out.find(chosen), std::string::npos);
    const std::vector<std::string> words{"info", in_.string(), "--input", "optical_depth=tau"};
    EXPECT_NE(brume(words).out.find("input    optical_depth: " + chosen), std::string::npos);
    EXPECT_EQ(brume({"info", in_.string()}).out.find("optical_depth"), std::string::npos);
}

TEST_F(Inputs, EffectsListTheirLayers)
{
    const Result r = brume({"effects", "--json"});
    ASSERT_EQ(r.status, 0) << r.err;
    const json all = json::parse(r.out);
    const json &library = all["library_layers"];
    EXPECT_TRUE(std::any_of(library.begin(), library.end(), [](const json &layer) {
        return layer["name"] == "optical_depth" && layer["direction"] == "read" && layer["channels"] == 3 &&
               !layer["needed"];
    }));
    bool found = false;
    for (const json &effect : all["effects"])
        for (const json &layer : effect.value("layers", json::array()))
            found |= effect["name"] == "multiscatter" && layer["name"] == "blur_radius" && layer["direction"] == "filled" &&
                     layer["channels"] == 1 && !layer["help"].empty();
    EXPECT_TRUE(found) << r.out;
    const std::string text = brume({"effects", "multiscatter"}).out;
    EXPECT_NE(text.find("blur_radius"), std::string::npos) << text;
}

class KnownInputs : public testing::Test {
protected:
    std::string found(const std::string &role, std::vector<std::string> names)
    {
        std::vector<TestChannel> channels = rgb();
        for (const std::string &name : names)
            channels.push_back({name});
        write_exr(folder_ / "a.exr", {{channels}});
        const ImageFile file(folder_ / "a.exr");
        const auto choice = find_known_input(file, role, resolve_color(file, {}));
        return choice ? choice->label() : "";
    }
    Folder folder_;
};

TEST_F(KnownInputs, AreNamedAsRenderersNameThem)
{
    EXPECT_EQ(found("normal", {"N.X", "N.Y", "N.Z"}), "N.X,N.Y,N.Z");
    EXPECT_EQ(found("normal", {"ViewLayer.Normal.X", "ViewLayer.Normal.Y", "ViewLayer.Normal.Z"}),
              "ViewLayer.Normal.X,ViewLayer.Normal.Y,ViewLayer.Normal.Z");
    EXPECT_EQ(found("normal", {"normal.R", "normal.G", "normal.B"}), "normal.R,normal.G,normal.B");
    EXPECT_EQ(found("albedo", {"V.DiffCol.R", "V.DiffCol.G", "V.DiffCol.B"}), "V.DiffCol.R,V.DiffCol.G,V.DiffCol.B");
    EXPECT_EQ(found("specular", {"V.GlossCol.R", "V.GlossCol.G", "V.GlossCol.B"}), "V.GlossCol.R,V.GlossCol.G,V.GlossCol.B");
    EXPECT_EQ(found("roughness", {"roughness.Y"}), "roughness.Y");
    EXPECT_EQ(found("roughness", {"rough.Y"}), "");
    EXPECT_EQ(found("normal", {"V.N.X", "V.N.Y", "V.N.Z"}), "");
}

TEST_F(KnownInputs, AreListedWhereThereAreSeveral)
{
    try {
        found("albedo", {"albedo.R", "albedo.G", "albedo.B", "V.DiffCol.R", "V.DiffCol.G", "V.DiffCol.B"});
        ADD_FAILURE();
    } catch (const RequestError &e) {
        for (const char *word : {"--input albedo=", "albedo.R", "V.DiffCol.R"})
            EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << e.what();
    }
}

TEST_F(KnownInputs, AreNeverTheMedium)
{
    EXPECT_EQ(found("optical_depth", {"optical_depth.R", "optical_depth.G", "optical_depth.B"}), "");
    EXPECT_FALSE(has_known_names("optical_depth"));
    EXPECT_FALSE(has_known_names("transmittance"));
    EXPECT_TRUE(has_known_names("normal"));
}

}  // namespace
}  // namespace brume::tests
