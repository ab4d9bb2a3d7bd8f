// Formulas of shaders/lib where they switch from one form to another: no jump that shows, in float and in double.
#include <functional>
#include <map>

#include <gtest/gtest.h>

#include "airlight_world.h"
#include "calibrated/spread.h"

namespace f32 = brume::maths_float;
namespace f64 = brume::maths_double;

namespace {

struct Switch {
    std::string name;
    double at;
    double tolerance;  // of the jump, relative to the value or `floor`
    std::function<double(double)> wide, narrow;
    double step = 0;  // to either side, where the last digit is no measure: at 0, or of what is found by bisection
    double floor = 1e-30;
};

// The same text in both precisions, as m::.
#define WIDE(expression)                                                                                                    \
    [=](double x) -> double {                                                                                               \
        namespace m = f64;                                                                                                  \
        (void)x;                                                                                                            \
        return double(expression);                                                                                          \
    }
#define NARROW(expression)                                                                                                  \
    [=](double x) -> double {                                                                                               \
        namespace m = f32;                                                                                                  \
        (void)x;                                                                                                            \
        return double(expression);                                                                                          \
    }
#define BOTH(expression) WIDE(expression), NARROW(expression)

constexpr double rounding = 1e-6;    // a few of float's
constexpr double truncation = 2e-7;  // of the series and rational forms, and one rounding

// The step across the switch beyond what the slope on either side explains.
double jump(const std::function<double(double)> &f, double low, double high, double lower, double higher, double floor)
{
    const double a = f(low), b = f(high), slope = 0.5 * (std::abs(a - f(lower)) + std::abs(f(higher) - b));
    if (!std::isfinite(a) || !std::isfinite(b))
        return INFINITY;
    return std::max(std::abs(b - a) - 2 * slope, 0.0) / std::max({std::abs(a), std::abs(b), floor});
}

double jump_in_float(const Switch &s)
{
    const float at = float(s.at), step = float(s.step);
    const float low = step > 0 ? at - step : std::nextafter(at, -INFINITY),
                high = step > 0 ? at + step : std::nextafter(at, INFINITY);
    const float lower = step > 0 ? at - 2 * step : std::nextafter(low, -INFINITY),
                higher = step > 0 ? at + 2 * step : std::nextafter(high, INFINITY);
    // The switch itself takes one side or the other.
    return std::max({jump(s.narrow, low, high, lower, higher, s.floor), jump(s.narrow, low, at, lower, high, s.floor),
                     jump(s.narrow, at, high, low, higher, s.floor)});
}

double jump_in_double(const Switch &s)
{
    const double step = s.step > 0 ? s.step : 1e-10 * std::abs(s.at);
    return jump(s.wide, s.at - step, s.at + step, s.at - 2 * step, s.at + 2 * step, s.floor);
}

// Prints the worst of the table and holds each row to its tolerance.
void hold(const char *title, const std::vector<Switch> &all)
{
    double in_float = 0, in_double = 0;
    const char *where_float = "", *where_double = "";
    for (const Switch &s : all) {
        const double narrow = jump_in_float(s), wide = s.wide ? jump_in_double(s) : 0;
        EXPECT_LE(narrow, s.tolerance) << s.name << " in float at " << s.at;
        EXPECT_LE(wide, s.tolerance) << s.name << " in double at " << s.at;
        if (narrow >= in_float) {
            in_float = narrow;
            where_float = s.name.c_str();
        }
        if (wide >= in_double) {
            in_double = wide;
            where_double = s.name.c_str();
        }
    }
    printf("%s, %zu switches: float %.1e (%s), double %.1e (%s)\n", title, all.size(), in_float, where_float, in_double,
           where_double);
}

template <class Medium> Medium medium(double scattering, double absorption)
{
    Medium m{};
    m.scattering = decltype(m.scattering)(scattering);
    m.absorption = decltype(m.absorption)(absorption);
    m.luminance = decltype(m.luminance)(1.0 / 3);
    m.emission = decltype(m.emission)(0.5);
    return m;
}

template <class Medium> Medium sloping(double along, double log_density)
{
    Medium m = medium<Medium>(0.05, 0.01);
    m.term_count = 1;
    m.terms[0] = decltype(m.phase)(along, 0, 0, log_density);
    return m;
}

template <class Light> Light spot(double cosine)
{
    Light l{};
    l.type = f32::light_spot;
    l.position = decltype(l.position)(0.4, 1, -5);
    l.direction = decltype(l.direction)(0, 0, 1);
    l.intensity = decltype(l.intensity)(1);
    l.cos_outer = decltype(l.radius)(cosine);
    l.cos_inner = decltype(l.radius)(0.9);
    return l;
}

template <class Real> struct Image {
    explicit Image(const std::vector<float> &v, int channels, int width = 1024)
        : values(v.begin(), v.end()), channels(channels), width(width)
    {
        values.resize((values.size() / size_t(width * channels) + 1) * size_t(width * channels));
    }
    template <class Texture> Texture as() const
    {
        return {values.data(), width * channels, width, int(values.size()) / (width * channels), channels};
    }

    std::vector<Real> values;
    int channels, width;
};

struct Images {
    Images(const std::vector<float> &v, int channels, int width = 1024)
        : wide(v, channels, width), narrow(v, channels, width)
    {
    }
    Image<double> wide;
    Image<float> narrow;
};

}  // namespace

TEST(Continuity, Densities)
{
    std::vector<Switch> all{
        {"mean_exponential", 2, truncation, BOTH(m::mean_exponential(m::real(x)))},
        {"mean_square_exponential", 1, rounding, BOTH(m::mean_square_exponential(m::real(x)))},
        {"mean_square_exponential, e", 100, rounding, BOTH(m::mean_square_exponential(m::real(x)))},
        {"mean_square_to_end", 1, rounding, BOTH(m::mean_square_to_end(m::real(x)))},
        {"exponential term across the slope", 0, rounding,
         BOTH(m::exponential_density_integral(m::vec4(0.5, 0, 0, 0.3), m::vec3(x, 1, 0), 10)), 1e-7},
        {"density_moment across the slope", 0, rounding,
         BOTH(m::density_moment(sloping<m::Medium>(0.5, 0.3), m::vec3(x, 1, 0), 10)), 1e-7},
        {"density_integral, saturated", 69.07755279, 1e-5,
         BOTH(m::density_integral(sloping<m::Medium>(0, x), m::vec3(0, 1, 0), 1)), 1e-4},
        {"density_at, saturated", 69, 1e-5, BOTH(m::density_at(sloping<m::Medium>(0, x), m::vec3(0)))},
        {"exponential term, e^80", 80, 1e-5, BOTH(m::density_moment(sloping<m::Medium>(0, x), m::vec3(0, 1, 0), 1e-10))},
    };
    // The medium that a ray of a given slope leaves in the same density: through all of its signs and sizes.
    for (double q : {-2.0, -1.0, 1.0, 2.0, 100.0}) {
        all.push_back({"density_integral at q " + std::to_string(q), q, rounding,
                       BOTH(m::density_integral(sloping<m::Medium>(0.1, 0), m::vec3(x / 10, 0, 0), 100))});
        all.push_back({"density_moment at q " + std::to_string(q), q, rounding,
                       BOTH(m::density_moment(sloping<m::Medium>(0.1, 0), m::vec3(x / 10, 0, 0), 100))});
    }
    hold("densities", all);
}

TEST(Continuity, Shares)
{
    std::vector<Switch> all{
        {"one_minus_exp", 2, truncation, BOTH(m::one_minus_exp(m::real(x)))},
        {"scattered_share", 2, truncation, BOTH(m::scattered_share(medium<m::Medium>(1, 0.1), m::real(x)).x)},
        {"rescattered_share", 2, rounding, BOTH(m::rescattered_share(medium<m::Medium>(1, 0.1), m::real(x)).x)},
        {"emitted", 2, truncation, BOTH(m::emitted(medium<m::Medium>(0.9, 0.1), m::real(x)).x)},
        {"composed, limit", 65504, rounding, BOTH(m::composed(m::real(x), 1, 0, 65504))},
        {"composed, largest float", 3.4e38, rounding, BOTH(m::composed(m::real(3.4e38), m::real(x / 3.4e38), 0, 3.402e38f)),
         1e32},
        {"spread_angle, long", 1e15, rounding, BOTH(m::spread_angle(medium<m::Medium>(1e-10, 1e-12), m::real(x)))},
        {"spread_angle, dense", 1e15, rounding, BOTH(m::spread_angle(medium<m::Medium>(1e3, 0), m::real(x)))},
        {"spread_angle, absorbing", 1e10, rounding, BOTH(m::spread_angle(medium<m::Medium>(1, 1e8), m::real(x)))},
        {"placement, nothing moved", 1, rounding, BOTH(m::placement(m::real(x), 1))},
        {"henyey_greenstein, g 0", 0, rounding, BOTH(m::henyey_greenstein(m::real(x), m::real(-0.7))), 1e-8},
        {"henyey_greenstein, g .9999", 0.9999, 2e-3, BOTH(m::henyey_greenstein(m::real(x), m::real(0.99)))},
        {"henyey_greenstein, g -.9999", -0.9999, 2e-3, BOTH(m::henyey_greenstein(m::real(x), m::real(0.99)))},
        {"henyey_greenstein, cosine 1", 1, 1e-2, BOTH(m::henyey_greenstein(m::real(0.9), m::real(x)))},
        {"spread_level, finest", 0.86, rounding, BOTH(m::spread_level(m::real(x), m::real(0.86), 8)), 0, 1},
        {"spread_level, coarsest", 0.86 * 256, rounding, BOTH(m::spread_level(m::real(x), m::real(0.86), 8))},
        {"leak_mask, from", 3.44, rounding, BOTH(m::leak_mask(m::real(x), m::real(0.86), 2, 3)), 0, 1},
        {"leak_mask, to", 10.32, rounding, BOTH(m::leak_mask(m::real(x), m::real(0.86), 2, 3)), 0, 1},
        {"soft_step, from", 3, rounding, BOTH(m::soft_step(3, 2, m::real(x))), 0, 1},
        {"soft_step, to", 5, rounding, BOTH(m::soft_step(3, 2, m::real(x))), 0, 1},
    };
    hold("shares and spreads", all);
}

TEST(Continuity, Gaussians)
{
    std::vector<Switch> all{
        {"erf, end", 3.9, truncation, BOTH(m::erf(m::real(x)))},
        {"erf, other end", -3.9, truncation, BOTH(m::erf(m::real(x)))},
        {"scaled_erfc, end", 1e15, rounding, BOTH(m::scaled_erfc(m::real(x)))},
        {"gaussian_area, beside the centre", 0.5, rounding, BOTH(m::gaussian_area(m::real(x), 1))},
        {"gaussian_area, before the centre", -1.5, rounding, BOTH(m::gaussian_area(m::real(x), 1))},
        {"gaussian_area, from the centre", 0, rounding, BOTH(m::gaussian_area(m::real(x), 2)), 1e-7},
        {"gaussian_area, to the centre", -2, rounding, BOTH(m::gaussian_area(m::real(x), 2))},
        {"gaussian_area, far away", -1e15, rounding, BOTH(m::gaussian_area(m::real(x), m::real(1.5e15))), 0, 1},
        {"moment, far away", 1e15, rounding, BOTH(m::profile_density_moment({1, 1, m::real(1e15)}, m::real(x)).y), 4e14},
        {"moment, nothing left", 8.23, rounding, BOTH(m::profile_density_moment({1, 1, m::real(-x)}, 2).y)},
    };
    for (double c : {0.0, 0.3, 1.0, 2.0, 5.0}) {
        const double w = 0.25 / std::max(c, 1.0), exponent = 1 + c * c;  // which has as many digits less
        for (double side : {-1.0, 1.0})
            all.push_back({"gaussian_area, series about " + std::to_string(side * c), 2 * w, rounding * exponent,
                           BOTH(m::gaussian_area(m::real(side * c - 0.5 * x), m::real(x))), 1e-6 * w});
        for (double side : {-1.0, 1.0}) {
            const double middle = -side * c, distance = 0.5 / std::max(c, 1.0);
            all.push_back({"moment's integral, middle " + std::to_string(middle), distance, rounding * exponent,
                           BOTH(m::profile_density_moment({1, 1, m::real(middle)}, m::real(x)).x), 1e-6 * distance});
            // Its terms cancel on the flanks, where it is good to 1e-4 of the integral.
            const double floor = f64::profile_density_moment({1, 1, middle}, distance).x;
            all.push_back({"moment, middle " + std::to_string(middle), distance, 1e-4 * exponent,
                           BOTH(m::profile_density_moment({1, 1, m::real(middle)}, m::real(x)).y), 1e-6 * distance, floor});
        }
    }
    // Gaussians that are passed at a distance: left out below 3e-5 of what a ray through the centre meets.
    const double whole = 1.7724538509;
    all.push_back(
        {"passed_by", std::sqrt(std::log(1 / 3e-5)), 3.1e-5,
         BOTH(m::passed_by(medium<m::Medium>(1, 0), {m::vec3(m::real(x), 0, -9), 1, 1, m::vec3(1)},
                           m::profile_along({m::vec3(m::real(x), 0, -9), 1, 1, m::vec3(1)}, m::vec3(0), m::vec3(0, 0, -1)))
                  ? 0
                  : m::gaussian_integral({m::vec3(m::real(x), 0, -9), 1, 1, m::vec3(1)}, m::vec3(0), m::vec3(0, 0, -1), 0,
                                         20)),
         1e-5, whole});
    hold("Gaussians", all);
}

TEST(Continuity, LightGaussiansLeaveOutWhatDoesNotShow)
{
    auto shadow = [](f64::vec3 center) {
        return [=](double x) {
            airlight_cases::Case c;
            c.lights.push_back(airlight_cases::light_at({0, 0, -20}));
            c.gaussians.push_back({center * x, 1, 1, f64::vec3(1)});
            return double(airlight_cases::World(c).shadow(-1, {0, 0, -10}));
        };
    };
    const double whole = 1.7724538509, aside = std::sqrt(14.0);
    hold("shadow lists", {{"aside", 1, 1e-6, nullptr, shadow({aside, 0, 0}), 1e-5, whole},
                          {"aside of the middle", 1, 1e-6, nullptr,
                           [=](double x) {
                               return shadow({0, 0, 0})(x) + shadow({aside, 0, -5})(x);
                           },
                           1e-5, whole},
                          {"before the way", 1, 1e-6, nullptr, shadow({0, 0, 3.5}), 1e-5, whole}});
}

TEST(Continuity, LightsAndTables)
{
    const Images sun(brume::airlight::sun_table(), 1), environment(brume::airlight::environment_table(), 4);
    auto in_wide = [](const Images &i) { return i.wide.as<f64::Texture>(); };
    auto in_narrow = [](const Images &i) { return i.narrow.as<f32::Texture>(); };
    auto table = [&](const std::string &name, double at, double tolerance, const Images &image, auto wide, auto narrow,
                     double floor) {
        return Switch{name,
                      at,
                      tolerance,
                      [=, &image](double x) { return double(wide(in_wide(image), x)); },
                      [=, &image](double x) { return double(narrow(in_narrow(image), float(x))); },
                      0,
                      floor};
    };
    std::vector<Switch> all{
        {"fluence, surface", 0.5, 1e-3, BOTH(m::fluence(m::real(x), m::real(0.5)))},
        {"aspect, least height", 5e-4, rounding,
         BOTH(m::aspect_of({m::vec3(m::real(x), 0, -5), 0, m::vec3(0), -1, m::vec3(1), -1, 0, 0}, m::vec3(0, 0, -1)).height),
         1e-9},
        {"spot_factor, rim", 0.5, rounding, BOTH(m::spot_factor(spot<m::Light>(0.5), m::real(x))), 0, 1},
        {"spot_factor, inner cone", 0.9, rounding, BOTH(m::spot_factor(spot<m::Light>(0.5), m::real(x))), 0, 1},
        {"asinh_of", 0, rounding, BOTH(m::asinh_of(m::real(x))), 1e-8, 1},
        {"half_turn_tangent", 0, rounding, BOTH(m::half_turn_tangent(m::real(x), 2)), 1e-8},
    };
    auto length = [](auto s) { return std::max(double(s.y) - double(s.x), 0.0); };
    auto tilted = [](auto zero, double along) {  // a direction at this cosine from the spot's axis
        using Vector = decltype(zero);
        return Vector(typename Vector::value_type(std::sqrt(1 - along * along)), 0, typename Vector::value_type(along));
    };
    for (double along : {0.8, 0.05, -0.05, -0.8})
        all.push_back({"cone to half of space", 1e-6, 1e-5,
                       BOTH(length(m::lit_interval(spot<m::Light>(x), tilted(m::vec3(0), along), 20, m::real(x)))), 1e-9,
                       20});
    // Rays along the cone's side run in it to any distance on one side of the switch, and to the picture's end on the other.
    for (double c : {0.3, 0.7, 0.99})
        all.push_back({"along the cone's side", c, 1e-4,
                       BOTH(length(m::lit_interval(spot<m::Light>(c), tilted(m::vec3(0), x), 20, m::real(c)))), 1e-6, 20});
    all.push_back({"half of space, across", 0, 1e-4,
                   BOTH(length(m::lit_interval(spot<m::Light>(0), tilted(m::vec3(0), x), 20, 0))), 1e-6, 20});

    for (double u : {10.0, 10.0 * 20 / 63, 10.0 * 62 / 63})
        for (double v : {0.2, 1.0, 1.55})
            all.push_back(table(
                "sun_function over u", u, rounding, sun,
                [=](const f64::Texture &t, double x) { return f64::sun_function(t, x, v); },
                [=](const f32::Texture &t, float x) { return f32::sun_function(t, x, float(v)); }, 1e-3));
    for (int cell : {1, 30, 62})
        all.push_back(table(
            "sun_function over v", 1.57079632679490 * cell / 63, rounding, sun,
            [=](const f64::Texture &t, double x) { return f64::sun_function(t, 2, x); },
            [=](const f32::Texture &t, float x) { return f32::sun_function(t, 2, x); }, 1e-3));
    for (int entry : {0, 1, 33, 79, 80})
        for (int upper : {0, 1})
            all.push_back(table(
                "environment_factors", 1e-4 * std::exp2(entry / 4.0), 1e-5, environment,
                [=](const f64::Texture &t, double x) { return f64::environment_factors(t, x, upper).x; },
                [=](const f32::Texture &t, float x) { return f32::environment_factors(t, x, upper).x; }, 1e-30));
    hold("lights and tables", all);
}

TEST(Continuity, CalibratedTable)
{
    const int top = 6;
    const multiscatter::SpreadSource source{0.05, 0, 0.8, 500, top};
    const Images values(multiscatter::spread_values(source), 1);
    f32::Calibrated f{};
    f.top = top;
    f.step = source.step;
    f.first_place = float(multiscatter::first_place(source));
    f.per_reach = std::exp2(-f.first_place);
    f64::Calibrated g{};
    g.top = top;
    g.step = source.step;
    g.first_place = f.first_place;
    g.per_reach = f.per_reach;
    g.detour = f64::vec3(0.01);
    f.detour = f32::vec3(0.01f);
    const auto wide = values.wide.as<f64::Texture>();
    const auto narrow = values.narrow.as<f32::Texture>();
    std::vector<Switch> all;
    for (int level = 0; level <= top; ++level) {
        if (level > 0 && !f32::collects(f, level))
            continue;
        const std::string name = " of level " + std::to_string(level);
        for (int place : {1, 15, 30, 31})
            all.push_back({"staying" + name, double(place), rounding, [=](double x) { return f64::staying(wide, level, x); },
                           [=](double x) { return double(f32::staying(narrow, level, float(x))); }});
        for (int place : {1, 8, 15})
            all.push_back({"visible_share" + name, place / 16.0, 1e-5,
                           [=](double x) { return f64::visible_share(wide, level, x); },
                           [=](double x) { return double(f32::visible_share(narrow, level, float(x))); }, 0, 1e-2});
        all.push_back({"visible_share, to the source" + name, 1, rounding,
                       [=](double x) { return x < 1 ? f64::visible_share(wide, level, x) : 1; },
                       [=](double x) { return x < 1 ? double(f32::visible_share(narrow, level, float(x))) : 1; }});
    }
    for (double place : {0.0, 31.0}) {
        const double p = std::exp2(f.first_place + 0.5 * place);
        all.push_back({"spread_place, end", p, 2e-6, [=](double x) { return f64::spread_place(g, f64::octaves_of(x)); },
                       [=](double x) { return double(f32::spread_place(f, f32::octaves_of(float(x)))); }, 1e-6 * p, 1});
        all.push_back({"reach_of, end", p, 2e-6, [=](double x) { return f64::reach_of(g, x); },
                       [=](double x) { return double(f32::reach_of(f, float(x))); }, 1e-6 * p});
    }
    auto absorbing = [](double x) { return std::max(x, 0.0); };
    all.push_back({"arrived_share, no absorption", 0, rounding,
                   [=](double x) {
                       const auto thin = medium<f64::Medium>(0.05, absorbing(x));
                       return f64::arrived_share(thin, g, 20, f64::octaves_of(20), f64::scattered_share(thin, 20)).x;
                   },
                   [=](double x) {
                       const auto thin = medium<f32::Medium>(0.05, absorbing(x));
                       return double(f32::arrived_share(thin, f, 20, f32::octaves_of(20), f32::scattered_share(thin, 20)).x);
                   },
                   1e-10});
    hold("kernel calibrated", all);
}

TEST(Continuity, PyramidsAndNoise)
{
    const int n = 8;
    std::vector<float> base(n * n * 4), stack(n * n * 4);
    for (size_t i = 0; i < base.size(); ++i) {
        base[i] = 1 + 0.5f * std::sin(float(i * i % 97));
        stack[i] = 1 + 0.5f * std::cos(float(i * i % 89));
    }
    const Images bases(base, 4, n), stacks(stack, 4, n);
    const auto wide = bases.wide.as<f64::Texture>(), wide_stack = stacks.wide.as<f64::Texture>();
    const auto narrow = bases.narrow.as<f32::Texture>(), narrow_stack = stacks.narrow.as<f32::Texture>();
    std::vector<Switch> all;
    for (int mode = 0; mode < 3; ++mode) {
        for (double level : {1.0, 2.0})
            all.push_back(
                {"fetch_pyramid over levels, mode " + std::to_string(mode), level, rounding,
                 [=](double x) {
                     return f64::fetch_pyramid(wide, wide_stack, {{n, n}, 3}, mode, {3.3, 4.1}, x).x;
                 },
                 [=](double x) {
                     return double(f32::fetch_pyramid(narrow, narrow_stack, {{n, n}, 3}, mode, {3.3f, 4.1f}, float(x)).x);
                 }});
        for (double pixel : {0.5, 3.5, 4.0, 7.5})
            all.push_back(
                {"fetch_pyramid over pixels, mode " + std::to_string(mode), pixel, 2e-6,
                 [=](double x) {
                     return f64::fetch_pyramid(wide, wide_stack, {{n, n}, 3}, mode, {x, 4.1}, 0.4).x;
                 },
                 [=](double x) {
                     return double(f32::fetch_pyramid(narrow, narrow_stack, {{n, n}, 3}, mode, {float(x), 4.1f}, 0.4f).x);
                 }});
    }
    for (double q : {0.0, 3.0, -7.0, 256.0})
        all.push_back({"noise_at, lattice", q, 1e-5, BOTH(m::noise_at(m::vec3(m::real(x), m::real(0.3), m::real(2.7)), 5).x),
                       1e-7, 1});
    hold("pyramids and noise", all);
}

// Paths and methods of the tier `nodes` are chosen by thresholds. Their results differ by what the tier is off.
TEST(Continuity, PathsOfTierNodes)
{
    auto airlight = [](std::function<airlight_cases::Case(double)> make) {
        return [=](double x) {
            const airlight_cases::Case c = make(x);
            return double(airlight_cases::World(c).airlight(f32::airlight_nodes).radiance.x);
        };
    };
    auto lamp = [](f64::vec3 position) {
        airlight_cases::Case c;
        c.lights.push_back(airlight_cases::light_at(position));
        c.medium.scattering = f64::vec3(0.05);
        c.medium.absorption = f64::vec3(0.01);
        c.medium.constant = 1;
        c.distance = 10;
        return c;
    };
    const f64::Gaussian blob{{0.1, 0, -6}, 1, 2, f64::vec3(1)};
    std::vector<Switch> all;
    auto add = [&](const char *name, double at, std::function<airlight_cases::Case(double)> make) {
        all.push_back({name, at, 3e-3, nullptr, airlight(make), 1e-5 * at});
    };
    add("decay to angle", 10, [=](double x) { return lamp({x, 0, -5}); });
    add("passing the foot", 5, [=](double x) { return lamp({x, 0, -5}); });
    add("light's radius over its distance", 0.7, [=](double x) {
        auto c = lamp({0.7, 0, -5});
        c.lights[0].radius = x;
        return c;
    });
    add("peak of the phase function", 0.4, [=](double x) {
        auto c = lamp({0.2, 0, -5});
        c.medium.phase.x = x;
        return c;
    });
    add("bell to angle", 2, [=](double x) {
        auto c = lamp({0.1 + x, 0, -6});
        c.medium.constant = 0;
        c.gaussians.push_back(blob);
        return c;
    });
    add("far end", 1e15, [=](double x) {
        auto c = lamp({0.5, 0, -5});
        c.distance = x;
        return c;
    });
    // From one Gaussian to two the whole method changes; the second is next to nothing.
    all.push_back({"parts to cells", 1, 1e-2, nullptr, airlight([=](double x) {
                       auto c = lamp({0.5, 0.3, -5});
                       c.gaussians.push_back(blob);
                       if (x > 1)
                           c.gaussians.push_back({{0.1, 0, -6}, 1, 1e-9, f64::vec3(1)});
                       return c;
                   }),
                   1e-5});
    hold("paths of tier nodes", all);
}
