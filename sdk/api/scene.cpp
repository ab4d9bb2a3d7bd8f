#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "api/handles.h"
#include "api/structs.h"
#include "scene/scene_check.h"
#include "base/scene_ranges.h"
#include "scene/view.h"

using namespace brume;
using namespace brume::api;

namespace {

Gaussian read_gaussian(const brume_gaussian *given, const ValueName &name)
{
    brume_gaussian read = BRUME_GAUSSIAN_INIT;
    read = read_struct(given, read, name, &brume_gaussian::center, &brume_gaussian::scale, &brume_gaussian::amplitude,
                       &brume_gaussian::color, &brume_gaussian::reserved);
    if (read.reserved)
        expect(false, name.of(".reserved").text(), read.reserved, "0");
    Gaussian gaussian;
    std::copy_n(read.center, 3, gaussian.center.begin());
    gaussian.scale = read.scale;
    gaussian.amplitude = read.amplitude;
    std::transform(read.color, read.color + 3, gaussian.color.begin(), [](double x) { return float(x); });
    check_gaussian(gaussian, name);
    return gaussian;
}

}  // namespace

std::vector<Gaussian> api::read_gaussians(const brume_gaussian *given, uint32_t count, const char *name,
                                          const char *count_name)
{
    if (!given && count > 0)
        throw Error(BRUME_ERROR_ARGUMENT, fmt::format("{}: NULL with a {} above 0", name, count_name));
    if (count > BRUME_MAX_GAUSSIANS)
        throw Error(BRUME_ERROR_ARGUMENT,
                    fmt::format("{}: {}; expected at most {}", count_name, count, BRUME_MAX_GAUSSIANS));
    std::vector<Gaussian> gaussians;
    gaussians.reserve(count);
    for (size_t i = 0; i < count; ++i)
        gaussians.push_back(read_gaussian(element(given, i), {name, int64_t(i)}));
    return gaussians;
}

namespace {

template <class Function> brume_status with_scene(brume_scene scene, Function function)
{
    if (!scene)
        return barrier(nullptr, [] { expect(false, "scene: NULL"); });
    return barrier(scene->context.get(), [&] { function(scene->scene); });
}

Number3 numbers(const double (&values)[3])
{
    return {Number(values[0]), Number(values[1]), Number(values[2])};
}

DensityTerm read_term(const brume_density_term *given, size_t index)
{
    brume_density_term term = BRUME_DENSITY_TERM_INIT;
    term = read_struct(given, term, {"brume_medium.terms", int64_t(index)}, &brume_density_term::type,
                       &brume_density_term::value, &brume_density_term::falloff, &brume_density_term::direction,
                       &brume_density_term::origin);
    return {term.type, term.value, term.falloff, numbers(term.direction), numbers(term.origin)};
}

std::vector<GaussianSet> gaussians_of(const brume_medium &medium)
{
    if (medium.gaussian_count == 0)
        return {};
    GaussianSet set;
    set.file = "brume_medium.gaussians";
    set.fixed = std::make_shared<std::vector<Gaussian>>(
        read_gaussians(medium.gaussians, medium.gaussian_count, "brume_medium.gaussians", "brume_medium.gaussian_count"));
    return {set};
}

Light read_light(const brume_light *given, const ValueName &name)
{
    brume_light read = BRUME_LIGHT_INIT;
    read = read_struct(given, read, name, &brume_light::type, &brume_light::position, &brume_light::direction,
                       &brume_light::intensity, &brume_light::radius, &brume_light::angle, &brume_light::penumbra,
                       &brume_light::distance, &brume_light::shadow_kind, &brume_light::shadow_depth,
                       &brume_light::shadow_extent, &brume_light::shadow_to_world, &brume_light::surfaces,
                       &brume_light::reserved, &brume_light::shadow_range);
    if (read.reserved)
        expect(false, name.of(".reserved").text(), read.reserved, "0");
    Light light{
        read.type,     numbers(read.position), numbers(read.direction), numbers(read.intensity), read.radius, read.angle,
        read.penumbra, read.distance};
    light.shadow.kind = read.shadow_kind;
    light.shadow.depth = read.shadow_depth;
    light.shadow.extent = read.shadow_extent;
    light.shadow.range = {read.shadow_range[0], read.shadow_range[1]};
    std::copy_n(read.shadow_to_world, 16, light.shadow.to_world.begin());
    light.surfaces = read.surfaces;
    check_light(light, name);
    return light;
}

EffectSettings &settings_of(Scene &scene, const Effect &effect)
{
    for (auto &settings : scene.effects)
        if (settings.name == effect.name)
            return settings;
    return scene.effects.emplace_back(EffectSettings{effect.name, {}});
}

}  // namespace

extern "C" {

brume_status brume_scene_create(brume_context context, brume_scene *out)
{
    return brume_scene_create_from_text(context, nullptr, 0, nullptr, out);
}

brume_status brume_scene_create_from_text(brume_context context, const char *text, size_t length, const char *name,
                                          brume_scene *out)
{
    if (out)
        *out = nullptr;
    if (!context)
        return barrier(nullptr, [] { expect(false, "context: NULL"); });
    return barrier(context->context.get(), [&] {
        expect(out, "out: NULL");
        expect(text || length == 0, "text: NULL");
        Scene scene;
        if (text)
            scene = parse_scene(std::string(text, length), name ? name : "scene", context->context->effects);
        *out = new brume_scene_t{context->context, std::move(scene)};
    });
}

void brume_scene_destroy(brume_scene scene)
{
    delete scene;
}

size_t brume_scene_schema(brume_context context, char *buffer, size_t capacity)
{
    std::string schema;
    if (context)
        barrier(context->context.get(), [&] { schema = scene_schema(context->context->effects); });
    return copy_text(schema, buffer, capacity);
}

brume_status brume_scene_set_medium(brume_scene handle, const brume_medium *given)
{
    return with_scene(handle, [&](Scene &scene) {
        if (!given) {
            scene.medium.reset();
            return;
        }
        brume_medium medium = BRUME_MEDIUM_INIT;
        medium = read_struct(given, medium, "brume_medium", &brume_medium::term_count, &brume_medium::scattering,
                             &brume_medium::absorption, &brume_medium::emission, &brume_medium::g, &brume_medium::visibility,
                             &brume_medium::droplet_diameter, &brume_medium::terms, &brume_medium::gaussians,
                             &brume_medium::gaussian_count, &brume_medium::noise_seed, &brume_medium::noise_strength,
                             &brume_medium::noise_scale, &brume_medium::noise_offset);
        Medium result;
        result.scattering = numbers(medium.scattering);
        result.absorption = numbers(medium.absorption);
        result.emission = numbers(medium.emission);
        result.g = medium.g;
        if (medium.visibility != 0)
            result.visibility = medium.visibility;
        if (medium.droplet_diameter != 0)
            result.droplet_diameter = medium.droplet_diameter;
        expect(medium.terms || medium.term_count == 0, "brume_medium.terms: NULL with a term_count above 0");
        expect(medium.term_count <= 4096, "brume_medium.term_count", medium.term_count, "0 to 4096");
        for (size_t i = 0; i < medium.term_count; ++i)
            result.density.push_back(read_term(element(medium.terms, i), i));
        result.gaussian_sets = gaussians_of(medium);
        result.noise = {medium.noise_strength, medium.noise_scale, numbers(medium.noise_offset), medium.noise_seed};
        check_medium(result);
        scene.medium = std::move(result);
    });
}

brume_status brume_scene_set_lights(brume_scene handle, const brume_light *given, uint32_t count)
{
    return with_scene(handle, [&](Scene &scene) {
        expect(given || count == 0, "lights: NULL with a count above 0");
        if (count > BRUME_MAX_LIGHTS)
            throw Error(BRUME_ERROR_ARGUMENT, fmt::format("count: {}; expected at most {} lights", count, BRUME_MAX_LIGHTS));
        handle->read.resize(count);
        for (size_t i = 0; i < count; ++i)
            handle->read[i] = read_light(element(given, i), {"lights", int64_t(i)});
        scene.lights.swap(handle->read);
    });
}

brume_status brume_scene_set_quality(brume_scene handle, const brume_quality *given)
{
    return with_scene(handle, [&](Scene &scene) {
        if (!given) {
            scene.quality = {};
            return;
        }
        const brume_quality quality = read_struct(
            given, brume_quality BRUME_QUALITY_INIT, "brume_quality", &brume_quality::preset, &brume_quality::max_error,
            &brume_quality::budget_ms, &brume_quality::transmittance, &brume_quality::detail);
        expect(quality.preset <= BRUME_PRESET_REFERENCE, "brume_quality.preset", quality.preset, "a BRUME_PRESET_...");
        auto check = [](double value, const Range &range, const char *name) {
            if (value != 0 && !range.contains(value))
                throw Error(BRUME_ERROR_ARGUMENT,
                            fmt::format("brume_quality.{}: {}; expected 0 or {}", name, value, range.describe()));
        };
        check(quality.max_error, ranges::max_error, "max_error");
        check(quality.budget_ms, ranges::budget_ms, "budget_ms");
        check(quality.transmittance, ranges::fraction, "transmittance");
        check(quality.detail, ranges::detail, "detail");
        if ((quality.preset != BRUME_PRESET_NONE) + (quality.max_error != 0) + (quality.budget_ms != 0) > 1)
            throw Error(BRUME_ERROR_ARGUMENT,
                        fmt::format("brume_quality: preset {}, max_error {} and budget_ms {}; expected one of them",
                                    quality.preset, quality.max_error, quality.budget_ms));
        scene.quality = {quality.preset, quality.max_error, quality.budget_ms, quality.transmittance, quality.detail};
    });
}

brume_status brume_scene_get_quality(brume_scene handle, brume_quality *out)
{
    return with_scene(handle, [&](Scene &scene) {
        const Quality &q = scene.quality;
        write_struct(out, {0, q.preset, q.max_error, q.budget_ms, q.transmittance, q.detail}, "brume_quality");
    });
}

brume_status brume_scene_set_environment(brume_scene handle, const double *coefficients, uint32_t count)
{
    return with_scene(handle, [&](Scene &scene) {
        expect(coefficients || count == 0, "coefficients: NULL with a count above 0");
        if (count != 0 && !is_environment_count(count))
            throw Error(BRUME_ERROR_ARGUMENT, fmt::format("count: {}; expected 0, 1, 4, 9, 16, 25 or 36", count));
        Environment environment;
        for (size_t i = 0; i < count; ++i)
            environment.coefficients.push_back({coefficients[3 * i], coefficients[3 * i + 1], coefficients[3 * i + 2]});
        check_environment(environment);
        scene.environment = std::move(environment);
    });
}

size_t brume_scene_environment_file(brume_scene scene, char *buffer, size_t capacity)
{
    return copy_text(scene ? scene->scene.environment.file : "", buffer, capacity);
}

size_t brume_scene_light_shadow_file(brume_scene scene, uint32_t light, char *buffer, size_t capacity)
{
    const bool there = scene && light < scene->scene.lights.size();
    return copy_text(there ? scene->scene.lights[light].shadow.file : "", buffer, capacity);
}

size_t brume_scene_light_group(brume_scene scene, uint32_t light, char *buffer, size_t capacity)
{
    const bool there = scene && light < scene->scene.lights.size();
    return copy_text(there ? scene->scene.lights[light].group : "", buffer, capacity);
}

brume_status brume_scene_get_info(brume_scene handle, brume_scene_info *out)
{
    return with_scene(handle, [&](Scene &scene) {
        brume_scene_info info = BRUME_SCENE_INFO_INIT;
        info.light_count = uint32_t(scene.lights.size());
        if (scene.medium) {
            size_t gaussians = scene.medium->gaussians.size();
            for (const GaussianSet &set : scene.medium->gaussian_sets)
                gaussians += set.fixed ? set.fixed->size() : 0;
            info.gaussian_count = uint32_t(std::min<size_t>(gaussians, UINT32_MAX));
        }
        info.environment_count = uint32_t(scene.environment.coefficients.size());
        info.environment_up = scene.environment.file_up;
        write_struct(out, info, "brume_scene_info");
    });
}

brume_status brume_scene_set_camera(brume_scene handle, const brume_camera *given)
{
    return with_scene(handle, [&](Scene &scene) {
        brume_camera camera = read_camera(given, "brume_camera");
        check_camera(camera);
        scene.camera = {};
        if (camera.given & BRUME_CAMERA_FIELD_OF_VIEW) {
            scene.camera.vertical_fov = camera.vertical_fov;
            scene.camera.pixel_aspect = camera.pixel_aspect;
            scene.camera.center = {Number(camera.center[0]), Number(camera.center[1])};
        }
        if (camera.given & BRUME_CAMERA_POSE) {
            scene.camera.camera_to_world.emplace();
            for (size_t i = 0; i < 16; ++i)
                (*scene.camera.camera_to_world)[i] = camera.camera_to_world[i];
        }
    });
}

brume_status brume_scene_get_camera_given(brume_scene handle, uint32_t *given)
{
    return with_scene(handle, [&](Scene &scene) {
        expect(given, "given: NULL");
        const Camera &camera = scene.camera;
        *given = (camera.vertical_fov || camera.horizontal_fov ? BRUME_CAMERA_FIELD_OF_VIEW : 0u) |
                 (camera.camera_to_world ? BRUME_CAMERA_POSE : 0u);
    });
}

brume_status brume_scene_set_metres_per_unit(brume_scene handle, double metres)
{
    return with_scene(handle, [&](Scene &scene) {
        expect(metres >= 1e-12 && metres <= 1e12, "metres", metres, "1e-12 to 1e12");
        scene.metres_per_unit = metres;
    });
}

brume_status brume_scene_set_luminance_weights(brume_scene handle, const double weights[3])
{
    return with_scene(handle, [&](Scene &scene) {
        expect(weights, "weights: NULL");
        for (int i = 0; i < 3; ++i)
            expect(weights[i] >= 0 && weights[i] <= 1, fmt::format("weights[{}]", i), weights[i], "a number from 0 to 1");
        const double sum = weights[0] + weights[1] + weights[2];
        expect(std::abs(sum - 1) < 1e-3, "weights", fmt::format("a sum of {}", sum), "1");
        scene.luminance = {weights[0], weights[1], weights[2]};
    });
}

brume_status brume_scene_set_text(brume_scene handle, const char *effect, const char *parameter, const char *value)
{
    return with_scene(handle, [&](Scene &scene) {
        expect(effect, "effect: NULL");
        expect(!parameter || value, "value: NULL");
        const Effect &found = handle->context->effects.find(effect);
        if (parameter) {
            const Parameter &p = found.parameters[find_parameter(found, parameter)];
            double number = parameter_from_text(found, p, value);
            settings_of(scene, found).parameters[p.name] = number;
        } else {
            settings_of(scene, found);
        }
    });
}

brume_status brume_scene_set_number(brume_scene handle, const char *effect, const char *parameter, double value)
{
    return with_scene(handle, [&](Scene &scene) {
        expect(effect, "effect: NULL");
        expect(parameter, "parameter: NULL");
        const Effect &found = handle->context->effects.find(effect);
        const Parameter &p = found.parameters[find_parameter(found, parameter)];
        double number = parameter_from_number(found, p, value);
        settings_of(scene, found).parameters[p.name] = number;
    });
}

}  // extern "C"
