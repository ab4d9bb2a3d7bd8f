// What the medium between lights and surfaces makes of the light that surfaces receive, by all methods. Needs airlight.glsl,
// lamp_field.glsl, environment.glsl.
#include "surface_published.glsl"
#include "surface_lamp.glsl"
#include "surface_transfer.glsl"

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

// Cosine between the normal and the way up.
PURE float cosine_up(IN(Surface) surface, vec3 up)
{
    return surface.normal == vec3(R(0.0)) ? R(1.0) : clamp(dot(surface.normal, up), R(-1.0), R(1.0));
}

// At these optical depths of the way to a sun.
PURE SlabField sun_field(IN(SurfaceSettings) settings, float scattering, float absorption, float asymmetry, float sun_up)
{
    return slab_field(vec2(scattering * sun_up), vec2(absorption * sun_up), asymmetry, R(1.0), sun_up, settings.ground);
}

// Of a sun's irradiance across its rays: diffuse light comes from above alike.
PURE Received received_of_sun(IN(SurfaceSettings) settings, float scattering, float absorption, float asymmetry, float sun_up,
                              float normal_up)
{
    SlabField field = sun_field(settings, scattering, absorption, asymmetry, sun_up);
    return Received(field.straight, field.down * R(0.5) * (R(1.0) + normal_up));
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

// What arrives of a sun by method calibrated.
PURE Arrived arrived_of_sun(IN(SurfaceSettings) settings, float scattering, float absorption, float asymmetry, float sun_up,
                            float normal_up, float mirrored_up, IN(Facing) facing, IN(Shine) shine)
{
    float kept = exp(-(scattering + absorption));
    Received r = received_of_sun(settings, scattering, absorption, asymmetry, sun_up, normal_up);
    // Radiance from above is even but for the sun's own forward peak.
    float sky = R(0.5) * (R(1.0) + clamp(mirrored_up, R(-1.0), R(1.0)));
    return Arrived(r.along, kept, r.aside,
                   r.aside / max(pi * R(0.5) * (R(1.0) + normal_up), R(1e-6)) * sky +
                       max(r.along - kept, R(0.0)) * henyey_greenstein(asymmetry * shine.cosine, facing.mirror_cosine));
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
PURE Arrived arrived_of(IN(Medium) medium, IN(SurfaceSettings) settings, IN(Surface) surface, sampler2D table, float scattering,
                        float absorption, float p, bool sun, IN(SunSlant) slant, IN(Facing) facing, IN(Material) material,
                        IN(Shine) shine)
{
    float s = min(scattering * p, orders_depth_limit);
    float a = min(absorption * p, orders_depth_limit);
    if (sun)
        return arrived_of_sun(settings, s, a, medium.asymmetry, slant.cosine, cosine_up(surface, slant.up),
                              dot(shine.mirrored, slant.up), facing, shine);
    return arrived_as_published(settings.method, table, s, a, facing, material.exponent, shine.gloss != vec3(R(0.0)));
}

// Without a material it changes by a factor; light that is flat counts as if it were not.
PURE float share_of_arrived(IN(Arrived) arrived, float cosine)
{
    return arrived.along + arrived.aside / max(cosine, least_cosine);
}

// What becomes of a light's part of the picture; of suns by method calibrated alone, else theirs stays as it is.
PURE Change change_by_light(IN(Medium) medium, IN(LampColours) colours, IN(SurfaceSettings) settings, IN(Surface) surface,
                            IN(Light) light, IN(Material) material, IN(Shine) shine, sampler2D gaussians, sampler2D table)
{
    bool sun = may_have(settings, without_suns) && light.type == light_directional;
    if (!sun && settings.method == method_calibrated)
        return change_by_lamp(medium, colours, settings, surface, light, material, shine, gaussians);
    if (sun && settings.method != method_calibrated)
        return scaled_by(vec3(R(1.0)));
    SunSlant slant = SunSlant(vec3(R(0.0)), R(1.0));
    if (sun)
        slant = sun_slant(medium, light.direction, surface.point);
    float p = density_to_lamp(medium, surface, light, gaussians, settings.gaussian_count);
    Facing facing = facing_of(surface, light, material, shine, true);
    Arrived red = arrived_of(medium, settings, surface, table, medium.scattering.x, medium.absorption.x, p, sun, slant, facing,
                             material, shine);
    Arrived green = red;
    if (!green_as_red(medium))
        green = arrived_of(medium, settings, surface, table, medium.scattering.y, medium.absorption.y, p, sun, slant, facing, material,
                           shine);
    Arrived blue = green;
    if (!blue_as_green(medium))
        blue = arrived_of(medium, settings, surface, table, medium.scattering.z, medium.absorption.z, p, sun, slant, facing, material,
                          shine);
    if (some(material.known))
        return change_of(surface, light, material, shine, facing, red, green, blue);
    return scaled_by(vec3(share_of_arrived(red, facing.cosine), share_of_arrived(green, facing.cosine),
                          share_of_arrived(blue, facing.cosine)));
}

PURE vec3 lit_by_lamp(IN(Medium) medium, IN(SurfaceSettings) settings, IN(Surface) surface, IN(Light) light, IN(Material) material,
                      sampler2D gaussians, sampler2D table, vec3 own)
{
    SurfaceSettings around = settings;
    around.material = 2;
    return becomes(change_by_light(medium, lamp_colours(medium), around, surface, light, material, shine_of(surface, material),
                                   gaussians, table), own);
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

// The environment's part of the picture after, by method psf: eq. 27 with a lobe of Phong for the rest of what reflects. Without a
// normal or an end of the medium it stays as it is.
PURE vec3 lit_by_environment(IN(Medium) medium, IN(Camera) camera, IN(SurfaceSettings) settings, sampler2D gaussians,
                             sampler2D environment, sampler2D table, IN(Surface) surface, IN(Material) material, vec3 own)
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

// The environment's irradiance in clear air.
PURE vec3 sky_irradiance(IN(Camera) camera, IN(SurfaceSettings) settings, sampler2D environment, IN(Surface) surface)
{
    if (settings.environment_order == 0)
        return vec3(R(0.0));
    return environment_irradiance(environment, settings.environment_order, in_world(camera, surface.normal));
}

// What the medium adds to the environment's part of the picture.
PURE vec3 sky_change(IN(Medium) medium, IN(Camera) camera, IN(SurfaceSettings) settings, sampler2D gaussians, sampler2D environment,
                     sampler2D table, IN(Surface) surface, IN(Material) material, vec3 own)
{
    if (settings.environment_order == 0)
        return vec3(R(0.0));
    if (settings.method == method_psf)
        return lit_by_environment(medium, camera, settings, gaussians, environment, table, surface, material, own) - own;
    if (settings.method == method_calibrated)
        return own * (environment_share(medium, camera, settings, environment, gaussians, surface) - vec3(R(1.0)));
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

// Light that comes alike from all the half sphere around an axis, `down` of it onto level ground.
PURE float sent_from_above(float down, IN(Sent) sent)
{
    return R(2.0) * down * max(sent.of[0] + R(0.5) * sent.of[1] - R(0.125) * sent.of[3], R(0.0));
}

// Radiance for albedo 1 of what the medium brings of a light; of suns by method calibrated alone.
PURE vec3 sent_of_light(IN(Medium) medium, IN(LampColours) colours, IN(Camera) camera, IN(SurfaceSettings) settings,
                        IN(Surface) surface, IN(Light) light, IN(Transfer) transfer, sampler2D gaussians, sampler2D table)
{
    bool sun = may_have(settings, without_suns) && light.type == light_directional;
    if (!sun && settings.method == method_calibrated)
        return sent_of_one_lamp(medium, colours, camera, settings, surface, light, transfer, gaussians);
    if (sun && settings.method != method_calibrated)
        return vec3(R(0.0));
    float p = density_to_lamp(medium, surface, light, gaussians, settings.gaussian_count);
    vec3 way = way_to(surface, light);
    float cosine = cosine_to(surface, light);
    SunSlant slant = SunSlant(way, R(1.0));
    if (sun) {
        slant = sun_slant(medium, light.direction, surface.point);
        way = slant.up;
        cosine = cosine_up(surface, slant.up);
    }
    Sent sent = sent_toward(transfer, settings.transfer, in_transfer_axes(camera, settings, way), cosine);
    vec3 sum = vec3(R(0.0));
    for (int c = 0; c < 3; ++c) {
        float scattering = min(medium.scattering[c] * p, orders_depth_limit);
        float absorption = min(medium.absorption[c] * p, orders_depth_limit);
        if (c > 0 && medium.scattering[c] == medium.scattering[c - 1] && medium.absorption[c] == medium.absorption[c - 1])
            sum[c] = sum[c - 1];
        else if (sun)
            sum[c] = sent_from_above(sun_field(settings, scattering, absorption, medium.asymmetry, slant.cosine).down, sent);
        else
            sum[c] = sent_by_psf(table, scattering, absorption, sent);
    }
    return sent_of_irradiance(surface, light, sum);
}

// The same of the environment, by method psf alone: method calibrated knows but a factor of what the picture has of it. in_axes: its
// coefficients in the transfer's axes.
PURE vec3 sent_of_sky(IN(Medium) medium, IN(Camera) camera, IN(SurfaceSettings) settings, sampler2D gaussians, sampler2D environment,
                      sampler2D in_axes, sampler2D table, IN(Surface) surface, IN(Transfer) transfer)
{
    if (settings.environment_order == 0 || settings.method != method_psf)
        return vec3(R(0.0));
    float p = mean_density_around(medium, camera, table, gaussians, settings.gaussian_count, surface.point);
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
