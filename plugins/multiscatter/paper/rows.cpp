// Kernel `paper` on the CPU: loops over rows around the functions of shaders/lib/multiscatter.glsl.
#include "pixels.hpp"
#include "paper/passes.h"

namespace multiscatter {

using namespace brume::maths_float;
using namespace brume_pixels;

namespace {

// What the passes share.
struct Call {
    explicit Call(const brume_plugin_rows &rows)
        : slots(rows.slots), constants(*static_cast<const PaperConstants *>(rows.constants)), medium(medium_of(*rows.scene)),
          camera(camera_of(*rows.scene))
    {
    }

    // The images of product "density" and those beside it are at the same slots in both passes.
    Pixel pixel_at(int x, int y) const
    {
        const float *texel = at(slots[scatter_pass::density], x, y);
        const vec2 density(texel[0], texel[1]);
        const brume_plugin_pixels &rgb = slots[scatter_pass::density_rgb],
                                  &gaussians = slots[scatter_pass::gaussian_density];
        const Pixel pixel = rgb.data ? pixel_in_layer(medium, camera, density, vec3(load(rgb, x, y)))
                                     : pixel_in_medium(medium, camera, density);
        return placed_pixel(pixel, medium, camera, constants.multiscatter, pixel_centre(x, y), density,
                            gaussians.data ? at(gaussians, x, y)[1] : 0.0f);
    }

    const brume_plugin_pixels *slots;
    const PaperConstants &constants;
    Medium medium;
    Camera camera;
};

static_assert(int(scatter_pass::density) == int(paper_compose_pass::density) &&
              int(scatter_pass::density_rgb) == int(paper_compose_pass::density_rgb) &&
              int(scatter_pass::gaussian_density) == int(paper_compose_pass::gaussian_density));

// A template for the number of taps, so that the loops over them unroll.
template <int taps> brume_status downsample(const brume_plugin_rows &rows, int32_t first, int32_t last)
{
    using namespace downsample_pass;
    const Call call(rows);
    const PaperConstants &c = call.constants;
    const Filter &f = c.multiscatter;
    const vec3 luminance = call.medium.luminance;
    const Texture finer = texture_of(call.slots[finer_radiance]), finer_w = texture_of(call.slots[finer_spread]),
                  finer_ssc = texture_of(call.slots[finer_separated]);
    return for_pixels(rows, first, last, [&](int x, int y) {
        const ivec2 texel(x, y);
        const int row = c.rows.y + y;
        store(call.slots[radiance], x, row,
              downsampled_radiance(finer, c.finer_size, c.rows.x, texel, c.level, taps, f.masking, f, luminance));
        if (call.slots[spread].data)
            *at(call.slots[spread], x, row) =
                downsampled_spread(finer_w, c.finer_size, c.rows.x, texel, taps, c.spread_channel);
        if (call.slots[separated].data)
            store(call.slots[separated], x, row,
                  downsampled_radiance(finer_ssc, c.finer_size, c.rows.x, texel, c.level, taps, 0, f, luminance));
    });
}

}  // namespace

brume_status paper_scatter_rows(const brume_plugin_rows *rows, int32_t first, int32_t last)
{
    using namespace scatter_pass;
    const Call call(*rows);
    const Filter &f = call.constants.multiscatter;
    return for_pixels(*rows, first, last, [&](int x, int y) {
        Pixel pixel = call.pixel_at(x, y);
        pixel.share = share_beside_lights(texture_of(call.slots[lights]), f.lights, f.all_orders, call.medium, call.camera,
                                          pixel_centre(x, y), pixel);
        const Sources s = scattered_sources(call.medium, f, pixel, vec3(load(call.slots[color], x, y)));
        store(call.slots[radiance], x, y, s.spread);
        if (call.slots[separated].data)
            store(call.slots[separated], x, y, s.separated);
    });
}

brume_status paper_downsample_rows(const brume_plugin_rows *rows, int32_t first, int32_t last)
{
    const int taps = static_cast<const PaperConstants *>(rows->constants)->taps;
    return (taps == 2 ? downsample<2> : taps == 4 ? downsample<4> : downsample<6>)(*rows, first, last);
}

brume_status paper_compose_rows(const brume_plugin_rows *rows, int32_t first, int32_t last)
{
    using namespace paper_compose_pass;
    const Call call(*rows);
    const Filter &f = call.constants.multiscatter;
    const brume_plugin_pixels *slots = call.slots;
    const Pyramid pyramid{ivec2(rows->width, rows->height), f.top};
    const Texture level_0 = texture_of(slots[radiance]), stack = texture_of(slots[radiance_stack]),
                  w_stack = texture_of(slots[spread_stack]), ssc = texture_of(slots[separated]),
                  ssc_stack = texture_of(slots[separated_stack]);
    return for_pixels(*rows, first, last, [&](int x, int y) {
        const vec4 source = load(slots[color], x, y);
        const Pixel pixel = call.pixel_at(x, y);
        vec3 added = pixel.emitted;
        if (pyramid.top > 0)
            added += gathered(level_0, stack, w_stack, ssc, ssc_stack, pyramid, f, pixel_centre(x, y), pixel.spread);
        else
            added += pixel.share * finite_or_zero(vec3(source));
        store(slots[result], x, y,
              vec4(compose_radiance(vec3(source), pixel.transmittance, added, rows->scene->output_limit), source.w));
        if (slots[transmittance_out].data)
            store(slots[transmittance_out], x, y, vec4(pixel.transmittance, 1.0f));
        if (slots[optical_depth_out].data)
            store(slots[optical_depth_out], x, y,
                  vec4(slots[density_rgb].data ? optical_depth(call.medium, vec3(load(slots[density_rgb], x, y)))
                                               : optical_depth(call.medium, pixel.density),
                       1.0f));
        if (slots[scattered_out].data)
            store(slots[scattered_out], x, y, vec4(added, 1.0f));
        if (slots[blur_radius_out].data)
            *at(slots[blur_radius_out], x, y) = pixel.spread;
    });
}

}  // namespace multiscatter
