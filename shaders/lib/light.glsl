// Lights (brume_plugin_light). Needs data.glsl, ray.glsl.

const int light_point = 0;
const int light_spot = 1;
const int light_directional = 2;

struct Light {
    vec3 position;    // camera space [m]
    float radius;     // [m]
    vec3 direction;   // unit, where it shines to
    float cos_outer;
    vec3 intensity;   // [radiance m^2]; directional: irradiance
    float cos_inner;
    int type;
    float distance;   // directional: [m] of the constant terms that its light has come through
};

PURE Light light_at(sampler2D lights, int i)
{
    vec4 a = data_texel(lights, 4 * i);
    vec4 b = data_texel(lights, 4 * i + 1);
    vec4 c = data_texel(lights, 4 * i + 2);
    vec4 d = data_texel(lights, 4 * i + 3);
    return Light(vec3(a.x, a.y, a.z), a.w, vec3(b.x, b.y, b.z), b.w, vec3(c.x, c.y, c.z), c.w, int(d.x), d.y);
}

// Share of a spot's intensity in a direction at this cosine from its axis; smoothstep from the rim to the inner cone.
PURE float spot_factor(IN(Light) light, float cosine)
{
    float x = (cosine - light.cos_outer) / max(light.cos_inner - light.cos_outer, R(1e-7));
    float s = clamp(x, R(0.0), R(1.0));
    return s * s * (R(3.0) - R(2.0) * s);
}

// The part [x, y] of the line apex-relative `foot + s direction` (foot perpendicular to direction) that lies in the cone
// about `axis` of half angle acos(c), 0 <= c <= 1; x >= y where it is empty.
PURE vec2 line_in_cone(vec3 foot, vec3 direction, vec3 axis, float c)
{
    const vec2 empty = vec2(R(1.0), -R(1.0));
    float along = dot(direction, axis);
    float off = dot(foot, axis);
    if (c < R(1e-6)) {
        // Half of space.
        if (abs(along) < R(1e-6))
            return off >= R(0.0) ? vec2(-far_away, far_away) : empty;
        return along > R(0.0) ? vec2(-off / along, far_away) : vec2(-far_away, -off / along);
    }
    float a = (along - c) * (along + c);
    if (abs(a) < R(1e-12))
        a = -R(1e-12);
    float square = dot(foot, foot);
    float discriminant = off * off + a * square;
    // Within the cone's angle of its axis (a > 0) every line meets it, be it at the apex alone, where all else is zero.
    if (a < R(0.0) && (discriminant <= R(0.0) || off <= R(0.0)))
        return empty;
    float s = along * off;
    float root = c * sqrt(max(discriminant, R(0.0)));
    float q = s < R(0.0) ? root - s : -root - s;
    float first = q / a;
    float second = abs(q) > R(1e-30) ? (off * off - c * c * square) / q : first;
    float near = min(first, second);
    float far = max(first, second);
    if (a < R(0.0))
        return vec2(near, far);
    // Of two nappes the front one takes the end of the line that runs along the axis.
    return along > R(0.0) ? vec2(far, far_away) : vec2(-far_away, near);
}

// The part of the camera's ray that a light shines on, within [0, distance]; x >= y where that is nothing. c: cosine of the
// cone to be clipped at (cos_outer, or cos_inner for where a spot is at its full intensity).
PURE vec2 lit_interval(IN(Light) light, vec3 direction, float distance, float c)
{
    if (light.type != light_spot)
        return vec2(R(0.0), distance);
    float t0 = dot(light.position, direction);
    vec2 s = line_in_cone(t0 * direction - light.position, direction, light.direction, c);
    return vec2(clamp(t0 + s.x, R(0.0), distance), clamp(t0 + s.y, R(0.0), distance));
}
