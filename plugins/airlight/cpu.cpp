// The effect on the CPU: loops over rows around the functions of shaders/lib/airlight*.glsl.
#include <utility>

#include "common/pixels.hpp"
#include "passes.h"
#include "settings.h"

namespace airlight {
namespace {

using namespace brume::maths_float;
using namespace brume_pixels;

class CpuPasses : public Passes {
public:
    CpuPasses(const brume_services &services, brume_host host, const State &state, const brume_plugin_frame &frame)
        : services_(services), host_(host), state_(state), frame_(frame), medium_(medium_of(*frame.scene)),
          camera_(camera_of(*frame.scene)), settings_(settings_of(state, *frame.scene))
    {
    }

    brume_status map();
    brume_status blobs() override;
    brume_status gather(const Gathering &gathering) override;
    brume_status compose() override;

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
        tile_gaussians_{}, origins_{}, cells_{}, cell_gaussians_{}, blob_density_{}, sun_table_{}, environment_{}, environment_table_{}, radiance_{},
        error_{}, distances_{}, transmittance_{}, optical_depth_{}, airlight_{}, airlight_error_{};
};

brume_status CpuPasses::map()
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
        {state_.sun_table, &sun_table_},
        {state_.environment, &environment_},
        {state_.environment_table, &environment_table_},
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

brume_status CpuPasses::gather(const Gathering &to)
{
    if (state_.parameters.tier == Tier::reference)
        return gather_reference(services_, host_, state_, frame_, to);
    brume_plugin_pixels radiance{}, error{}, distances{};
    const std::pair<brume_plugin_image, brume_plugin_pixels *> images[] = {
        {to.radiance, &radiance}, {to.error, &error}, {to.distances, &distances}};
    for (auto &[image, pixels] : images)
        if (brume_status s = map(image, *pixels))
            return s;
    AirlightSettings settings = settings_;
    if (!to.environment)
        settings.environment_order = 0;
    const ivec2 light_range(to.first_light, to.last_light);
    const int tier = tier_of(state_);
    const ivec2 size(state_.width, state_.height);
    const Texture depth = texture_of(depth_), gaussian_density = texture_of(gaussian_density_), tiles = texture_of(tiles_),
                  gaussians = texture_of(gaussians_), lights = texture_of(lights_),
                  tile_gaussians = texture_of(tile_gaussians_), cells = texture_of(cells_),
                  cell_gaussians = texture_of(cell_gaussians_), shadow_origins = texture_of(origins_),
                  blob_density = texture_of(blob_density_), sun_table = texture_of(sun_table_),
                  environment = texture_of(environment_), environment_table = texture_of(environment_table_);
    return for_rows(services_, host_, "gather", radiance.height, 4, [&](int y) {
        for (int x = 0; x < radiance.width; ++x) {
            const ivec2 pixel = representative(ivec2(x, y), to.reduction, size);
            const Airlight a = airlight_at(tier, medium_, camera_, settings, AIRLIGHT_PIXEL_PASSED, pixel, size, light_range);
            store(radiance, x, y, vec4(a.radiance, 1.0f));
            if (error.data)
                store(error, x, y, vec4(a.error, 1.0f));
            if (distances.data)
                *at(distances, x, y) = pixel_ray(camera_, pixel_centre(pixel.x, pixel.y), *at(depth_, pixel.x, pixel.y)).distance;
        }
    });
}

brume_status CpuPasses::blobs()
{
    const int values = settings_.gaussian_count * (1 + settings_.light_count);
    const Texture gaussians = texture_of(gaussians_), lights = texture_of(lights_), cells = texture_of(cells_),
                  cell_gaussians = texture_of(cell_gaussians_), shadow_origins = texture_of(origins_);
    return for_rows(services_, host_, "blobs", (values + BRUME_DATA_WIDTH - 1) / BRUME_DATA_WIDTH, 1, [&](int y) {
        for (int x = 0; x < BRUME_DATA_WIDTH && y * BRUME_DATA_WIDTH + x < values; ++x)
            *at(blob_density_, x, y) =
                blob_density_at(medium_, camera_, settings_, SHADOW_PASSED, lights, y * BRUME_DATA_WIDTH + x);
    });
}

brume_status CpuPasses::compose()
{
    const float limit = frame_.scene->output_limit;
    return for_rows(services_, host_, "compose", state_.height, 8, [&](int y) {
        for (int x = 0; x < state_.width; ++x) {
            const vec4 source = load(color_, x, y);
            const Ray ray = pixel_ray(camera_, pixel_centre(x, y), *at(depth_, x, y));
            const float density = density_to(medium_, ray, gaussian_density_.data ? *at(gaussian_density_, x, y) : 0.0f);
            const vec3 t = shares_of(medium_, density).straight;  // as other effects have it, bit for bit
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

brume_status make_cpu_passes(const brume_services &services, brume_host host, const State &state,
                             const brume_plugin_frame &frame, std::unique_ptr<Passes> &out)
{
    auto passes = std::make_unique<CpuPasses>(services, host, state, frame);
    const brume_status s = passes->map();
    if (!s)
        out = std::move(passes);
    return s;
}

}  // namespace airlight
