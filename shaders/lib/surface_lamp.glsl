// What of a lamp's light surfaces receive through the medium, by method `calibrated`. Needs lamp_medium.glsl, shadow.glsl, lit.glsl.
//
// A lamp gives a plane that takes all that falls on it, under the cosine c at r, in clear air I c / r^2, and in the medium
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

// g: of a phase function that is no delta.
PURE Received received_in(IN(LampMedium) medium, float g, float x, float cosine)
{
    float c = clamp(cosine, R(0.0), R(1.0));
    float up = c * x + R(1.42);
    float square = x * x * (R(1.0) - c * c) + up * up;
    float below = sqrt(square);
    float forward = max(g, R(0.0));
    float once = (R(1.0) - forward) * (R(0.31) - R(0.57) * forward) +
                 (R(1.0) - c) * (R(0.18) + forward * (R(0.88) - R(0.65) * forward));
    float net = net_flux(medium, g, x);
    float aside = up * x * x / (square * below) * net_flux(medium, g, below) +
                  once * x / (R(1.0) + (R(10.7) - R(4.3) * forward) * x * x) * net;
    return Received(net, (R(1.0) - medium.a) * aside);
}

PURE float within_asymmetry(float asymmetry)
{
    return clamp(asymmetry, -largest_asymmetry, largest_asymmetry);
}

// scattering, absorption: optical depths of the way.
PURE Received received(float scattering, float absorption, float asymmetry, float cosine)
{
    float g = within_asymmetry(asymmetry);
    LampMedium medium = lamp_medium(min(scattering, orders_depth_limit), min(absorption, orders_depth_limit), g);
    return received_in(medium, g, medium.reduced, cosine);
}

PURE float share_of(IN(Received) r, float cosine)
{
    return max(r.along + r.aside / max(cosine, least_cosine), R(0.0));
}

// What a surface receives of a lamp over what it would in clear air.
PURE float received_share(float scattering, float absorption, float asymmetry, float cosine)
{
    return share_of(received(scattering, absorption, asymmetry, cosine), cosine);
}

struct SurfaceSettings {
    int method;
    int light_count;
    int gaussian_count;  // of the scene
    int environment_order;
    int world_normals;
    int material;  // how much of it frames bring: 1 albedo, 2 also specular and roughness
    int shadowed;  // as AirlightSettings has it
    int without;   // of what scenes may have, what this one is known not to have
    int transfer;  // degrees that frames bring of the surfaces' transfer; 0: none
    int world_transfer;
    float ground;  // albedo of what lies below, for suns and sky
};

// Bits of SurfaceSettings::without.
const int without_suns = 1;
const int without_spots = 2;
const int without_ungrouped = 4;  // lights with a part in what no light's own layer has
const int without_green = 8;      // a medium that green sees otherwise than red
const int without_blue = 16;      // and blue otherwise than green

PURE bool may_have(IN(SurfaceSettings) settings, int without)
{
    return (settings.without & without) == 0;
}

// Light i, of a kind that compilers know where there is but one.
PURE Light surface_light(IN(SurfaceSettings) settings, sampler2D lights, int i)
{
    Light light = light_at(lights, i);
    if (!may_have(settings, without_suns))
        light.type = may_have(settings, without_spots) && light.type == light_spot ? light_spot : light_point;
    return light;
}

// Where the surface is, and how it lies.
struct Surface {
    Bool seen;    // there is one
    vec3 point;   // camera space [m]
    vec3 normal;  // unit; 0 where nobody knows it: then it counts as facing every lamp
};

PURE Bool has_normal(IN(Surface) surface)
{
    return dot(surface.normal, surface.normal) > R(0.0);
}

PURE Surface surface_at(IN(Ray) ray, vec3 normal)
{
    Bool seen = !ray.keep && ray.distance < farthest_surface;
    float size = length(normal);
    Bool known = is_finite(size) && size > R(1e-6);
    return Surface(seen, choose(seen, ray.distance, R(0.0)) * ray.direction, chosen(known, normal / size, vec3(R(0.0))));
}

// d, of the world, in camera axes.
PURE vec3 in_camera(IN(Camera) camera, vec3 d)
{
    return vec3(dot(d, camera.right), dot(d, camera.up), dot(d, camera.back));
}

// normal: of the layer, or of normal_by_depth().
PURE Surface surface_of(IN(Camera) camera, IN(SurfaceSettings) settings, vec2 pixel, float raw, vec3 normal)
{
    return surface_at(pixel_ray(camera, pixel, raw), settings.world_normals != 0 ? in_camera(camera, normal) : normal);
}

// Cosine between the normal and the way to the lamp.
PURE float cosine_to(IN(Surface) surface, IN(Light) light)
{
    if (light.type == light_directional)
        return choose(has_normal(surface), -dot(surface.normal, light.direction), R(1.0));
    vec3 way = light.position - surface.point;
    return choose(has_normal(surface), dot(surface.normal, way) / max(length(way), R(1e-20)), R(1.0));
}

// Irradiance in clear air and without shadows.
PURE vec3 clear_irradiance(IN(Surface) surface, IN(Light) light)
{
    float strength = clamp(cosine_to(surface, light), R(0.0), R(1.0));
    if (light.type != light_directional) {
        vec3 way = light.position - surface.point;
        strength *= fluence(max(length(way), smallest_light), light.radius);
        if (light.type == light_spot)
            strength *= spot_factor(light, -dot(way, light.direction) / max(length(way), R(1e-20)));
    }
    return min(min(strength, radiance_limit) * light.intensity, vec3(radiance_limit));
}

// int rho dt between a surface and a light, `index` of all.
PURE float density_to_lamp(IN(Medium) medium, IN(Camera) camera, IN(SurfaceSettings) settings, IN(Surface) surface, int index,
                           IN(Light) light, sampler2D light_gaussians)
{
    float p = terms_to_light(medium, light, surface.point);
    if (settings.gaussian_count > 0)
        p += shadow_density(light_gaussians, camera, index, light, surface.point);
    return clamp(p, R(0.0), density_limit);
}

// The medium's colours, for lamps at all distances: made once for all of them.
struct LampColours {
    LampMedium red;
    LampMedium green;
    LampMedium blue;
    float asymmetry;
};

PURE LampColours lamp_colours(IN(Medium) medium)
{
    float g = within_asymmetry(medium.asymmetry);
    return LampColours(lamp_medium(medium.scattering.x, medium.absorption.x, g),
                       lamp_medium(medium.scattering.y, medium.absorption.y, g),
                       lamp_medium(medium.scattering.z, medium.absorption.z, g), g);
}

// Whether colours see the same medium, which is worked out once then.
PURE bool green_as_red(IN(Medium) medium)
{
    return some(medium.scattering.x == medium.scattering.y && medium.absorption.x == medium.absorption.y);
}

PURE bool blue_as_green(IN(Medium) medium)
{
    return some(medium.scattering.y == medium.scattering.z && medium.absorption.y == medium.absorption.z);
}

PURE float share_of_lamp_in(IN(LampMedium) colour, float g, float p, float cosine)
{
    return share_of(received_in(colour, g, min(colour.reduced * p, orders_depth_limit), cosine), cosine);
}

// received_share() of each colour.
PURE vec3 share_of_lamp(IN(Medium) medium, IN(LampColours) colours, IN(Surface) surface, IN(Light) light, float p)
{
    float cosine = cosine_to(surface, light);
    float g = colours.asymmetry;
    vec3 share = vec3(share_of_lamp_in(colours.red, g, p, cosine));
    if (!green_as_red(medium)) {
        share.y = share_of_lamp_in(colours.green, g, p, cosine);
        share.z = share.y;
    }
    if (!blue_as_green(medium))
        share.z = share_of_lamp_in(colours.blue, g, p, cosine);
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

PURE vec3 reflectance(vec3 colour)
{
    return min(max(finite_or_zero(colour), vec3(R(0.0))), vec3(R(1.0)));
}

PURE Material material_of(int parts, vec3 albedo, vec3 specular, float roughness)
{
    if (parts == 0)
        return unknown_material();
    Bool glossy = is_finite(roughness) && roughness < R(1.0);
    if (parts == 1)
        glossy = false;
    vec3 of_gloss = chosen(glossy, reflectance(specular), vec3(R(0.0)));
    vec3 of_all = reflectance(albedo);
    vec3 both = of_all + of_gloss;
    // No surface reflects more than it receives.
    Bool tint = max(max(both.x, both.y), both.z) > R(1.0);
    return Material(true, of_all, of_gloss, tint, choose(glossy, phong_exponent(roughness), R(1.0)));
}

// How a surface's glossy part reflects toward the camera.
struct Shine {
    vec3 mirrored;  // the lobe's axis
    vec3 gloss;
    float peak;     // of the lobe
    float cosine;   // mean, of light in the lobe to its axis
};

PURE Shine shine_of(IN(Surface) surface, IN(Material) material)
{
    vec3 view = surface.point / max(length(surface.point), R(1e-20));
    float grazing = clamp(R(1.0) + dot(view, surface.normal), R(0.0), R(1.0));
    float twice = grazing * grazing;
    float n = material.exponent;
    return Shine(view - R(2.0) * dot(view, surface.normal) * surface.normal,
                 material.specular * choose(material.tint, R(0.04) + R(0.96) * twice * twice * grazing, R(1.0)),
                 (n + R(1.0)) / (R(2.0) * pi), (n + R(1.0)) / (n + R(2.0)));
}

// Irradiance across a light's way in clear air, for intensity 1.
PURE float strength_across(IN(Surface) surface, IN(Light) light)
{
    if (light.type == light_directional)
        return R(1.0);
    return min(fluence(max(length(light.position - surface.point), smallest_light), light.radius), radiance_limit);
}

// The part of it that a spot's cone lets through.
PURE float within_spot(IN(Surface) surface, IN(Light) light)
{
    if (light.type != light_spot)
        return R(1.0);
    vec3 way = light.position - surface.point;
    return spot_factor(light, -dot(way, light.direction) / max(length(way), smallest_light));
}

PURE vec3 way_to(IN(Surface) surface, IN(Light) light)
{
    if (light.type == light_directional)
        return -light.direction;
    vec3 way = light.position - surface.point;
    return way / max(length(way), smallest_light);
}

// How a lamp stands to a surface of known material.
struct Facing {
    float strength;  // irradiance across the lamp's way in clear air, for intensity 1
    float straight;  // of that, what a spot's cone lets through. What leaves the cone is not followed
    float cosine;
    float mirror_cosine;
    float lobe;      // what of the straight light is mirrored, for gloss 1
};

// glossy: whether the surface may be.
PURE Facing facing_of(IN(Surface) surface, IN(Light) light, IN(Material) material, IN(Shine) shine, bool glossy)
{
    Facing facing = Facing(strength_across(surface, light), within_spot(surface, light), cosine_to(surface, light), R(0.0), R(0.0));
    if (glossy) {
        float m = dot(shine.mirrored, way_to(surface, light));
        float lobe = facing.straight * shine.peak * exp(material.exponent * log(max(m, R(1e-6))));
        facing.mirror_cosine = m;
        facing.lobe = choose(facing.cosine > R(0.0) && m > R(0.0), lobe, R(0.0));
    }
    return facing;
}

// Of one colour: shares of what came straight, diffuse and mirrored, and what comes from aside, onto the surface and into its lobe.
struct Arrived {
    float along;
    float kept;
    float aside;
    float mirrored_aside;
};

// From behind less comes: the first moments of light of this mean cosine.
PURE float fallen_off(float mean_cosine, float cosine)
{
    return exp(R(2.0) * mean_cosine * min(cosine, R(0.0)));
}

PURE Arrived arrived_of_lamp(IN(LampMedium) colour, float g, float p, IN(Facing) facing, IN(Shine) shine, bool glossy)
{
    float x = min(colour.reduced * p, orders_depth_limit);
    float depth = min(colour.extinction * colour.reduced * p, orders_depth_limit);
    Received r = received_in(colour, g, x, facing.cosine);
    Rescattered again = rescattered_in(colour, x, depth);
    Arrived arrived = Arrived(r.along, R(0.0), fallen_off(again.cosine, facing.cosine) * r.aside, R(0.0));
    if (glossy) {
        arrived.kept = parted(depth).x;
        arrived.mirrored_aside = again.fluence * henyey_greenstein(again.cosine * shine.cosine, facing.mirror_cosine);
    }
    return arrived;
}

// What becomes of a light's part of the picture, whatever that is.
struct Change {
    vec3 along;      // shares of diffuse light,
    vec3 kept;       // and of the highlight,
    vec3 highlight;  // which is this, where it is that much
    vec3 brought;    // by the medium to where the part is not
};

PURE Change scaled_by(vec3 share)
{
    return Change(share, vec3(R(0.0)), vec3(R(0.0)), vec3(R(0.0)));
}

// Diffuse light that came straight keeps to its way and the rest comes from aside, so that shadows and sides turned away get theirs. A
// highlight keeps e^-tau; what has been scattered makes one as wide as it comes: the mean cosines of the lobe and of the light multiply.
// Published methods dim all that came straight by e^-tau. Without a normal a surface has no sides and no mirror.
PURE Change change_of(IN(Surface) surface, IN(Light) light, IN(Material) material, IN(Shine) shine, IN(Facing) facing, IN(Arrived) red,
                      IN(Arrived) green, IN(Arrived) blue)
{
    Bool sided = has_normal(surface);
    vec3 along = vec3(red.along, green.along, blue.along);
    vec3 aside = vec3(red.aside, green.aside, blue.aside);
    vec3 mirrored = vec3(red.mirrored_aside, green.mirrored_aside, blue.mirrored_aside);
    vec3 clear = min(facing.strength * light.intensity, vec3(radiance_limit));
    vec3 brought = min(clear * facing.straight, vec3(radiance_limit)) * (material.albedo * aside / pi + shine.gloss * mirrored);
    return Change(chosen(sided, along, along + aside), vec3(red.kept, green.kept, blue.kept),
                  chosen(sided, shine.gloss * (facing.lobe * clear), vec3(R(0.0))), chosen(sided, brought, vec3(R(0.0))));
}

// own: the light's part.
PURE vec3 becomes(IN(Change) change, vec3 own)
{
    vec3 highlight = min(change.highlight, max(own, vec3(R(0.0))));
    return min((own - highlight) * change.along + highlight * change.kept + change.brought, vec3(radiance_limit));
}

// p: density_to_lamp(), as of change_by_sun().
PURE Change change_by_lamp(IN(Medium) medium, IN(LampColours) colours, IN(SurfaceSettings) settings, IN(Surface) surface,
                           IN(Light) light, IN(Material) material, IN(Shine) shine, float p)
{
    if (!some(material.known))
        return scaled_by(share_of_lamp(medium, colours, surface, light, p));
    bool glossy = settings.material > 1;
    Facing facing = facing_of(surface, light, material, shine, glossy);
    float g = colours.asymmetry;
    Arrived red = arrived_of_lamp(colours.red, g, p, facing, shine, glossy);
    Arrived green = red;
    if (!green_as_red(medium))
        green = arrived_of_lamp(colours.green, g, p, facing, shine, glossy);
    Arrived blue = green;
    if (!blue_as_green(medium))
        blue = arrived_of_lamp(colours.blue, g, p, facing, shine, glossy);
    return change_of(surface, light, material, shine, facing, red, green, blue);
}
