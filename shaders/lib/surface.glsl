// What the medium between lights and surfaces makes of the light that surfaces receive, by all methods. Needs airlight.glsl,
// lamp_field.glsl, environment.glsl.
#include "surface_published.glsl"
#include "surface_lamp.glsl"
#include "surface_transfer.glsl"
#include "surface_sun.glsl"

// Received of a lamp by a published method, whose `aside` comes at all cosines.
PURE Received published(int method, sampler2D table, float scattering, float absorption, float cosine)
{
    float depth = min(scattering + absorption, orders_depth_limit);
    float once = scattering / max(scattering + absorption, R(1e-30)) * pi * published_lobe(method, table, depth, R(1.0), cosine);
    return Received(exp(-depth), once);
}

// What a surface receives of a lamp over what it would in clear air, by the method that is asked for.
PURE float share_by_method(IN(SurfaceSettings) settings, sampler2D table, float scattering, float absorption, float asymmetry,
                           float cosine)
{
    if (settings.method == method_calibrated)
        return received_share(scattering, absorption, asymmetry, cosine);
    Received r = published(settings.method, table, scattering, absorption, cosine);
    return r.along + r.aside / max(cosine, least_cosine);
}

// 1 where the light's shadow map lets its light onto the surface, or it has none. Asked for a texel's width off the surface, on the side
// that it faces: where light grazes it, the map's depth is not that of the point but of the texel's centre, far before or behind it.
PURE float lit_by_map(IN(Camera) camera, int shadowed, SHADOW_MAP_IMAGES, IN(Surface) surface, int light)
{
    float distance = length(surface.point);
    if (shadowed == 0 || distance <= R(0.0))
        return R(1.0);
    ShadowRay ray = shadow_ray(camera, SHADOW_MAP_PASSED, shadowed, light, surface.point / distance, R(1.01) * distance);
    if (ray.kind == 0)
        return R(1.0);
    float width = ray.texel;
    if (ray.kind == shadow_perspective || ray.kind == shadow_latlong)
        width *= length(shadow_place(ray, distance));
    vec3 point = surface.point + width * surface.normal;
    distance = max(length(point), R(1e-30));
    ray = shadow_ray(camera, SHADOW_MAP_PASSED, shadowed, light, point / distance, R(1.01) * distance);
    return ray.kind == 0 || is_lit(shadow_maps, ray, distance) ? R(1.0) : R(0.0);
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

// What arrives of a lamp by a published method.
PURE Arrived arrived_as_published(int method, sampler2D table, float scattering, float absorption, IN(Facing) facing,
                                  float exponent, bool glossy)
{
    Received r = published(method, table, scattering, absorption, facing.cosine);
    float mirrored = R(0.0);
    if (glossy)
        mirrored = scattering / max(scattering + absorption, R(1e-30)) *
                   published_lobe(method, table, scattering + absorption, exponent, facing.mirror_cosine);
    return Arrived(r.along, exp(-(scattering + absorption)), r.aside, mirrored);
}

// Of one colour, at these coefficients and this int rho dt.
PURE Arrived arrived_of(IN(SurfaceSettings) settings, sampler2D table, float scattering, float absorption, float p, IN(Facing) facing,
                        IN(Material) material, IN(Shine) shine)
{
    return arrived_as_published(settings.method, table, depth_of(scattering, p), depth_of(absorption, p), facing, material.exponent,
                                shine.gloss != vec3(R(0.0)));
}

PURE Change change_as_published(IN(Medium) medium, IN(SurfaceSettings) settings, IN(Surface) surface, IN(Light) light,
                                IN(Material) material, IN(Shine) shine, float p, sampler2D table)
{
    Facing facing = facing_of(surface, light, material, shine, true);
    Arrived red = arrived_of(settings, table, medium.scattering.x, medium.absorption.x, p, facing, material, shine);
    Arrived green = red;
    if (!green_as_red(medium))
        green = arrived_of(settings, table, medium.scattering.y, medium.absorption.y, p, facing, material, shine);
    Arrived blue = green;
    if (!blue_as_green(medium))
        blue = arrived_of(settings, table, medium.scattering.z, medium.absorption.z, p, facing, material, shine);
    return change_of_arrived(surface, light, material, shine, facing, red, green, blue);
}

// What becomes of a light's part of the picture; of suns by method calibrated alone, else theirs stays as it is.
PURE Change change_by_light(IN(Medium) medium, IN(LampColours) colours, IN(SurfaceSettings) settings, IN(Surface) surface,
                            IN(Light) light, IN(Material) material, IN(Shine) shine, float p, sampler2D table)
{
    if (settings.method == method_calibrated) {
        if (is_sun(settings, light))
            return change_by_sun(medium, settings, surface, light, material, shine, p);
        return change_by_lamp(medium, colours, settings, surface, light, material, shine, p);
    }
    if (is_sun(settings, light))
        return scaled_by(vec3(R(1.0)));
    return change_as_published(medium, settings, surface, light, material, shine, p, table);
}

// The environment's part of the picture after, by method psf: eq. 27 with a lobe of Phong for the rest of what reflects. Without a
// normal or an end of the medium it stays as it is.
PURE vec3 lit_by_environment(IN(Medium) medium, IN(Camera) camera, IN(SurfaceSettings) settings, sampler2D light_gaussians,
                             sampler2D environment, sampler2D table, IN(Surface) surface, IN(Material) material, vec3 own)
{
    float p = mean_density_around(medium, camera, table, light_gaussians, gaussians_around(settings), surface.point);
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

// What the medium adds to the environment's part of the picture.
PURE vec3 sky_change(IN(Medium) medium, IN(Camera) camera, IN(SurfaceSettings) settings, sampler2D light_gaussians, sampler2D environment,
                     sampler2D table, IN(Surface) surface, IN(Material) material, vec3 own)
{
    if (settings.environment_order == 0)
        return vec3(R(0.0));
    if (settings.method == method_psf)
        return lit_by_environment(medium, camera, settings, light_gaussians, environment, table, surface, material, own) - own;
    if (settings.method == method_calibrated)
        return own * (environment_share(medium, camera, settings, environment, light_gaussians, surface) - vec3(R(1.0)));
    return vec3(R(0.0));
}

// What the medium brings of a lamp by method psf and a point sends on; degree by degree, single scattering.
PURE float sent_by_psf(sampler2D table, float scattering, float absorption, IN(Sent) sent)
{
    float depth = min(scattering + absorption, orders_depth_limit);
    vec4 low = environment_factors(table, depth, 0);
    vec4 high = environment_factors(table, depth, 1);
    float sum = high.x * sent.of[4];
    for (int l = 0; l < 4; ++l)
        sum += low[l] * sent.of[l];
    return scattering / max(scattering + absorption, R(1e-30)) * max(sum, R(0.0));
}

// Radiance for albedo 1 of what the medium brings of a light; of suns by method calibrated alone.
PURE vec3 sent_of_light(IN(Medium) medium, IN(LampColours) colours, IN(Camera) camera, IN(SurfaceSettings) settings,
                        IN(Surface) surface, IN(Light) light, IN(Transfer) transfer, float p, sampler2D table)
{
    if (settings.method == method_calibrated) {
        if (is_sun(settings, light))
            return sent_of_sun(medium, camera, settings, surface, light, transfer, p);
        return sent_of_one_lamp(medium, colours, camera, settings, surface, light, transfer, p);
    }
    if (is_sun(settings, light))
        return vec3(R(0.0));
    Sent sent = sent_toward(transfer, settings.transfer, in_transfer_axes(camera, settings, way_to(surface, light)),
                            cosine_to(surface, light));
    vec3 sum = vec3(R(0.0));
    for (int c = 0; c < 3; ++c) {
        if (c > 0 && medium.scattering[c] == medium.scattering[c - 1] && medium.absorption[c] == medium.absorption[c - 1])
            sum[c] = sum[c - 1];
        else
            sum[c] = sent_by_psf(table, depth_of(medium.scattering[c], p), depth_of(medium.absorption[c], p), sent);
    }
    return sent_of_irradiance(surface, light, sum);
}

// The same of the environment, by method psf alone: method calibrated knows but a factor of what the picture has of it. in_axes: its
// coefficients in the transfer's axes.
PURE vec3 sent_of_sky(IN(Medium) medium, IN(Camera) camera, IN(SurfaceSettings) settings, sampler2D light_gaussians, sampler2D environment,
                      sampler2D in_axes, sampler2D table, IN(Surface) surface, IN(Transfer) transfer)
{
    if (settings.environment_order == 0 || settings.method != method_psf)
        return vec3(R(0.0));
    float p = mean_density_around(medium, camera, table, light_gaussians, gaussians_around(settings), surface.point);
    if (p < R(0.0))
        return vec3(R(0.0));
    int given = min(settings.transfer, settings.environment_order);
    Degrees around_normal = environment_degrees(environment, settings.environment_order, in_world(camera, surface.normal));
    float open = transfer.of[0].x / R(0.282094791774);
    vec3 of_degree[5];
    for (int l = 0; l < transfer_degrees; ++l)
        of_degree[l] = open * lobe_degree(l, R(1.0)) * around_normal.of[l];
    for (int l = 0; l < given; ++l) {
        of_degree[l] = vec3(R(0.0));
        for (int i = l * l; i < (l + 1) * (l + 1); ++i)
            of_degree[l] += transfer.of[i / 3][i % 3] * vec3(data_texel(in_axes, i));
    }
    vec3 depth = min(optical_depth(medium, p), vec3(density_limit));
    vec3 sum = vec3(R(0.0));
    for (int c = 0; c < 3; ++c) {
        vec4 low = environment_factors(table, depth[c], 0);
        vec4 high = environment_factors(table, depth[c], 1);
        float all = high.x * of_degree[4][c];
        for (int l = 0; l < 4; ++l)
            all += low[l] * of_degree[l][c];
        sum[c] = medium.scattering[c] / max(medium.scattering[c] + medium.absorption[c], R(1e-30)) * max(all, R(0.0));
    }
    return sum;
}

#include "surface_relit.glsl"
