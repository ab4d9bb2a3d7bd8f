#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "scene/fields.h"
#include "scene/frame_values.h"

namespace brume {
namespace {

constexpr double steepest = 1e15;      // falloff [1/m]: its product with any length in float is finite
constexpr double koschmieder = 3.912;  // -log(0.02): contrast at the visibility's distance is 2 %

bool always_zero(const Number &number)
{
    return std::all_of(number.keys().begin(), number.keys().end(), [](const auto &key) { return key.second == 0.0; });
}

template <class T> bool any_animated(const T &value, Fields<T> fields)
{
    bool any = false;
    each_number(value, fields, ~0u, [&](const Field<T> &, const Number &number, int) { any |= number.animated(); });
    return any;
}

template <class T> bool any_animated(const std::vector<T> &values, Fields<T> fields)
{
    return std::any_of(values.begin(), values.end(), [&](const T &value) { return any_animated(value, fields); });
}

bool animated(const Medium &medium)
{
    const auto by_frame = [](const GaussianSet &set) { return set.frames != nullptr; };
    return any_animated(medium, medium_fields) || any_animated(medium.density, density_fields) ||
           any_animated(medium.gaussians, gaussian_fields) || any_animated(medium.gaussian_sets, gaussian_set_fields) ||
           std::any_of(medium.gaussian_sets.begin(), medium.gaussian_sets.end(), by_frame) ||
           any_animated(medium.noise, noise_fields);
}

bool shadow_animated(const Light &light)
{
    const auto &pose = light.shadow.to_world;
    return light.shadow.extent.animated() ||
           std::any_of(pose.begin(), pose.end(), [](const Number &n) { return n.animated(); });
}

double dot(const std::array<double, 3> &a, const std::array<double, 3> &b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Mean cosine of Draine's phase function.
double draine_mean_cosine(double g, double alpha)
{
    return g * (1.0 + alpha * (3.0 + 2.0 * g * g) / 5.0) / (1.0 + alpha * (1.0 + 2.0 * g * g) / 3.0);
}

// Henyey-Greenstein, or the mixture of it and Draine that Jendersie and d'Eon 2023 fit to Mie scattering by droplets of
// diameter d [um].
void evaluate_phase(const Medium &medium, const FrameValues &values, brume_plugin_medium &out)
{
    if (!medium.droplet_diameter) {
        out.asymmetry = out.phase[0] = float(values.get(medium.g, ranges::asymmetry, "medium.g"));
        return;
    }
    const double d = values.get(*medium.droplet_diameter, ranges::droplet_diameter, "medium.droplet_diameter");
    const double g_hg = std::exp(-0.0990567 / (d - 1.67154));
    const double g_draine = std::exp(-2.20679 / (d + 3.91029) - 0.428934);
    const double alpha = std::exp(3.62489 - 8.29288 / (d + 5.52825));
    const double weight = std::exp(-0.599085 / (d - 0.641583) - 0.665888);
    out.phase[0] = float(g_hg);
    out.phase[1] = float(g_draine);
    out.phase[2] = float(alpha);
    out.phase[3] = float(weight);
    out.asymmetry = float((1.0 - weight) * g_hg + weight * draine_mean_cosine(g_draine, alpha));
}

void evaluate_noise(const Scene &scene, const FrameValues &values, const std::array<double, 16> &camera_to_world,
                    brume_plugin_medium &out)
{
    constexpr double period = 256;
    const Noise &noise = scene.medium->noise;
    const double scale = values.get(noise.scale, ranges::noise_scale, "medium.noise.scale");
    const std::array<double, 3> offset = values.get(noise.offset, ranges::any, "medium.noise.offset");
    out.noise[0] = float(values.get(noise.strength, ranges::noise_strength, "medium.noise.strength"));
    out.noise[1] = float(1 / (scale * scene.metres_per_unit));
    out.noise[2] = float(noise.seed);
    for (size_t i = 0; i < 3; ++i)
        out.noise_shift[i] = float(std::fmod((camera_to_world[4 * i + 3] - offset[i]) / scale, period));
}

void evaluate_density(const Scene &scene, const FrameValues &values, const std::array<double, 16> &camera_to_world,
                      brume_plugin_medium &out)
{
    const Pose pose(camera_to_world, scene.metres_per_unit, values);
    const std::vector<DensityTerm> &terms = scene.medium->density;
    const bool gaussians = !scene.medium->gaussians.empty() || !scene.medium->gaussian_sets.empty();
    double constant = terms.empty() && !gaussians ? 1.0 : 0.0;
    for (size_t i = 0; i < terms.size(); ++i) {
        const ValueName name("medium.density", int64_t(i));
        const DensityTerm &term = terms[i];
        const bool exponential = term.type == BRUME_DENSITY_EXPONENTIAL;
        const double value = values.get(term.value, ranges::not_negative, name.of(".value"));
        const double falloff = exponential ? values.get(term.falloff, ranges::not_negative, name.of(".falloff")) : 0.0;
        if (falloff == 0.0) {
            constant += value;
            continue;
        }
        const std::array<double, 3> n = values.unit_vector(term.direction, name.of(".direction"));
        const std::array<double, 3> origin = values.get(term.origin, ranges::any, name.of(".origin"));
        if (value == 0.0)
            continue;
        if (out.term_count == int32_t(BRUME_MAX_DENSITY_TERMS))
            throw Error(BRUME_ERROR_ARGUMENT,
                        fmt::format("medium.density: more exponential terms than {}", BRUME_MAX_DENSITY_TERMS));
        std::array<double, 3> from_origin;
        for (size_t axis = 0; axis < 3; ++axis)
            from_origin[axis] = pose.position[axis] - origin[axis] * scene.metres_per_unit;

        float *to = out.terms[out.term_count++];
        for (size_t axis = 0; axis < 3; ++axis)
            to[axis] = float(std::clamp(falloff * dot(pose.axes[axis], n), -steepest, steepest));
        to[3] = float(std::clamp(std::log(value) - falloff * dot(from_origin, n), -ranges::huge, ranges::huge));
    }
    out.constant = float(std::min(constant, ranges::huge));
}

}  // namespace

double Number::between_keys(double frame) const
{
    const std::vector<Key> &keys = *keys_;
    const auto after =
        std::upper_bound(keys.begin(), keys.end(), frame, [](double f, const auto &key) { return f < key.first; });
    if (after == keys.begin())
        return keys.front().second;
    if (after == keys.end())
        return keys.back().second;
    const auto before = after - 1;
    return std::lerp(before->second, after->second, (frame - before->first) / (after->first - before->first));
}

bool SceneValues::animated() const
{
    return (medium && brume::animated(*medium)) || any_animated(camera, camera_fields) ||
           any_animated(lights, light_fields) || std::any_of(lights.begin(), lights.end(), shadow_animated);
}

bool has_gaussians(const Scene &scene)
{
    if (!scene.medium)
        return false;
    const auto dense = [](const GaussianTerm &term) { return !always_zero(term.amplitude); };
    const auto holds_dense = [](const GaussianSet &set) {
        const auto positive = [](const Gaussian &g) { return g.amplitude > 0.0; };
        return !always_zero(set.amplitude) && (set.frames || std::any_of(set.fixed->begin(), set.fixed->end(), positive));
    };
    const Medium &medium = *scene.medium;
    return std::any_of(medium.gaussians.begin(), medium.gaussians.end(), dense) ||
           std::any_of(medium.gaussian_sets.begin(), medium.gaussian_sets.end(), holds_dense);
}

bool reads_gaussians_by_frame(const Scene &scene)
{
    const auto by_frame = [](const GaussianSet &set) { return set.frames != nullptr; };
    return scene.medium && std::any_of(scene.medium->gaussian_sets.begin(), scene.medium->gaussian_sets.end(), by_frame);
}

bool pose_matters(const Scene &scene)
{
    if (!scene.medium)
        return false;
    const auto varies = [](const DensityTerm &term) {
        return term.type == BRUME_DENSITY_EXPONENTIAL && !always_zero(term.falloff) && !always_zero(term.value);
    };
    const Medium &medium = *scene.medium;
    return std::any_of(medium.density.begin(), medium.density.end(), varies) || has_gaussians(scene);
}

bool drops_alike(const SceneValues &a, const SceneValues &b)
{
    const auto but_gaussians = [](const Medium &m) {
        return std::tie(m.scattering, m.absorption, m.emission, m.g, m.visibility, m.droplet_diameter, m.density, m.noise);
    };
    return a.metres_per_unit == b.metres_per_unit && a.luminance == b.luminance &&
           a.medium.has_value() == b.medium.has_value() &&
           (!a.medium || but_gaussians(*a.medium) == but_gaussians(*b.medium));
}

Scene least_to_drop_alike(const Scene &scene)
{
    Scene least;
    least.metres_per_unit = scene.metres_per_unit;
    least.luminance = scene.luminance;
    least.camera = scene.camera;
    least.environment = scene.environment;
    for (const Light &light : scene.lights)
        if (std::none_of(least.lights.begin(), least.lights.end(),
                         [&](const Light &taken) { return taken.shadow.kind == light.shadow.kind; }))
            least.lights.push_back(light);
    if (scene.medium) {
        const Medium &m = *scene.medium;
        least.medium = {m.scattering,       m.absorption, m.emission, m.g, m.visibility,
                        m.droplet_diameter, m.density,    {},         {},  m.noise};
        if (has_gaussians(scene))
            least.medium->gaussians.emplace_back();
        else if (!m.gaussians.empty() || !m.gaussian_sets.empty())
            least.medium->gaussians.emplace_back().amplitude = 0;
    }
    least.effects_named = scene.effects_named;
    return least;
}

Scene with_peak_medium(Scene scene)
{
    if (!scene.medium)
        return scene;
    Medium &medium = *scene.medium;
    const auto by_value = [](const auto &a, const auto &b) { return a.second < b.second; };
    const auto peak = [&](Number &number) {
        number = std::max_element(number.keys().begin(), number.keys().end(), by_value)->second;
    };
    for (Number3 *numbers : {&medium.scattering, &medium.absorption, &medium.emission})
        std::for_each(numbers->begin(), numbers->end(), peak);
    if (medium.visibility)
        medium.visibility =
            std::min_element(medium.visibility->keys().begin(), medium.visibility->keys().end(), by_value)->second;
    for (DensityTerm &term : medium.density)
        peak(term.value);
    for (GaussianTerm &term : medium.gaussians)
        peak(term.amplitude);
    for (GaussianSet &set : medium.gaussian_sets)
        peak(set.amplitude);
    return scene;
}

void evaluate_medium(const Scene &scene, double frame, const std::array<double, 16> &camera_to_world,
                     brume_plugin_medium &out)
{
    out = {};
    for (size_t i = 0; i < 3; ++i)
        out.luminance[i] = float(scene.luminance[i]);
    if (!scene.medium)
        return;

    const Medium &medium = *scene.medium;
    const FrameValues values(frame);
    std::array<double, 3> scattering = values.get(medium.scattering, ranges::not_negative, "medium.scattering");
    const std::array<double, 3> absorption = values.get(medium.absorption, ranges::not_negative, "medium.absorption");
    const std::array<double, 3> emission = values.get(medium.emission, ranges::not_negative, "medium.emission");
    if (medium.visibility) {
        const double extinction = koschmieder / values.get(*medium.visibility, ranges::positive, "medium.visibility");
        for (size_t i = 0; i < 3; ++i) {
            // Room for the rounding of a visibility that stands for the absorption alone.
            if (absorption[i] > extinction * (1 + 1e-6))
                throw Error(
                    BRUME_ERROR_ARGUMENT,
                    fmt::format("medium.visibility: stands for an extinction of {:.6g} / m, below the absorption[{}] of "
                                "{:.6g} / m; expected at most {:.6g} m",
                                extinction, i, absorption[i], koschmieder / absorption[i]));
            scattering[i] = std::max(extinction - absorption[i], 0.0);
        }
    }
    for (size_t i = 0; i < 3; ++i) {
        out.scattering[i] = float(scattering[i]);
        out.absorption[i] = float(absorption[i]);
        out.emission[i] = float(emission[i]);
    }
    evaluate_phase(medium, values, out);
    evaluate_density(scene, values, camera_to_world, out);
    evaluate_noise(scene, values, camera_to_world, out);
}

}  // namespace brume
