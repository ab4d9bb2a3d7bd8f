// What is left of the picture, by the lamps' shares, and all of it together.
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
uniform float brume_output_limit;
uniform SurfaceSettings settings;
uniform int first;  // nothing was divided yet
uniform sampler2D color;
uniform sampler2D rest;
uniform sampler2D lit;
uniform sampler2D depth;
uniform sampler2D normals;
uniform sampler2D lights;
uniform sampler2D ungrouped;
uniform sampler2D gaussians;
uniform sampler2D environment;
uniform sampler2D table;
uniform sampler2D albedo;
uniform sampler2D specular;
uniform sampler2D roughness;
uniform sampler2D light_shadows;
uniform sampler2D shadow_maps;
writeonly uniform image2D result;
writeonly uniform image2D surface_out;

// As the plan has it: drivers that run both sides of branches would pay for what no pixel needs.
SurfaceSettings planned()
{
    SurfaceSettings s = settings;
    s.method = METHOD;
    s.lamps_alone = LAMPS_ALONE;
    if (MATERIAL == 0)
        s.material = 0;
    if (ENVIRONMENT == 0)
        s.environment_order = 0;
    if (SHADOWED == 0)
        s.shadowed = 0;
    return s;
}

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (p.x >= brume_grid.x || p.y >= brume_grid.y)
        return;
    SurfaceSettings around = planned();
    vec4 source = texelFetch(color, p, 0);
    Surface surface = surface_of(brume_camera, around, vec2(p) + 0.5, texelFetch(depth, p, 0).r, texelFetch(normals, p, 0).rgb);
    Divided divided = first != 0 ? Divided(source.rgb, vec3(0.0)) : Divided(texelFetch(rest, p, 0).rgb, texelFetch(lit, p, 0).rgb);
    vec3 shown = relit(brume_medium, lamp_colours(brume_medium), brume_camera, around, SURFACE_PASSED, SHADOW_MAP_PASSED, surface, material_at(around.material, albedo, specular, roughness, p), source.rgb, divided, brume_output_limit);
    imageStore(result, p, vec4(shown, source.a));
    imageStore(surface_out, p, vec4(shown, 1.0));
}
