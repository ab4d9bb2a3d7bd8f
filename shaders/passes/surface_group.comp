// Lamps' own layers: takes them from what is still to be divided.
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
#include "surface_groups.glsl"

uniform Medium brume_medium;
uniform Camera brume_camera;
uniform SurfaceSettings settings;
uniform ivec4 of_lights;
uniform int groups;
uniform int first;  // nothing was divided yet
uniform sampler2D rest;
uniform sampler2D lit;
uniform sampler2D group_0;
uniform sampler2D group_1;
uniform sampler2D group_2;
uniform sampler2D group_3;
uniform sampler2D depth;
uniform sampler2D normals;
uniform sampler2D lights;
uniform sampler2D light_gaussians;
uniform sampler2D table;
uniform sampler2D albedo;
uniform sampler2D specular;
uniform sampler2D roughness;
writeonly uniform image2D rest_out;
writeonly uniform image2D lit_out;

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (p.x >= brume_grid.x || p.y >= brume_grid.y)
        return;
    SurfaceSettings around = planned(settings);
    Medium medium = planned(brume_medium);
    LampColours colours = lamp_colours(medium);
    Surface surface = surface_of(brume_camera, around, vec2(p) + 0.5, texelFetch(depth, p, 0).r, texelFetch(normals, p, 0).rgb);
    Material material = as_relit(around, material_at(around.material, albedo, specular, roughness, p));
    Shine shine = shine_of(surface, material);
    Divided divided = Divided(texelFetch(rest, p, 0).rgb, first != 0 ? vec3(0.0) : texelFetch(lit, p, 0).rgb);
    vec3 of_groups[4] = vec3[](texelFetch(group_0, p, 0).rgb, texelFetch(group_1, p, 0).rgb, texelFetch(group_2, p, 0).rgb,
                               texelFetch(group_3, p, 0).rgb);
    divided = divided_by_groups(medium, colours, brume_camera, around, surface, material, shine, lights, light_gaussians, table, groups,
                                of_lights, of_groups, divided);
    imageStore(rest_out, p, vec4(divided.rest, 1.0));
    imageStore(lit_out, p, vec4(divided.lit, 1.0));
}
