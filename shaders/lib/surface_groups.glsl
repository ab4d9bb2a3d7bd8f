// Lamps' own layers of the picture that a pass is given, of which programs have four at most. Needs surface.glsl.

Divided divided_by_groups(Medium medium, LampColours colours, Camera camera, SurfaceSettings settings, Surface surface,
                          Material material, Shine shine, sampler2D lights, sampler2D light_gaussians, sampler2D table, int groups,
                          ivec4 of_lights, vec3 of_groups[4], Divided pixel)
{
    int g = 0;
    if (groups > 0)
        do {
            pixel = divided_by_group(medium, colours, camera, settings, surface, material, shine, lights, light_gaussians, table, pixel,
                                     of_lights[g], of_groups[g]);
        } while (++g < groups);
    return pixel;
}
