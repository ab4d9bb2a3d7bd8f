// A light's shadow map by what the picture itself shows: rays from the light, marched through the picture's depth.
// Needs shadow_map.glsl.

// A surface is taken to be as thick as this share of its distance from the camera: light that passes behind it farther off goes on.
const float screen_thickness = R(0.02);

const int screen_steps = 1024;           // along a ray at most; else one for each pixel that it crosses
const float screen_reach = R(1e5);       // [m] from the light
const float screen_slope = R(0.02);      // pixels whose distances differ by less, of that distance, are of one surface

// What the picture has of the ray from + t direction for t in `range`; empty where it sees nothing of it.
PURE vec2 screen_part(IN(Camera) camera, ivec2 size, vec3 from, vec3 direction, vec2 range)
{
    vec2 first = -camera.center * camera.tangent_scale;
    vec2 last = (vec2(float(size.x), float(size.y)) - camera.center) * camera.tangent_scale;
    vec2 low = min(first, last);
    vec2 high = max(first, last);
    range = range_above(range, -from.z - R(1e-3) * length(from) - R(1e-6), -direction.z);
    range = range_above(range, from.x + low.x * from.z, direction.x + low.x * direction.z);
    range = range_above(range, -from.x - high.x * from.z, -direction.x - high.x * direction.z);
    range = range_above(range, from.y + low.y * from.z, direction.y + low.y * direction.z);
    return range_above(range, -from.y - high.y * from.z, -direction.y - high.y * direction.z);
}

PURE vec2 screen_pixel(IN(Camera) camera, vec3 point)
{
    return camera.center + vec2(point.x, point.y) / (-point.z * camera.tangent_scale);
}

// Distance to the surface that a pixel shows; far_away where it shows none.
PURE float screen_surface(IN(Camera) camera, sampler2D depth, ivec2 size, int x, int y)
{
    ivec2 pixel = ivec2(clamp(x, 0, size.x - 1), clamp(y, 0, size.y - 1));
    return ray_distance(camera, texelFetch(depth, pixel, 0).x,
                        length(ray_through(camera, vec2(float(pixel.x), float(pixel.y)) + R(0.5))));
}

// The same between pixels that show one surface. near: how far the ray is at most from what might matter, of its distance.
PURE float screen_surface_at(IN(Camera) camera, sampler2D depth, ivec2 size, vec2 place, float nearest, float farthest)
{
    float there = screen_surface(camera, depth, size, int(place.x), int(place.y));
    float slack = screen_slope * there;
    if (there >= far_away || nearest > there + screen_thickness * there + slack || farthest < there - slack)
        return there;
    int x = int(floor(place.x - R(0.5)));
    int y = int(floor(place.y - R(0.5)));
    float a = screen_surface(camera, depth, size, x, y);
    float b = screen_surface(camera, depth, size, x + 1, y);
    float c = screen_surface(camera, depth, size, x, y + 1);
    float d = screen_surface(camera, depth, size, x + 1, y + 1);
    if (max(max(a, b), max(c, d)) - min(min(a, b), min(c, d)) > slack)
        return there;
    float u = place.x - R(0.5) - float(x);
    return mix(mix(a, b, u), mix(c, d, u), place.y - R(0.5) - float(y));
}

// Where the ray first meets what the picture shows; far_away if nowhere. What holds the light itself is left out: what begins
// nearer than `begin`, and what the ray is in from there on.
PURE float screen_meets(IN(Camera) camera, sampler2D depth, vec3 from, vec3 direction, float begin)
{
    ivec2 size = textureSize(depth, 0);
    vec2 seen = screen_part(camera, size, from, direction, vec2(begin, screen_reach));
    if (!(seen.x < seen.y))
        return far_away;
    vec3 start = from + seen.x * direction;
    vec3 end = from + seen.y * direction;
    vec2 first = screen_pixel(camera, start);
    vec2 last = screen_pixel(camera, end);
    int steps = clamp(int(max(abs(last.x - first.x), abs(last.y - first.y))) + 1, 1, screen_steps);
    bool outside = seen.x > begin;
    float t = seen.x;
    float away = length(start);
    for (int i = 1; i <= steps; ++i) {
        // Even on the screen.
        float s = float(i) / float(steps);
        float next = i == steps ? seen.y : mix(seen.x, seen.y, s * start.z / ((R(1.0) - s) * end.z + s * start.z));
        float next_away = length(from + next * direction);
        float nearest = min(away, next_away);
        float farthest = max(away, next_away);
        float there = screen_surface_at(camera, depth, size, mix(first, last, (float(i) - R(0.5)) / float(steps)), nearest, farthest);
        float behind = there + screen_thickness * there;
        bool meets = there < far_away && nearest <= behind && farthest >= there;
        if (meets && outside) {
            float at = away <= there ? there : min(behind, away);
            float share = (at - away) / (next_away == away ? R(1.0) : next_away - away);
            return mix(t, next, clamp(share, R(0.0), R(1.0)));
        }
        outside = outside || !meets;
        t = next;
        away = next_away;
    }
    return far_away;
}

// A texel of the light's map; radius: the light's.
PURE float screen_shadow(IN(Camera) camera, sampler2D depth, sampler2D light_shadows, int light, float radius, ivec2 texel)
{
    vec4 x = data_texel(light_shadows, 5 * light);
    vec4 y = data_texel(light_shadows, 5 * light + 1);
    vec4 z = data_texel(light_shadows, 5 * light + 2);
    vec4 extent = data_texel(light_shadows, 5 * light + 3);
    vec4 rectangle = data_texel(light_shadows, 5 * light + 4);
    vec3 from = -(x.w * vec3(x.x, x.y, x.z) + y.w * vec3(y.x, y.y, y.z) + z.w * vec3(z.x, z.y, z.z));
    // Of the picture's middle, -1 to 1; the rows of all images run alike.
    float u = (R(2.0) * float(texel.x) + R(1.0)) / rectangle.z - R(1.0);
    float v = (R(2.0) * float(texel.y) + R(1.0)) / rectangle.w - R(1.0);
    v = camera.tangent_scale.y > R(0.0) ? v : -v;
    vec3 way = vec3(extent.y * u * rectangle.z / rectangle.w, extent.y * v, -R(1.0));
    if (int(extent.x) == shadow_latlong)
        way = vec3(sin(pi * u) * cos(R(0.5) * pi * v), sin(R(0.5) * pi * v), -cos(pi * u) * cos(R(0.5) * pi * v));
    vec3 direction = way.x * vec3(x.x, x.y, x.z) + way.y * vec3(y.x, y.y, y.z) + way.z * vec3(z.x, z.y, z.z);
    return screen_meets(camera, depth, from, direction / length(direction), R(1.1) * radius);
}
