#include "plan/host_products.h"

#include <algorithm>
#include <cstring>
#include <string>

#include <fmt/format.h>

#include "plan/density_rows.h"
#include "base/error.h"
#include "plan/plan.h"
#include "plan/services.h"
#include "effects/shader_text.h"

namespace brume {
namespace {

// Mesa's software GL ends all loops of a shader's invocation after 65,535 turns and goes on with what it has by then.
constexpr float most_on_llvmpipe = 500;

constexpr brume_slot gaussian_slots[] = {{"depth", BRUME_ACCESS_FETCH, 0},
                                         {"gaussians", BRUME_ACCESS_FETCH, 0},
                                         {"tiles", BRUME_ACCESS_FETCH, 0},
                                         {"tile_gaussians", BRUME_ACCESS_FETCH, 0},
                                         {"density", BRUME_ACCESS_WRITE, 0}};
constexpr brume_slot density_slots[] = {{"depth", BRUME_ACCESS_FETCH, 0},
                                        {"gaussian_density", BRUME_ACCESS_FETCH, 0},
                                        {"layer", BRUME_ACCESS_FETCH, 0},
                                        {"density", BRUME_ACCESS_WRITE, 0},
                                        {"density_rgb", BRUME_ACCESS_WRITE, 0}};

template <size_t N>
brume_pass make_pass(brume_host_t &host, const char *name, const char *file, const std::string &defines,
                     const brume_slot (&slots)[N], brume_rows_function rows)
{
    const std::string source(shader_text(file));
    brume_pass_desc desc{};
    desc.struct_size = sizeof desc;
    desc.name = name;
    desc.slots = slots;
    desc.slot_count = N;
    desc.source = source.c_str();
    desc.source_name = file;
    desc.defines = defines.c_str();
    desc.rows = rows;
    desc.grain = 8;
    return host.create_pass(desc);
}

void run(brume_host_t &host, brume_pass pass, const brume_plugin_image *images, int32_t width, int32_t height)
{
    if (const brume_status status = host.run(pass, images, nullptr, width, height, nullptr))
        throw Error(status, "a pass of the host failed");
}

}  // namespace

bool HostProducts::makes(std::string_view product)
{
    for (const char *name : {"density", "density_rgb", "gaussian_density", "gaussians", "light_gaussians",
                             "camera_gaussians", "lights", "light_shadows", "visible_lights"})
        if (product == name)
            return true;
    return false;
}

void HostProducts::plan(brume_host_t &host, const std::vector<std::string> &uses, const brume_plugin_scene &scene,
                        const FrameLayers &layers, int32_t width, int32_t height)
{
    auto used = [&](const char *name) { return std::find(uses.begin(), uses.end(), name) != uses.end(); };
    width_ = width;
    height_ = height;
    lights_ = used("lights");
    visible_lights_ = used("visible_lights");
    camera_gaussians_ = used("camera_gaussians");
    light_gaussians_ = camera_gaussians_ || used("light_gaussians");
    if (used("light_shadows"))
        shadow_maps_.plan(host, scene, layers);
    layer_ = layers.has_input("optical_depth") ? 1 : layers.has_input("transmittance") ? 2 : 0;
    const bool gaussians =
        scene.gaussian_count > 0 && (used("gaussians") || used("gaussian_density") || (used("density") && !layer_));
    const double pixels = double(width) * height;
    if (gaussians) {
        gaussian_density_ = host.create_image("density of Gaussians", width, height, 2);
        double length = 1;
        if (scene.gaussians) {
            const TileEstimate estimate = estimate_tiles(scene, width, height);
            length = estimate.length;
            if (estimate.seen < scene.gaussian_count) {
                const std::string reason = fmt::format(
                    "{} of {} Gaussians outside the frustum of the planned view: its rays skip them, those of lights do not",
                    scene.gaussian_count - estimate.seen, scene.gaussian_count);
                host.add_entry({sizeof(brume_plugin_entry), 0, "gaussians", reason.c_str(), 0, 0, 0, 0});
            }
        }
        // The CPU goes through lists by rows of pixels.
        const double of_pixel = host.backend_kind() == BRUME_BACKEND_CPU ? 80 + 8 * length : 10 + 40 * length;
        host.add_entry({sizeof(brume_plugin_entry), 1, "gaussians", "density of the Gaussians along each pixel's ray",
                        uint64_t(pixels * (4 + 8)), uint64_t(pixels * of_pixel), 0, 0});
        gaussian_pass_ = make_pass(host, "gaussians", "gaussian_density.comp", "", gaussian_slots, gaussian_density_rows());
    }
    if (!used("density"))
        return;
    density_ = host.create_image("density", width, height, 2);
    if (layer_)
        density_rgb_ = host.create_image("density of each colour", width, height, 4);
    host.add_entry({sizeof(brume_plugin_entry), 1, "density",
                    layer_ == 0   ? "the medium's density along each pixel's ray"
                    : layer_ == 1 ? "the layer optical_depth in place of the scene's density"
                                  : "the layer transmittance in place of the scene's density",
                    uint64_t(pixels * (4 + 8 + (layer_ ? 32 : 0))),
                    uint64_t(pixels * (3 + 3 * scene.medium->term_count + (layer_ ? 20 : 0))), 0, 0});
    density_pass_ = make_pass(host, "density", "density.comp", fmt::format("#define LAYER {}\n", layer_), density_slots,
                              layer_ == 0   ? density_rows()
                              : layer_ == 1 ? layer_density_rows<1>
                                            : layer_density_rows<2>);
}

void HostProducts::upload_gaussians(brume_host_t &host, const brume_plugin_scene &scene)
{
    build_tiles(scene, width_, height_, lists_);
    gaussians_ = host.upload(upload_of_gaussians, 4, scene.gaussian_count ? scene.gaussians[0].center : nullptr,
                             uint64_t(scene.gaussian_count) * 2);
    tiles_ = host.upload(upload_of_tiles, 4, lists_.ranges.data(), lists_.ranges.size() / 4);
    tile_gaussians_ = host.upload(upload_of_tile_gaussians, 1, lists_.indices.data(), lists_.indices.size());
    const brume_plugin_image images[] = {gaussians_, tiles_, tile_gaussians_};
    host.publish("gaussians", images, 3, scene.gaussian_count, uploads_);
    host.publish("gaussian_density", &gaussian_density_, 1, 0, uploads_);
    if (longest_list() > most_on_llvmpipe)
        host.warn_on_software_gl(
            fmt::format("medium.density: {} Gaussians lie behind one tile; llvmpipe may end loops over so many "
                        "early and leave lights dark, the CPU backend does not",
                        int(longest_list())));
}

// moved: not the camera alone.
void HostProducts::upload_light_gaussians(brume_host_t &host, const brume_plugin_scene &scene, bool moved)
{
    directions_.refresh(scene, moved, camera_gaussians_);
    const brume_plugin_image image =
        host.upload(upload_of_light_gaussians, 4, directions_.texels.data(), directions_.texels.size() / 4);
    for (const char *name : {"light_gaussians", "camera_gaussians"})
        host.publish(name, &image, 1, scene.light_count, uploads_);
}

void HostProducts::upload_lights(brume_host_t &host, const brume_plugin_scene &scene)
{
    std::vector<float> &texels = texels_;
    texels.resize(size_t(scene.light_count) * 16);
    for (uint32_t i = 0; i < scene.light_count; ++i)
        std::copy_n(scene.lights[i].position, 16, &texels[16 * i]);
    const brume_plugin_image image =
        texels.empty() ? nullptr : host.upload(upload_of_lights, 4, texels.data(), texels.size() / 4);
    host.publish("lights", &image, image ? 1 : 0, scene.light_count, uploads_);
}

void HostProducts::upload_visible_lights(brume_host_t &host, const brume_plugin_scene &scene)
{
    std::vector<float> &spheres = spheres_;
    spheres.clear();
    for (uint32_t i = 0; i < scene.light_count; ++i)
        if (const brume_plugin_light &light = scene.lights[i]; light.radius > 0)
            spheres.insert(spheres.end(), {light.position[0], light.position[1], light.position[2], light.radius});
    const brume_plugin_image image =
        spheres.empty() ? nullptr : host.upload(upload_of_visible_lights, 4, spheres.data(), spheres.size() / 4);
    host.publish("visible_lights", &image, image ? 1 : 0, uint32_t(spheres.size() / 4), uploads_);
}

void HostProducts::upload(brume_host_t &host, const brume_plugin_scene &scene)
{
    const bool moved = !uploaded_ || revision_ != scene.revision ||
                       std::memcmp(&camera_, scene.camera, sizeof camera_) != 0 ||
                       std::memcmp(position_, scene.position, sizeof position_) != 0;
    if (!moved)
        return;
    const bool scene_moved = !uploaded_ || revision_ != scene.revision;
    uploaded_ = false;  // should one of these throw
    ++uploads_;
    if (lights_)
        upload_lights(host, scene);
    if (visible_lights_)
        upload_visible_lights(host, scene);
    if (gaussian_density_)
        upload_gaussians(host, scene);
    if (light_gaussians_)
        upload_light_gaussians(host, scene, scene_moved);
    revision_ = scene.revision;
    camera_ = *scene.camera;
    std::memcpy(position_, scene.position, sizeof position_);
    uploaded_ = true;
}

void HostProducts::execute(brume_host_t &host, const brume_plugin_scene &scene, brume_plugin_image depth,
                           const FrameLayers &layers)
{
    upload(host, scene);
    shadow_maps_.execute(host, scene, depth, layers);
    if (gaussian_density_) {
        const brume_plugin_image images[] = {depth, gaussians_, tiles_, tile_gaussians_, gaussian_density_};
        run(host, gaussian_pass_, images, width_, height_);
    }
    if (density_) {
        const brume_plugin_image layer =
            layer_ == 0 ? nullptr : layers.input(layer_ == 1 ? "optical_depth" : "transmittance");
        const brume_plugin_image images[] = {depth, layer_ ? nullptr : gaussian_density_, layer, density_, density_rgb_};
        run(host, density_pass_, images, width_, height_);
        host.publish("density", &density_, 1, 0, uploads_);
        if (density_rgb_)
            host.publish("density_rgb", &density_rgb_, 1, 0, uploads_);
    }
}

float HostProducts::longest_list() const
{
    float most = 0;
    for (size_t i = 1; i < lists_.ranges.size(); i += 4)
        most = std::max(most, lists_.ranges[i]);
    return most;
}

}  // namespace brume
