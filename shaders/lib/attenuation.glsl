// Attenuation maps (Gautron et al.): how much of the medium's Gaussians a light's rays have come through, as a function of direction
// and distance. Needs ray.glsl, light.glsl, octahedral.glsl, data.glsl.
//
//   attenuation         one channel, int rho dt [m at unit density]: of light l in direction (x, y) from it to node k, the texel
//                       (k side + x, l side + y). Directions lie on the corners of a grid, so that the map's edges join.
//   attenuation_frames  3 texels per light. Of directional lights 0 and 1 are the map's axes across the light: its place, 0 to 1, is
//                       dot(xyz, point) + w; of others the map is a window of the octahedral square about an axis: xyz the directions in
//                       which the square's x and y grow in its middle, w where the window begins in it. 2  x the distance of node 0
//                       and y that of the last, of directional lights along them; zw the window's size
//
// Depths and not the paper's sixteen cosine coefficients of transmittances: they serve every colour and never ring.

struct AttenuationFrame {
    vec4 u;
    vec4 v;
    float near;
    float far;
    vec2 size;
};

PURE AttenuationFrame attenuation_frame(sampler2D attenuation_frames, int light)
{
    vec4 range = data_texel(attenuation_frames, 3 * light + 2);
    return AttenuationFrame(data_texel(attenuation_frames, 3 * light), data_texel(attenuation_frames, 3 * light + 1), range.x, range.y,
                            vec2(range.z, range.w));
}

// Where a point is: the map's place of its direction from the light, 0 to 1, and its distance.
PURE vec3 attenuation_place(IN(AttenuationFrame) frame, IN(Light) light, vec3 point)
{
    vec3 u = vec3(frame.u);
    vec3 v = vec3(frame.v);
    if (light.type == light_directional)
        return vec3(dot(u, point) + frame.u.w, dot(v, point) + frame.v.w, dot(light.direction, point));
    vec3 d = point - light.position;
    vec2 square = octahedral(vec3(dot(u, d), dot(v, d), dot(cross(u, v), d)));
    return vec3((square.x - frame.u.w) / frame.size.x, (square.y - frame.v.w) / frame.size.y, length(d));
}

// Lights may stand at the end of all numbers.
PURE float or_zero(float x)
{
    return choose(is_finite(x), x, R(0.0));
}

// A node's depth, between texels: at (column, row) with its neighbours right and below.
PURE float attenuation_across(sampler2D attenuation, float column, float row, float u, float v)
{
    return mix(mix(value_at(attenuation, column, row), value_at(attenuation, column + R(1.0), row), u),
               mix(value_at(attenuation, column, row + R(1.0)), value_at(attenuation, column + R(1.0), row + R(1.0)), u), v);
}

// How far a cubic that rises by `step` has risen at w, 0 to 1, with slopes `from` and `to` at its ends.
PURE float risen(float w, float step, float from, float to)
{
    return w * (from + w * (R(3.0) * step - R(2.0) * from - to + w * (from + to - R(2.0) * step)));
}

// int rho dt of the Gaussians between the light and the point, over their distance; of directional lights itself. A mean density is
// smooth where the light stands inside a Gaussian, and an integral is not. Outside the map is what is on its edge.
PURE float attenuation_density(IN(AttenuationFrame) frame, sampler2D attenuation, int side, int nodes, int index, IN(Light) light,
                               vec3 point)
{
    vec3 place = attenuation_place(frame, light, point);
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
    float row = float(index * side) + top;
    float nearer = attenuation_across(attenuation, first, row, u, v);
    float farther = attenuation_across(attenuation, first + float(side), row, u, v);
    float before = attenuation_across(attenuation, max(node - R(1.0), R(0.0)) * float(side) + left, row, u, v);
    float behind = attenuation_across(attenuation, min(node + R(2.0), float(nodes - 1)) * float(side) + left, row, u, v);
    // Cubic along the ray, with slopes from the neighbours and none that would turn it.
    float step = farther - nearer;
    float step_before = choose(node > R(0.0), nearer - before, step);
    float step_behind = choose(node < float(nodes - 2), behind - farther, step);
    float from = min(R(0.5) * (step_before + step), R(3.0) * min(step_before, step));
    float to = min(R(0.5) * (step + step_behind), R(3.0) * min(step, step_behind));
    float integral = nearer + risen(w, step, from, to);
    if (light.type == light_directional)
        return integral;
    return integral / max(place.z, R(1e-6));
}
