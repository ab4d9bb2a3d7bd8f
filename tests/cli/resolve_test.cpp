#include <ImfStandardAttributes.h>
#include <gtest/gtest.h>

#include "image/resolve.hpp"
#include "files.hpp"
#include "support/error.hpp"

namespace brume::tests {
namespace {

using namespace brume::tool;

std::vector<TestChannel> named(const std::vector<std::string> &names)
{
    std::vector<TestChannel> channels;
    for (const std::string &name : names)
        channels.push_back({name});
    return channels;
}

class Resolve : public testing::Test {
protected:
    ImageFile file_of(const std::vector<TestPart> &parts)
    {
        write_exr(folder_ / "a.exr", parts);
        return ImageFile(folder_ / "a.exr");
    }
    ImageFile file(const std::vector<std::string> &channels, const std::vector<std::string> &views = {})
    {
        TestPart part{named(channels)};
        part.edit = [views](Imf::Header &h) {
            if (!views.empty())
                Imf::addMultiView(h, views);
        };
        return file_of({part});
    }
    static std::string depth_of(const ImageFile &f, LayerRequest request = {})
    {
        const ColorChoice color = resolve_color(f, request);
        const DepthChoice depth = resolve_depth(f, request, &color);
        return f.parts().size() > 1 ? std::to_string(depth.part) + ":" + depth.channel : depth.channel;
    }
    static std::string complaint(const ImageFile &f, LayerRequest request = {})
    {
        try {
            depth_of(f, request);
        } catch (const RequestError &e) {
            return e.what();
        }
        return "";
    }

    Folder folder_;
};

TEST_F(Resolve, ColourIsTheRootThenTheDefaultViewThenTheOnlyLayer)
{
    EXPECT_EQ(resolve_color(file({"R", "G", "B", "A", "x.R", "x.G", "x.B"}), {}).label(), "R,G,B,A");
    EXPECT_EQ(resolve_color(
                  file({"ViewLayer.Combined.R", "ViewLayer.Combined.G", "ViewLayer.Combined.B", "ViewLayer.Normal.X"}), {})
                  .rgb[0],
              "ViewLayer.Combined.R");
    EXPECT_EQ(resolve_color(
                  file({"V.Combined.R", "V.Combined.G", "V.Combined.B", "V.DiffCol.R", "V.DiffCol.G", "V.DiffCol.B"}), {})
                  .layer,
              "V.Combined");
    EXPECT_EQ(
        resolve_color(file({"left.R", "left.G", "left.B", "right.R", "right.G", "right.B"}, {"right", "left"}), {}).rgb[1],
        "right.G");
    EXPECT_EQ(resolve_color(file({"red", "green", "blue"}), {}).rgb[2], "blue");
    const ColorChoice grey = resolve_color(file({"Y", "A"}), {});
    EXPECT_TRUE(grey.luminance);
    EXPECT_EQ(grey.alpha, "A");
}

TEST_F(Resolve, ColourAsAskedOrNotAtAll)
{
    const ImageFile f = file({"a.R", "a.G", "a.B", "b.R", "b.G", "b.B"});
    EXPECT_THROW(resolve_color(f, {}), RequestError);
    EXPECT_EQ(resolve_color(f, {"b", "", "", ""}).rgb[0], "b.R");
    EXPECT_THROW(resolve_color(f, {"c", "", "", ""}), RequestError);
    EXPECT_THROW(resolve_color(f, {"", "7", "", ""}), RequestError);
    EXPECT_THROW(resolve_color(f, {"", "", "left", ""}), RequestError);
    EXPECT_THROW(resolve_color(file({"Z", "N.X", "N.Y", "N.Z"}), {}), RequestError);
    try {
        resolve_color(f, {});
    } catch (const RequestError &e) {
        EXPECT_NE(std::string(e.what()).find("a.R,a.G,a.B; b.R,b.G,b.B"), std::string::npos) << e.what();
    }
}

TEST_F(Resolve, DepthByEveryKnownName)
{
    for (const char *name : {"Z", "depth.Z", "ViewLayer.Depth.Z", "ViewLayer.Depth.V", "AI.WorldDepth.R", "VRayZDepth.R",
                             "VRayZDepth", "Pz", "Depth"})
        EXPECT_EQ(depth_of(file({"R", "G", "B", name})), name);
}

TEST_F(Resolve, RootZGoesFirst)
{
    EXPECT_EQ(depth_of(file({"R", "G", "B", "Z", "depth.Z", "character.Z"})), "Z");
    EXPECT_EQ(depth_of(file({"R", "G", "B", "depth.Z", "character.Z"})), "depth.Z")
        << "a layer's own Z is not the picture's";
}

TEST_F(Resolve, NeverTheThirdAxisOfAVector)
{
    EXPECT_EQ(depth_of(file({"R", "G", "B", "V.Depth.Z", "V.Normal.X", "V.Normal.Y", "V.Normal.Z"})), "V.Depth.Z");
    for (const char *layer : {"N.", "depth.", ""}) {
        const std::string l = layer;
        EXPECT_NE(complaint(file({"R", "G", "B", l + "X", l + "Y", l + "Z"})), "") << layer;
    }
    EXPECT_NE(complaint(file({"R", "G", "B", "Mist.Z"})).find("Mist.Z"), std::string::npos) << "offered, not chosen";
}

TEST_F(Resolve, DepthAsAsked)
{
    const ImageFile f = file({"R", "G", "B", "Z", "Mist.Z", "dist.T"});
    EXPECT_EQ(depth_of(f, {"", "", "", "Mist.Z"}), "Mist.Z");
    EXPECT_EQ(depth_of(f, {"", "", "", "dist"}), "dist.T") << "a layer of one channel";
    EXPECT_EQ(depth_of(f, {"", "", "", "R"}), "R") << "even what looks like colour";
    EXPECT_NE(complaint(f, {"", "", "", "nope"}).find("Mist.Z; Z"), std::string::npos);
}

TEST_F(Resolve, SeveralDepthsAreListed)
{
    const std::string text = complaint(file({"R", "G", "B", "a.Depth.Z", "b.Depth.Z"}));
    EXPECT_NE(text.find("a.Depth.Z; b.Depth.Z"), std::string::npos) << text;
}

TEST_F(Resolve, DepthSharesTheColoursView)
{
    const ImageFile stereo = file({"R", "G", "B", "Z", "left.R", "left.G", "left.B", "left.Z"}, {"right", "left"});
    EXPECT_EQ(depth_of(stereo), "Z");
    EXPECT_EQ(depth_of(stereo, {"", "", "left", ""}), "left.Z");
    const ImageFile half = file({"R", "G", "B", "left.R", "left.G", "left.B", "left.Z"}, {"right", "left"});
    EXPECT_NE(complaint(half).find("view 'right'"), std::string::npos) << complaint(half);
    const ImageFile nuke = file({"R", "G", "B", "left.R", "left.G", "left.B", "left.depth.Z", "depth.Z"}, {"right", "left"});
    EXPECT_EQ(depth_of(nuke, {"", "", "left", ""}), "left.depth.Z");
}

TEST_F(Resolve, PartsAreMatchedByViewAndName)
{
    TestPart rgb_left{rgb()}, z_left{named({"Z"})}, rgb_right{rgb()}, z_right{named({"Z"})};
    rgb_left.name = "rgba_left", z_left.name = "depth_left", rgb_right.name = "rgba_right", z_right.name = "depth_right";
    rgb_left.view = z_left.view = "left";
    rgb_right.view = z_right.view = "right";
    const ImageFile f = file_of({rgb_right, z_left, rgb_left, z_right});
    EXPECT_EQ(depth_of(f), "3:Z");
    EXPECT_EQ(depth_of(f, {"", "", "left", ""}), "1:Z");
    EXPECT_EQ(depth_of(f, {"", "rgba_left", "", ""}), "1:Z");
    EXPECT_EQ(depth_of(f, {"", "2", "", ""}), "1:Z");

    TestPart picture{rgb()}, depth{named({"Y"})};
    picture.name = "beauty", depth.name = "depth";
    EXPECT_EQ(depth_of(file_of({picture, depth})), "1:Y") << "a part's name only";
}

TEST_F(Resolve, DeepAndSubsampledDepthAreRefused)
{
    TestPart picture{rgb()}, deep{{{"Z", Imf::FLOAT}}};
    picture.name = "rgb", deep.name = "deep", deep.deep = true;
    const ImageFile f = file_of({picture, deep});
    EXPECT_NE(complaint(f).find("no depth"), std::string::npos);
    EXPECT_NE(complaint(f, {"", "", "", "Z"}).find("deep data"), std::string::npos);
    auto channels = rgb();
    channels.push_back({"Z", Imf::HALF, constant(1), 2});
    EXPECT_NE(complaint(file_of({{channels}}), {"", "", "", "Z"}).find("subsampled"), std::string::npos);
}

}  // namespace
}  // namespace brume::tests
