// Kernel `calibrated` on the CPU: loops over rows around the functions of shaders/lib/calibrated.glsl.
#include <memory>
#include <utility>

#include "calibrated.h"
#include "common/pixels.hpp"

namespace multiscatter {
namespace {

using namespace brume::maths_float;
using namespace brume_pixels;

void store_coverage(const brume_plugin_pixels &image, int x, int y, vec3 value)
{
    if (image.channels == 1)
        *at(image, x, y) = value.x;
    else
        store(image, x, y, vec4(value, 1.0f));
}

class CpuPasses : public CalibratedPasses {
public:
    CpuPasses(const brume_services &services, brume_host host, const State &state, const brume_plugin_frame &frame)
        : services_(services), host_(host), state_(state), frame_(frame), medium_(medium_of(*frame.scene)),
          camera_(camera_of(*frame.scene)), filter_(filter_of(state, *frame.scene)),
          calibrated_(calibrated_of(state, *frame.scene, state.tabled))
    {
    }

    brume_status map();
    brume_status spread() override;
    brume_status share(int level) override;
    brume_status smooth(int level) override;
    brume_status collect() override;
    brume_status compose() override;

private:
    Pixel pixel_at(int x, int y) const
    {
        vec2 gaussians(0.0f);
        if (const float *g = gaussian_density_.data ? at(gaussian_density_, x, y) : nullptr)
            gaussians = vec2(g[0], g[1]);
        return pixel_in_medium(medium_, camera_, filter_, pixel_centre(x, y), *at(depth_, x, y), gaussians);
    }
    vec3 shown(int x, int y, const Pixel &pixel) const
    {
        return shown_share(texture_of(lights_), calibrated_.lights, medium_, camera_, pixel_centre(x, y), *at(depth_, x, y),
                           pixel.density);
    }

    const brume_services &services_;
    brume_host host_;
    const State &state_;
    const brume_plugin_frame &frame_;
    Medium medium_;
    Camera camera_;
    Filter filter_;
    Calibrated calibrated_;
    brume_plugin_pixels color_{}, depth_{}, gaussian_density_{}, lights_{}, output_{}, radiance_{}, radiance_stack_{},
        coverage_{}, coverage_stack_{}, smooth_radiance_{}, smooth_coverage_{}, ambient_stack_{}, table_{}, transmittance_{},
        optical_depth_{}, scattered_{}, blur_radius_{};
};

brume_status CpuPasses::map()
{
    const std::pair<brume_plugin_image, brume_plugin_pixels *> images[] = {
        {frame_.color, &color_},
        {frame_.depth, &depth_},
        {frame_.gaussian_density, &gaussian_density_},
        {frame_.lights, &lights_},
        {frame_.output, &output_},
        {state_.radiance, &radiance_},
        {state_.radiance_stack, &radiance_stack_},
        {state_.coverage, &coverage_},
        {state_.coverage_stack, &coverage_stack_},
        {state_.smooth_radiance, &smooth_radiance_},
        {state_.smooth_coverage, &smooth_coverage_},
        {state_.ambient_stack, &ambient_stack_},
        {state_.table, &table_},
        {frame_.transmittance, &transmittance_},
        {frame_.optical_depth, &optical_depth_},
        {frame_.scattered, &scattered_},
        {frame_.blur_radius, &blur_radius_},
    };
    for (auto &[image, pixels] : images)
        if (image)
            if (brume_status s = services_.pixels(host_, image, pixels))
                return s;
    return BRUME_OK;
}

brume_status CpuPasses::spread()
{
    const Texture table = texture_of(table_), color = texture_of(color_);
    const ivec2 base = state_.base(), size(state_.width, state_.height);
    return for_rows(services_, host_, "scatter", base.y, 8, [&](int y) {
        for (int x = 0; x < base.x; ++x) {
            const ivec2 at = representative({x, y}, state_.reduction, size);
            const Pixel pixel = pixel_at(at.x, at.y);
            const Spreading s =
                spreading_source(medium_, calibrated_, table, pixel.density, pixel.share,
                                 mean_of_square(color, {x, y}, state_.reduction, size), shown(at.x, at.y, pixel));
            store(radiance_, x, y, s.radiance);
            store_coverage(coverage_, x, y, s.coverage);
        }
    });
}

brume_status CpuPasses::share(int level)
{
    const LevelRows rows = level_rows(state_, level);
    const Texture finer = texture_of(level == 1 ? radiance_ : radiance_stack_),
                  finer_coverage = texture_of(level == 1 ? coverage_ : coverage_stack_),
                  ambient = texture_of(ambient_stack_), table = texture_of(table_);
    return for_rows(services_, host_, "downsample", rows.size.y, 8, [&](int y) {
        for (int x = 0; x < rows.size.x; ++x) {
            const Spreading s = spreading_texel(medium_, calibrated_, table, finer, finer_coverage, rows.finer_size,
                                                rows.finer_row, ivec2(x, y), level);
            store(radiance_stack_, x, rows.row + y, s.radiance);
            store_coverage(coverage_stack_, x, rows.row + y, s.coverage);
            store(ambient_stack_, x, rows.row + y,
                  ambient_texel(calibrated_, finer, finer_coverage, ambient, rows.finer_size, rows.finer_row, ivec2(x, y),
                                level));
        }
    });
}

brume_status CpuPasses::smooth(int level)
{
    const LevelRows rows = level_rows(state_, level);
    const Texture radiance = texture_of(radiance_stack_), coverage = texture_of(coverage_stack_), table = texture_of(table_);
    return for_rows(services_, host_, "smooth", rows.size.y, 8, [&](int y) {
        for (int x = 0; x < rows.size.x; ++x) {
            const Spreading s =
                stayed(medium_, calibrated_, table, radiance, coverage, rows.size, rows.row, ivec2(x, y), level);
            store(smooth_radiance_, x, rows.row + y, s.radiance);
            store_coverage(smooth_coverage_, x, rows.row + y, s.coverage);
        }
    });
}

// Into the pyramid's level 0, which is not needed any more.
brume_status CpuPasses::collect()
{
    const Texture radiance = texture_of(smooth_radiance_), coverage = texture_of(smooth_coverage_),
                  table = texture_of(table_);
    const ivec2 base = state_.base(), size(state_.width, state_.height);
    const Pyramid pyramid{base, calibrated_.top};
    return for_rows(services_, host_, "collect", base.y, 8, [&](int y) {
        for (int x = 0; x < base.x; ++x) {
            const ivec2 at = representative({x, y}, state_.reduction, size);
            const Pixel pixel = pixel_at(at.x, at.y);
            const Collected c = collected(medium_, calibrated_, table, radiance, coverage, pyramid,
                                          pixel_centre(at.x, at.y) / float(state_.reduction), pixel.density);
            store(radiance_, x, y, vec4(c.radiance, pixel.distance));
            store_coverage(coverage_, x, y, c.coverage);
        }
    });
}

brume_status CpuPasses::compose()
{
    const Texture radiance = texture_of(smooth_radiance_), coverage = texture_of(smooth_coverage_),
                  collected_radiance = texture_of(radiance_), collected_coverage = texture_of(coverage_),
                  ambient = texture_of(ambient_stack_), table = texture_of(table_);
    const Pyramid pyramid{state_.base(), calibrated_.top};
    const ivec2 size(state_.width, state_.height);
    const float limit = frame_.scene->output_limit;
    return for_rows(services_, host_, "compose", state_.height, 8, [&](int y) {
        for (int x = 0; x < state_.width; ++x) {
            const vec4 color = load(color_, x, y);
            const Pixel pixel = pixel_at(x, y);
            const vec2 position = pixel_centre(x, y) / float(state_.reduction);
            const Collected levels =
                state_.reduction > 1
                    ? upsampled_collected(calibrated_, collected_radiance, collected_coverage, state_.reduction, size,
                                          {x, y}, pixel.distance)
                    : collected(medium_, calibrated_, table, radiance, coverage, pyramid, position, pixel.density);
            const vec3 added =
                pixel.emitted + scattered_light(medium_, calibrated_, table, ambient, pyramid, position, pixel.density,
                                                pixel.share, vec3(color), shown(x, y, pixel), levels);
            store(output_, x, y, vec4(compose_radiance(vec3(color), pixel.transmittance, added, limit), color.w));
            if (transmittance_.data)
                store(transmittance_, x, y, vec4(pixel.transmittance, 1.0f));
            if (optical_depth_.data)
                store(optical_depth_, x, y, vec4(optical_depth(medium_, pixel.density), 1.0f));
            if (scattered_.data)
                store(scattered_, x, y, vec4(added, 1.0f));
            if (blur_radius_.data)
                *at(blur_radius_, x, y) = pixel.spread;
        }
    });
}

}  // namespace

std::unique_ptr<CalibratedPasses> calibrated_on_cpu(const brume_services &services, brume_host host, const State &state,
                                                    const brume_plugin_frame &frame, brume_status &status)
{
    auto passes = std::make_unique<CpuPasses>(services, host, state, frame);
    status = passes->map();
    return passes;
}

}  // namespace multiscatter
