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

// With a map for each light.
Picture fogged_by(brume_context context, const Json &scene, const std::vector<Picture> &maps)
{
    Options options;
    options.inputs_of_lights["shadow"] = maps;
    return run(context, scene.dump(), Picture(width, height, 4, 0), Picture(width, height, 1, 12), options).output;
}

Json first(const Json &lights, size_t count)
{
    Json some = Json::array();
    for (size_t l = 0; l < count; ++l)
        some.push_back(lights[l]);
    return some;
}

// Each by its own map: of other sizes, and side by side in one image.
TEST(Shadows, OfManyLightsAreThoseOfEach)
{
    Json lights = Json::array();
    std::vector<Picture> maps, alone;
    for (int l = 0; l < 24; ++l) {
        Json light = lamp(true);
        light["position"][0] = 0.2 * l - 2;
        light["shadow"]["camera_to_world"][0][3] = 0.2 * l - 2;
        lights.push_back(light);
        Picture map(5 + 7 * l, 40 - l, 1, 1.5f);
        for (int y = 0; y < map.height; ++y)
            for (int x = 0; x < map.width; ++x)
                if ((x * 9 / map.width + l) % 3)
                    *map.at(x, y) = std::numeric_limits<float>::infinity();
        alone.push_back(fogged(cpu(), scene_with(Json::array({light})), {{"shadow", map}}));
        maps.push_back(map);
    }
    for (const auto &[tier, count] : {std::pair("nodes", size_t(24)), std::pair("reference", size_t(2))}) {
        const Json scene = scene_with(first(lights, count), {{"tier", tier}});
        const std::vector<Picture> some(maps.begin(), maps.begin() + std::ptrdiff_t(count));
        const Picture together = fogged_by(cpu(), scene, some);
        Picture sum = alone[0];
        for (size_t l = 1; l < count; ++l)
            for (size_t i = 0; i < sum.data.size(); ++i)
                sum.data[i] += alone[l].data[i];
        EXPECT_LT(error_of(together, sum), 5e-3) << tier;
        if (gl() && count == lights.size()) {
            EXPECT_LT(error_of(fogged_by(*gl(), scene, some), together), 1e-3);
        }
    }
}

// All around a point, by both kinds of gather.
TEST(Shadows, OfPointsFallAllAroundAlikeOnAllBackends)
{
    Json light{{"type", "point"}, {"position", {0, 0.5, -8}}, {"intensity", 100}};
    const Picture without = fogged(cpu(), scene_with(Json::array({light})));
    light["shadow"] = {{"file", "lamp.exr"},
                       {"projection", "latlong"},
                       {"camera_to_world", {{-1, 0, 0, 0}, {0, 1, 0, 0.5}, {0, 0, -1, -8}, {0, 0, 0, 1}}}};
    Picture map(96, 48, 1, std::numeric_limits<float>::infinity());
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x)
            if (x / 4 % 2 && y > 12)
                *map.at(x, y) = 1.5f;
    Json puffs = scene_with(Json::array({light}), {{"tier", "maps"}});
    puffs["medium"]["density"] = {{{"type", "constant"}, {"value", 1}},
                                  {{"type", "gaussian"}, {"center", {0, 0, -7}}, {"scale", 0.7}, {"amplitude", 3}}};
    for (const Json &scene : {scene_with(Json::array({light})), puffs}) {
        const Picture with = fogged(cpu(), scene, {{"shadow", map}});
        if (scene != puffs) {
            EXPECT_LT(sum(with), 0.85 * sum(without));
            EXPECT_GT(sum(with), 0.3 * sum(without));
        }
        if (gl()) {
            EXPECT_LT(error_of(fogged(*gl(), scene, {{"shadow", map}}), with), 1e-3);
        }
    }
}

// Of near and far planes, reversed, and without an end; suns' are linear.
TEST(Shadows, DepthBuffersAreMapsToo)
{
    struct Case {
        double near, far;  // far 0: none
        bool reversed;
    };
    Json sun{{"type", "directional"}, {"direction", {0, 0, 1}}, {"intensity", 20}};
    sun["shadow"] = lamp(true)["shadow"];
    sun["shadow"].erase("vertical_fov");
    sun["shadow"]["orthographic_width"] = 4;
    Json outdoors = scene_with(Json::array({sun}));
    outdoors["medium"]["density"] = {{{"type", "gaussian"}, {"center", {0, 0, -5}}, {"scale", 0.4}, {"amplitude", 3}}};
    for (const Json &planar : {scene_with(Json::array({lamp(true)})), outdoors})
        for (const Case &c : {Case{0.5, 40, false}, Case{0.5, 40, true}, Case{0.25, 0, false}, Case{0.25, 0, true}}) {
            const bool parallel = planar == outdoors;
            if (parallel && c.far == 0)
                continue;
            Picture map = fence();
            const double first = parallel ? c.near : 1 / c.near, last = parallel ? c.far : c.far ? 1 / c.far : 0;
            for (float &z : map.data) {
                const double value = parallel ? z : 1 / z;
                const double stored = std::isinf(z) ? 1 : (value - first) / (last - first);
                z = float(c.reversed ? 1 - stored : stored);
            }
            Json device = planar;
            Json &shadow = device["lights"][0]["shadow"];
            shadow["depth"] = "device";
            shadow["near"] = c.near;
            if (c.far)
                shadow["far"] = c.far;
            shadow["reversed"] = c.reversed;
            const Picture expected = fogged(cpu(), planar, {{"shadow", fence()}});
            EXPECT_LT(error_of(fogged(cpu(), device, {{"shadow", map}}), expected), 1e-3);
            if (gl()) {
                EXPECT_LT(error_of(fogged(*gl(), device, {{"shadow", map}}), expected), 1e-3);
            }
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
    expect_refusal(scene_with(Json::array({lamp(true)}), {{"tier", "fogshop"}}), {{"shadow", fence()}},
                   BRUME_ERROR_UNSUPPORTED, "method: fogshop");
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
    auto energy = [](const Picture &p) {
        double sum = 0;
        for (int i = 0; i < p.width * p.height; ++i)
            for (int c = 0; c < 3; ++c)
                sum += p.data[size_t(p.channels * i + c)];
        return sum;
    };
    auto shadowed_by = [&](brume_context context, const char *what) {
        Json changed = scene;
        Options options;
        if (what == std::string("map"))
            options.inputs["shadow"] = read_exr(folder / "slats_shadow.exr", {"Z"});
        else if (what == std::string("screen"))
            changed["lights"][0]["shadow"] = "screen";
        else
            changed["lights"][0].erase("shadow");
        const Picture got = run(context, changed.dump(), color, depth, options).output;
        Picture rgb(got.width, got.height, 3);
        for (int i = 0; i < got.width * got.height; ++i)
            std::copy_n(&got.data[size_t(got.channels * i)], 3, &rgb.data[size_t(3 * i)]);
        printf("slats, shadows by %s: relMSE %.4f, energy %.3f\n", what, rel_mse(rgb, truth), energy(rgb) / energy(truth));
        return rgb;
    };
    EXPECT_GT(rel_mse(shadowed_by(cpu(), "nothing"), truth), 0.5);
    for (const char *where : backend_names) {
        const bool on_gl = where == std::string("gl");
        ASSERT_TRUE(!on_gl || gl()) << "no GL backend";
        brume_context context = on_gl ? *gl() : cpu();
        const Picture by_map = shadowed_by(context, "map");
        EXPECT_LT(rel_mse(by_map, truth), 0.01) << where;
        // A march of 400 steps through the same map has 1.05: what is left is not the intervals'.
        EXPECT_NEAR(energy(by_map) / energy(truth), 1, 0.05) << where;
        const Picture by_screen = shadowed_by(context, "screen");
        EXPECT_LT(rel_mse(by_screen, truth), 0.02) << where;
    }
}
