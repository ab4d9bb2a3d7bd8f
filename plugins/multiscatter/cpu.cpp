// Kernel `paper` on the CPU: loops over rows around the functions of shaders/lib/multiscatter.glsl.
#include "common/pixels.hpp"
#include "state.h"

namespace multiscatter {
namespace {

using namespace brume::maths_float;
using namespace brume_pixels;

// All that the passes of one frame share.
struct Frame {
    const brume_services &services;
    brume_host host;
    const State &state;
    Medium medium;
    Camera camera;
    Filter filter;
    float output_limit;
    brume_plugin_pixels color{}, depth{}, gaussian_density{}, lights{}, output{}, radiance{}, radiance_stack{},
        spread_stack{}, separated{}, separated_stack{}, transmittance{}, optical_depth{}, scattered{}, blur_radius{};

    // Maps an image that may be NULL.
    brume_status map(brume_plugin_image image, brume_plugin_pixels &out)
    {
        return image ? services.pixels(host, image, &out) : BRUME_OK;
    }
};

Pixel pixel_at(const Frame &frame, int x, int y)
{
    vec2 gaussians(0.0f);
    if (const float *g = frame.gaussian_density.data ? at(frame.gaussian_density, x, y) : nullptr)
        gaussians = vec2(g[0], g[1]);
    return placed_pixel(frame.medium, frame.camera, frame.filter, pixel_centre(x, y), *at(frame.depth, x, y), gaussians);
}

brume_status scatter(Frame &frame)
{
    return for_rows(frame.services, frame.host, "scatter", frame.state.height, 8, [&](int y) {
        for (int x = 0; x < frame.state.width; ++x) {
            Pixel pixel = pixel_at(frame, x, y);
            pixel.share = share_beside_lights(texture_of(frame.lights), frame.filter.lights, frame.medium, frame.camera,
                                              pixel_centre(x, y), *at(frame.depth, x, y), pixel);
            Sources s = scattered_sources(frame.medium, frame.filter, pixel, vec3(load(frame.color, x, y)));
            store(frame.radiance, x, y, s.spread);
            if (frame.separated.data)
                store(frame.separated, x, y, s.separated);
        }
    });
}

// A template for the number of taps, so that the loops over them unroll.
template <int taps> void downsample_row(const Frame &frame, int level, int y)
{
    ivec2 base(frame.state.width, frame.state.height);
    ivec2 size = level_size(base, level), finer_size = level_size(base, level - 1);
    int row = level_row(base, level), finer_row = level == 1 ? 0 : level_row(base, level - 1);
    const Filter &f = frame.filter;
    Texture radiance = texture_of(level == 1 ? frame.radiance : frame.radiance_stack);
    Texture separated = texture_of(level == 1 ? frame.separated : frame.separated_stack);
    Texture spread = texture_of(level == 1 ? frame.radiance : frame.spread_stack);
    for (int x = 0; x < size.x; ++x) {
        ivec2 texel(x, y);
        store(
            frame.radiance_stack, x, row + y,
            downsampled_radiance(radiance, finer_size, finer_row, texel, level, taps, f.masking, f, frame.medium.luminance));
        if (frame.spread_stack.data)
            *at(frame.spread_stack, x, row + y) =
                downsampled_spread(spread, finer_size, finer_row, texel, taps, level == 1 ? 3 : 0);
        if (frame.separated_stack.data)
            store(frame.separated_stack, x, row + y,
                  downsampled_radiance(separated, finer_size, finer_row, texel, level, taps, 0, f, frame.medium.luminance));
    }
}

brume_status downsample(Frame &frame)
{
    auto row = frame.state.parameters.taps == 2   ? downsample_row<2>
               : frame.state.parameters.taps == 4 ? downsample_row<4>
                                                  : downsample_row<6>;
    for (int level = 1; level <= frame.filter.top; ++level) {
        int height = level_size({frame.state.width, frame.state.height}, level).y;
        brume_status s = for_rows(frame.services, frame.host, "downsample", height, 8, [&](int y) { row(frame, level, y); });
        if (s)
            return s;
    }
    return BRUME_OK;
}

brume_status compose(Frame &frame)
{
    Pyramid pyramid{ivec2(frame.state.width, frame.state.height), frame.state.radiance ? frame.filter.top : 0};
    Texture radiance = texture_of(frame.radiance), stack = texture_of(frame.radiance_stack);
    Texture spread_stack = texture_of(frame.spread_stack);
    Texture separated = texture_of(frame.separated), separated_stack = texture_of(frame.separated_stack);
    return for_rows(frame.services, frame.host, "compose", frame.state.height, 8, [&](int y) {
        for (int x = 0; x < frame.state.width; ++x) {
            vec2 centre = pixel_centre(x, y);
            vec4 color = load(frame.color, x, y);
            Pixel pixel = pixel_at(frame, x, y);
            vec3 added = pixel.emitted;
            if (pyramid.top > 0)
                added += gathered(radiance, stack, spread_stack, separated, separated_stack, pyramid, frame.filter, centre,
                                  pixel.spread);
            else
                added += pixel.share * finite_or_zero(vec3(color));
            vec3 result = compose_radiance(vec3(color), pixel.transmittance, added, frame.output_limit);
            store(frame.output, x, y, vec4(result, color.w));
            if (frame.transmittance.data)
                store(frame.transmittance, x, y, vec4(pixel.transmittance, 1.0f));
            if (frame.optical_depth.data)
                store(frame.optical_depth, x, y, vec4(optical_depth(frame.medium, pixel.density), 1.0f));
            if (frame.scattered.data)
                store(frame.scattered, x, y, vec4(added, 1.0f));
            if (frame.blur_radius.data)
                *at(frame.blur_radius, x, y) = pixel.spread;
        }
    });
}

}  // namespace

brume_status execute_cpu(const brume_services &services, brume_host host, const State &state,
                         const brume_plugin_frame &frame)
{
    Frame f{services,
            host,
            state,
            medium_of(*frame.scene),
            camera_of(*frame.scene),
            filter_of(state, *frame.scene),
            frame.scene->output_limit};
    const std::pair<brume_plugin_image, brume_plugin_pixels *> images[] = {
        {frame.color, &f.color},
        {frame.depth, &f.depth},
        {frame.gaussian_density, &f.gaussian_density},
        {frame.lights, &f.lights},
        {frame.output, &f.output},
        {state.radiance, &f.radiance},
        {state.radiance_stack, &f.radiance_stack},
        {state.spread_stack, &f.spread_stack},
        {state.separated, &f.separated},
        {state.separated_stack, &f.separated_stack},
        {frame.transmittance, &f.transmittance},
        {frame.optical_depth, &f.optical_depth},
        {frame.scattered, &f.scattered},
        {frame.blur_radius, &f.blur_radius},
    };
    for (auto &[image, pixels] : images)
        if (brume_status s = f.map(image, *pixels))
            return s;
    if (state.top > 0) {
        if (brume_status s = scatter(f))
            return s;
        if (brume_status s = downsample(f))
            return s;
    }
    return compose(f);
}

}  // namespace multiscatter
