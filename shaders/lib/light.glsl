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
