// Shadows of solid things: depth pictures from lights ("shadow maps"), and which parts of a ray they let a light shine on.
// Needs data.glsl, ray.glsl, phase.glsl, shadow_lit.glsl. Products "light_shadows" of brume_plugin.h:
//
//   light_shadows  5 texels per light: three rows that bring a point of camera space [m], 1 appended, into the space of the map's
//                  camera; shadow_kind (0: no map), shadow_extent, 1 where distances are along rays, 0; x, y, width and height of
//                  the map's rectangle in shadow_maps
//   shadow_maps    all maps side by side: distance from the map's camera [m], far_away where nothing is

#define SHADOW_MAP_IMAGES sampler2D light_shadows, sampler2D shadow_maps
#define SHADOW_MAP_PASSED light_shadows, shadow_maps

const int shadow_steps = 1024;  // along a ray at most; else one for each texel that it crosses
const int shadow_halvings = 40;   // at most, of a step in which a shadow begins or ends

// What a map brings: planar and along the ray in units, device as 1/m at 0 and at 1 or, of an orthographic map, normalized as [m].
struct ShadowDepth {
    int kind;     // as Camera.depth_kind
    float unit;   // [m]
    vec2 range;
};

// Distance [m], or far_away where nothing is.
PURE float shadow_distance(IN(ShadowDepth) depth, float raw)
{
    if (!is_finite(raw))
        return far_away;
    float distance = raw * depth.unit;
    if (depth.kind == depth_device || depth.kind == depth_normalized) {
        bool rises = depth.range.x < depth.range.y;
        float value = mix(depth.range.x, depth.range.y, clamp(raw, R(0.0), R(1.0)));
        bool inverse = depth.kind == depth_device;
        if (raw == (rises == inverse ? R(0.0) : R(1.0)))
            return far_away;
        distance = !inverse ? value : value > R(1e-30) ? R(1.0) / value : far_away;
    }
    return distance > R(0.0) ? min(distance, far_away) : far_away;
}

// What of the range has at + t by >= 0.
PURE vec2 range_above(vec2 range, float at, float by)
{
    if (abs(by) < R(1e-20))
        return at >= R(0.0) ? range : vec2(range.x, range.x - R(1.0));
    float t = -at / by;
    return by > R(0.0) ? vec2(max(range.x, t), range.y) : vec2(range.x, min(range.y, t));
}

// The part [from, to] of a ray.
PURE ShadowRay shadow_section(ShadowRay ray, float from, float to)
{
    ray.seen = vec2(max(ray.seen.x, from), min(ray.seen.y, to));
    if (ray.kind == shadow_latlong) {
        float swept = atan(ray.seen.y - ray.foot, ray.height) - atan(ray.seen.x - ray.foot, ray.height);
        ray.steps = float(clamp(int(swept / ray.texel) + 1, 1, shadow_steps));
        return ray;
    }
    vec2 way = shadow_position(ray, shadow_place(ray, ray.seen.y)) - shadow_position(ray, shadow_place(ray, ray.seen.x));
    ray.steps = float(clamp(int(max(abs(way.x), abs(way.y))) + 1, 1, shadow_steps));
    return ray;
}

// shadowed: 0 where no light has a map.
PURE ShadowRay shadow_ray(IN(Camera) camera, SHADOW_MAP_IMAGES, int shadowed, int light, vec3 direction, float distance)
{
    ShadowRay ray;
    ray.kind = 0;
    ray.along_ray = 0;
    ray.corner = ivec2(0, 0);
    ray.size = ivec2(1, 1);
    ray.from = vec3(R(0.0));
    ray.direction = direction;
    ray.scale = vec2(R(1.0));
    ray.texel = R(0.0);
    ray.seen = vec2(R(0.0), distance);
    ray.steps = R(1.0);
    ray.foot = R(0.0);
    ray.height = R(0.0);
    if (shadowed == 0)
        return ray;
    vec4 extent = data_texel(light_shadows, 5 * light + 3);
    ray.kind = int(extent.x);
    if (ray.kind == 0)
        return ray;
    vec4 x = data_texel(light_shadows, 5 * light);
    vec4 y = data_texel(light_shadows, 5 * light + 1);
    vec4 z = data_texel(light_shadows, 5 * light + 2);
    vec4 rectangle = data_texel(light_shadows, 5 * light + 4);
    ray.along_ray = int(extent.z);
    ray.corner = ivec2(int(rectangle.x), int(rectangle.y));
    ray.size = ivec2(int(rectangle.z), int(rectangle.w));
    ray.from = vec3(x.w, y.w, z.w);
    ray.direction = vec3(dot(vec3(x.x, x.y, x.z), direction), dot(vec3(y.x, y.y, y.z), direction), dot(vec3(z.x, z.y, z.z), direction));
    if (ray.kind == shadow_latlong) {
        ray.foot = -dot(ray.from, ray.direction);
        ray.height = max(length(shadow_place(ray, ray.foot)), R(1e-6));
        ray.texel = pi / float(ray.size.y);
        float rows = float(ray.size.y) / pi;
        ray.scale = vec2(float(ray.size.x) / (R(2.0) * pi), camera.tangent_scale.y > R(0.0) ? rows : -rows);
        return shadow_section(ray, R(0.0), distance);
    }
    bool perspective = ray.kind == shadow_perspective;
    float width = float(ray.size.x);
    float height = float(ray.size.y);
    float half_width = perspective ? extent.y * (width / height) : extent.y;
    float half_height = perspective ? extent.y : extent.y * (height / width);
    ray.texel = R(2.0) * half_width / width;
    // The rows of all images run alike.
    ray.scale = vec2(R(0.5) * width / half_width, (camera.tangent_scale.y > R(0.0) ? R(0.5) : -R(0.5)) * height / half_height);

    vec3 from = ray.from;
    vec3 by = ray.direction;
    float away = perspective ? -from.z : R(1.0);
    float away_by = perspective ? -by.z : R(0.0);
    vec2 seen = range_above(vec2(R(0.0), distance), -from.z, -by.z);
    seen = range_above(seen, half_width * away + from.x, half_width * away_by + by.x);
    seen = range_above(seen, half_width * away - from.x, half_width * away_by - by.x);
    seen = range_above(seen, half_height * away + from.y, half_height * away_by + by.y);
    seen = range_above(seen, half_height * away - from.y, half_height * away_by - by.y);
    ray.seen = seen;
    ray = shadow_section(ray, R(0.0), distance);
    if (!(seen.x < seen.y))
        ray.kind = 0;
    return ray;
}

// The lit parts up to `end` one after another: begin with lit_walk(), then next_lit() gives one each time, empty after the last.
struct LitWalk {
    int step;   // -1 stands for the ray's begin, steps + 1 for its end
    float at;
    bool lit;   // there
    vec2 part;
};

PURE LitWalk lit_walk(float from)
{
    return LitWalk(-1, from, true, vec2(from));
}

PURE LitWalk next_lit(sampler2D shadow_maps, IN(ShadowRay) ray, LitWalk walk, float end)
{
    float begin = walk.at;
    if (ray.kind == 0) {
        walk.part = vec2(begin, end);
        walk.at = end;
        return walk;
    }
    while (float(walk.step) <= ray.steps) {
        float low = walk.at;
        walk.step += 1;
        bool outside = float(walk.step) > ray.steps;
        float high = outside ? ray.seen.y : shadow_step(ray, walk.step);
        bool now = outside || is_lit(shadow_maps, ray, high);
        walk.at = high;
        if (now == walk.lit)
            continue;
        if (outside || walk.step == 0)
            low = high;
        for (int i = 0; i < shadow_halvings && high - low > R(1e-5) * high; ++i) {
            float middle = R(0.5) * (low + high);
            if (is_lit(shadow_maps, ray, middle) == walk.lit)
                low = middle;
            else
                high = middle;
        }
        walk.lit = now;
        if (now) {
            begin = high;
        } else if (begin < low) {
            walk.part = vec2(begin, low);
            return walk;
        }
    }
    walk.part = walk.lit ? vec2(begin, end) : vec2(end);
    walk.lit = false;
    return walk;
}

// How much of [from, to] is lit: a share of 1.
PURE float lit_share(sampler2D shadow_maps, IN(ShadowRay) ray, float from, float to)
{
    ShadowRay section = shadow_section(ray, from, to);
    if (!(section.seen.x < section.seen.y))
        return R(1.0);
    float lit = R(0.0);
    LitWalk walk = next_lit(shadow_maps, section, lit_walk(from), to);
    while (walk.part.x < walk.part.y) {
        lit += walk.part.y - walk.part.x;
        walk = next_lit(shadow_maps, section, walk, to);
    }
    return min(lit / max(to - from, R(1e-20)), R(1.0));
}
