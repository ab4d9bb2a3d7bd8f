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

PURE float depth_of(float coefficient, float p)
{
    return min(coefficient * p, orders_depth_limit);
}

// How a surface, or a mirrored ray, lies below a sun: the cosine to the way up, and how much the sun's side of the way along the ground
// has of it, times the sine of the sun's slant.
struct SunFacing {
    float up;
    float toward;
};

// up: cosine to the way up; to_sun: to the sun.
PURE SunFacing below_sun(float up, float to_sun, IN(SunSlant) slant)
{
    return SunFacing(up, to_sun - up * slant.cosine);
}

PURE SunFacing surface_below_sun(IN(Surface) surface, IN(Light) light, IN(SunSlant) slant)
{
    SunFacing lies = below_sun(cosine_up(surface, slant.up), cosine_to(surface, light), slant);
    return SunFacing(lies.up, choose(has_normal(surface), lies.toward, R(0.0)));
}

// Diffuse light of a sun onto a surface, `down` of it onto level ground. All over the irradiance across its rays.
PURE float onto_surface(float down, IN(SlabSide) side, IN(SunFacing) lies)
{
    float level = R(0.5) * (R(1.0) + lies.up) + (side.walls - R(0.5)) * (R(1.0) - lies.up * lies.up);
    return max(down * level + side.walls * side.toward * lies.toward, R(0.0));
}

// At these optical depths of the way to the sun.
PURE SlabStreams streams_below_sun(IN(SurfaceSettings) settings, float scattering, float absorption, float asymmetry, float cosine)
{
    return slab_streams(scattering * cosine, absorption * cosine, asymmetry, low_sun(cosine), R(1.0), cosine, settings.ground);
}

PURE Arrived arrived_of_sun(IN(SurfaceSettings) settings, float scattering, float absorption, float asymmetry, IN(SunSlant) slant,
                            IN(SunFacing) lies, IN(SunFacing) mirrored, IN(Facing) facing, IN(Shine) shine, bool glossy)
{
    SlabStreams streams = streams_below_sun(settings, scattering, absorption, asymmetry, slant.cosine);
    float down = slab_ground(streams, R(1.0), settings.ground);
    SlabSide side = slab_side(streams);
    Arrived arrived = Arrived(streams.straight, R(0.0), onto_surface(down, side, lies), R(0.0));
    if (glossy) {
        arrived.kept = exp(-(scattering + absorption));
        float around = max(down + R(1.5) * side.toward * mirrored.toward, R(0.0)) * R(0.5) * (R(1.0) + mirrored.up) / pi;
        arrived.mirrored_aside = around + max(arrived.along - arrived.kept, R(0.0)) *
                                              henyey_greenstein(asymmetry * shine.cosine, facing.mirror_cosine);
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
                          IN(Material) material, IN(Shine) shine, float p)
{
    bool glossy = some(material.known) && settings.material > 1;
    SunSlant slant = sun_slant(medium, light.direction, surface.point);
    Facing facing = facing_of(surface, light, material, shine, glossy);
    SunFacing lies = surface_below_sun(surface, light, slant);
    SunFacing mirrored = below_sun(clamp(dot(shine.mirrored, slant.up), R(-1.0), R(1.0)), -dot(shine.mirrored, light.direction), slant);
    float g = medium.asymmetry;
    Arrived red = arrived_of_sun(settings, depth_of(medium.scattering.x, p), depth_of(medium.absorption.x, p), g, slant, lies, mirrored,
                                 facing, shine, glossy);
    Arrived green = red;
    if (!green_as_red(medium))
        green = arrived_of_sun(settings, depth_of(medium.scattering.y, p), depth_of(medium.absorption.y, p), g, slant, lies, mirrored,
                               facing, shine, glossy);
    Arrived blue = green;
    if (!blue_as_green(medium))
        blue = arrived_of_sun(settings, depth_of(medium.scattering.z, p), depth_of(medium.absorption.z, p), g, slant, lies, mirrored,
                              facing, shine, glossy);
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

// More of them are not followed on the sky's ways, where each costs every pixel.
const int most_gaussians_around = 256;

PURE int gaussians_around(IN(SurfaceSettings) settings)
{
    return settings.gaussian_count > most_gaussians_around ? 0 : settings.gaussian_count;
}

// Whether the medium ends on the way up, so that it is known how much of it there is.
PURE bool ends_above(IN(Medium) medium, IN(Camera) camera)
{
    return !some(medium.constant > R(0.0)) || camera.sky == sky_clamp;
}

// int rho dt from a surface up, out of the medium.
PURE float density_above(IN(Medium) medium, IN(Camera) camera, sampler2D light_gaussians, int gaussian_count, vec3 point, vec3 up)
{
    float p = density_between(medium, point, up, far_away, some(medium.constant > R(0.0)) ? camera.sky_distance : R(0.0));
    int first = gaussian_count > 0 ? first_gaussian(light_gaussians) : 0;
    for (int i = 0; i < gaussian_count; ++i)
        p += profile_depth(profile_along(gaussian_at(light_gaussians, first + i), point, up), R(0.0), far_away);
    return clamp(p, R(0.0), density_limit);
}

// Of the environment's light onto level ground: all that comes, and what of it comes its own way.
struct SkyArrived {
    float all;
    float along;
};

PURE SkyArrived arrived_of_sky(IN(SurfaceSettings) settings, float scattering, float absorption, float asymmetry)
{
    SlabStreams streams = slab_streams(scattering, absorption, asymmetry, R(0.0), R(0.0), R(1.0), settings.ground);
    float all = slab_ground(streams, R(0.0), settings.ground);
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
                            sampler2D light_gaussians, IN(Surface) surface)
{
    if (!ends_above(medium, camera))
        return vec3(R(1.0));
    vec3 thinning = thinning_way(medium, surface.point);
    vec3 up = chosen(dot(thinning, thinning) > R(0.0), thinning, surface.normal);
    Bool known = dot(up, up) > R(0.0);
    if (!some(known))
        return vec3(R(1.0));
    vec3 normal = chosen(has_normal(surface), surface.normal, up);
    float p = density_above(medium, camera, light_gaussians, gaussians_around(settings), surface.point, up);
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

// What a point sends on of a sun's diffuse light, as onto_surface() has it. above: of light from straight above; of_sun: degree 1 of
// light from the sun.
PURE float sent_below_sun(float down, IN(SlabSide) side, IN(Sent) above, float of_sun, float cosine)
{
    float even = R(2.0) * (above.of[0] + R(0.5) * above.of[1] - R(0.125) * above.of[3]);
    float low = (side.walls - R(0.5)) * R(8.0 / 3.0) * (above.of[0] - R(0.8) * above.of[2]);
    return max(down * (even + low) + R(2.0) * side.walls * side.toward * (of_sun - cosine * above.of[1]), R(0.0));
}

PURE float sent_of_sun_in(IN(SurfaceSettings) settings, float scattering, float absorption, float asymmetry, float cosine,
                          IN(Sent) above, float of_sun)
{
    SlabStreams streams = streams_below_sun(settings, scattering, absorption, asymmetry, cosine);
    return sent_below_sun(slab_ground(streams, R(1.0), settings.ground), slab_side(streams), above, of_sun, cosine);
}

// Radiance for albedo 1 of what the medium brings of a sun.
PURE vec3 sent_of_sun(IN(Medium) medium, IN(Camera) camera, IN(SurfaceSettings) settings, IN(Surface) surface, IN(Light) light,
                      IN(Transfer) transfer, float p)
{
    SunSlant slant = sun_slant(medium, light.direction, surface.point);
    Sent above = sent_toward(transfer, settings.transfer, in_transfer_axes(camera, settings, slant.up), cosine_up(surface, slant.up));
    float of_sun = sent_toward(transfer, settings.transfer, in_transfer_axes(camera, settings, -light.direction),
                               cosine_to(surface, light)).of[1];
    float g = medium.asymmetry;
    vec3 sent = vec3(sent_of_sun_in(settings, depth_of(medium.scattering.x, p), depth_of(medium.absorption.x, p), g, slant.cosine, above,
                                    of_sun));
    if (!green_as_red(medium)) {
        sent.y = sent_of_sun_in(settings, depth_of(medium.scattering.y, p), depth_of(medium.absorption.y, p), g, slant.cosine, above,
                                of_sun);
        sent.z = sent.y;
    }
    if (!blue_as_green(medium))
        sent.z = sent_of_sun_in(settings, depth_of(medium.scattering.z, p), depth_of(medium.absorption.z, p), g, slant.cosine, above,
                                of_sun);
    return sent_of_irradiance(surface, light, sent);
}
