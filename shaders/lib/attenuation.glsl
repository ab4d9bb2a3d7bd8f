// Attenuation maps (Gautron et al.): how much of the medium's Gaussians a light's rays have come through, as a function of direction
// and distance. Needs ray.glsl, light.glsl, octahedral.glsl, data.glsl.
//
//   attenuation         one channel, int rho dt [m at unit density]: of light l in direction (x, y) from it to node k, the texel
//                       (k side + x, l side + y). Directions lie on the corners of a grid, so that the map's edges join.
//   attenuation_frames  3 texels per light: 0, 1  directional: the map's axes across the light, as texels 0 and 1 of
//                       shadow_origins; 2  x the distance of node 0 and y that of the last; of directional lights along them
//
// Depths and not the paper's sixteen cosine coefficients of transmittances: they serve every colour and never ring.

struct AttenuationFrame {
    vec4 u;
    vec4 v;
    float near;
    float far;
};

PURE AttenuationFrame attenuation_frame(sampler2D attenuation_frames, int light)
{
    vec4 range = data_texel(attenuation_frames, 3 * light + 2);
    return AttenuationFrame(data_texel(attenuation_frames, 3 * light), data_texel(attenuation_frames, 3 * light + 1), range.x, range.y);
}

// Where a point is: the unit square's place of its direction from the light, and its distance.
PURE vec3 attenuation_place(IN(Camera) camera, IN(AttenuationFrame) frame, IN(Light) light, vec3 point)
{
    if (light.type == light_directional)
        return vec3(dot(vec3(frame.u), point) + frame.u.w, dot(vec3(frame.v), point) + frame.v.w, dot(light.direction, point));
    vec3 d = point - light.position;
    vec2 square = octahedral(in_world(camera, d));
    return vec3(square.x, square.y, length(d));
}

// Lights may stand at the end of all numbers.
PURE float or_zero(float x)
{
    return choose(is_finite(x), x, R(0.0));
}

// int rho dt of the Gaussians between the light and the point, over their distance; of directional lights itself. A mean density is
// smooth where the light stands inside a Gaussian, and an integral is not.
PURE float attenuation_density(IN(Camera) camera, IN(AttenuationFrame) frame, sampler2D attenuation, int side, int nodes, int index,
                               IN(Light) light, vec3 point)
{
    vec3 place = attenuation_place(camera, frame, light, point);
    float most = float(side - 1);
    float x = clamp(or_zero(place.x), R(0.0), R(1.0)) * most;
    float y = clamp(or_zero(place.y), R(0.0), R(1.0)) * most;
    float z = clamp(or_zero((place.z - frame.near) / (frame.far - frame.near)), R(0.0), R(1.0)) * float(nodes - 1);
    float left = min(floor(x), most - R(1.0));
    float top = min(floor(y), most - R(1.0));
    float node = min(floor(z), float(nodes - 2));
    float u = x - left;
    float v = y - top;
    float w = z - node;
    float first = node * float(side) + left;
    float second = first + float(side);
    float row = float(index * side) + top;
    float nearer = mix(mix(value_at(attenuation, first, row), value_at(attenuation, first + R(1.0), row), u),
                       mix(value_at(attenuation, first, row + R(1.0)), value_at(attenuation, first + R(1.0), row + R(1.0)), u), v);
    float farther = mix(mix(value_at(attenuation, second, row), value_at(attenuation, second + R(1.0), row), u),
                        mix(value_at(attenuation, second, row + R(1.0)), value_at(attenuation, second + R(1.0), row + R(1.0)), u), v);
    float integral = mix(nearer, farther, w);
    if (light.type == light_directional)
        return choose(place.x == clamp(place.x, R(0.0), R(1.0)) && place.y == clamp(place.y, R(0.0), R(1.0)), integral, R(0.0));
    return integral / max(place.z, R(1e-6));
}
