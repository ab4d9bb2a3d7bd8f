// The tier `sun`: Sun et al. 2005 eq. 11, as published. Needs airlight.glsl.
//
// Homogeneous, isotropic, no Gaussians. Fine for forward views (mean .5 %, at most 4.4 %, airlight_accuracy); a difference of two
// values of the table scaled by e^(+T_sv) elsewhere: away from the light one view of twenty is more than twice too bright or dark.
// Beyond the paper: absorption, spots clipped at the middle of their penumbra, directional lights in closed form, and
// exponential terms as their mean between the camera and the light.

const int sun_table_size = 64;
const float sun_table_limit = R(10.0);  // the largest u; larger ones read as it
const float half_pi = R(1.57079632679490);

PURE float sun_texel(sampler2D sun_table, int u, int v)
{
    return data_texel(sun_table, v * sun_table_size + u).x;
}

// F(u, v) = int_0^v e^(-u tan x) dx, bilinear; v in [0, pi / 2].
PURE float sun_function(sampler2D sun_table, float u, float v)
{
    float last = float(sun_table_size - 1);
    float x = clamp(u / sun_table_limit, R(0.0), R(1.0)) * last;
    float y = clamp(v / half_pi, R(0.0), R(1.0)) * last;
    int i = min(int(x), sun_table_size - 2);
    int j = min(int(y), sun_table_size - 2);
    float fx = x - float(i);
    float lower = mix(sun_texel(sun_table, i, j), sun_texel(sun_table, i + 1, j), fx);
    float upper = mix(sun_texel(sun_table, i, j + 1), sun_texel(sun_table, i + 1, j + 1), fx);
    return mix(lower, upper, y - float(j));
}

// What bilinear interpolation is off by at most: an eighth of the cell's sides squared times the second derivatives.
PURE float sun_function_error(float u, float v)
{
    float du = sun_table_limit / float(sun_table_size - 1);
    float dv = half_pi / float(sun_table_size - 1);
    float t = min(tan(min(v, half_pi - R(0.5) * dv)), R(1e4));
    float w = max(u - R(0.5) * du, R(0.37) * du);  // it is u log u at u = 0
    return R(0.125) * (du * du * one_minus_exp(w * t) / w + dv * dv * u * (R(1.0) + t * t) * exp(-u * t)) +
           (u > sun_table_limit ? exp(-sun_table_limit * t) : R(0.0));
}

// La of eq. 11 and its error at sigma_s = beta, I = 1.
PURE vec2 sun_airlight(sampler2D sun_table, IN(Aspect) aspect, vec2 lit, float beta)
{
    float u = min(beta * aspect.height, radiance_limit);
    float v0 = R(0.5) * half_pi + R(0.5) * atan(lit.x - aspect.foot, aspect.height);
    float v1 = R(0.5) * half_pi + R(0.5) * atan(lit.y - aspect.foot, aspect.height);
    float a0 = min(beta * exp(clamp(-beta * aspect.foot, -R(80.0), R(80.0))) / (R(2.0) * pi * aspect.height), radiance_limit);
    float f = sun_function(sun_table, u, v1) - sun_function(sun_table, u, v0);
    return min(a0 * vec2(max(f, R(0.0)), sun_function_error(u, v0) + sun_function_error(u, v1)), vec2(radiance_limit));
}

// The same for each colour, with the scattering in place of the extinction, and the light's intensity.
PURE Airlight homogeneous_airlight(IN(Medium) medium, sampler2D sun_table, IN(Light) light, vec3 direction, float distance,
                                   float density)
{
    Airlight none = Airlight(vec3(R(0.0)), vec3(R(0.0)));
    vec2 lit = lit_interval(light, direction, distance, mix(light.cos_outer, light.cos_inner, R(0.5)));
    if (lit.x >= lit.y || density <= R(0.0))
        return none;
    Aspect aspect = aspect_of(light, direction);
    aspect.height = max(aspect.height, light.radius);
    vec3 extinction = medium.scattering + medium.absorption;
    vec3 beta = min(extinction * density, vec3(density_limit));
    vec2 value = vec2(R(0.0));
    Airlight sum = none;
    for (int c = 0; c < 3; ++c) {
        if (beta[c] <= R(0.0))
            continue;
        if (c == 0 || beta[c] != beta[c - 1])
            value = sun_airlight(sun_table, aspect, lit, beta[c]);
        float albedo = medium.scattering[c] / extinction[c];
        sum.radiance[c] = min(albedo * light.intensity[c] * value.x, radiance_limit);
        sum.error[c] = min(albedo * light.intensity[c] * value.y, radiance_limit);
    }
    return sum;
}

// Parallel light needs no table: C_s p E e^(-C_t P_0) int rho e^(-C_t P(t)) dt is exact for any terms that are alike all along
// the light's way, with P_0 as at the camera.
PURE vec3 parallel_airlight(IN(Medium) medium, IN(Light) light, vec3 direction, float distance)
{
    float p = density_integral(medium, direction, distance);
    vec3 tau = optical_depth(medium, p);
    vec3 mean = vec3(mean_exponential(tau.x), mean_exponential(tau.y), mean_exponential(tau.z));
    // What of the light is scattered is at most all of it, whatever overflows on the way.
    vec3 share = min(medium.scattering * min(p * mean, vec3(density_limit)), vec3(R(1.0)));
    return min(phase(medium, -dot(light.direction, direction)) * light.intensity, vec3(radiance_limit)) * share *
           transmittance(medium, density_between(medium, vec3(R(0.0)), -light.direction, far_away, light.distance));
}

// Mean of the constant and exponential terms between the camera and the light.
PURE float mean_density(IN(Medium) medium, IN(Light) light)
{
    float d = length(light.position);
    if (medium.term_count == 0)
        return medium.constant;
    return d > R(0.0) ? density_integral(medium, light.position / d, d) / d : density_at(medium, vec3(R(0.0)));
}

// The constant and exponential terms' part by eq. 11.
PURE Airlight terms_by_table(IN(Medium) medium, sampler2D sun_table, IN(Light) light, IN(Sight) sight)
{
    if (light.type == light_directional)
        return Airlight(parallel_airlight(medium, light, sight.direction, sight.distance), vec3(R(0.0)));
    return homogeneous_airlight(medium, sun_table, light, sight.direction, sight.distance, mean_density(medium, light));
}

PURE Airlight airlight_by_table(IN(Medium) medium, AIRLIGHT_IMAGES, IN(Sight) sight, int first_light, int last_light)
{
    Airlight sum = Airlight(vec3(R(0.0)), vec3(R(0.0)));
    for (int l = first_light; l < last_light; ++l) {
        Airlight one = terms_by_table(medium, sun_table, light_at(lights, l), sight);
        sum.radiance += one.radiance;
        sum.error += one.error;
    }
    return Airlight(min(sum.radiance, vec3(radiance_limit)), min(sum.error, vec3(radiance_limit)));
}
