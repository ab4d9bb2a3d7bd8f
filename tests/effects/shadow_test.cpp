// Shadows of solid things in the airlight, through the C ABI.
#include <filesystem>
#include <fstream>
#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "exr.h"
#include "picture_metrics.h"

using namespace fog;
using Json = nlohmann::ordered_json;

namespace {

constexpr int width = 48, height = 32;

// A spot before the camera that shines toward it from 8 m, its map as wide as its cone.
Json lamp(bool shadowed)
{
    Json light{{"type", "spot"}, {"position", {0, 0.5, -8}}, {"direction", {0, 0, 1}}, {"intensity", 100}, {"angle", 60}};
    if (shadowed)
        light["shadow"] = {{"file", "lamp.exr"},
                           {"vertical_fov", 60},
                           {"camera_to_world", {{-1, 0, 0, 0}, {0, 1, 0, 0.5}, {0, 0, -1, -8}, {0, 0, 0, 1}}}};
    return light;
}

Json scene_with(const Json &lights, const Json &airlight = Json::object())
{
    return {
        {"brume", 1},
        {"camera", {{"vertical_fov", 50}, {"camera_to_world", {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}}}},
        {"medium", {{"scattering", 0.05}, {"g", 0.3}}},
        {"lights", lights},
        {"effects", {{"airlight", airlight}}}};
}

// Slats 1.5 m before the lamp, of another size than the frame.
Picture fence()
{
    Picture map(64, 40, 1, std::numeric_limits<float>::infinity());
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x)
            if (x / 6 % 2)
                *map.at(x, y) = 1.5f;
    return map;
}

Picture fogged(brume_context context, const Json &scene, const std::map<std::string, Picture> &inputs = {})
{
    const Picture color(width, height, 4, 0), depth(width, height, 1, 12);
    Options options;
    options.inputs = inputs;
    return run(context, scene.dump(), color, depth, options).output;
}

double sum(const Picture &p)
{
    double total = 0;
    for (float v : p.data)
        total += v;
    return total;
}

void expect_refusal(const Json &scene, const std::map<std::string, Picture> &inputs, brume_status status, const char *part)
{
    try {
        fogged(cpu(), scene, inputs);
        ADD_FAILURE() << "not refused: " << part;
    } catch (const Failure &failure) {
        EXPECT_EQ(failure.status, status) << failure.what();
        EXPECT_NE(std::string(failure.what()).find(part), std::string::npos) << failure.what();
    }
}

}  // namespace

TEST(Shadows, DarkenTheFogAlikeOnAllBackends)
{
    const Json shadowed = scene_with(Json::array({lamp(true)}));
    const Picture without = fogged(cpu(), scene_with(Json::array({lamp(false)}))),
                  with = fogged(cpu(), shadowed, {{"shadow", fence()}});
    EXPECT_LT(sum(with), 0.8 * sum(without));
    EXPECT_GT(sum(with), 0.3 * sum(without));
    if (gl()) {
        EXPECT_LT(error_of(fogged(*gl(), shadowed, {{"shadow", fence()}}), with), 1e-3);
    }
}

TEST(Shadows, AreNoneWhereMapsShowNothing)
{
    const Picture without = fogged(cpu(), scene_with(Json::array({lamp(false)})));
    for (float value : {0.0f, -1.0f, 1e10f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()})
        EXPECT_EQ(fogged(cpu(), scene_with(Json::array({lamp(true)})), {{"shadow", Picture(7, 5, 1, value)}}).data,
                  without.data)
            << value;
}

TEST(Shadows, AgreeWithTheReference)
{
    const Json reference = scene_with(Json::array({lamp(true)}), {{"tier", "reference"}});
    const Picture exact = fogged(cpu(), reference, {{"shadow", fence()}});
    EXPECT_LT(error_of(fogged(cpu(), scene_with(Json::array({lamp(true)})), {{"shadow", fence()}}), exact), 5e-3);
}

TEST(Shadows, SayWhatIsMissing)
{
    const Json one = scene_with(Json::array({lamp(true)}));
    expect_refusal(one, {}, BRUME_ERROR_SCENE, "lights[0].shadow.file: lamp.exr");
    expect_refusal(scene_with(Json::array({lamp(true), lamp(true)})), {{"shadow", fence()}}, BRUME_ERROR_ARGUMENT,
                   "light 1 is missing");
    expect_refusal(scene_with(Json::array({lamp(false), lamp(true)})), {{"shadow", fence()}}, BRUME_ERROR_ARGUMENT,
                   "light 0 is given");
    expect_refusal(scene_with(Json(5, lamp(true))), {{"shadow", fence()}}, BRUME_ERROR_UNSUPPORTED, "expected at most 4");
    expect_refusal(scene_with(Json::array({lamp(true)}), {{"tier", "fogshop"}}), {{"shadow", fence()}},
                   BRUME_ERROR_UNSUPPORTED, "tier: fogshop");
}

// A march of 400 steps through the same map has relMSE .0033.
TEST(Shadows, OfSlatsAreThoseOfPathTracing)
{
    const std::filesystem::path folder = std::filesystem::path(BRUME_SHARED_DIR) / "truth";
    if (std::string(BRUME_SHARED_DIR).empty() || !std::filesystem::exists(folder))
        GTEST_SKIP() << "no path-traced scenes here";
    const Json description = Json::parse(std::ifstream(folder / "slats_s1.json"));
    Json scene{{"brume", 1},
               {"camera",
                {{"horizontal_fov", description["camera"]["horizontal_fov_degrees"]},
                 {"camera_to_world", description["camera"]["camera_to_world"]}}},
               {"medium", description["medium"]},
               {"lights", description["lights"]},
               {"effects", {{"airlight", Json::object()}}}};
    scene["medium"].erase("orders");
    const std::string clear = folder / "slats_clear.exr";
    const Picture color = read_exr(clear, {"R", "G", "B", "A"}), depth = read_exr(clear, {"Z"}),
                  truth = read_exr(folder / "slats_s1.exr", {"R", "G", "B"});
    Options options;
    options.inputs["shadow"] = read_exr(folder / "slats_shadow.exr", {"Z"});
    for (const char *where : backend_names) {
        brume_context context = std::string(where) == "gl" ? brume_context(*gl()) : brume_context(cpu());
        const Picture got = run(context, scene.dump(), color, depth, options).output;
        double energy = 0, expected = 0;
        for (int i = 0; i < got.width * got.height; ++i)
            for (int c = 0; c < 3; ++c) {
                energy += got.data[size_t(got.channels * i + c)];
                expected += truth.data[size_t(3 * i + c)];
            }
        Picture rgb(got.width, got.height, 3);
        for (int i = 0; i < got.width * got.height; ++i)
            std::copy_n(&got.data[size_t(got.channels * i)], 3, &rgb.data[size_t(3 * i)]);
        printf("slats on %s: relMSE %.4f, energy %.3f\n", where, rel_mse(rgb, truth), energy / expected);
        EXPECT_LT(rel_mse(rgb, truth), 0.01) << where;
        // A march of 400 steps through the same map has 1.05: what is left is not the intervals'.
        EXPECT_NEAR(energy / expected, 1, 0.05) << where;
    }
}
