// LAYER (0: the scene's density, 1: a layer optical_depth, 2: a layer transmittance) is set by the plan.
#include "scene.glsl"
#include "ray.glsl"
#include "density.glsl"
#include "radiance.glsl"
#include "spread.glsl"
#include "pixel.glsl"
#include "layer_density.glsl"

uniform Medium brume_medium;
uniform Camera brume_camera;
uniform sampler2D depth;
uniform sampler2D gaussian_density;
uniform sampler2D layer;
writeonly uniform image2D density;
writeonly uniform image2D density_rgb;

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (p.x >= brume_grid.x || p.y >= brume_grid.y)
        return;
    Ray ray = pixel_ray(brume_camera, vec2(p) + 0.5, texelFetch(depth, p, 0).r);
#if LAYER == 0
    float sum = density_to(brume_medium, ray, texelFetch(gaussian_density, p, 0).r);
#else
    vec4 each = layer_density(brume_medium, ray, LAYER, texelFetch(layer, p, 0).rgb);
    imageStore(density_rgb, p, each);
    float sum = each.w;
#endif
    imageStore(density, p, vec4(density_texel(ray, sum), 0.0, 1.0));
}
