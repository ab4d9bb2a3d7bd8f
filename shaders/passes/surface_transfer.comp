// What the medium brings to diffuse surfaces whose transfer is known.
#include "scene.glsl"
#include "ray.glsl"
#include "density.glsl"
#include "radiance.glsl"
#include "data.glsl"
#include "erf.glsl"
#include "gaussian.glsl"
#include "phase.glsl"
#include "light.glsl"
#include "light_cone.glsl"
#include "lit.glsl"
#include "octahedral.glsl"
#include "shadow.glsl"
#include "value.glsl"
#include "shadow_lit.glsl"
#include "shadow_map.glsl"
#include "airlight.glsl"
#include "lamp_field.glsl"
#include "environment.glsl"
#include "surface.glsl"
#include "surface_planned.glsl"

uniform Medium brume_medium;
uniform Camera brume_camera;
uniform SurfaceSettings settings;
uniform sampler2D depth;
uniform sampler2D normals;
uniform sampler2D lights;
uniform sampler2D ungrouped;
uniform sampler2D light_gaussians;
uniform sampler2D environment;
uniform sampler2D in_axes;
uniform sampler2D table;
uniform sampler2D albedo;
uniform sampler2D transfer_0;
uniform sampler2D transfer_1;
uniform sampler2D transfer_2;
uniform sampler2D transfer_3;
uniform sampler2D transfer_4;
uniform sampler2D transfer_5;
writeonly uniform image2D brought;

Transfer transfer_at(ivec2 p)
{
    Transfer t;
    for (int i = 0; i < 6; ++i)
        t.of[i] = vec3(0.0);
    t.of[0] = finite_or_zero(texelFetch(transfer_0, p, 0).rgb);
    if (TRANSFER > 1)
        t.of[1] = finite_or_zero(texelFetch(transfer_1, p, 0).rgb);
    if (TRANSFER > 2)
        t.of[2] = finite_or_zero(texelFetch(transfer_2, p, 0).rgb);
    if (TRANSFER > 3) {
        t.of[3] = finite_or_zero(texelFetch(transfer_3, p, 0).rgb);
        t.of[4] = finite_or_zero(texelFetch(transfer_4, p, 0).rgb);
        t.of[5] = finite_or_zero(vec3(texelFetch(transfer_5, p, 0).r));
    }
    return t;
}

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (p.x >= brume_grid.x || p.y >= brume_grid.y)
        return;
    SurfaceSettings around = planned(settings);
    Medium medium = planned(brume_medium);
    Surface surface = surface_of(brume_camera, around, vec2(p) + 0.5, texelFetch(depth, p, 0).r, texelFetch(normals, p, 0).rgb);
    vec3 light = brought_by_transfer(medium, lamp_colours(medium), brume_camera, around, SURFACE_PASSED, in_axes,
                                     surface, texelFetch(albedo, p, 0).rgb, transfer_at(p));
    imageStore(brought, p, vec4(light, 1.0));
}
