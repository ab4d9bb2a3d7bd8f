// What of a sun's and of the environment's light surfaces receive through the medium, by method `calibrated`. Needs slab_field.glsl,
// surface_lamp.glsl, surface_transfer.glsl.

PURE bool is_sun(IN(SurfaceSettings) settings, IN(Light) light)
{
    return may_have(settings, without_suns) && light.type == light_directional;
}

// Cosine between the normal and the way up.
PURE float cosine_up(IN(Surface) surface, vec3 up)
{
    return choose(has_normal(surface), clamp(dot(surface.normal, up), R(-1.0), R(1.0)), R(1.0));
}

// Of a light's irradiance: of a sun, across its rays; of a sky, on level ground in clear air. Optical depths of the way straight down.
PURE float diffuse_down(IN(SurfaceSettings) settings, float scattering, float absorption, float asymmetry, float sun, float cosine)
{
    return slab_ground(slab_streams(scattering, absorption, asymmetry, sun, cosine, settings.ground), sun, settings.ground);
}

PURE float depth_of(float coefficient, float p)
{
    return min(coefficient * p, orders_depth_limit);
}

// At these optical depths of the way to a sun, of its irradiance across its rays: diffuse light comes from above alike.
PURE Received received_of_sun(IN(SurfaceSettings) settings, float scattering, float absorption, float asymmetry, float sun_up,
                              float normal_up)
{
    SlabStreams streams =
        slab_streams(scattering * sun_up, absorption * sun_up, asymmetry, R(1.0), sun_up, settings.ground);
    return Received(streams.straight, slab_ground(streams, R(1.0), settings.ground) * R(0.5) * (R(1.0) + normal_up));
}

// How a surface lies below a sun.
struct SunFacing {
    float sun_up;
    float normal_up;
    float sky;  // what the mirrored ray sees of an even half sphere
};

PURE Arrived arrived_of_sun(IN(SurfaceSettings) settings, float scattering, float absorption, float asymmetry, IN(SunFacing) lies,
                            IN(Facing) facing, IN(Shine) shine, bool glossy)
{
    Received r = received_of_sun(settings, scattering, absorption, asymmetry, lies.sun_up, lies.normal_up);
    Arrived arrived = Arrived(r.along, R(0.0), r.aside, R(0.0));
    if (glossy) {
        arrived.kept = exp(-(scattering + absorption));
        // Radiance from above is even but for the sun's own forward peak.
        arrived.mirrored_aside =
            r.aside / max(pi * R(0.5) * (R(1.0) + lies.normal_up), R(1e-6)) * lies.sky +
            max(r.along - arrived.kept, R(0.0)) * henyey_greenstein(asymmetry * shine.cosine, facing.mirror_cosine);
    }
    return arrived;
}

// Without a material a light's part changes by a factor; light that is flat counts as if it were not.
PURE float share_of_arrived(IN(Arrived) arrived, float cosine)
{
    return arrived.along + arrived.aside / max(cosine, least_cosine);
}

PURE Change change_of_arrived(IN(Surface) surface, IN(Light) light, IN(Material) material, IN(Shine) shine, IN(Facing) facing,
                              IN(Arrived) red, IN(Arrived) green, IN(Arrived) blue)
{
    if (some(material.known))
        return change_of(surface, light, material, shine, facing, red, green, blue);
    return scaled_by(vec3(share_of_arrived(red, facing.cosine), share_of_arrived(green, facing.cosine),
                          share_of_arrived(blue, facing.cosine)));
}

PURE Change change_by_sun(IN(Medium) medium, IN(SurfaceSettings) settings, IN(Surface) surface, IN(Light) light,
                          IN(Material) material, IN(Shine) shine, sampler2D gaussians)
{
    bool glossy = some(material.known) && settings.material > 1;
    SunSlant slant = sun_slant(medium, light.direction, surface.point);
    float p = density_to_lamp(medium, surface, light, gaussians, settings.gaussian_count);
    Facing facing = facing_of(surface, light, material, shine, glossy);
    SunFacing lies = SunFacing(slant.cosine, cosine_up(surface, slant.up),
                               R(0.5) * (R(1.0) + clamp(dot(shine.mirrored, slant.up), R(-1.0), R(1.0))));
    float g = medium.asymmetry;
    Arrived red = arrived_of_sun(settings, depth_of(medium.scattering.x, p), depth_of(medium.absorption.x, p), g, lies, facing, shine,
                                 glossy);
    Arrived green = red;
    if (!green_as_red(medium))
        green = arrived_of_sun(settings, depth_of(medium.scattering.y, p), depth_of(medium.absorption.y, p), g, lies, facing, shine,
                               glossy);
    Arrived blue = green;
    if (!blue_as_green(medium))
        blue = arrived_of_sun(settings, depth_of(medium.scattering.z, p), depth_of(medium.absorption.z, p), g, lies, facing, shine,
                              glossy);
    return change_of_arrived(surface, light, material, shine, facing, red, green, blue);
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

// Whether the medium ends on the way up, so that it is known how much of it there is.
PURE bool ends_above(IN(Medium) medium, IN(Camera) camera)
{
    return !some(medium.constant > R(0.0)) || camera.sky == sky_clamp;
}

// int rho dt from a surface up, out of the medium.
PURE float density_above(IN(Medium) medium, IN(Camera) camera, sampler2D gaussians, int gaussian_count, vec3 point, vec3 up)
{
    float p = density_between(medium, point, up, far_away, some(medium.constant > R(0.0)) ? camera.sky_distance : R(0.0));
    for (int i = 0; i < gaussian_count; ++i)
        p += profile_depth(profile_along(gaussian_at(gaussians, i), point, up), R(0.0), far_away);
    return clamp(p, R(0.0), density_limit);
}

// Of the environment's light onto level ground: all that comes, and what of it comes its own way.
struct SkyArrived {
    float all;
    float along;
};

PURE SkyArrived arrived_of_sky(IN(SurfaceSettings) settings, float scattering, float absorption, float asymmetry)
{
    float all = diffuse_down(settings, scattering, absorption, asymmetry, R(0.0), R(1.0));
    // Even light keeps e^(-1.66 t) of its ways, within a twentieth (2 E_3).
    float straight = min(scattering * (R(1.0) - asymmetry * asymmetry) + absorption, orders_depth_limit);
    return SkyArrived(all, min(exp(-R(1.66) * straight), all));
}

// clear, around: irradiance of the surface and of one that sees half above and half below as it does.
PURE float share_of_sky(IN(SkyArrived) sky, float clear, float around)
{
    float becomes = sky.along * clear + (sky.all - sky.along) * around;
    return choose(clear > R(0.0), min(becomes / max(clear, R(1e-30)), radiance_limit), sky.all);
}

// What is left of the environment's part. Layers lie as thinning_way() has it, else along the surface. An even sky, over a ground that
// gives all back and fog that absorbs nothing, is as it was.
PURE vec3 environment_share(IN(Medium) medium, IN(Camera) camera, IN(SurfaceSettings) settings, sampler2D environment,
                            sampler2D gaussians, IN(Surface) surface)
{
    if (!ends_above(medium, camera))
        return vec3(R(1.0));
    vec3 thinning = thinning_way(medium, surface.point);
    vec3 up = chosen(dot(thinning, thinning) > R(0.0), thinning, surface.normal);
    Bool known = dot(up, up) > R(0.0);
    if (!some(known))
        return vec3(R(1.0));
    vec3 normal = chosen(has_normal(surface), surface.normal, up);
    float p = density_above(medium, camera, gaussians, settings.gaussian_count, surface.point, up);
    vec3 clear = environment_irradiance(environment, settings.environment_order, in_world(camera, normal));
    vec3 above = environment_irradiance(environment, settings.environment_order, in_world(camera, up));
    vec3 below = environment_irradiance(environment, settings.environment_order, in_world(camera, -up));
    float seen_above = R(0.5) * (R(1.0) + clamp(dot(normal, up), R(-1.0), R(1.0)));
    vec3 around = (R(1.0) - seen_above) * below + seen_above * above;
    float g = medium.asymmetry;
    SkyArrived red = arrived_of_sky(settings, depth_of(medium.scattering.x, p), depth_of(medium.absorption.x, p), g);
    SkyArrived green = red;
    if (!green_as_red(medium))
        green = arrived_of_sky(settings, depth_of(medium.scattering.y, p), depth_of(medium.absorption.y, p), g);
    SkyArrived blue = green;
    if (!blue_as_green(medium))
        blue = arrived_of_sky(settings, depth_of(medium.scattering.z, p), depth_of(medium.absorption.z, p), g);
    return chosen(known, vec3(share_of_sky(red, clear.x, around.x), share_of_sky(green, clear.y, around.y),
                              share_of_sky(blue, clear.z, around.z)), vec3(R(1.0)));
}

// The environment's irradiance in clear air.
PURE vec3 sky_irradiance(IN(Camera) camera, IN(SurfaceSettings) settings, sampler2D environment, IN(Surface) surface)
{
    if (settings.environment_order == 0)
        return vec3(R(0.0));
    return environment_irradiance(environment, settings.environment_order, in_world(camera, surface.normal));
}

// Light that comes alike from all the half sphere around an axis, `down` of it onto level ground.
PURE float sent_from_above(float down, IN(Sent) sent)
{
    return R(2.0) * down * max(sent.of[0] + R(0.5) * sent.of[1] - R(0.125) * sent.of[3], R(0.0));
}

// Radiance for albedo 1 of what the medium brings of a sun.
PURE vec3 sent_of_sun(IN(Medium) medium, IN(Camera) camera, IN(SurfaceSettings) settings, IN(Surface) surface, IN(Light) light,
                      IN(Transfer) transfer, sampler2D gaussians)
{
    SunSlant slant = sun_slant(medium, light.direction, surface.point);
    Sent sent = sent_toward(transfer, settings.transfer, in_transfer_axes(camera, settings, slant.up), cosine_up(surface, slant.up));
    float p = slant.cosine * density_to_lamp(medium, surface, light, gaussians, settings.gaussian_count);
    float g = medium.asymmetry;
    vec3 down = vec3(diffuse_down(settings, depth_of(medium.scattering.x, p), depth_of(medium.absorption.x, p), g, R(1.0), slant.cosine));
    if (!green_as_red(medium)) {
        down.y = diffuse_down(settings, depth_of(medium.scattering.y, p), depth_of(medium.absorption.y, p), g, R(1.0), slant.cosine);
        down.z = down.y;
    }
    if (!blue_as_green(medium))
        down.z = diffuse_down(settings, depth_of(medium.scattering.z, p), depth_of(medium.absorption.z, p), g, R(1.0), slant.cosine);
    return sent_of_irradiance(surface, light, vec3(sent_from_above(down.x, sent), sent_from_above(down.y, sent),
                                                   sent_from_above(down.z, sent)));
}
