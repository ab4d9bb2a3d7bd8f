#include "core/scene_images.h"

#include <algorithm>
#include <cstring>
#include <string>

#include <fmt/format.h>

#include "core/error.h"
#include "core/plan.h"
#include "core/services.h"
#include "core/shader_text.h"
#include "scene_maths.hpp"

namespace brume {
namespace {

constexpr const char *pass_name = "gaussians";
// Mesa's software GL ends all loops of a shader's invocation after 65,535 turns and goes on with what it has by then.
constexpr float most_on_llvmpipe = 500;

enum Slot : uint32_t { slot_gaussians, slot_tiles, slot_tile_gaussians, slot_lights };

}  // namespace

void SceneImages::plan(brume_host_t &host, const brume_plugin_scene &scene, const brume_format &format, uint32_t backend)
{
    planned_ = true;
    width_ = format.width;
    height_ = format.height;
    if (scene.gaussian_count == 0)
        return;
    density_ = host.create_image(width_, height_, 2);
    double length = 1;
    if (scene.gaussians) {
        const TileEstimate estimate = estimate_tiles(scene, width_, height_);
        length = estimate.length;
        if (estimate.seen < scene.gaussian_count) {
            const std::string reason = fmt::format(
                "{} of {} Gaussians outside the frustum of the planned view: its rays skip them, those of lights do not",
                scene.gaussian_count - estimate.seen, scene.gaussian_count);
            host.add_entry({sizeof(brume_plugin_entry), 0, pass_name, reason.c_str(), 0, 0});
        }
    }
    const double pixels = double(width_) * height_;
    host.add_entry({sizeof(brume_plugin_entry), 1, pass_name, "density of the Gaussians along each pixel's ray",
                    uint64_t(pixels * (4 + 8)), uint64_t(pixels * (10 + 40 * length))});
    if (backend == BRUME_BACKEND_GL)
        program_ = host.compile(pass_name, std::string(shader_text("gaussian_density.comp")).c_str(), "");
}

brume_status SceneImages::execute(brume_host_t &host, brume_plugin_frame &frame)
{
    const brume_plugin_scene &scene = *frame.scene;
    const bool moved = !uploaded_ || revision_ != scene.revision || std::memcmp(&camera_, &scene.camera, sizeof camera_) != 0 ||
                       std::memcmp(position_, scene.position, sizeof position_) != 0;
    if (planned_ && moved) {
        if (scene.light_count)
            lights_ = host.upload(slot_lights, 4, scene.lights[0].position, uint64_t(scene.light_count) * 4);
        if (density_) {
            build_tiles(scene, width_, height_, lists_);
            gaussians_ = host.upload(slot_gaussians, 4, scene.gaussian_count ? scene.gaussians[0].center : nullptr,
                                     uint64_t(scene.gaussian_count) * 2);
            tiles_ = host.upload(slot_tiles, 4, lists_.ranges.data(), lists_.ranges.size() / 4);
            tile_gaussians_ = host.upload(slot_tile_gaussians, 1, lists_.indices.data(), lists_.indices.size());
            if (longest_list() > most_on_llvmpipe)
                host.warn_on_software_gl("medium.density: " + std::to_string(int(longest_list())) + " Gaussians lie behind one tile; " +
                                         "llvmpipe may end loops over so many early and leave lights dark, the CPU backend does not");
        }
        revision_ = scene.revision;
        camera_ = scene.camera;
        std::memcpy(position_, scene.position, sizeof position_);
        uploaded_ = true;
    }
    frame.lights = scene.light_count ? lights_ : nullptr;
    if (!density_)
        return BRUME_OK;
    frame.gaussian_density = density_;
    frame.gaussians = gaussians_;
    frame.tiles = tiles_;
    frame.tile_gaussians = tile_gaussians_;
    return program_ ? density_gl(host, frame) : density_cpu(host, frame);
}

float SceneImages::longest_list() const
{
    float most = 0;
    for (size_t i = 1; i < lists_.ranges.size(); i += 4)
        most = std::max(most, lists_.ranges[i]);
    return most;
}

brume_status SceneImages::density_gl(brume_host_t &host, const brume_plugin_frame &frame)
{
    const brume_plugin_binding bindings[] = {{"depth", frame.depth, BRUME_ACCESS_FETCH, 0},
                                             {"gaussians", gaussians_, BRUME_ACCESS_FETCH, 0},
                                             {"tiles", tiles_, BRUME_ACCESS_FETCH, 0},
                                             {"tile_gaussians", tile_gaussians_, BRUME_ACCESS_FETCH, 0},
                                             {"density", density_, BRUME_ACCESS_WRITE, 0}};
    brume_plugin_pass pass{};
    pass.struct_size = sizeof pass;
    pass.name = pass_name;
    pass.program = program_;
    pass.bindings = bindings;
    pass.binding_count = uint32_t(std::size(bindings));
    pass.width = width_;
    pass.height = height_;
    return services().run(&host, &pass);
}

brume_status SceneImages::density_cpu(brume_host_t &host, const brume_plugin_frame &frame)
{
    using namespace maths_float;
    struct Call {
        brume_plugin_pixels depth, density;
        Texture gaussians, tiles, tile_gaussians;
        maths_float::Medium medium;
        maths_float::Camera camera;
    } call{host.pixels(frame.depth), host.pixels(density_), texture_of(host.pixels(gaussians_)),
           texture_of(host.pixels(tiles_)), texture_of(host.pixels(tile_gaussians_)), medium_of(*frame.scene), camera_of(*frame.scene)};
    return services().rows(
        &host, pass_name, height_, 8,
        [](void *user, int32_t first, int32_t last) {
            const Call &c = *static_cast<const Call *>(user);
            for (int32_t y = first; y < last; ++y)
                for (int32_t x = 0; x < c.depth.width; ++x) {
                    const ivec2 pixel(x, y);
                    const vec2 moment =
                        tile_density(c.medium, c.camera, c.gaussians, c.tiles, c.tile_gaussians, c.depth.width, pixel,
                                     c.depth.data[y * c.depth.row_stride + x * c.depth.channels]);
                    float *to = c.density.data + y * c.density.row_stride + int64_t(x) * c.density.channels;
                    to[0] = moment.x;
                    to[1] = moment.y;
                }
            return brume_status(BRUME_OK);
        },
        &call);
}

}  // namespace brume
