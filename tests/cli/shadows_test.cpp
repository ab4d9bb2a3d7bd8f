// Shadow maps that scenes name.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "files.hpp"
#include "run/shadow_files.hpp"

namespace brume::tests {
namespace {

constexpr double kNothing = std::numeric_limits<double>::infinity();

/// A lamp above the view's middle, and a map that looks down from it with 90 degrees.
class Shadows : public testing::Test {
protected:
    Shadows() { write_exr(in_, {{rgbz()}}); }

    fs::path scene(const std::string &shadow, const std::string &seen = R"("vertical_fov": 90)") const
    {
        const std::string more = shadow.empty() ? "" : R"(, "shadow": {)" + seen + R"(, "file": ")" + shadow + R"(",
            "camera_to_world": [[1,0,0,0], [0,0,1,3], [0,-1,0,-5], [0,0,0,1]]})";
        write_text(folder_ / "fog.json", R"({"brume":1, "medium": {"scattering": 0.05},
            "camera": {"vertical_fov": 60, "camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]},
            "lights": [{"type": "point", "position": [0,3,-5], "intensity": 50)" +
                                             more + R"(}], "effects": {"airlight": {}}})");
        return folder_ / "fog.json";
    }
    /// The left half of what the lamp sees is at `left`.
    void write_map(const std::string &name, double left, Imf::PixelType type = Imf::FLOAT,
                   const std::string &channel = "Z") const
    {
        write_exr(folder_ / name, {{{{channel, type, [left](int x, int) { return x < kWidth / 2 ? left : kNothing; }}}}});
    }
    std::vector<double> fogged(const std::string &shadow) const
    {
        const Result r = brume({"run", scene(shadow).string(), in_.string(), "-o", out_.string(), "--backend", "cpu"});
        EXPECT_EQ(r.status, 0) << r.err;
        return r.status == 0 ? read_plane(out_, "G") : std::vector<double>();
    }
    void expect_refused(const std::string &shadow, const std::vector<std::string> &words, const fs::path &out = "") const
    {
        const Result r = brume({"run", scene(shadow).string(), in_.string(), "-o", (out.empty() ? out_ : out).string()});
        EXPECT_EQ(r.status, 2) << shadow;
        for (const std::string &word : words)
            EXPECT_NE(r.err.find(word), std::string::npos) << word << " in " << r.err;
        EXPECT_FALSE(fs::exists(out_));
    }

    Folder folder_;
    const fs::path in_ = folder_ / "in.exr", out_ = folder_ / "out.exr";
};

}  // namespace

TEST_F(Shadows, FallIntoTheFogWhereTheMapHasThings)
{
    const auto lit = fogged("");
    write_map("empty.exr", kNothing);
    const auto empty = fogged("empty.exr");
    write_map("left.exr", 0.1);
    const auto left = fogged("left.exr");
    ASSERT_EQ(lit.size(), std::size_t(kWidth * kHeight));
    ASSERT_EQ(left.size(), lit.size());
    double sums[2] = {}, shadowed[2] = {};
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const std::size_t i = std::size_t(y * kWidth + x);
            EXPECT_NEAR(empty[i], lit[i], 2e-3 * lit[i]) << x << ", " << y;
            EXPECT_LE(left[i], lit[i] * 1.002) << x << ", " << y;
            sums[x >= kWidth / 2] += lit[i];
            shadowed[x >= kWidth / 2] += left[i];
        }
    EXPECT_LT(shadowed[0], 0.95 * sums[0]);
    EXPECT_NEAR(shadowed[1], sums[1], 2e-3 * sums[1]);
}

TEST_F(Shadows, ComeWithTheFrameFromTheLayerThatIsNamed)
{
    write_map("key.0001.exr", kNothing, Imf::HALF, "key.depth");
    write_map("key.0002.exr", 0.1, Imf::HALF, "key.depth");
    for (const char *frame : {"0001", "0002"})
        fs::copy_file(in_, folder_ / ("shot." + std::string(frame) + ".exr"));
    const Result r = brume({"run", scene("key.####.exr:key.depth").string(), (folder_ / "shot.####.exr").string(), "-o",
                            (folder_ / "fog.####.exr").string(), "--backend", "cpu"});
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_NE(read_plane(folder_ / "fog.0001.exr", "G"), read_plane(folder_ / "fog.0002.exr", "G"));

    const Result plan =
        brume({"plan", scene("key.####.exr:key.depth").string(), (folder_ / "shot.####.exr").string(), "--json"});
    ASSERT_EQ(plan.status, 0) << plan.err;
    const std::string said = nlohmann::json::parse(plan.out)["inputs"]["shadow0"];
    EXPECT_NE(said.find("key.0001.exr:key.depth: the scene's lights[0].shadow.file"), std::string::npos) << said;
    fs::remove(folder_ / "key.0002.exr");
    const Result gone = brume({"run", scene("key.####.exr:key.depth").string(), (folder_ / "shot.####.exr").string(), "-o",
                               (folder_ / "gone.####.exr").string()});
    EXPECT_EQ(gone.status, 1);
    EXPECT_NE(gone.err.find("key.0002.exr: no such file"), std::string::npos) << gone.err;
    EXPECT_TRUE(fs::exists(folder_ / "gone.0001.exr"));
}

TEST_F(Shadows, AllAroundTheLamp)
{
    const auto light_of = [&](const std::vector<double> &pixels) {
        const auto clear = read_plane(in_, "G");
        double sum = 0;
        for (std::size_t i = 0; i < pixels.size(); ++i)
            sum += pixels[i] - clear[i] * std::exp(-0.05 * (1 + double(i) / kWidth));
        return sum;
    };
    const auto run = [&](const std::string &seen) {
        return brume({"run", scene("around.exr", seen).string(), in_.string(), "-o", out_.string(), "--backend", "cpu"});
    };
    // All but what is within .1 m of the lamp.
    write_exr(folder_ / "around.exr", {{{{"Z", Imf::FLOAT, constant(0.1)}}}});
    Result r = run(R"("projection": "latlong")");
    ASSERT_EQ(r.status, 0) << r.err;
    const double enclosed = light_of(read_plane(out_, "G")), lit = light_of(fogged(""));
    EXPECT_LT(enclosed, 0.2 * lit);
    for (const char *wrong : {R"("projection": "latlong", "vertical_fov": 90)", R"("projection": "cube")",
                              R"("projection": "latlong", "depth": "planar")"}) {
        r = run(wrong);
        EXPECT_EQ(r.status, 2) << wrong;
        EXPECT_NE(r.err.find("expected"), std::string::npos) << r.err;
    }
}

// A map that stands still is in memory once, however many frames are read.
TEST_F(Shadows, AreReadAnewOnlyWhereTheFileIsAnotherOrNew)
{
    const auto written = fs::file_time_type::clock::now() - std::chrono::hours(1);
    const auto write = [&](const char *name, double left, std::chrono::seconds later) {
        write_map(name, left);
        fs::last_write_time(folder_ / name, written + later);
    };
    tool::ShadowFiles files;
    const auto pixels = [&](const char *name, std::uint32_t light) {
        const tool::ImageFile file(folder_ / name);
        return files.read(file, tool::resolve_shadow(file, "", light)).pixels;
    };
    write("key.exr", 1, {});
    write("rim.exr", 2, {});
    const auto key = pixels("key.exr", 0), rim = pixels("rim.exr", 1);
    EXPECT_EQ(pixels("key.exr", 0), key);
    EXPECT_EQ(pixels("rim.exr", 1), rim);
    EXPECT_EQ(rim->front(), 2);
    write("key.exr", 3, std::chrono::seconds(1));
    EXPECT_EQ(pixels("key.exr", 0)->front(), 3);
    EXPECT_EQ(pixels("rim.exr", 0)->front(), 2);
    EXPECT_EQ(key->front(), 1) << "of a frame that is still under way";
}

// Of a map that was rendered in part, the rest shows nothing.
TEST_F(Shadows, SpanTheDisplayWindow)
{
    write_exr(folder_ / "part.exr", {{{{"Z", Imf::FLOAT, constant(0.1)}}, {{0, 0}, {kWidth / 2 - 1, kHeight - 1}}}});
    write_map("whole.exr", 0.1);
    EXPECT_EQ(fogged("part.exr"), fogged("whole.exr"));
}

TEST_F(Shadows, WhatIsNoMapIsRefusedByName)
{
    expect_refused("none.exr", {"lights[0].shadow.file", "none.exr: no such file"});
    write_exr(folder_ / "rgb.exr", {{rgb()}});
    expect_refused("rgb.exr", {"rgb.exr: lights[0].shadow.file", "expected FILE:LAYER with one of R,G,B"});
    expect_refused("rgb.exr:R,G", {"rgb.exr: lights[0].shadow.file \":R,G\"", "no such layer"});
    write_exr(folder_ / "n.exr", {{rgb("n.")}});
    expect_refused("n.exr:n", {"n.exr: lights[0].shadow.file", "has 3 channels; expected one"});
    write_map("ids.exr", 1, Imf::UINT);
    expect_refused("ids.exr", {"ids.exr: lights[0].shadow.file: 'Z' is uint; expected half or float"});
    write_map("key.exr", 1);
    expect_refused("key.exr:Z", {"key.exr: would overwrite the input"}, folder_ / "key.exr");
}

}  // namespace brume::tests
