#pragma once
// Scenes with lights: as text for the C ABI, and the same text evaluated exhaustively in double, without any list.
#include <algorithm>
#include <array>
#include <random>

#include <nlohmann/json.hpp>

#include "fog.h"
#include "reference_ray.h"

namespace fog {

using Json = nlohmann::json;
using Vector = std::array<double, 3>;

// camera_to_world of a camera that is turned by `yaw` about +y, then pitched up.
inline Json pose(const Vector &at, double yaw = 0, double pitch = 0)
{
    const double cy = std::cos(yaw), sy = std::sin(yaw), cp = std::cos(pitch), sp = std::sin(pitch);
    return {{cy, sy * sp, sy * cp, at[0]}, {0, cp, -sp, at[1]}, {-sy, cy * sp, cy * cp, at[2]}, {0, 0, 0, 1}};
}

inline brume_camera camera(const Json &camera_to_world, double vertical_fov_degrees)
{
    brume_camera c = BRUME_CAMERA_INIT;
    c.given = BRUME_CAMERA_FIELD_OF_VIEW | BRUME_CAMERA_POSE;
    c.vertical_fov = vertical_fov_degrees * 3.14159265358979323846 / 180;
    for (size_t i = 0; i < 16; ++i)
        c.camera_to_world[i] = camera_to_world[i / 4][i % 4];
    return c;
}

inline Json gaussian(const Vector &center, double scale, double amplitude)
{
    return {{"type", "gaussian"}, {"center", center}, {"scale", scale}, {"amplitude", amplitude}};
}

inline Json constant(double value)
{
    return {{"type", "constant"}, {"value", value}};
}

inline Json point_light(const Vector &position, double intensity, double radius = 0)
{
    return {{"type", "point"}, {"position", position}, {"intensity", intensity}, {"radius", radius}};
}

// One camera at the origin with a field of view of 50 degrees, and the airlight alone.
inline Json lit_scene(const Json &medium, const Json &lights, const Json &airlight = Json::object())
{
    return {{"brume", 1},
            {"camera", {{"vertical_fov", 50}, {"camera_to_world", pose({0, 0, 0})}}},
            {"medium", medium},
            {"lights", lights},
            {"effects", {{"airlight", airlight}}}};
}

// Gaussians in front of, behind and around a camera at the origin.
inline Json random_gaussians(int count, unsigned seed, double extent, double largest_radius, double amplitude)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> u(0, 1);
    Json all = Json::array();
    for (int i = 0; i < count; ++i) {
        const Vector center{extent * (2 * u(random) - 1), extent * (u(random) - 0.5), extent * (2 * u(random) - 1.5)};
        const double radius = largest_radius * std::pow(10, -1.3 * u(random)), strength = amplitude * u(random);
        all.push_back(gaussian(center, 1 / radius, strength));
    }
    return all;
}

struct NamedScene {
    const char *name;
    Json scene;
    std::vector<const char *> tiers;  // those that know its medium and lights; reference aside
};

// One of each kind of medium, light and phase function.
inline std::vector<NamedScene> lit_scenes()
{
    const Json grey{{"scattering", {0.03, 0.04, 0.06}}, {"absorption", {0.01, 0, 0.002}}};
    const Json lamps{point_light({-1.5, 0.5, -6}, 4, 0.1), point_light({3, -1, -14}, 20), point_light({0.5, 1, 3}, 6)};
    std::vector<NamedScene> all;
    all.push_back({"homogeneous", lit_scene(grey, lamps), {"nodes", "fogshop", "sun"}});

    Json medium = grey;
    medium["density"] = random_gaussians(40, 5, 16, 4, 6);
    medium["density"].push_back(constant(0.2));
    all.push_back({"gaussians", lit_scene(medium, lamps), {"nodes", "fogshop"}});

    medium = {{"scattering", 0.05}, {"absorption", {0, 0.01, 0.02}}, {"g", 0.7}};
    medium["density"] = {{{"type", "exponential"}, {"value", 1}, {"falloff", 0.2}, {"direction", {0.1, 1, 0}}},
                         gaussian({1, 0, -8}, 0.5, 2)};
    const Json spot{{"type", "spot"}, {"position", {-4, 3, -8}}, {"direction", {0.8, -0.6, -0.1}},
                    {"angle", 40},    {"penumbra", 0.3},         {"intensity", {90, 70, 50}},
                    {"radius", 0.05}};
    all.push_back({"spot", lit_scene(medium, Json::array({spot, lamps[0]})), {"nodes"}});

    medium = {{"scattering", 0.02}, {"droplet_diameter", 12}};
    medium["density"] = random_gaussians(30, 6, 20, 5, 5);
    const Json sun{{"type", "directional"}, {"direction", {0.3, -1, 0.4}}, {"intensity", {3, 2.8, 2.5}}};
    all.push_back({"sun", lit_scene(medium, Json::array({sun})), {"nodes"}});

    Json sky = lit_scene(all[1].scene["medium"], Json::array({lamps[0]}));
    sky["environment"]["sh"] = {{0.7, 0.8, 1}, {0.2, 0.25, 0.4}, {0.1, 0, 0}, {0, -0.1, 0}};
    all.push_back({"sky", sky, {"nodes", "fogshop"}});
    return all;
}

struct Frame {
    Picture color, depth;
};

// A post 3 m away before a wall, under a sky.
inline Frame lit_frame(int width, int height)
{
    std::mt19937 random(2);
    std::uniform_real_distribution<float> u(0, 1);
    Frame f{Picture(width, height, 4), Picture(width, height, 1)};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            for (int c = 0; c < 4; ++c)
                f.color.at(x, y)[c] = u(random);
            const bool post = x * 5 / width == 1;
            f.depth.at(x, y)[0] = post ? 3 : y < height / 3 ? INFINITY : 18 + 6 * float(x) / float(width);
        }
    return f;
}

inline Picture flipped(const Picture &p)
{
    Picture out = p;
    for (int y = 0; y < p.height; ++y)
        std::copy_n(p.at(0, p.height - 1 - y), p.width * p.channels, out.at(0, y));
    return out;
}

// The display window of a format, as brume_format has it.
struct Window {
    int x = 0, y = 0, width = 0, height = 0;
};

// A scene's rays and what the formulas say along them, summed over every Gaussian and light there is.
class Exhaustive {
public:
    using vec3 = brume::maths_double::vec3;
    using Gaussian = brume::maths_double::Gaussian;

    Exhaustive(const Json &scene, int width, int height, const Window &window = {})
        : window_(window.width ? window : Window{0, 0, width, height}), pose_(scene["camera"]["camera_to_world"])
    {
        tangent_ = std::tan(scene["camera"]["vertical_fov"].get<double>() * 3.14159265358979323846 / 360);
        const Json &medium = scene["medium"];
        medium_.scattering = rgb(medium.value("scattering", Json(0)));
        medium_.absorption = rgb(medium.value("absorption", Json(0)));
        medium_.phase.x = medium.value("g", 0.0);
        if (medium.contains("droplet_diameter")) {  // Jendersie and d'Eon 2023
            const double d = medium["droplet_diameter"];
            medium_.phase = {std::exp(-0.0990567 / (d - 1.67154)), std::exp(-2.20679 / (d + 3.91029) - 0.428934),
                             std::exp(3.62489 - 8.29288 / (d + 5.52825)), std::exp(-0.599085 / (d - 0.641583) - 0.665888)};
        }
        medium_.constant = medium.contains("density") ? 0 : 1;
        for (const Json &term : medium.value("density", Json::array()))
            if (term["type"] == "constant") {
                medium_.constant += term.value("value", 1.0);
            } else if (term["type"] == "gaussian") {
                gaussians_.push_back(
                    {seen(term["center"]), term["scale"], term["amplitude"], rgb(term.value("colour", Json(1)))});
            } else {
                const vec3 n = glm::normalize(turned(rgb(term["direction"]))) * term["falloff"].get<double>();
                const vec3 origin = seen(term.value("origin", Json{0, 0, 0}));
                medium_.terms[medium_.term_count++] = {n.x, n.y, n.z,
                                                       std::log(term.value("value", 1.0)) + glm::dot(n, origin)};
            }
        for (const Json &light : scene.value("lights", Json::array()))
            lights_.push_back(light_of(light));
        // The library holds scenes in float, radii such that their squares are normal.
        for (Gaussian &g : gaussians_) {
            g.scale = std::clamp(g.scale, 1e-18, 1e18);
            for (double *v : {&g.center.x, &g.center.y, &g.center.z, &g.scale, &g.amplitude})
                *v = float(*v);
        }
    }

    const std::vector<Gaussian> &gaussians() const { return gaussians_; }

    struct Ray {
        vec3 direction;
        double distance;
    };
    Ray ray(int x, int y, double planar) const
    {
        const double scale = 2 * tangent_ / window_.height;
        const vec3 d((x + 0.5 - window_.x - 0.5 * window_.width) * scale,
                     -(y + 0.5 - window_.y - 0.5 * window_.height) * scale, -1);
        const double stretch = glm::length(d);
        return {d / stretch, std::isfinite(planar) ? planar * stretch : brume::maths_double::far_away};
    }

    // Of one Gaussian, and along all of a line through its centre. Lists may leave out 1e-4 of the latter (tiles.glsl).
    static double density(const Gaussian &g, const Ray &ray)
    {
        const double m = glm::dot(g.center, ray.direction), h = glm::length(glm::cross(g.center, ray.direction));
        const double a = g.scale, from = -a * m, to = a * (ray.distance - m);
        const double area = from > 0.5  ? std::erfc(from) - std::erfc(to)
                            : to < -0.5 ? std::erfc(-to) - std::erfc(-from)
                                        : std::erf(to) - std::erf(from);
        return 0.5 * whole_density(g) * std::exp(-a * a * h * h) * area;
    }
    static double whole_density(const Gaussian &g) { return 1.77245385090551602730 * g.amplitude / g.scale; }

    vec3 optical_depth(const Ray &ray) const
    {
        double p = brume::maths_double::density_integral(medium_, ray.direction, ray.distance);
        for (const Gaussian &g : gaussians_)
            p += density(g, ray);
        return (medium_.scattering + medium_.absorption) * p;
    }

    vec3 airlight(const Ray &ray, double tolerance = 1e-6) const
    {
        return brume::airlight::reference_airlight({medium_, gaussians_, lights_}, ray.direction, ray.distance, 0,
                                                   int(lights_.size()), tolerance)
            .radiance;
    }

private:
    static vec3 rgb(const Json &v)
    {
        return v.is_array() ? vec3(v[0].get<double>(), v[1].get<double>(), v[2].get<double>()) : vec3(v.get<double>());
    }
    vec3 turned(const vec3 &w) const
    {
        vec3 out;
        for (int axis = 0; axis < 3; ++axis)
            out[axis] = w.x * pose_[0][size_t(axis)].get<double>() + w.y * pose_[1][size_t(axis)].get<double>() +
                        w.z * pose_[2][size_t(axis)].get<double>();
        return out;
    }
    vec3 seen(const Json &point) const
    {
        return turned(rgb(point) - vec3(pose_[0][3].get<double>(), pose_[1][3].get<double>(), pose_[2][3].get<double>()));
    }
    brume::maths_double::Light light_of(const Json &light) const
    {
        brume::maths_double::Light out{};
        out.intensity = rgb(light["intensity"]);
        out.type = light["type"] == "point"  ? BRUME_LIGHT_POINT
                   : light["type"] == "spot" ? BRUME_LIGHT_SPOT
                                             : BRUME_LIGHT_DIRECTIONAL;
        if (out.type != int(BRUME_LIGHT_POINT))
            out.direction = glm::normalize(turned(rgb(light["direction"])));
        if (out.type == int(BRUME_LIGHT_DIRECTIONAL)) {
            out.distance = light.value("distance", 0.0);
            return out;
        }
        out.position = seen(light["position"]);
        out.radius = light.value("radius", 0.0);
        const double half = light.value("angle", 45.0) * 3.14159265358979323846 / 360;
        out.cos_outer = std::cos(half);
        out.cos_inner = std::cos(half * (1 - light.value("penumbra", 0.1)));
        return out;
    }

    Window window_;
    Json pose_;
    double tangent_;
    brume::maths_double::Medium medium_{};
    std::vector<Gaussian> gaussians_;
    std::vector<brume::maths_double::Light> lights_;
};

// Tests on each backend: CPU always, GL too (Mesa's software GL counts).
inline brume_context backend(const std::string &name)
{
    if (name == "cpu")
        return cpu();
    if (!gl())
        throw std::runtime_error("no GL backend");
    return *gl();
}

}  // namespace fog
