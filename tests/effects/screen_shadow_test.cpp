// Shadows by what the picture shows, through the C ABI: against a map of the same things, and where the picture shows
// nothing of them.
#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "fog.h"
#include "picture_metrics.h"

using namespace fog;
using Json = nlohmann::ordered_json;

namespace {

constexpr int width = 144, height = 96;
constexpr double tangent = 0.46630766;  // of half the field of view, 50 degrees

// A spot 8 m ahead that shines toward the camera from (0, y, -8).
Json lamp(double y = 0.5)
{
    return {{"type", "spot"}, {"position", {0, y, -8}}, {"direction", {0, 0, 1}}, {"intensity", 100}, {"angle", 60}};
}

Json scene_with(const Json &lights)
{
    return {
        {"brume", 1},
        {"camera", {{"vertical_fov", 50}, {"camera_to_world", {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}}}},
        {"medium", {{"scattering", 0.05}, {"g", 0.3}}},
        {"lights", lights},
        {"effects", {{"airlight", Json::object()}}}};
}

// A fence 1.5 m before the lamp: slats half a metre apart.
bool is_slat(double x, double y)
{
    const double place = (x + 20.25) / 0.5;
    return place - std::floor(place) < 0.5 && std::abs(y - 0.5) < 0.8 && std::abs(x) < 1.4;
}

Picture seen_by_camera(bool fence)
{
    Picture depth(width, height, 1, 12);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double per_pixel = 6.5 * tangent * 2 / height;
            if (fence && is_slat((x + 0.5 - width / 2) * per_pixel, (height / 2 - y - 0.5) * per_pixel))
                *depth.at(x, y) = 6.5;
        }
    return depth;
}

Picture seen_by_lamp()
{
    Picture map(256, 256, 1, std::numeric_limits<float>::infinity());
    for (int y = 0; y < 256; ++y)
        for (int x = 0; x < 256; ++x) {
            const double per_texel = 1.5 * std::tan(M_PI / 6) * 2 / 256;
            if (is_slat(-(x + 0.5 - 128) * per_texel, 0.5 + (128 - y - 0.5) * per_texel))
                *map.at(x, y) = 1.5f;
        }
    return map;
}

Picture fogged(brume_context context, const Json &light, const Picture &depth, const Options &options = {})
{
    return run(context, scene_with(Json::array({light})).dump(), Picture(width, height, 4, 0), depth, options).output;
}

Json by_screen(Json light)
{
    light["shadow"] = "screen";
    return light;
}

}  // namespace

TEST(ScreenShadows, AreThoseOfAMapOfWhatThePictureShows)
{
    Json mapped = lamp();
    mapped["shadow"] = {{"file", "lamp.exr"},
                        {"vertical_fov", 60},
                        {"camera_to_world", {{-1, 0, 0, 0}, {0, 1, 0, 0.5}, {0, 0, -1, -8}, {0, 0, 0, 1}}}};
    Options options;
    options.inputs["shadow"] = seen_by_lamp();
    const Picture depth = seen_by_camera(true), map = fogged(cpu(), mapped, depth, options),
                  none = fogged(cpu(), lamp(), depth), screen = fogged(cpu(), by_screen(lamp()), depth);
    printf("error without shadows %.3f, by the picture %.3f\n", error_of(none, map), error_of(screen, map));
    EXPECT_GT(error_of(none, map), 0.3);
    EXPECT_LT(error_of(screen, map), 0.25 * error_of(none, map));
    if (gl()) {
        EXPECT_LT(error_of(fogged(*gl(), by_screen(lamp()), depth), screen), 5e-3);
    }
    // All around, upside down.
    Json point = by_screen({{"type", "point"}, {"position", {0, 0.5, -8}}, {"intensity", 100}});
    const Picture around = fogged(cpu(), point, depth);
    options.inputs.clear();
    options.origin = BRUME_ORIGIN_BOTTOM_LEFT;
    Picture turned = depth;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            *turned.at(x, y) = *depth.at(x, height - 1 - y);
    const Picture flipped = fogged(cpu(), point, turned, options);
    Picture back = flipped;
    for (int y = 0; y < height; ++y)
        std::copy_n(flipped.at(0, height - 1 - y), 4 * width, back.at(0, y));
    EXPECT_LT(error_of(back, around), 0.02);
    if (gl()) {
        EXPECT_LT(error_of(fogged(*gl(), point, depth), around), 5e-3);
    }
    point.erase("shadow");
    EXPECT_GT(error_of(around, fogged(cpu(), point, depth)), 0.05);
}

// What is out of the picture, or nothing, throws none; nor does what shows the lamp itself.
TEST(ScreenShadows, AreNoneOfWhatThePictureDoesNotShow)
{
    const Picture wall = seen_by_camera(false);
    EXPECT_LT(error_of(fogged(cpu(), by_screen(lamp()), wall), fogged(cpu(), lamp(), wall)), 1e-3);
    const Picture sky(width, height, 1, std::numeric_limits<float>::infinity());
    Options clamped;
    clamped.format = [](brume_format &format) {
        format.sky = BRUME_SKY_CLAMP;
        format.sky_distance = 30;
    };
    EXPECT_LT(error_of(fogged(cpu(), by_screen(lamp()), sky, clamped), fogged(cpu(), lamp(), sky, clamped)), 1e-6);
    Json bulb = lamp(0);
    bulb["radius"] = 0.2;
    Picture globe = wall;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            if (std::hypot(x + 0.5 - width / 2, y + 0.5 - height / 2) * 8 * tangent * 2 / height < 0.2)
                *globe.at(x, y) = 7.8f;
    EXPECT_LT(error_of(fogged(cpu(), by_screen(bulb), globe), fogged(cpu(), bulb, globe)), 1e-3);
}

TEST(ScreenShadows, TakeNoMap)
{
    Options options;
    options.inputs["shadow"] = Picture(4, 4, 1, 1);
    try {
        fogged(cpu(), by_screen(lamp()), seen_by_camera(true), options);
        ADD_FAILURE() << "not refused";
    } catch (const Failure &failure) {
        EXPECT_EQ(failure.status, BRUME_ERROR_ARGUMENT);
        EXPECT_NE(std::string(failure.what()).find("layer shadow of light 0 is given; expected none"), std::string::npos)
            << failure.what();
    }
}
