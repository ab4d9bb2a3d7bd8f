// The pixel's ray and the distance along it. Needs scene.glsl.

// Stands for infinity where shaders may not rely on IEEE infinities: products with it stay finite in 32 bits.
const float far_away = R(1e30);

// Farther away no medium that lamps shine through is told apart.
const float farthest_surface = R(1e12);

const int depth_planar = 0;
const int depth_ray = 1;
const int depth_inverse = 2;
const int depth_normalized = 3;
const int depth_device = 4;

const int sky_fog = 0;
const int sky_keep = 1;
const int sky_clamp = 2;

const int nonpositive_near = 1;

PURE vec3 in_world(IN(Camera) camera, vec3 d)
{
    return d.x * camera.right + d.y * camera.up + d.z * camera.back;
}

struct Ray {
    vec3 direction;  // unit, camera space, looking down -z
    float distance;  // to what the pixel shows [m], 0 to far_away
    Bool keep;       // a far pixel that is to have no medium in front of it
};

// Camera-space point of the pixel's ray at planar depth 1; pixel centres lie at half-integers.
PURE vec3 ray_through(IN(Camera) camera, vec2 pixel)
{
    vec2 tangent = (pixel - camera.center) * camera.tangent_scale;
    return vec3(tangent.x, tangent.y, -R(1.0));
}

// raw: the depth buffer's value; stretch: |ray_through|, the ray distance of planar depth 1.
// far_away for whatever counts as far: NaN, infinities, >= far_distance, <= 0 (see BRUME_DEPTH_... in brume.h).
PURE float ray_distance(IN(Camera) camera, float raw, float stretch)
{
    Bool is_far = !is_finite(raw);
    float along = raw * camera.metres_per_unit;
    if (camera.depth_kind == depth_inverse) {
        is_far = is_far || raw <= R(0.0);
        along = min(camera.metres_per_unit / raw, far_away);
    } else if (camera.depth_kind == depth_normalized) {
        is_far = is_far || raw < R(0.0) || raw >= R(1.0);
        along = camera.depth_range.x + raw * (camera.depth_range.y - camera.depth_range.x);
    } else if (camera.depth_kind == depth_device) {
        is_far = is_far || raw == choose(camera.depth_range.x < camera.depth_range.y, R(0.0), R(1.0));
        float inverse = mix(camera.depth_range.x, camera.depth_range.y, clamp(raw, R(0.0), R(1.0)));
        along = choose(inverse > R(1e-30), R(1.0) / inverse, far_away);
    } else if (camera.nonpositive == nonpositive_near) {
        along = max(along, R(0.0));
    } else {
        is_far = is_far || raw <= R(0.0);
    }
    is_far = is_far || along >= camera.far_distance;
    return choose(is_far, far_away, camera.depth_kind == depth_ray ? along : along * stretch);
}

PURE Ray pixel_ray(IN(Camera) camera, vec2 pixel, float raw)
{
    vec3 through = ray_through(camera, pixel);
    float stretch = length(through);
    float d = ray_distance(camera, raw, stretch);
    Bool is_far = d >= far_away;
    return Ray(through / stretch, choose(is_far && camera.sky == sky_clamp, camera.sky_distance, d),
               is_far && camera.sky == sky_keep);
}
