// multiscatter: what surfaces send to the camera, attenuated and blurred by the medium between (Iser 2018).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>

#include "state.h"

namespace multiscatter {
namespace {

using brume::maths_float::level_size;

// Thinner media change no pixel by more than a ten thousandth: they are nothing.
constexpr double least_optical_depth = 1e-4;

class Planner {
public:
    Planner(const brume_services &services, brume_host host, const brume_plugin_request &request)
        : services_(services), host_(host), request_(request),
          layered_(services.made(host, "density_rgb") != BRUME_MADE_NOWHERE)
    {
    }

    brume_status plan(std::unique_ptr<State> &out);

private:
    brume_status drop(const char *name, const std::string &reason) { return entry(false, name, reason, 0, 0); }
    brume_status run(const char *name, const std::string &reason, double bytes_per_pixel, double operations_per_pixel)
    {
        double pixels = double(request_.width) * request_.height;
        return entry(true, name, reason, pixels * bytes_per_pixel, pixels * operations_per_pixel);
    }
    brume_status entry(bool runs, const char *name, const std::string &reason, double bytes, double operations)
    {
        brume_plugin_entry e{sizeof e, runs ? 1u : 0u, name, reason.c_str(), uint64_t(bytes), uint64_t(operations), 0, 0};
        return services_.add_entry(host_, &e);
    }
    brume_status image(const char *label, int width, int height, int channels, brume_plugin_image &out)
    {
        return services_.create_image(host_, label, width, height, channels, &out);
    }

    bool wants_output() const;
    double largest_optical_depth() const;
    brume_status need_camera(bool scatters, bool surrounded);
    brume_status plan_levels(State &state);
    brume_status plan_pyramid(State &state);
    brume_status drop_settings_of_paper();
    brume_status plan_paper(State &state);

    const brume_services &services_;
    brume_host host_;
    const brume_plugin_request &request_;
    const bool layered_;  // the caller gives the density
};

bool Planner::wants_output() const
{
    return std::any_of(request_.layers, request_.layers + request_.layer_count, [](uint32_t wanted) { return wanted != 0; });
}

bool any(const float (&v)[3])
{
    return v[0] > 0 || v[1] > 0 || v[2] > 0;
}

brume_status Planner::need_camera(bool scatters, bool surrounded)
{
    auto need = [&](bool condition, uint32_t what, const char *reason) {
        return condition ? services_.need_camera(host_, what, reason) : BRUME_OK;
    };
    if (brume_status s =
            need(scatters, BRUME_CAMERA_FIELD_OF_VIEW, "the blur's width in pixels follows from the field of view"))
        return s;
    if (brume_status s = need(request_.scene->camera->depth_kind != BRUME_DEPTH_RAY, BRUME_CAMERA_FIELD_OF_VIEW,
                              "the depth is planar and the field of view turns it into distance along the ray"))
        return s;
    if (brume_status s = need(surrounded, BRUME_CAMERA_FIELD_OF_VIEW | BRUME_CAMERA_POSE,
                              "the environment is placed in the world and surrounds the picture"))
        return s;
    return need(request_.pose_matters != 0, BRUME_CAMERA_FIELD_OF_VIEW | BRUME_CAMERA_POSE,
                "the medium's density changes with the position");
}

// Whether a kernel takes the environment for what surrounds the picture; else it lets others add what that scatters.
bool surrounds(Kernel kernel)
{
    return kernel == Kernel::calibrated || kernel == Kernel::reference;
}

// Of all that a frame can show; infinite where that has no end.
double Planner::largest_optical_depth() const
{
    const brume_plugin_medium &m = *request_.scene->medium;
    const brume_plugin_camera &c = *request_.scene->camera;
    if (layered_ || m.term_count > 0 || request_.scene->gaussian_count > 0 || c.sky == BRUME_SKY_FOG)
        return INFINITY;
    double extinction = 0;
    for (int i = 0; i < 3; ++i)
        extinction = std::max(extinction, double(m.scattering[i]) + m.absorption[i]);
    // Rays to the edges of the widest images are a few times as long as the planar distance.
    const double farthest = std::max(c.depth_kind == BRUME_DEPTH_RAY ? c.far_distance : 10.0 * c.far_distance,
                                     c.sky == BRUME_SKY_CLAMP ? double(c.sky_distance) : 0.0);
    return extinction * m.constant * farthest;
}

brume_status Planner::plan_levels(State &state)
{
    int full = 0;
    while ((1 << full) < std::max(state.base().x, state.base().y))
        ++full;
    const Parameters &p = state.parameters;
    state.top = p.levels > 0 ? std::min(p.levels, full) : full;
    if (p.levels > 0 && p.levels < full)
        if (brume_status s = drop("levels", "levels " + std::to_string(p.levels + 1) + " to " + std::to_string(full) +
                                                ": the parameter `levels` stops there"))
            return s;
    return BRUME_OK;
}

brume_status Planner::plan_pyramid(State &state)
{
    if (brume_status s = plan_levels(state))
        return s;
    brume_status s;
    if (state.top == 0) {
        s = drop("pyramid", "one pixel: scattered light stays where it is");
        if (!s)
            s = run("compose", "attenuates; scattered light stays in its pixel", 16 + 4 + 16, 130);
    } else {
        s = state.parameters.kernel == Kernel::paper ? plan_paper(state) : drop_settings_of_paper();
        if (!s && state.parameters.kernel == Kernel::calibrated)
            s = plan_calibrated(services_, host_, request_, state);
    }
    if (!s && (state.top == 0 || state.parameters.kernel == Kernel::paper))
        s = plan_paper_passes(services_, host_, state);
    return s;
}

bool of_calibrated(std::string_view parameter)
{
    return parameter == "method" || parameter == "levels" || parameter == "lobes" || parameter == "resolution";
}

brume_status Planner::drop_settings_of_paper()
{
    std::string names;
    for (size_t i = 0; i < parameter_table().size(); ++i) {
        const brume_parameter_info &p = parameter_table()[i];
        if (request_.parameters[i] != p.default_number && !of_calibrated(p.name))
            names += (names.empty() ? "" : ", ") + std::string(p.name);
    }
    return names.empty() ? BRUME_OK : drop("settings", names + ": of method paper, which is not the one chosen");
}

brume_status Planner::plan_paper(State &state)
{
    const brume::maths_float::Filter &f = state.parameters.filter;
    auto check = [](std::initializer_list<brume_status> results) {
        for (brume_status s : results)
            if (s)
                return s;
        return brume_status(BRUME_OK);
    };
    int stack_w = level_size({state.width, state.height}, 1).x;
    int stack_h = stack_height(state.width, state.height, state.top);
    double taps = state.parameters.taps * state.parameters.taps;
    bool blurring = f.density_blurring != 0, separation = f.separation != 0;
    double fetches = f.fetch == brume::maths_float::fetch_linear_bilinear  ? 2
                     : f.fetch == brume::maths_float::fetch_linear_bicubic ? 8
                                                                           : 16;
    return check(
        {image("radiance", state.width, state.height, 4, state.radiance),
         image("radiance levels", stack_w, stack_h, 4, state.radiance_stack),
         blurring ? image("spread levels", stack_w, stack_h, 1, state.spread_stack) : BRUME_OK,
         separation ? image("separated", state.width, state.height, 4, state.separated) : BRUME_OK,
         separation ? image("separated levels", stack_w, stack_h, 4, state.separated_stack) : BRUME_OK,
         run("scatter", "splits radiance into what arrives straight and what was scattered",
             16 + 4 + 16 + (separation ? 16 : 0), 120),
         run("downsample",
             "levels 1 to " + std::to_string(state.top) + " of the pyramid; each frame stops at that of its largest blur",
             (16 + 16 / 3.0) * (separation ? 2 : 1) * 1.33 + (blurring ? 4 / 3.0 : 0),
             taps / 3 * (20 + (blurring ? 4 : 0) + (separation ? 16 : 0))),
         blurring ? BRUME_OK : drop("density blurring", "switched off"),
         f.masking ? BRUME_OK : drop("masking", "switched off"),
         separation ? BRUME_OK : drop("separation", "switched off (the default)"),
         run("compose", "fetches each pixel's level and adds what arrives straight",
             16 + 4 + 16 + 16 * 1.33 + (blurring ? 4 : 0) + (separation ? 16 * 1.33 : 0),
             120 + fetches * (30 + (blurring ? 10 : 0) + (separation ? 30 : 0)))});
}

brume_status Planner::plan(std::unique_ptr<State> &out)
{
    const brume_plugin_medium &m = *request_.scene->medium;
    bool scatters = any(m.scattering);
    bool absorbs = any(m.absorption);
    bool emits = any(m.emission);
    bool dense = layered_ || m.constant > 0 || m.term_count > 0 || request_.scene->gaussian_count > 0;
    if (!request_.scene->has_medium)
        return drop("multiscatter", "the scene has no medium");
    if (!dense || !(scatters || absorbs || emits)) {
        if (!wants_output())
            return drop("multiscatter", dense ? "the medium neither scatters, absorbs nor emits"
                                              : "the medium's density is zero everywhere");
    }
    if (const double tau = largest_optical_depth(); tau < least_optical_depth && !emits && !wants_output()) {
        char reason[120];
        snprintf(reason, sizeof reason, "the optical depth is at most %.1e, which is less than %.0e", tau,
                 least_optical_depth);
        return drop("multiscatter", reason);
    }
    auto state = std::make_unique<State>();
    state->parameters = read_parameters(request_.parameters);
    state->width = request_.width;
    state->height = request_.height;
    state->reduction = state->parameters.kernel == Kernel::calibrated ? state->parameters.reduction : 1;
    state->beside_lights = services_.made(host_, "single_scattering") != BRUME_MADE_NOWHERE;
    state->beside_all_orders = services_.made(host_, "all_scattering") != BRUME_MADE_NOWHERE;
    state->layered = layered_;
    state->surrounded = scatters && surrounds(state->parameters.kernel) && request_.scene->environment_count > 0;
    for (uint32_t i = 0; i < layer_count; ++i)
        state->outputs |= request_.layers[i] ? 1u << i : 0;
    brume_status s = dense ? need_camera(scatters, state->surrounded) : BRUME_OK;
    if (s)
        return s;
    const Kernel kernel = state->parameters.kernel;
    if (kernel == Kernel::reference || kernel == Kernel::paper_reference) {
        const bool paper = kernel == Kernel::paper_reference;
        if (request_.backend != BRUME_BACKEND_CPU)
            return services_.fail(
                host_, BRUME_ERROR_UNSUPPORTED,
                paper ? "method: paper_reference on OpenGL; expected paper, or the CPU, on which alone references run"
                      : "method: reference on OpenGL; expected calibrated, or the CPU, on which alone references run");
        s = run("reference", "every pixel's light to every other, in double", 52, 30.0 * request_.width * request_.height);
        if (!s)
            s = plan_reference_passes(services_, host_, *state);
    } else if (!scatters) {
        s = drop("pyramid", "the medium does not scatter: nothing to blur");
        if (!s)
            s = run("compose", "attenuates and adds the medium's own light", 16 + 4 + 16, 100);
        if (!s)
            s = plan_paper_passes(services_, host_, *state);
    } else {
        s = plan_pyramid(*state);
    }
    if (!s)
        out = std::move(state);
    return s;
}

brume_status plan(const brume_services *services, brume_host host, const brume_plugin_request *request, void **out)
{
    std::unique_ptr<State> state;
    brume_status s = Planner(*services, host, *request).plan(state);
    *out = state.release();
    return s;
}

brume_status execute(const brume_services *services, brume_host host, void *opaque, const brume_plugin_frame *frame)
{
    State &state = *static_cast<State *>(opaque);
    if (state.table)
        return execute_calibrated(*services, host, state, *frame);
    if (state.find_sources)
        return execute_reference(*services, host, state, *frame);
    return execute_paper(*services, host, state, *frame);
}

}  // namespace

int stack_height(int width, int height, int top)
{
    return brume::maths_float::level_row({width, height}, top + 1);
}

}  // namespace multiscatter

BRUME_PLUGIN_EXPORT const brume_effect *brume_plugin_effect(uint32_t host_abi)
{
    using namespace multiscatter;
    static constexpr uint32_t size = sizeof(brume_layer_info);
    static constexpr brume_layer_info layers[layer_count] = {
        {size, BRUME_LAYER_OUTPUT, 3, 0, "transmittance", "exp(-tau) of the medium in front of each pixel"},
        {size, BRUME_LAYER_OUTPUT, 3, 0, "optical_depth", "tau of the medium in front of each pixel"},
        {size, BRUME_LAYER_OUTPUT, 3, 0, "scattered",
         "scattered and emitted radiance, which is added to the attenuated image"},
        {size, BRUME_LAYER_OUTPUT, 1, 0, "blur_radius", "deviation of the blur of each pixel's light, in pixels"}};
    static constexpr const char *uses[use_count] = {"density", "density_rgb", "gaussian_density", "visible_lights"};
    static constexpr const char *makes[] = {"attenuated_radiance", "environment_scattering"};
    // None of method paper: its passes have the same names, and take another time an operation.
    static constexpr const char *scenes[] = {
        R"({"brume":1,"camera":{"vertical_fov":50},"medium":{"scattering":[0.03,0.035,0.04],"absorption":0.002,"g":0.8}})",
        R"({"brume":1,"camera":{"vertical_fov":50},"medium":{"scattering":0.03}})"};
    static const brume_effect effect = [] {
        brume_effect e{};
        e.struct_size = sizeof e;
        e.abi = BRUME_PLUGIN_ABI;
        e.name = "multiscatter";
        e.help = "attenuates the image and blurs it by multiple scattering (Iser 2018)";
        e.order = 100;
        e.thread_safety = BRUME_THREADS_SAFE;
        e.wanted = BRUME_WANTED_WITH_MEDIUM;
        e.parameters = parameter_table().data();
        e.parameter_count = uint32_t(parameter_table().size());
        e.layers = layers;
        e.layer_count = layer_count;
        e.makes = makes;
        e.make_count = 2;
        e.makes_with = [](const double *parameters, uint32_t index) {
            return uint32_t(index == 0 || surrounds(read_parameters(parameters).kernel));
        };
        e.uses = uses;
        e.use_count = use_count;
        e.plan = plan;
        e.execute = execute;
        e.destroy = [](void *state) { delete static_cast<State *>(state); };
        e.offer = offer;
        e.scenes = scenes;
        e.scene_count = uint32_t(std::size(scenes));
        return e;
    }();
    return host_abi == BRUME_PLUGIN_ABI ? &effect : nullptr;
}
