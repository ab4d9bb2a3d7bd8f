// What the medium between lamps and surfaces makes of the light that surfaces receive. Needs airlight.glsl, lamp_field.glsl,
// environment.glsl.
#include "surface_published.glsl"

// Method `calibrated`. A lamp gives a plane that takes all that falls on it, under the cosine c at r, in clear air I c / r^2, and in
// the medium
//   I / r^2 [ N(x) c + (1 - a) (h' x^2 / x'^3 N(x') + k x / (1 + (10.7 - 4.3 g) x^2) N(x)) ],  x = s' r,  a = sigma_a / s',
// N being the lamp's net flux in an endless medium; h' = c x + 1.42 the height of its image below the plane, x' the way from there,
// which is right from afar; k what one scattering gives more than it takes, fitted to paths (surface_calibration says how
// well). Nothing is lost in fog that does not absorb: what leaves the beam arrives from aside.

// Light that comes flatter than so counts as if it came so. Its own share of the picture goes to nothing, and what else is there,
// from surface to surface, must not be taken for it.
const float least_cosine = R(0.1);

// Of a lamp's irradiance in clear air facing it: what comes the lamp's way, and what comes from aside and has no cosine.
struct Received {
    float along;
    float aside;
};

// scattering, absorption: optical depths of the way.
PURE Received received(float scattering, float absorption, float asymmetry, float cosine)
{
    float g = clamp(asymmetry, -largest_asymmetry, largest_asymmetry);
    float s = min(scattering, orders_depth_limit);
    float d = min(absorption, orders_depth_limit);
    float x = d + (R(1.0) - g) * s;
    if (!(x > R(1e-9)))
        return Received(R(1.0), R(0.0));
    float a = d / x;
    float c = clamp(cosine, R(0.0), R(1.0));
    float up = c * x + R(1.42);
    float square = x * x * (R(1.0) - c * c) + up * up;
    float below = sqrt(square);
    float image = up * (x / square) * (x / below) * net_flux(s * (below / x), d * (below / x), g);
    float forward = max(g, R(0.0));
    float once = (R(1.0) - forward) * (R(0.31) - R(0.57) * forward) +
                 (R(1.0) - c) * (R(0.18) + forward * (R(0.88) - R(0.65) * forward));
    float net = net_flux(s, d, g);
    float aside = image + once * x / (R(1.0) + (R(10.7) - R(4.3) * forward) * x * x) * net;
    return Received(net, (R(1.0) - a) * aside);
}

// What a surface receives of a lamp over what it would in clear air.
PURE float received_share(float scattering, float absorption, float asymmetry, float cosine)
{
    Received r = received(scattering, absorption, asymmetry, cosine);
    return max(r.along + r.aside / max(cosine, least_cosine), R(0.0));
}

// The same by a published method, whose `aside` comes at all cosines.
PURE Received published(int method, sampler2D table, float scattering, float absorption, float cosine)
{
    float depth = min(scattering + absorption, orders_depth_limit);
    float once = scattering / max(scattering + absorption, R(1e-30)) * pi * published_lobe(method, table, depth, R(1.0), cosine);
    return Received(exp(-depth), once);
}

struct SurfaceSettings {
    int method;
    int light_count;
    int gaussian_count;
    int environment_order;
    int world_normals;
    int material;  // how much of it frames bring: 1 albedo, 2 also specular and roughness
    int shadowed;  // as AirlightSettings has it
    float ground;  // albedo of what lies below, for suns and sky
};

// What a surface receives of a lamp over what it would in clear air, by the method that is asked for.
PURE float share_by_method(IN(SurfaceSettings) settings, sampler2D table, float scattering, float absorption, float asymmetry,
                           float cosine)
{
    if (settings.method == method_calibrated)
        return received_share(scattering, absorption, asymmetry, cosine);
    Received r = published(settings.method, table, scattering, absorption, cosine);
    return r.along + r.aside / max(cosine, least_cosine);
}

// Where the surface is, and how it lies.
struct Surface {
    Bool seen;    // there is one
    vec3 point;   // camera space [m]
    vec3 normal;  // unit; 0 where nobody knows it: then it counts as facing every lamp
};

PURE Surface surface_at(IN(Ray) ray, vec3 normal)
{
    Bool seen = !ray.keep && ray.distance < farthest_surface;
    float size = length(normal);
    Bool known = is_finite(size) && size > R(1e-6);
    vec3 unit = vec3(choose(known, normal.x / size, R(0.0)), choose(known, normal.y / size, R(0.0)),
                     choose(known, normal.z / size, R(0.0)));
    return Surface(seen, choose(seen, ray.distance, R(0.0)) * ray.direction, unit);
}

// 1 where the light's shadow map lets its light onto the surface, or it has none.
PURE float lit_by_map(IN(Camera) camera, int shadowed, SHADOW_MAP_IMAGES, IN(Surface) surface, int light)
{
    float distance = length(surface.point);
    if (shadowed == 0 || distance <= R(0.0))
        return R(1.0);
    ShadowRay ray = shadow_ray(camera, SHADOW_MAP_PASSED, shadowed, light, surface.point / distance, R(1.01) * distance);
    return ray.kind == 0 || is_lit(shadow_maps, ray, distance) ? R(1.0) : R(0.0);
}

// d, of the world, in camera axes.
PURE vec3 in_camera(IN(Camera) camera, vec3 d)
{
    return vec3(dot(d, camera.right), dot(d, camera.up), dot(d, camera.back));
}

// Cosine between the normal and the way to the lamp.
PURE float cosine_to(IN(Surface) surface, IN(Light) light)
{
    if (surface.normal == vec3(R(0.0)))
        return R(1.0);
    if (light.type == light_directional)
        return -dot(surface.normal, light.direction);
    vec3 way = light.position - surface.point;
    return dot(surface.normal, way) / max(length(way), R(1e-20));
}

// Irradiance in clear air and without shadows.
PURE vec3 clear_irradiance(IN(Surface) surface, IN(Light) light)
{
    float strength = clamp(cosine_to(surface, light), R(0.0), R(1.0));
    if (light.type != light_directional) {
        vec3 from = surface.point - light.position;
        strength *= fluence(max(length(from), smallest_light), light.radius);
        if (light.type == light_spot)
            strength *= spot_factor(light, dot(from, light.direction) / max(length(from), R(1e-20)));
    }
    return min(min(strength, radiance_limit) * light.intensity, vec3(radiance_limit));
}

// int rho dt between a surface and a lamp.
PURE float density_to_lamp(IN(Medium) medium, IN(Surface) surface, IN(Light) light, sampler2D gaussians, int gaussian_count)
{
    vec3 way = light.position - surface.point;
    float distance = length(way);
    vec3 direction = way / max(distance, R(1e-20));
    if (light.type == light_directional) {
        distance = far_away;
        direction = -light.direction;
    }
    float p = terms_to_light(medium, light, surface.point);
    for (int i = 0; i < gaussian_count; ++i)
        p += profile_depth(profile_along(gaussian_at(gaussians, i), surface.point, direction), R(0.0), distance);
    return clamp(p, R(0.0), density_limit);
}

// Cosine between the normal and the way up.
PURE float cosine_up(IN(Surface) surface, vec3 up)
{
    return surface.normal == vec3(R(0.0)) ? R(1.0) : clamp(dot(surface.normal, up), R(-1.0), R(1.0));
}

// Of a sun's irradiance across its rays, at these optical depths of the way to it: diffuse light comes from above alike.
PURE Received received_of_sun(IN(SurfaceSettings) settings, float scattering, float absorption, float asymmetry, float sun_up,
                              float normal_up)
{
    float s = scattering * sun_up;
    float a = absorption * sun_up;
    SlabField field = slab_field(vec2(s), vec2(a), asymmetry, R(1.0), sun_up, settings.ground);
    return Received(field.straight, field.down * R(0.5) * (R(1.0) + normal_up));
}

// share_by_method() of each colour; of suns by method calibrated alone, else theirs stays as it is.
PURE vec3 received_of_light(IN(Medium) medium, IN(SurfaceSettings) settings, IN(Surface) surface, IN(Light) light,
                            sampler2D gaussians, sampler2D table)
{
    bool sun = light.type == light_directional;
    if (sun && settings.method != method_calibrated)
        return vec3(R(1.0));
    SunSlant slant = SunSlant(vec3(R(0.0)), R(1.0));
    if (sun)
        slant = sun_slant(medium, light.direction, surface.point);
    float p = density_to_lamp(medium, surface, light, gaussians, settings.gaussian_count);
    float cosine = cosine_to(surface, light);
    vec3 share = vec3(R(1.0));
    for (int c = 0; c < 3; ++c) {
        if (c > 0 && medium.scattering[c] == medium.scattering[c - 1] && medium.absorption[c] == medium.absorption[c - 1])
            share[c] = share[c - 1];
        else if (sun) {
            Received r = received_of_sun(settings, min(medium.scattering[c] * p, orders_depth_limit),
                                         min(medium.absorption[c] * p, orders_depth_limit), medium.asymmetry, slant.cosine,
                                         cosine_up(surface, slant.up));
            share[c] = r.along + r.aside / max(cosine, least_cosine);
        } else
            share[c] = share_by_method(settings, table, min(medium.scattering[c] * p, orders_depth_limit),
                                       min(medium.absorption[c] * p, orders_depth_limit), medium.asymmetry, cosine);
    }
    return share;
}

// What the picture's maker knows of the surface.
struct Material {
    Bool known;     // albedo is
    vec3 albedo;    // of diffuse reflection
    vec3 specular;  // of glossy reflection; 0 where nobody knows
    Bool tint;      // specular is the colour of a dielectric's reflection, of which it reflects as much as Fresnel says
    float exponent; // of Phong's lobe that stands for it
};

PURE Material unknown_material()
{
    return Material(false, vec3(R(0.0)), vec3(R(0.0)), false, R(1.0));
}

// roughness: as renderers have it, the root of a microfacet distribution's alpha.
PURE float phong_exponent(float roughness)
{
    float alpha = clamp(roughness * roughness, R(0.005), R(1.0));
    return R(0.5) / (alpha * alpha) - R(0.5);
}

PURE Material material_of(int parts, vec3 albedo, vec3 specular, float roughness)
{
    if (parts == 0)
        return unknown_material();
    Bool glossy = parts > 1 && is_finite(roughness) && roughness < R(1.0);
    vec3 of_gloss = glossy ? clamp(finite_or_zero(specular), vec3(R(0.0)), vec3(R(1.0))) : vec3(R(0.0));
    vec3 of_all = clamp(finite_or_zero(albedo), vec3(R(0.0)), vec3(R(1.0)));
    vec3 both = of_all + of_gloss;
    // No surface reflects more than it receives.
    Bool tint = max(max(both.x, both.y), both.z) > R(1.0);
    return Material(true, of_all, of_gloss, tint, glossy ? phong_exponent(roughness) : R(1.0));
}

// Of a pixel; parts: as SurfaceSettings::material.
PURE Material material_at(int parts, sampler2D albedo, sampler2D specular, sampler2D roughness, ivec2 p)
{
    if (parts == 0)
        return unknown_material();
    vec3 of_gloss = vec3(R(0.0));
    float rough = R(1.0);
    if (parts > 1) {
        of_gloss = vec3(texelFetch(specular, p, 0));
        rough = texelFetch(roughness, p, 0).x;
    }
    return material_of(parts, vec3(texelFetch(albedo, p, 0)), of_gloss, rough);
}

// How a surface's glossy part reflects toward the camera.
struct Shine {
    vec3 mirrored;  // the lobe's axis
    vec3 gloss;
};

PURE Shine shine_of(IN(Surface) surface, IN(Material) material)
{
    vec3 view = surface.point / max(length(surface.point), R(1e-20));
    float grazing = clamp(R(1.0) + dot(view, surface.normal), R(0.0), R(1.0));
    float twice = grazing * grazing;
    return Shine(view - R(2.0) * dot(view, surface.normal) * surface.normal,
                 material.specular * (material.tint ? R(0.04) + R(0.96) * twice * twice * grazing : R(1.0)));
}

// What a lamp's part of the picture becomes: `own`, and what the medium brings to where it is not. Diffuse light that came straight keeps
// to its way and the rest comes from aside, so that shadows and sides turned away get theirs. A highlight keeps e^-tau; what has
// been scattered makes one as wide as it comes: the mean cosines of the lobe and of the light multiply. Published methods dim all that
// came straight by e^-tau.
PURE vec3 lit_by_lamp(IN(Medium) medium, IN(SurfaceSettings) settings, IN(Surface) surface, IN(Light) light, IN(Material) material,
                      sampler2D gaussians, sampler2D table, vec3 own)
{
    bool sun = light.type == light_directional;
    if (!material.known || (sun && settings.method != method_calibrated) || surface.normal == vec3(R(0.0)))
        return own * received_of_light(medium, settings, surface, light, gaussians, table);
    float p = density_to_lamp(medium, surface, light, gaussians, settings.gaussian_count);
    vec3 from = surface.point - light.position;
    float distance = max(length(from), smallest_light);
    vec3 to_lamp = -from / distance;
    float strength = min(fluence(distance, light.radius), radiance_limit);
    SunSlant slant = SunSlant(vec3(R(0.0)), R(1.0));
    if (sun) {
        to_lamp = -light.direction;
        strength = R(1.0);
        slant = sun_slant(medium, light.direction, surface.point);
    }
    Shine shine = shine_of(surface, material);
    vec3 gloss = shine.gloss;
    float mirror_cosine = dot(shine.mirrored, to_lamp);
    float cosine = cosine_to(surface, light);
    // What leaves a spot's cone is not followed.
    float straight = light.type == light_spot ? spot_factor(light, dot(from, light.direction) / distance) : R(1.0);
    float n = material.exponent;
    float lobe = cosine > R(0.0) && mirror_cosine > R(0.0)
                     ? straight * (n + R(1.0)) / (R(2.0) * pi) * exp(n * log(max(mirror_cosine, R(1e-6))))
                     : R(0.0);
    vec3 sum = vec3(R(0.0));
    float along = R(0.0);
    float kept = R(0.0);
    float aside = R(0.0);
    float mirrored_aside = R(0.0);
    for (int c = 0; c < 3; ++c) {
        if (c == 0 || medium.scattering[c] != medium.scattering[c - 1] || medium.absorption[c] != medium.absorption[c - 1]) {
            float scattering = min(medium.scattering[c] * p, orders_depth_limit);
            float absorption = min(medium.absorption[c] * p, orders_depth_limit);
            kept = exp(-(scattering + absorption));
            if (sun) {
                float up = cosine_up(surface, slant.up);
                Received r = received_of_sun(settings, scattering, absorption, medium.asymmetry, slant.cosine, up);
                along = r.along;
                aside = r.aside;
                // Radiance from above is even but for the sun's own forward peak.
                float sky = R(0.5) * (R(1.0) + clamp(dot(shine.mirrored, slant.up), R(-1.0), R(1.0)));
                mirrored_aside = r.aside / max(pi * R(0.5) * (R(1.0) + up), R(1e-6)) * sky +
                                 max(along - kept, R(0.0)) *
                                     henyey_greenstein(medium.asymmetry * (n + R(1.0)) / (n + R(2.0)), mirror_cosine);
            } else if (settings.method == method_calibrated) {
                Received r = received(scattering, absorption, medium.asymmetry, cosine);
                Rescattered again = rescattered(scattering, absorption, medium.asymmetry);
                along = r.along;
                // From behind less comes: the first moments of light of this mean cosine.
                aside = exp(R(2.0) * again.cosine * min(cosine, R(0.0))) * r.aside;
                float width = again.cosine * (n + R(1.0)) / (n + R(2.0));
                mirrored_aside = again.fluence * henyey_greenstein(width, mirror_cosine);
            } else {
                Received r = published(settings.method, table, scattering, absorption, cosine);
                along = r.along;
                aside = r.aside;
                if (gloss != vec3(R(0.0)))
                    mirrored_aside = scattering / max(scattering + absorption, R(1e-30)) *
                                     published_lobe(settings.method, table, scattering + absorption, n, mirror_cosine);
            }
        }
        float intensity = min(strength * light.intensity[c], radiance_limit);
        float highlight = min(gloss[c] * lobe * intensity, max(own[c], R(0.0)));
        float brought = material.albedo[c] / pi * aside + gloss[c] * mirrored_aside;
        sum[c] = min((own[c] - highlight) * along + highlight * kept +
                         min(intensity * straight, radiance_limit) * brought, radiance_limit);
    }
    return sum;
}

// Irradiance by an environment of `order` degrees of spherical harmonics (environment.glsl), of which those above 2 hardly count.
PURE vec3 environment_irradiance(sampler2D environment, int order, vec3 normal)
{
    vec3 sum = R(0.886226925453) * vec3(data_texel(environment, 0));
    if (order > 1)
        sum += R(1.02332670795) * (normal.y * vec3(data_texel(environment, 1)) + normal.z * vec3(data_texel(environment, 2)) +
                                   normal.x * vec3(data_texel(environment, 3)));
    if (order > 2) {
        sum += R(0.858085531) * (normal.x * normal.y * vec3(data_texel(environment, 4)) +
                                 normal.y * normal.z * vec3(data_texel(environment, 5)) +
                                 normal.x * normal.z * vec3(data_texel(environment, 7)));
        sum += R(0.2477079561) * (R(3.0) * normal.z * normal.z - R(1.0)) * vec3(data_texel(environment, 6));
        sum += R(0.4290427655) * (normal.x * normal.x - normal.y * normal.y) * vec3(data_texel(environment, 8));
    }
    return max(sum, vec3(R(0.0)));
}

// normal: of the layer, or of normal_by_depth().
PURE Surface surface_of(IN(Camera) camera, IN(SurfaceSettings) settings, vec2 pixel, float raw, vec3 normal)
{
    return surface_at(pixel_ray(camera, pixel, raw), settings.world_normals != 0 ? in_camera(camera, normal) : normal);
}

#define SURFACE_IMAGES sampler2D lights, sampler2D ungrouped, sampler2D gaussians, sampler2D environment, sampler2D table
#define SURFACE_PASSED lights, ungrouped, gaussians, environment, table

// The environment's part of the picture after, by method psf: eq. 27 with a lobe of Phong for the rest of what reflects. Without a
// normal or an end of the medium it stays as it is.
PURE vec3 lit_by_environment(IN(Medium) medium, IN(Camera) camera, IN(SurfaceSettings) settings, SURFACE_IMAGES, IN(Surface) surface,
                             IN(Material) material, vec3 own)
{
    float p = mean_density_around(medium, camera, table, gaussians, settings.gaussian_count, surface.point);
    if (p < R(0.0) || surface.normal == vec3(R(0.0)))
        return own;
    vec3 normal = in_world(camera, surface.normal);
    Degrees around_normal = environment_degrees(environment, settings.environment_order, normal);
    Shine shine = shine_of(surface, material);
    Degrees mirrored = environment_degrees(environment, settings.environment_order, in_world(camera, shine.mirrored));
    vec3 clear = environment_irradiance(environment, settings.environment_order, normal);
    vec3 depth = min(optical_depth(medium, p), vec3(density_limit));
    vec3 extinction = medium.scattering + medium.absorption;
    vec3 sum = vec3(R(0.0));
    for (int c = 0; c < 3; ++c) {
        float diffuse = psf_lobe_of_environment(table, around_normal, settings.environment_order, c, depth[c], R(1.0));
        float brought = min(pi * diffuse / max(clear[c], R(1e-30)), radiance_limit) * own[c];
        if (material.known)
            brought = material.albedo[c] * diffuse +
                      shine.gloss[c] * psf_lobe_of_environment(table, mirrored, settings.environment_order, c, depth[c],
                                                               material.exponent);
        float once = medium.scattering[c] / max(extinction[c], R(1e-30));
        sum[c] = min(own[c] * exp(-depth[c]) + once * brought, radiance_limit);
    }
    return sum;
}

// int rho dt from a surface up, out of the medium; negative where it has no end.
PURE float density_above(IN(Medium) medium, IN(Camera) camera, sampler2D gaussians, int gaussian_count, vec3 point, vec3 up)
{
    if (medium.constant > R(0.0) && camera.sky != sky_clamp)
        return R(-1.0);
    float p = density_between(medium, point, up, far_away, medium.constant > R(0.0) ? camera.sky_distance : R(0.0));
    for (int i = 0; i < gaussian_count; ++i)
        p += profile_depth(profile_along(gaussian_at(gaussians, i), point, up), R(0.0), far_away);
    return clamp(p, R(0.0), density_limit);
}

// What is left of the environment's part by method calibrated. Layers lie as thinning_way() has it, else along the surface. An even
// sky, over a ground that gives all back and fog that absorbs nothing, is as it was.
PURE vec3 environment_share(IN(Medium) medium, IN(Camera) camera, IN(SurfaceSettings) settings, sampler2D environment,
                            sampler2D gaussians, IN(Surface) surface)
{
    vec3 up = thinning_way(medium, surface.point);
    if (up == vec3(R(0.0)))
        up = surface.normal;
    if (up == vec3(R(0.0)))
        return vec3(R(1.0));
    vec3 normal = surface.normal == vec3(R(0.0)) ? up : surface.normal;
    float p = density_above(medium, camera, gaussians, settings.gaussian_count, surface.point, up);
    if (p < R(0.0))
        return vec3(R(1.0));
    vec3 clear = environment_irradiance(environment, settings.environment_order, in_world(camera, normal));
    vec3 above = environment_irradiance(environment, settings.environment_order, in_world(camera, up));
    vec3 below = environment_irradiance(environment, settings.environment_order, in_world(camera, -up));
    vec3 around = mix(below, above, R(0.5) * (R(1.0) + clamp(dot(normal, up), R(-1.0), R(1.0))));
    float g = medium.asymmetry;
    vec3 share = vec3(R(1.0));
    for (int c = 0; c < 3; ++c) {
        float s = min(medium.scattering[c] * p, orders_depth_limit);
        float a = min(medium.absorption[c] * p, orders_depth_limit);
        float all = slab_field(vec2(s), vec2(a), g, R(0.0), R(1.0), settings.ground).down;
        // Even light keeps e^(-1.66 t) of its ways, within a twentieth (2 E_3).
        float along = min(exp(-R(1.66) * min(s * (R(1.0) - g * g) + a, orders_depth_limit)), all);
        float becomes = along * clear[c] + (all - along) * around[c];
        share[c] = clear[c] > R(0.0) ? min(becomes / max(clear[c], R(1e-30)), radiance_limit) : all;
    }
    return share;
}

// What no lamp's own layer has becomes this: each lamp's part by what it gives in clear air, and the environment's.
// ungrouped: of each light, 1 where it has a part in that.
PURE vec3 rest_received(IN(Medium) medium, IN(Camera) camera, IN(SurfaceSettings) settings, SURFACE_IMAGES, SHADOW_MAP_IMAGES,
                        IN(Surface) surface, IN(Material) material, vec3 rest)
{
    vec3 all = vec3(R(0.0));
    for (int l = 0; l < settings.light_count; ++l)
        if (data_texel(ungrouped, l).x != R(0.0))
            all = min(all + lit_by_map(camera, settings.shadowed, SHADOW_MAP_PASSED, surface, l) *
                                clear_irradiance(surface, light_at(lights, l)), vec3(radiance_limit));
    vec3 sky = vec3(R(0.0));
    if (settings.environment_order > 0)
        sky = environment_irradiance(environment, settings.environment_order, in_world(camera, surface.normal));
    all += sky;
    vec3 change = vec3(R(0.0));
    if (settings.method == method_psf && settings.environment_order > 0) {
        vec3 own = rest * (sky / max(all, vec3(R(1e-30))));
        change = lit_by_environment(medium, camera, settings, SURFACE_PASSED, surface, material, own) - own;
    }
    if (settings.method == method_calibrated && settings.environment_order > 0)
        change = rest * (sky / max(all, vec3(R(1e-30)))) *
                 (environment_share(medium, camera, settings, environment, gaussians, surface) - R(1.0));
    for (int l = 0; l < settings.light_count; ++l) {
        if (data_texel(ungrouped, l).x == R(0.0))
            continue;
        Light light = light_at(lights, l);
        vec3 own = rest * (lit_by_map(camera, settings.shadowed, SHADOW_MAP_PASSED, surface, l) * clear_irradiance(surface, light) /
                           max(all, vec3(R(1e-30))));
        if (own != vec3(R(0.0)) || material.known)
            change += lit_by_lamp(medium, settings, surface, light, material, gaussians, table, own) - own;
    }
    return max(rest + change, min(rest, vec3(R(0.0))));
}

// What a pixel shows of surfaces before and after: what is still to be divided among lamps, and what was.
struct Divided {
    vec3 rest;
    vec3 lit;
};

// group: the lamp's own layer of the picture.
PURE Divided divided_by_group(IN(Medium) medium, IN(SurfaceSettings) settings, IN(Surface) surface, IN(Light) light,
                              IN(Material) material, sampler2D gaussians, sampler2D table, IN(Divided) pixel, vec3 group)
{
    vec3 own = finite_or_zero(group);
    vec3 becomes = own;
    if (surface.seen)
        becomes = lit_by_lamp(medium, settings, surface, light, material, gaussians, table, own);
    return Divided(pixel.rest - own, min(pixel.lit + becomes, vec3(radiance_limit)));
}

// The pixel in the end; source: as it was.
PURE vec3 relit(IN(Medium) medium, IN(Camera) camera, IN(SurfaceSettings) settings, SURFACE_IMAGES, SHADOW_MAP_IMAGES, IN(Surface) surface,
                IN(Material) material, vec3 source, IN(Divided) pixel, float limit)
{
    if (!surface.seen)
        return source;
    vec3 sum = rest_received(medium, camera, settings, SURFACE_PASSED, SHADOW_MAP_PASSED, surface, material,
                             finite_or_zero(pixel.rest)) + pixel.lit;
    return vec3(composed(source.x, R(0.0), sum.x, limit), composed(source.y, R(0.0), sum.y, limit),
                composed(source.z, R(0.0), sum.z, limit));
}

// A point of the surface that a neighbouring pixel shows, relative to `point`; huge where it shows none.
PURE vec3 step_to(IN(Ray) ray, vec3 point)
{
    return ray.distance < farthest_surface ? ray.distance * ray.direction - point : vec3(R(1e15));
}

// Of two steps, one against the other, the shorter: beyond an edge surfaces are far.
PURE vec3 shorter_step(vec3 after, vec3 before)
{
    return dot(after, after) <= dot(before, before) ? after : -before;
}

PURE vec3 normal_by_depth(IN(Ray) ray, IN(Ray) left, IN(Ray) right, IN(Ray) before, IN(Ray) after)
{
    if (ray.distance >= farthest_surface)
        return vec3(R(0.0));
    vec3 point = ray.distance * ray.direction;
    vec3 u = shorter_step(step_to(right, point), step_to(left, point));
    vec3 v = shorter_step(step_to(after, point), step_to(before, point));
    vec3 n = cross(u / max(length(u), R(1e-20)), v / max(length(v), R(1e-20)));
    float size = length(n);
    if (max(dot(u, u), dot(v, v)) > R(1e26) || size < R(1e-6))
        return vec3(R(0.0));
    return (dot(n, ray.direction) > R(0.0) ? -n : n) / size;
}
