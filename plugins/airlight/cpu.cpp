// The effect on the CPU: loops over rows around the functions of shaders/lib/airlight*.glsl.
#include <utility>

#include "common/pixels.hpp"
#include "passes.h"
#include "settings.h"

namespace airlight {
namespace {

using namespace brume::maths_float;
using namespace brume_pixels;

// All that the passes of one frame share.
class Frame {
public:
    Frame(const brume_services &services, brume_host host, const State &state, const brume_plugin_frame &frame)
        : services_(services), host_(host), state_(state), frame_(frame), medium_(medium_of(*frame.scene)),
          camera_(camera_of(*frame.scene)), settings_(settings_of(state, *frame.scene))
    {
    }

    brume_status map();
    // Into images of one texel per square of `reduction` pixels; error may have no data.
    brume_status gather(brume_plugin_image radiance, brume_plugin_image error, int reduction, ivec2 light_range);
    brume_status compose();

private:
    brume_status map(brume_plugin_image image, brume_plugin_pixels &out)
    {
        return image ? services_.pixels(host_, image, &out) : BRUME_OK;
    }
    vec3 at_pixel(const brume_plugin_pixels &image, ivec2 pixel, float distance) const
    {
        if (state_.parameters.reduction == 1)
            return vec3(load(image, pixel.x, pixel.y));
        return vec3(upsampled(texture_of(image), texture_of(distances_), state_.parameters.reduction,
                              ivec2(state_.width, state_.height), pixel, distance));
    }

    const brume_services &services_;
    brume_host host_;
    const State &state_;
    const brume_plugin_frame &frame_;
    Medium medium_;
    Camera camera_;
    AirlightSettings settings_;
    brume_plugin_pixels color_{}, depth_{}, output_{}, gaussian_density_{}, gaussians_{}, lights_{}, tiles_{},
        tile_gaussians_{}, origins_{}, cells_{}, cell_gaussians_{}, blob_density_{}, table_{}, environment_{}, radiance_{},
        error_{}, distances_{}, transmittance_{}, optical_depth_{}, airlight_{}, airlight_error_{};
};

brume_status Frame::map()
{
    const std::pair<brume_plugin_image, brume_plugin_pixels *> images[] = {
        {frame_.color, &color_},
        {frame_.depth, &depth_},
        {frame_.output, &output_},
        {frame_.gaussian_density, &gaussian_density_},
        {frame_.gaussians, &gaussians_},
        {frame_.lights, &lights_},
        {frame_.tiles, &tiles_},
        {frame_.tile_gaussians, &tile_gaussians_},
        {state_.origins, &origins_},
        {state_.cells, &cells_},
        {state_.cell_gaussians, &cell_gaussians_},
        {state_.blob_density, &blob_density_},
        {state_.table, &table_},
        {state_.environment, &environment_},
        {state_.radiance, &radiance_},
        {state_.error, &error_},
        {state_.distances, &distances_},
        {frame_.transmittance, &transmittance_},
        {frame_.optical_depth, &optical_depth_},
        {frame_.airlight, &airlight_},
        {frame_.airlight_error, &airlight_error_},
    };
    for (auto &[image, pixels] : images)
        if (brume_status s = map(image, *pixels))
            return s;
    return BRUME_OK;
}

brume_status Frame::gather(brume_plugin_image radiance_image, brume_plugin_image error_image, int reduction, ivec2 light_range)
{
    brume_plugin_pixels radiance{}, error{};
    if (brume_status s = map(radiance_image, radiance))
        return s;
    if (brume_status s = map(error_image, error))
        return s;
    const ivec2 size(state_.width, state_.height);
    const Texture depth = texture_of(depth_), gaussian_density = texture_of(gaussian_density_), tiles = texture_of(tiles_),
                  gaussians = texture_of(gaussians_), lights = texture_of(lights_),
                  tile_gaussians = texture_of(tile_gaussians_), cells = texture_of(cells_),
                  cell_gaussians = texture_of(cell_gaussians_), shadow_origins = texture_of(origins_),
                  blob_density = texture_of(blob_density_);
    return for_rows(services_, host_, "gather", radiance.height, 4, [&](int y) {
        for (int x = 0; x < radiance.width; ++x) {
            const ivec2 pixel = representative(ivec2(x, y), reduction, size);
            const Airlight a = airlight_at(medium_, camera_, settings_, AIRLIGHT_PIXEL_PASSED, pixel, size, light_range);
            store(radiance, x, y, vec4(a.radiance, 1.0f));
            if (error.data)
                store(error, x, y, vec4(a.error, 1.0f));
            if (reduction > 1)
                *at(distances_, x, y) = pixel_ray(camera_, pixel_centre(pixel.x, pixel.y), *at(depth_, pixel.x, pixel.y)).distance;
        }
    });
}

brume_status Frame::compose()
{
    const float limit = frame_.scene->output_limit;
    return for_rows(services_, host_, "compose", state_.height, 8, [&](int y) {
        for (int x = 0; x < state_.width; ++x) {
            const vec4 source = load(color_, x, y);
            const Ray ray = pixel_ray(camera_, pixel_centre(x, y), *at(depth_, x, y));
            const float density = density_to(medium_, ray, gaussian_density_.data ? *at(gaussian_density_, x, y) : 0.0f);
            const vec3 t = transmittance(medium_, density);
            const vec3 airlight = state_.lit && !ray.keep ? at_pixel(radiance_, ivec2(x, y), ray.distance) : vec3(0.0f);
            const vec3 result = state_.attenuates
                                    ? compose_radiance(vec3(source), t, airlight + emitted(medium_, density), limit)
                                    : compose_radiance(vec3(source), vec3(1.0f), airlight, limit);
            store(output_, x, y, vec4(result, source.w));
            if (transmittance_.data)
                store(transmittance_, x, y, vec4(t, 1.0f));
            if (optical_depth_.data)
                store(optical_depth_, x, y, vec4(optical_depth(medium_, density), 1.0f));
            if (airlight_.data)
                store(airlight_, x, y, vec4(airlight, 1.0f));
            if (airlight_error_.data)
                store(airlight_error_, x, y,
                      vec4(state_.lit && !ray.keep ? at_pixel(error_, ivec2(x, y), ray.distance) : vec3(0.0f), 1.0f));
        }
    });
}

}  // namespace

brume_status execute_cpu(const brume_services &services, brume_host host, State &state, const brume_plugin_frame &frame)
{
    const int lights = int(frame.scene->light_count);
    if (state.lit)
        if (brume_status s = refresh_lists(services, host, frame, state))
            return s;
    Frame f(services, host, state, frame);
    if (brume_status s = f.map())
        return s;
    if (state.lit) {
        if (brume_status s = f.gather(state.radiance, state.error, state.parameters.reduction, ivec2(0, lights)))
            return s;
    }
    for (int l = 0; l < lights && frame.light_airlight; ++l)
        if (frame.light_airlight[l])
            if (brume_status s = f.gather(frame.light_airlight[l], nullptr, 1, state.lit ? ivec2(l, l + 1) : ivec2(0)))
                return s;
    return f.compose();
}

}  // namespace airlight
