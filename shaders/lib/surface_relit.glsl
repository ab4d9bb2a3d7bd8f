// Pixels whose lights' parts are known, or shared out. Needs what surface.glsl says of each light: change_by_light(), lit_by_map(),
// sent_of_light(), and of the sky: sky_irradiance(), sky_change(), sent_of_sky(). Of lamps alone pixels of a row may go side by side.

#define SURFACE_IMAGES sampler2D lights, sampler2D ungrouped, sampler2D light_gaussians, sampler2D environment, sampler2D table
#define SURFACE_PASSED lights, ungrouped, light_gaussians, environment, table

// Loops over lights are asked at their end: software OpenGL goes through a loop's body once more, for no pixel, after one that is asked at
// its begin.

// What `ungrouped` has of each light.
const int part_none = 0;       // it has no part in surfaces
const int part_ungrouped = 1;  // one in what no light's own layer has
const int part_grouped = 2;    // a layer of its own

// Of this light, where it has a part in what no light's own layer has.
PURE vec3 ungrouped_irradiance(IN(Camera) camera, IN(SurfaceSettings) settings, SHADOW_MAP_IMAGES, IN(Surface) surface,
                               IN(Light) light, int index)
{
    return lit_by_map(camera, settings.shadowed, SHADOW_MAP_PASSED, surface, index) * clear_irradiance(surface, light);
}

// What no lamp's own layer has becomes this: each lamp's part by what it gives in clear air, and the environment's.
PURE vec3 rest_received(IN(Medium) medium, IN(LampColours) colours, IN(Camera) camera, IN(SurfaceSettings) settings, SURFACE_IMAGES,
                        SHADOW_MAP_IMAGES, IN(Surface) surface, IN(Material) material, IN(Shine) shine, vec3 rest)
{
    int count = may_have(settings, without_ungrouped) ? settings.light_count : 0;
    // Of a highlight's light the medium leaves less, so that what a light's part is must be known first.
    bool glossy = settings.material > 1;
    vec3 all = vec3(R(0.0));
    vec3 changed = vec3(R(0.0));
    vec3 brought = vec3(R(0.0));
    int l = 0;
    if (count > 0)
        do {
            if (int(data_texel(ungrouped, l).x) != part_ungrouped)
                continue;
            Light light = surface_light(settings, lights, l);
            vec3 irradiance = ungrouped_irradiance(camera, settings, SHADOW_MAP_PASSED, surface, light, l);
            all = min(all + irradiance, vec3(radiance_limit));
            if (!glossy) {
                float p = density_to_lamp(medium, camera, settings, surface, l, light, light_gaussians);
                Change change = change_by_light(medium, colours, settings, surface, light, material, shine, p, table);
                changed += irradiance * (change.along - vec3(R(1.0)));
                brought += change.brought;
            }
        } while (++l < count);
    vec3 sky = sky_irradiance(camera, settings, environment, surface);
    vec3 scale = vec3(R(1.0)) / max(all + sky, vec3(R(1e-30)));
    vec3 change = rest * (changed * scale) + brought +
                  sky_change(medium, camera, settings, light_gaussians, environment, table, surface, material, rest * (sky * scale));
    l = 0;
    if (glossy && count > 0)
        do {
            if (int(data_texel(ungrouped, l).x) != part_ungrouped)
                continue;
            Light light = surface_light(settings, lights, l);
            vec3 own = rest * (ungrouped_irradiance(camera, settings, SHADOW_MAP_PASSED, surface, light, l) * scale);
            float p = density_to_lamp(medium, camera, settings, surface, l, light, light_gaussians);
            change += becomes(change_by_light(medium, colours, settings, surface, light, material, shine, p, table), own) - own;
        } while (++l < count);
    return max(rest + change, min(rest, vec3(R(0.0))));
}

// With a transfer the light that the medium brings to diffuse surfaces is the pass's for that.
PURE Material as_relit(IN(SurfaceSettings) settings, IN(Material) material)
{
    Material m = material;
    if (settings.transfer > 0)
        m.albedo = vec3(R(0.0));
    return m;
}

// What a pixel shows of surfaces before and after: what is still to be divided among lamps, and what was.
struct Divided {
    vec3 rest;
    vec3 lit;
};

// group: light l's own layer of the picture.
PURE Divided divided_by_group(IN(Medium) medium, IN(LampColours) colours, IN(Camera) camera, IN(SurfaceSettings) settings,
                              IN(Surface) surface, IN(Material) material, IN(Shine) shine, sampler2D lights, sampler2D light_gaussians,
                              sampler2D table, IN(Divided) pixel, int l, vec3 group)
{
    vec3 own = finite_or_zero(group);
    vec3 lit = own;
    if (some(surface.seen)) {
        Light light = surface_light(settings, lights, l);
        float p = density_to_lamp(medium, camera, settings, surface, l, light, light_gaussians);
        lit = chosen(surface.seen,
                     becomes(change_by_light(medium, colours, settings, surface, light, material, shine, p, table), own), own);
    }
    return Divided(pixel.rest - own, min(pixel.lit + lit, vec3(radiance_limit)));
}

// The pixel in the end; source: as it was.
PURE vec3 relit(IN(Medium) medium, IN(LampColours) colours, IN(Camera) camera, IN(SurfaceSettings) settings, SURFACE_IMAGES,
                SHADOW_MAP_IMAGES, IN(Surface) surface, IN(Material) material, IN(Shine) shine, vec3 source, IN(Divided) pixel,
                float limit)
{
    if (!some(surface.seen))
        return source;
    vec3 sum = rest_received(medium, colours, camera, settings, SURFACE_PASSED, SHADOW_MAP_PASSED, surface, material, shine,
                             finite_or_zero(pixel.rest)) + pixel.lit;
    return chosen(surface.seen, compose_radiance(source, vec3(R(0.0)), sum, limit), source);
}

// Light that the medium brings to diffuse surfaces with a transfer. in_axes: the environment's coefficients in the transfer's axes.
PURE vec3 brought_by_transfer(IN(Medium) medium, IN(LampColours) colours, IN(Camera) camera, IN(SurfaceSettings) settings, SURFACE_IMAGES,
                              sampler2D in_axes, IN(Surface) surface, vec3 albedo, IN(Transfer) transfer)
{
    Bool there = surface.seen && has_normal(surface);
    if (!some(there))
        return vec3(R(0.0));
    vec3 sum = sent_of_sky(medium, camera, settings, light_gaussians, environment, in_axes, table, surface, transfer);
    for (int l = 0; l < settings.light_count; ++l)
        if (int(data_texel(ungrouped, l).x) != part_none) {
            Light light = surface_light(settings, lights, l);
            float p = density_to_lamp(medium, camera, settings, surface, l, light, light_gaussians);
            sum += sent_of_light(medium, colours, camera, settings, surface, light, transfer, p, table);
        }
    return chosen(there, min(reflectance(albedo) * sum, vec3(radiance_limit)), vec3(R(0.0)));
}

// A point of the surface that a neighbouring pixel shows, relative to `point`; huge where it shows none.
PURE vec3 step_to(IN(Ray) ray, vec3 point)
{
    return chosen(ray.distance < farthest_surface, ray.distance * ray.direction - point, vec3(R(1e15)));
}

// Of two steps, one against the other, the shorter: beyond an edge surfaces are far.
PURE vec3 shorter_step(vec3 after, vec3 before)
{
    return chosen(dot(after, after) <= dot(before, before), after, -before);
}

PURE vec3 normal_by_depth(IN(Ray) ray, IN(Ray) left, IN(Ray) right, IN(Ray) before, IN(Ray) after)
{
    Bool seen = ray.distance < farthest_surface;
    vec3 point = choose(seen, ray.distance, R(0.0)) * ray.direction;
    vec3 u = shorter_step(step_to(right, point), step_to(left, point));
    vec3 v = shorter_step(step_to(after, point), step_to(before, point));
    vec3 n = cross(u / max(length(u), R(1e-20)), v / max(length(v), R(1e-20)));
    float size = length(n);
    Bool known = seen && max(dot(u, u), dot(v, v)) <= R(1e26) && size >= R(1e-6);
    return chosen(known, n / choose(dot(n, ray.direction) > R(0.0), -size, size), vec3(R(0.0)));
}
