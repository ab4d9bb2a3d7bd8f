#include "plan/density_rows.h"

#include <algorithm>
#include <cstring>

#include "lanes.hpp"
#include "scene_maths.hpp"

namespace brume {
namespace {

namespace scalar = maths_float;

float *texel(const brume_plugin_pixels &p, int x, int y)
{
    return p.data + y * p.row_stride + int64_t(x) * p.channels;
}

brume_status noisy_density_rows(const brume_plugin_rows *call, int32_t first, int32_t last)
{
    using namespace maths_float;
    const maths_float::Medium medium = medium_of(*call->scene);
    const maths_float::Camera camera = camera_of(*call->scene);
    const brume_plugin_pixels &depth = call->slots[0], &density = call->slots[4];
    const Texture gaussians = texture_of(call->slots[1]), tiles = texture_of(call->slots[2]),
                  tile_gaussians = texture_of(call->slots[3]);
    for (int32_t y = first; y < last; ++y)
        for (int32_t x = 0; x < call->width; ++x) {
            const vec2 moment = tile_density(medium, camera, gaussians, tiles, tile_gaussians, call->width, ivec2(x, y),
                                             *texel(depth, x, y));
            float *to = texel(density, x, y);
            to[0] = moment.x;
            to[1] = moment.y;
        }
    return BRUME_OK;
}

#define BRUME_LANES_BODY "plan/density_rows.inc"
#include "lanes_bodies.inc"

}  // namespace

brume_rows_function density_rows()
{
    return BRUME_OF_THIS_MACHINE(density_rows);
}

brume_rows_function gaussian_density_rows()
{
    return BRUME_OF_THIS_MACHINE(gaussian_density_rows);
}

template <int mode> brume_status layer_density_rows(const brume_plugin_rows *call, int32_t first, int32_t last)
{
    using namespace maths_float;
    const maths_float::Medium medium = medium_of(*call->scene);
    const maths_float::Camera camera = camera_of(*call->scene);
    const brume_plugin_pixels &depth = call->slots[0], &layer = call->slots[2], &density = call->slots[3],
                              &density_rgb = call->slots[4];
    for (int32_t y = first; y < last; ++y)
        for (int32_t x = 0; x < call->width; ++x) {
            const float *from = texel(layer, x, y);
            const Ray ray = pixel_ray(camera, vec2(float(x), float(y)) + 0.5f, *texel(depth, x, y));
            const vec4 p = layer_density(medium, ray, mode, vec3(from[0], from[1], from[2]));
            const vec2 d = density_texel(ray, p.w);
            float *to = texel(density, x, y), *rgb = texel(density_rgb, x, y);
            to[0] = d.x;
            to[1] = d.y;
            for (int c = 0; c < 4; ++c)
                rgb[c] = p[c];
        }
    return BRUME_OK;
}

template brume_status layer_density_rows<1>(const brume_plugin_rows *, int32_t, int32_t);
template brume_status layer_density_rows<2>(const brume_plugin_rows *, int32_t, int32_t);

}  // namespace brume
