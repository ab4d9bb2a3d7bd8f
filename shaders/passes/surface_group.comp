// One lamp's own layer: takes it from what is still to be divided.
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

uniform Medium brume_medium;
uniform Camera brume_camera;
uniform SurfaceSettings settings;
uniform int light;
uniform int first;  // nothing was divided yet
uniform sampler2D rest;
uniform sampler2D lit;
uniform sampler2D group;
uniform sampler2D depth;
uniform sampler2D normals;
uniform sampler2D lights;
uniform sampler2D gaussians;
uniform sampler2D table;
uniform sampler2D albedo;
uniform sampler2D specular;
uniform sampler2D roughness;
writeonly uniform image2D rest_out;
writeonly uniform image2D lit_out;

// As the plan has it: drivers that run both sides of branches would pay for what no pixel needs.
SurfaceSettings planned()
{
    SurfaceSettings s = settings;
    s.method = METHOD;
    s.lamps_alone = LAMPS_ALONE;
    if (MATERIAL == 0)
        s.material = 0;
    return s;
}

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (p.x >= brume_grid.x || p.y >= brume_grid.y)
        return;
    SurfaceSettings around = planned();
    Surface surface = surface_of(brume_camera, around, vec2(p) + 0.5, texelFetch(depth, p, 0).r, texelFetch(normals, p, 0).rgb);
    Divided before = Divided(texelFetch(rest, p, 0).rgb, first != 0 ? vec3(0.0) : texelFetch(lit, p, 0).rgb);
    Divided after = divided_by_group(brume_medium, lamp_colours(brume_medium), around, surface, light_at(lights, light),
                                     material_at(around.material, albedo, specular, roughness, p), gaussians, table, before,
                                     texelFetch(group, p, 0).rgb);
    imageStore(rest_out, p, vec4(after.rest, 1.0));
    imageStore(lit_out, p, vec4(after.lit, 1.0));
}
