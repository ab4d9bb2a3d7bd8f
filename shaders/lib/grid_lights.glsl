// The lights' attenuation at the grid's points. Needs attenuation.glsl, grid_settings.glsl.

const int grid_lights_at_once = 4;

// The grid's texel of lights [first, last).
PURE vec4 grid_lights_texel(IN(GridSettings) s, sampler2D attenuation, sampler2D attenuation_frames, sampler2D lights, int first,
                            int last, vec3 direction, float distance)
{
    vec4 densities = vec4(R(0.0));
    vec3 point = distance * direction;
    for (int i = 0; i < last - first; ++i) {
        Light light = light_at(lights, first + i);
        densities[i] = attenuation_density(attenuation_frame(attenuation_frames, first + i), attenuation, s.side, s.nodes,
                                           first + i - s.mapped, light, point);
    }
    return densities;
}
