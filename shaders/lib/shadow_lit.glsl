// Whether a light that has a shadow map reaches a ray of the camera at some distance. Needs value.glsl. What is to know of the map
// is in shadow_map.glsl; of pixels side by side all have the same map.

const int shadow_perspective = 1;
const int shadow_latlong = 3;

// A thing begins to shadow one texel's width behind its depth in the map, as wide as the texel is there: as far as a surface that
// faces the light by half may be off its texel's centre.
const float shadow_bias = R(1.0);

// Depths of neighbours that differ by less, in texels' widths, are of one surface: what is between them is interpolated.
const float shadow_slope = R(4.0);

// A ray of the camera on a light's map.
struct ShadowRay {
    int kind;          // 0: nothing of the ray is in a map
    int along_ray;     // 1: the map has distances along its rays
    ivec2 corner;      // of its rectangle
    ivec2 size;
    vec3 from;         // where the ray begins, in the space of the map's camera [m]
    vec3 direction;
    vec2 scale;        // texels per tangent, orthographic: per metre, lat-long: per radian; y as the image's rows run
    float texel;       // a texel's width at distance 1, orthographic: anywhere
    vec2 seen;         // the part of the ray that the map sees: beyond, all is lit
    float steps;       // whole
    float foot;        // where the ray is nearest to a lat-long map's place, and how far it is from there
    float height;
};

PURE vec3 shadow_place(IN(ShadowRay) ray, float t)
{
    return ray.from + t * ray.direction;
}

// Position in the map, texel centres at half-integers.
PURE vec2 shadow_position(IN(ShadowRay) ray, vec3 place)
{
    vec2 size = vec2(float(ray.size.x), float(ray.size.y));
    vec2 seen = vec2(place.x, place.y);
    if (ray.kind == shadow_latlong) {
        float across = sqrt(place.x * place.x + place.z * place.z);
        seen = vec2(choose(across > R(0.0), atan(place.x, -place.z), R(0.0)), atan(place.y, max(across, R(1e-20))));
    } else if (ray.kind == shadow_perspective) {
        seen = seen / max(-place.z, R(1e-20));
    }
    vec2 position = R(0.5) * size + ray.scale * seen;
    return vec2(clamp(position.x, R(0.0), size.x), clamp(position.y, R(0.0), size.y));
}

// Where the ray is step `step` of `steps`: even in the map.
PURE float shadow_step(IN(ShadowRay) ray, int step)
{
    if (step <= 0)
        return ray.seen.x;
    float s = float(step) / ray.steps;
    float t = mix(ray.seen.x, ray.seen.y, s);
    if (ray.kind == shadow_latlong) {
        // Even in the angle that the ray sweeps.
        float first = atan(ray.seen.x - ray.foot, ray.height);
        float at = first + s * (atan(ray.seen.y - ray.foot, ray.height) - first);
        t = clamp(ray.foot + ray.height * sin(at) / max(cos(at), R(1e-20)), ray.seen.x, ray.seen.y);
    } else if (ray.kind == shadow_perspective) {
        float first = -shadow_place(ray, ray.seen.x).z;
        float last = -shadow_place(ray, ray.seen.y).z;
        t = mix(ray.seen.x, ray.seen.y, s * first / max((R(1.0) - s) * last + s * first, R(1e-30)));
    }
    return choose(float(step) < ray.steps, t, ray.seen.y);
}

// Depth that the map has there, at whole numbers [m]; far_away where nothing is.
PURE float shadow_depth_at(sampler2D shadow_maps, IN(ShadowRay) ray, float x, float y)
{
    float width = float(ray.size.x);
    float height = float(ray.size.y);
    if (ray.kind == shadow_latlong)
        x = choose(x < R(0.0), x + width, choose(x >= width, x - width, x));
    // What is no number is 0.
    return value_at(shadow_maps, float(ray.corner.x) + min(max(R(0.0), x), width - R(1.0)),
                    float(ray.corner.y) + min(max(R(0.0), y), height - R(1.0)));
}

// Whether the light reaches the ray at t.
PURE Bool is_lit(sampler2D shadow_maps, IN(ShadowRay) ray, float t)
{
    vec3 place = shadow_place(ray, t);
    vec2 position = shadow_position(ray, place);
    bool radial = ray.kind == shadow_latlong || (ray.kind == shadow_perspective && ray.along_ray == 1);
    float there = radial ? length(place) : -place.z;
    float depth = shadow_depth_at(shadow_maps, ray, floor(position.x), floor(position.y));
    float width = ray.texel;
    if (ray.kind == shadow_perspective || ray.kind == shadow_latlong)
        width = ray.texel * depth;
    Bool lit = there <= depth;
    Bool seen = t >= ray.seen.x && t <= ray.seen.y;
    // Farther from the depth, what the neighbours say could not change it.
    Bool near = seen && abs(there - depth) <= (shadow_slope + shadow_bias) * width;
    if (some(near)) {
        float x = floor(position.x - R(0.5));
        float y = floor(position.y - R(0.5));
        float a = shadow_depth_at(shadow_maps, ray, x, y);
        float b = shadow_depth_at(shadow_maps, ray, x + R(1.0), y);
        float c = shadow_depth_at(shadow_maps, ray, x, y + R(1.0));
        float d = shadow_depth_at(shadow_maps, ray, x + R(1.0), y + R(1.0));
        float u = position.x - R(0.5) - x;
        float between = mix(mix(a, b, u), mix(c, d, u), position.y - R(0.5) - y);
        Bool one_surface = max(max(a, b), max(c, d)) - min(min(a, b), min(c, d)) < shadow_slope * width;
        depth = choose(one_surface, between, depth);
        lit = (near && there <= depth + shadow_bias * width) || (!near && lit);
    }
    return lit || !seen;
}
