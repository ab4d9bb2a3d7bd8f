// Surfaces around lamps, as planes that take what light falls on them. Needs data.glsl, ray.glsl, light.glsl.
//
// Each lamp has six, across the world's axes, before and behind it. Where nobody says where they are, they are what the picture shows of
// surfaces in the six directions from the lamp that face back: at their mean distance, by solid angle, and by as much as they cover of
// what the picture shows there. What it does not show counts as more of the same where much is seen, and else as open.

const int sides = 6;  // low and high of x, of y, of z

const int surroundings_open = 0;
const int surroundings_ground = 1;  // a plane at a height on an axis
const int surroundings_seen = 2;

struct SurroundingsSettings {
    int kind;
    int axis;
    float height;  // of the camera over the plane [m]
};

// Of one lamp: its heights over the planes, and how much each counts.
struct Surroundings {
    vec3 low;
    vec3 high;
    vec3 low_weight;
    vec3 high_weight;
};

PURE Surroundings open_surroundings()
{
    return Surroundings(vec3(R(0.0)), vec3(R(0.0)), vec3(R(0.0)), vec3(R(0.0)));
}

PURE bool any_plane(IN(Surroundings) s)
{
    vec3 all = s.low_weight + s.high_weight;
    return all.x + all.y + all.z > R(0.0);
}

// surroundings: texel sides * lamp + side has height and weight.
PURE Surroundings surroundings_of(sampler2D surroundings, int lamp)
{
    Surroundings s = open_surroundings();
    for (int axis = 0; axis < 3; ++axis) {
        vec4 low = data_texel(surroundings, sides * lamp + 2 * axis);
        vec4 high = data_texel(surroundings, sides * lamp + 2 * axis + 1);
        s.low[axis] = low.x;
        s.low_weight[axis] = low.y;
        s.high[axis] = high.x;
        s.high_weight[axis] = high.y;
    }
    return s;
}

// How finely the picture is looked through.
const ivec2 surroundings_samples = ivec2(48, 27);

// Solid angle of a side: a sixth of all. What is seen of it is believed to go on where it is much more than the next.
const float side_angle = R(2.0943951);
const float little_seen = R(0.1);

// Normal of what the pixel shows, in camera space, by the next pixels; 0 where these show nothing.
PURE vec3 normal_seen(IN(Camera) camera, sampler2D depth, ivec2 size, ivec2 pixel, vec3 point)
{
    ivec2 aside = ivec2(pixel.x + 1 < size.x ? pixel.x + 1 : pixel.x - 1, pixel.y);
    ivec2 below = ivec2(pixel.x, pixel.y + 1 < size.y ? pixel.y + 1 : pixel.y - 1);
    if (aside.x < 0 || below.y < 0)
        return vec3(R(0.0));
    Ray a = pixel_ray(camera, vec2(aside) + R(0.5), texelFetch(depth, aside, 0).x);
    Ray b = pixel_ray(camera, vec2(below) + R(0.5), texelFetch(depth, below, 0).x);
    if (a.distance >= farthest_surface || b.distance >= farthest_surface)
        return vec3(R(0.0));
    vec3 u = a.distance * a.direction - point;
    vec3 v = b.distance * b.direction - point;
    vec3 n = cross(u / max(length(u), R(1e-20)), v / max(length(v), R(1e-20)));
    float size_of = length(n);
    if (!(size_of > R(1e-6)))
        return vec3(R(0.0));
    return (dot(n, point) > R(0.0) ? -n : n) / size_of;
}

// Texel `side` of this lamp: height and weight.
PURE vec4 surroundings_texel(IN(SurroundingsSettings) settings, IN(Camera) camera, sampler2D depth, ivec2 size, IN(Light) light,
                             int side)
{
    int axis = side / 2;
    Bool high = side - 2 * axis == 1;
    if (settings.kind == surroundings_open)
        return vec4(R(0.0));
    // A sun's ground is what the camera has around it.
    vec3 lamp = light.type == light_directional ? vec3(R(0.0)) : in_world(camera, light.position);
    if (settings.kind == surroundings_ground) {
        Bool is_ground = axis == settings.axis && !high;
        return is_ground ? vec4(max(lamp[axis] + settings.height, R(0.0)), R(1.0), R(0.0), R(0.0)) : vec4(R(0.0));
    }
    // Sky is no wall, wherever the medium in front of it is to end.
    Camera eye = camera;
    eye.sky = sky_fog;
    float covered = R(0.0);
    float open = R(0.0);
    float far = R(0.0);
    vec2 cell = vec2(size) / vec2(surroundings_samples);
    float sample_area = abs(camera.tangent_scale.x * cell.x * camera.tangent_scale.y * cell.y);
    for (int j = 0; j < surroundings_samples.y; ++j)
        for (int i = 0; i < surroundings_samples.x; ++i) {
            ivec2 pixel = clamp(ivec2((vec2(float(i), float(j)) + R(0.5)) * cell), ivec2(0), size - 1);
            vec2 center = vec2(pixel) + R(0.5);
            Ray ray = pixel_ray(eye, center, texelFetch(depth, pixel, 0).x);
            float stretch = length(ray_through(camera, center));
            float angle = sample_area / (stretch * stretch * stretch);
            vec3 direction = in_world(camera, ray.direction);
            Bool seen = ray.distance < farthest_surface;
            vec3 to = seen ? ray.distance * direction - lamp : direction;
            float along = high ? to[axis] : -to[axis];
            vec3 size_of = abs(to);
            if (!(along > R(0.0)))
                continue;
            if (!seen) {
                if (max(max(size_of.x, size_of.y), size_of.z) <= along)
                    open += angle;
                continue;
            }
            vec3 normal = in_world(camera, normal_seen(eye, depth, size, pixel, ray.distance * ray.direction));
            float facing = max(high ? -normal[axis] : normal[axis], R(0.0));
            // What the sample covers of the plane, as the lamp sees it. Near it, that is no more than the side.
            float away = length(to);
            float area = angle * ray.distance * ray.distance / max(abs(direction[axis]), R(0.03));
            float share = min(area * along / max(away * away * away, R(1e-30)), R(0.1) * side_angle);
            covered += facing * facing * share;
            far += facing * facing * share * along;
        }
    if (!(covered > R(1e-9)))
        return vec4(R(0.0));
    float belief = covered * covered / (covered * covered + little_seen * side_angle * little_seen * side_angle);
    return vec4(far / covered, belief * covered / (covered + open), R(0.0), R(0.0));
}
