#include "plan/shadow_maps.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "base/error.h"
#include "effects/shader_text.h"
#include "plan/host_products.h"
#include "plan/plan.h"
#include "scene_maths.hpp"

namespace brume {

namespace screen_formulas {
using namespace maths_float;
using maths_float::Camera;  // the scene has one, too
using real = float;
#include "formulas_begin.hpp"
#include "lib/shadow_screen.glsl"
#include "formulas_end.hpp"
}  // namespace screen_formulas

namespace {

constexpr size_t texels_of_light = 5;
constexpr double expected_texels = 1024 * 1024;  // of a map, whose size frames decide
constexpr int32_t screen_side = 512;             // of a map by the picture's depth; one all around is twice as wide

struct MapConstants {
    maths_float::ShadowDepth depth;
    maths_float::ivec2 corner;
};

constexpr brume_slot map_slots[] = {{"map", BRUME_ACCESS_FETCH, 0}, {"shadow_maps", BRUME_ACCESS_WRITE, 0}};
constexpr brume_constant map_constants[] = {
    {"depth.kind", BRUME_CONSTANT_INT, 1, 1, offsetof(MapConstants, depth.kind)},
    {"depth.unit", BRUME_CONSTANT_FLOAT, 1, 1, offsetof(MapConstants, depth.unit)},
    {"depth.range", BRUME_CONSTANT_FLOAT, 2, 1, offsetof(MapConstants, depth.range)},
    {"corner", BRUME_CONSTANT_INT, 2, 1, offsetof(MapConstants, corner)},
};

brume_status copy_rows(const brume_plugin_rows *call, int32_t first, int32_t last)
{
    const MapConstants &to = *static_cast<const MapConstants *>(call->constants);
    const brume_plugin_pixels &map = call->slots[0], &all = call->slots[1];
    for (int32_t y = first; y < last; ++y) {
        const float *from = map.data + y * map.row_stride;
        float *row = all.data + (to.corner.y + y) * all.row_stride + to.corner.x;
        for (int32_t x = 0; x < call->width; ++x)
            row[x] = maths_float::shadow_distance(to.depth, from[int64_t(x) * map.channels]);
    }
    return BRUME_OK;
}

struct ScreenConstants {
    int32_t light;
    float radius;
    maths_float::ivec2 corner;
};

constexpr brume_slot screen_slots[] = {
    {"depth", BRUME_ACCESS_FETCH, 0}, {"light_shadows", BRUME_ACCESS_FETCH, 0}, {"shadow_maps", BRUME_ACCESS_WRITE, 0}};
constexpr brume_constant screen_constants[] = {
    {"light", BRUME_CONSTANT_INT, 1, 1, offsetof(ScreenConstants, light)},
    {"radius", BRUME_CONSTANT_FLOAT, 1, 1, offsetof(ScreenConstants, radius)},
    {"corner", BRUME_CONSTANT_INT, 2, 1, offsetof(ScreenConstants, corner)},
};

brume_status screen_rows(const brume_plugin_rows *call, int32_t first, int32_t last)
{
    using maths_float::texture_of;
    const ScreenConstants &of = *static_cast<const ScreenConstants *>(call->constants);
    const maths_float::Camera camera = maths_float::camera_of(*call->scene);
    const brume_plugin_pixels &all = call->slots[2];
    for (int32_t y = first; y < last; ++y) {
        float *row = all.data + (of.corner.y + y) * all.row_stride + of.corner.x;
        for (int32_t x = 0; x < call->width; ++x)
            row[x] = screen_formulas::screen_shadow(camera, texture_of(call->slots[0]), texture_of(call->slots[1]), of.light,
                                                    of.radius, maths_float::ivec2(x, y));
    }
    return BRUME_OK;
}

bool has_map(const brume_plugin_light &light)
{
    return light.shadow_kind > 0;
}

bool is_of_screen(const brume_plugin_light &light)
{
    return has_map(light) && light.shadow_screen > 0;
}

template <size_t Slots, size_t Values>
brume_pass make_pass(brume_host_t &host, const char *file, const brume_slot (&slots)[Slots],
                     const brume_constant (&constants)[Values], size_t size, brume_rows_function rows, int32_t grain)
{
    const std::string source(shader_text(file));
    brume_pass_desc desc{};
    desc.struct_size = sizeof desc;
    desc.name = "shadows";
    desc.slots = slots;
    desc.slot_count = Slots;
    desc.constants = constants;
    desc.constant_count = Values;
    desc.constant_size = uint32_t(size);
    desc.source = source.c_str();
    desc.source_name = file;
    desc.rows = rows;
    desc.grain = grain;
    return host.create_pass(desc);
}

}  // namespace

Rectangle pack(std::vector<Rectangle> &rectangles, int32_t largest)
{
    // Kept from frame to frame, which allocate nothing once warm.
    thread_local std::vector<size_t> order;
    order.resize(rectangles.size());
    std::iota(order.begin(), order.end(), size_t(0));
    std::sort(order.begin(), order.end(), [&](size_t a, size_t b) {
        return rectangles[a].height != rectangles[b].height ? rectangles[a].height > rectangles[b].height : a < b;
    });
    double area = 0;
    int32_t widest = 1;
    for (const Rectangle &r : rectangles) {
        area += double(r.width) * r.height;
        widest = std::max(widest, r.width);
    }
    Rectangle all;
    // Shelves of about a square waste little; where their heights add up to too much, wider ones may fit.
    for (int64_t side = std::min<int64_t>(largest, std::max<int64_t>(widest, int64_t(std::ceil(std::sqrt(area)))));;
         side = std::min<int64_t>(2 * side, largest)) {
        int64_t x = 0, y = 0, shelf = 0, right = 1;
        for (size_t i : order) {
            Rectangle &r = rectangles[i];
            if (x + r.width > side) {
                y += shelf;
                x = shelf = 0;
            }
            r.x = int32_t(x);
            r.y = int32_t(std::min<int64_t>(y, INT32_MAX));
            x += r.width;
            right = std::max(right, x);
            shelf = std::max<int64_t>(shelf, r.height);
        }
        all.width = int32_t(right);
        all.height = int32_t(std::clamp<int64_t>(y + shelf, 1, INT32_MAX));
        if (all.height <= largest || side >= largest)
            return all;
    }
}

void ShadowMaps::plan(brume_host_t &host, const brume_plugin_scene &scene, const FrameLayers &layers)
{
    brought_ = layers.has_input("shadow");
    const auto made = std::count_if(scene.lights, scene.lights + scene.light_count, is_of_screen);
    const auto all = std::count_if(scene.lights, scene.lights + scene.light_count, has_map);
    const auto copied = brought_ ? all - made : 0;
    if (made + copied == 0)
        return;
    std::string reason = copied ? fmt::format("the maps of {} lights, in one image", copied) : "";
    if (made)
        reason += fmt::format("{}maps of {} lights by the picture's depth", copied ? "; " : "", made);
    const double texels = double(copied) * expected_texels, marched = double(made) * screen_side * screen_side;
    host.add_entry({sizeof(brume_plugin_entry), 1, "shadows", reason.c_str(), uint64_t(texels * 8 + marched * 4),
                    uint64_t(texels * 2 + marched * 5000), 0, 0});
    if (copied)
        copy_pass_ = make_pass(host, "shadow_maps.comp", map_slots, map_constants, sizeof(MapConstants), copy_rows, 64);
    if (made)
        screen_pass_ =
            make_pass(host, "shadow_screen.comp", screen_slots, screen_constants, sizeof(ScreenConstants), screen_rows, 4);
}

void ShadowMaps::take(const brume_plugin_scene &scene, const brume_plugin_image *brought)
{
    maps_.clear();
    for (uint32_t l = 0; l < scene.light_count; ++l) {
        const bool screen = is_of_screen(scene.lights[l]), wanted = has_map(scene.lights[l]) && !screen,
                   there = brought && brought[l];
        if (brought_ && wanted != there)
            throw Error(BRUME_ERROR_ARGUMENT,
                        fmt::format("inputs: layer shadow of light {} is {}", l,
                                    wanted   ? "missing; expected one for each light that has a shadow_kind"
                                    : screen ? "given; expected none, since the light's shadow_kind is _SCREEN"
                                             : "given; expected shadow_kind of the light to say where it looks"));
        if (screen || there)
            maps_.push_back({l, there ? brought[l] : nullptr});
    }
}

void ShadowMaps::place(brume_host_t &host, const brume_plugin_scene &scene)
{
    rectangles_.clear();
    for (const Map &map : maps_) {
        const bool around = scene.lights[map.light].shadow_kind == float(BRUME_SHADOW_LATLONG);
        rectangles_.push_back(map.image ? Rectangle{0, 0, map.image->width, map.image->height}
                                        : Rectangle{0, 0, around ? 2 * screen_side : screen_side, screen_side});
    }
    const int32_t largest = host.largest_size();
    const Rectangle all = pack(rectangles_, largest);
    if (all.height > largest)
        throw Error(
            BRUME_ERROR_FORMAT,
            fmt::format("inputs: layer shadow: {} maps, side by side {} x {}; expected sides of at most {} on this device",
                        maps_.size(), all.width, all.height, largest));
    if (image_ && image_->width == all.width && image_->height == all.height)
        return;
    host.drop_image(image_);
    image_ = nullptr;
    image_ = host.create_image("shadow maps", all.width, all.height, 1);
}

void ShadowMaps::upload(brume_host_t &host, const brume_plugin_scene &scene)
{
    texels_.assign(size_t(scene.light_count) * 4 * texels_of_light, 0.0f);
    for (size_t i = 0; i < maps_.size(); ++i) {
        const brume_plugin_light &light = scene.lights[maps_[i].light];
        float *texels = &texels_[maps_[i].light * 4 * texels_of_light];
        std::copy_n(light.shadow_rows[0], 12, texels);
        texels[12] = light.shadow_kind;
        texels[13] = light.shadow_extent;
        texels[14] = light.shadow_depth == float(BRUME_DEPTH_RAY);
        const Rectangle &r = rectangles_[i];
        const int32_t rectangle[] = {r.x, r.y, r.width, r.height};
        std::copy_n(rectangle, 4, texels + 16);
    }
    table_ = host.upload(upload_of_light_shadows, 4, texels_.data(), texels_.size() / 4);
}

void ShadowMaps::run(brume_host_t &host, const brume_plugin_scene &scene, brume_plugin_image depth)
{
    for (size_t i = 0; i < maps_.size(); ++i) {
        const brume_plugin_light &light = scene.lights[maps_[i].light];
        const Rectangle &to = rectangles_[i];
        brume_status status;
        if (maps_[i].image) {
            // An orthographic map's device depth is linear.
            const bool linear =
                light.shadow_depth == float(BRUME_DEPTH_DEVICE) && light.shadow_kind == float(BRUME_SHADOW_ORTHOGRAPHIC);
            const MapConstants values{{linear ? int(BRUME_DEPTH_NORMALIZED) : int(light.shadow_depth),
                                       scene.camera->metres_per_unit,
                                       {light.shadow_range[0], light.shadow_range[1]}},
                                      {to.x, to.y}};
            const brume_plugin_image images[] = {maps_[i].image, image_};
            status = host.run(copy_pass_, images, &values, to.width, to.height, nullptr);
        } else {
            const ScreenConstants values{int32_t(maps_[i].light), light.radius, {to.x, to.y}};
            const brume_plugin_image images[] = {depth, table_, image_};
            status = host.run(screen_pass_, images, &values, to.width, to.height, nullptr);
        }
        if (status)
            throw Error(status, "a pass of the host failed");
    }
}

void ShadowMaps::execute(brume_host_t &host, const brume_plugin_scene &scene, brume_plugin_image depth,
                         const FrameLayers &layers)
{
    if (!copy_pass_ && !screen_pass_)
        return;
    take(scene, layers.inputs_of_lights("shadow"));
    place(host, scene);
    upload(host, scene);
    run(host, scene, depth);
    const brume_plugin_image images[] = {table_, image_};
    host.publish("light_shadows", images, 2, scene.light_count, ++revision_);
}

}  // namespace brume
