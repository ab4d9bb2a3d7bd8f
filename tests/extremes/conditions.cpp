#include "conditions.h"

namespace extremes {
namespace {

using fog::constant;
using fog::gaussian;
using fog::point_light;
using fog::Vector;

std::string text(double value)
{
    char buffer[40];
    snprintf(buffer, sizeof buffer, "%g", value);
    return buffer;
}

class Table {
public:
    std::vector<Condition> rows;

    Condition &add(const std::string &family, const std::string &name)
    {
        rows.push_back({family, name, ordinary_medium(), ordinary_lights()});
        return rows.back();
    }

    void distances()
    {
        for (float d : {0.0f, 1e-45f, 1e-6f, 1.0f, 1e30f, INFINITY, NAN, -3.0f})
            add("distance", text(d)).depth = d;
    }

    // Each with a channel that does not scatter and two that do not absorb.
    void optical_depths()
    {
        for (float d : {0.0f, 1e-45f, 1e-6f, 1.0f, 10.0f, 1e30f, INFINITY, NAN, -3.0f})
            for (double sigma : {0.0, 1e-12, 1e-4, 1.0, 50.0, 1e4})
                for (double g : {0.0, 0.8}) {
                    Condition &c = add("optical depth", text(sigma) + " / m to " + text(d) + ", g " + text(g));
                    c.medium = {{"scattering", {sigma, 0, sigma}}, {"absorption", {0, sigma, 0}}, {"g", g}};
                    c.depth = d;
                }
    }

    void phase_functions()
    {
        for (double g : {-1.0, -0.999, 0.0, 0.999, 1.0})
            for (double z : {-5.0, 5.0}) {
                Condition &c = add("g", text(g) + ", light at z " + text(z));
                c.medium["g"] = g;
                c.lights[0]["position"] = {0, 0, z};
            }
        for (double diameter : {5.0, 50.0})
            add("g", "droplets of " + text(diameter)).medium["droplet_diameter"] = diameter;
    }

    void radiances()
    {
        for (float l : {0.0f, 1e-45f, 1e-40f, 65504.0f, 1e10f, 3e38f, NAN, INFINITY, -INFINITY, -5.0f})
            add("radiance", text(l)).radiance = l;
    }

    void emissions()
    {
        for (double e : {1e-30, 1e-12, 0.02, 1e10, 1e30})
            for (float d : {0.0f, 1e-6f, 10.0f, INFINITY}) {
                Condition &c = add("emission", text(e) + " to " + text(d));
                c.medium = {{"scattering", {0.001, 0, 1e-9}}, {"emission", {e, 0, e}}, {"g", -0.3}};
                c.depth = d;
            }
    }

    void exponentials()
    {
        const Vector directions[] = {{0, 1, 0}, {0, -1, 0}, {1e-9, 1, 0}, {0, 1, 1e-9}, {0, 0, 1}, {0, 0, -1}};
        for (const Vector &direction : directions)
            for (double falloff : {0.0, 1e-12, 1e-9, 0.3, 1000.0})
                for (double height : {0.0, 1e6, -1e6}) {
                    Condition &c = add("exponential", "falloff " + text(falloff) + " along " + Json(direction).dump() +
                                                          " from height " + text(height));
                    c.medium = {{"scattering", 0.1}, {"absorption", {0, 0.05, 0}}};
                    c.medium["density"] = {{{"type", "exponential"},
                                            {"falloff", falloff},
                                            {"direction", direction},
                                            {"origin", {0, height, 0}}}};
                    c.depth = INFINITY;
                    c.dark = height != 0;
                }
    }

    void gaussians()
    {
        for (double scale : {1e-30, 1e-6, 0.5, 1e6, 1e30})
            for (double amplitude : {0.0, 1e-12, 1.0, 1e6, 1e30})
                for (double z : {0.0, -4.0}) {
                    Condition &c =
                        add("Gaussian", "scale " + text(scale) + ", amplitude " + text(amplitude) + " at z " + text(z));
                    c.medium["density"][1] = gaussian({0, 0, z}, scale, amplitude);
                    c.depth = z == 0 ? INFINITY : 4.0f;
                }
        for (double far : {1e6, -1e6, 1e30}) {
            Condition &c = add("Gaussian", "at z " + text(far));
            c.medium["density"][1] = gaussian({0, 0, far}, 1, 1);
            c.depth = INFINITY;
        }
        add("Gaussian", "none").medium["density"] = {constant(1)};
        add("Gaussian", "alone").medium["density"] = {gaussian({0, 0, -4}, 1, 1)};
    }

    void lights()
    {
        // The rays of the middle row pass close to the optical axis; the angle at the camera is as named.
        const std::pair<const char *, Vector> places[] = {{"at the camera", {0, 0, 0}},
                                                          {"within a denormal of the camera", {0, 0, -1e-42}},
                                                          {"gamma 0", {0, 0, -5}},
                                                          {"gamma 1e-7", {5e-7, 0, -5}},
                                                          {"gamma pi", {0, 0, 5}},
                                                          {"on the surface", {0, 0, -10}},
                                                          {"behind the surface", {0, 0, -11}},
                                                          {"inside the Gaussian", {0.5, 0.2, -4}},
                                                          {"1e6 m ahead", {0, 0, -1e6}},
                                                          {"1e6 m aside", {1e6, 0, 0}},
                                                          {"1e30 m away", {0, 1e30, 0}}};
        for (auto &[place, position] : places)
            for (double radius : {0.0, 0.1, 1e6}) {
                const std::string name = std::string(place) + ", radius " + text(radius);
                for (float depth : {10.0f, INFINITY}) {
                    Condition &c = add("point light", name + " to " + text(depth));
                    c.lights = {point_light(position, 10, radius)};
                    c.depth = depth;
                    c.dark = radius > 1;
                }
                for (double angle : {0.0, 1e-3, 90.0, 180.0})
                    for (double penumbra : {0.0, 1.0})
                        for (double z : {-1.0, 0.0, 1.0}) {
                            Json spot = point_light(position, 10, radius);
                            spot["type"] = "spot";
                            spot["angle"] = angle;
                            spot["penumbra"] = penumbra;
                            spot["direction"] = {z == 0 ? 1 : 0, 0, z};
                            add("spot",
                                name + ", angle " + text(angle) + ", penumbra " + text(penumbra) + ", to z " + text(z))
                                .lights = Json::array({spot});
                        }
            }
        for (double intensity : {0.0, 1e-30, 1e30}) {
            Condition &c = add("point light", "intensity " + text(intensity));
            c.lights = {point_light({0, 0, -5}, intensity)};
            c.saturates = intensity > 1;
        }
        for (double distance : {0.0, 10.0, 1e30})
            for (const Vector &direction : {Vector{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {1e-7, 0, -1}, {0, 1e-30, 0}}) {
                Condition &c = add("directional light", "along " + Json(direction).dump() + ", distance " + text(distance));
                c.lights = Json::array(
                    {{{"type", "directional"}, {"direction", direction}, {"intensity", 3}, {"distance", distance}}});
                c.depth = INFINITY;
            }
    }
};

}  // namespace

Json ordinary_medium()
{
    return {{"scattering", 0.05}, {"absorption", 0.01}, {"density", {constant(1), gaussian({0.5, 0.2, -4}, 0.8, 2)}}};
}

Json ordinary_lights()
{
    return Json::array({point_light({0.3, 1, -5}, 10, 0.05)});
}

bool Condition::isotropic() const
{
    return medium.value("g", 0.0) == 0 && !medium.contains("droplet_diameter");
}

bool Condition::homogeneous() const
{
    for (const Json &term : medium.value("density", Json::array()))
        if (term["type"] != "constant")
            return false;
    return true;
}

bool Condition::about_lights() const
{
    return family.ends_with("light") || family == "spot";
}

bool Condition::peaked() const
{
    return std::abs(medium.value("g", 0.0)) > 0.9;
}

std::vector<Condition> conditions()
{
    Table table;
    table.distances();
    table.optical_depths();
    table.phase_functions();
    table.radiances();
    table.emissions();
    table.exponentials();
    table.gaussians();
    table.lights();
    return table.rows;
}

}  // namespace extremes
