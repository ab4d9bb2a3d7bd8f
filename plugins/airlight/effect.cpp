// airlight: what the scene's lights scatter once toward the camera (Zhou et al. 2007, Sun et al. 2005).
#include <algorithm>
#include <memory>
#include <string>

#include "encounters.h"
#include "passes.h"
#include "state.h"

namespace airlight {
namespace {

bool any(const float (&v)[3])
{
    return v[0] > 0 || v[1] > 0 || v[2] > 0;
}

class Planner {
public:
    Planner(const brume_services &services, brume_host host, const brume_plugin_request &request)
        : services_(services), host_(host), request_(request), scene_(*request.scene), state_(std::make_unique<State>())
    {
        state_->parameters = read_parameters(request.parameters);
        state_->width = request.width;
        state_->height = request.height;
        state_->attenuates = !request.attenuated;
    }

    brume_status plan(std::unique_ptr<State> &out);

private:
    brume_status entry(bool runs, const char *name, const std::string &reason, double bytes, double operations)
    {
        brume_plugin_entry e{sizeof e, runs ? 1u : 0u, name, reason.c_str(), uint64_t(bytes), uint64_t(operations)};
        return services_.add_entry(host_, &e);
    }
    brume_status drop(const char *name, const std::string &reason) { return entry(false, name, reason, 0, 0); }
    brume_status fail(const std::string &message)
    {
        return services_.fail(host_, BRUME_ERROR_UNSUPPORTED, message.c_str());
    }

    brume_status check_tier();
    brume_status need_camera();
    double gather_operations() const;
    brume_status plan_gather();

    const brume_services &services_;
    brume_host host_;
    const brume_plugin_request &request_;
    const brume_plugin_scene &scene_;
    std::unique_ptr<State> state_;
};

// The published tiers know less of media than the others; a wrong picture would be worse than none.
brume_status Planner::check_tier()
{
    const Tier tier = state_->parameters.tier;
    const auto &m = scene_.medium;
    if (tier == Tier::reference && request_.backend != BRUME_BACKEND_CPU)
        return fail("tier: reference; expected nodes, fogshop or sun on the GL backend (the reference runs in double on the CPU)");
    if (tier != Tier::sun && tier != Tier::fogshop)
        return BRUME_OK;
    const std::string name = tier == Tier::sun ? "sun" : "fogshop";
    if (tier == Tier::sun && (m.term_count > 0 || scene_.gaussian_count > 0))
        return fail("tier: sun in a medium that is not constant; expected tier nodes: Sun et al. know homogeneous media only");
    if (m.phase[0] != 0 || m.phase[3] != 0)
        return fail("tier: " + name + " with a phase function that is not isotropic; expected tier nodes, or g 0");
    return BRUME_OK;
}

brume_status Planner::need_camera()
{
    if (state_->lit)
        return services_.need_camera(host_, BRUME_CAMERA_FIELD_OF_VIEW | BRUME_CAMERA_POSE,
                                     "the lights are placed in the world");
    if (request_.pose_matters)
        return services_.need_camera(host_, BRUME_CAMERA_FIELD_OF_VIEW | BRUME_CAMERA_POSE,
                                     "the medium's density changes with the position");
    if (scene_.camera.depth_kind != BRUME_DEPTH_RAY)
        return services_.need_camera(host_, BRUME_CAMERA_FIELD_OF_VIEW,
                                     "the depth is planar and the field of view turns it into distance along the ray");
    return BRUME_OK;
}

// Of one evaluation, as brume_plugin_entry counts them; measured for tier `nodes`.
double Planner::gather_operations() const
{
    const Parameters &p = state_->parameters;
    const double lights = scene_.light_count;
    const Encounters met = encounters(scene_, state_->width, state_->height);
    if (p.tier == Tier::fogshop || p.tier == Tier::sun)
        return 100 + 150 * lights + met.of_sight * (100 + 150 * lights);
    const int finer = p.max_error > 0.05 ? 0 : p.max_error >= 0.005 ? 1 : 2;
    constexpr double of_terms[] = {1, 1.2, 1.5}, of_gaussians[] = {1, 2.3, 5};
    // Mesa's software GL vectorises cells well and panels badly.
    const double of_light = request_.backend == BRUME_BACKEND_GL ? 6700 : 700,
                 of_term = request_.backend == BRUME_BACKEND_GL ? 5100 : 1900;
    const double of_orders = p.orders == Orders::all ? 3 : 1;
    double operations = 100 + of_orders * of_terms[finer] * lights * (of_light + of_term * scene_.medium.term_count);
    if (scene_.gaussian_count > 0)
        operations +=
            of_gaussians[finer] * (2000 * std::min(met.of_sight, 1.0) + 250 * met.of_sight + 1500 * lights * met.of_light);
    return operations;
}

brume_status Planner::plan_gather()
{
    State &state = *state_;
    const int reduction = state.parameters.reduction;
    const int width = (state.width + reduction - 1) / reduction, height = (state.height + reduction - 1) / reduction;
    auto image = [&](const char *label, int32_t channels, brume_plugin_image &out) {
        return services_.create_image(host_, label, width, height, channels, &out);
    };
    if (brume_status s = image("airlight", 4, state.radiance))
        return s;
    if (request_.outputs & BRUME_OUTPUT_AIRLIGHT_ERROR)
        if (brume_status s = image("airlight error", 4, state.error))
            return s;
    if (reduction > 1)
        if (brume_status s = image("airlight distances", 1, state.distances))
            return s;
    if (brume_status s = plan_tables(services_, host_, scene_, state))
        return s;
    if (state.parameters.tier == Tier::fogshop && scene_.gaussian_count > 0)
        if (brume_status s = entry(true, "blobs", "density from the camera and each light to each Gaussian, when something moved",
                                   0, 0))
            return s;
    const double pixels = double(width) * height;
    return entry(
        true, "gather",
        std::to_string(scene_.light_count) + (scene_.light_count == 1 ? " light" : " lights") +
            (scene_.environment_count ? " and the environment" : "") +
            (state.parameters.orders == Orders::all ? " scattered any number of times" : " scattered once") +
            (reduction > 1 ? ", at every " + std::string(reduction == 2 ? "second" : "fourth") + " pixel each way" : ""),
        pixels * (4 + 16), pixels * gather_operations());
}

brume_status Planner::plan(std::unique_ptr<State> &out)
{
    const auto &m = scene_.medium;
    if (!scene_.has_medium)
        return drop("airlight", "the scene has no medium");
    const bool dense = m.constant > 0 || m.term_count > 0 || scene_.gaussian_count > 0;
    const bool scatters = dense && any(m.scattering);
    const bool acts = dense && (scatters || any(m.absorption) || any(m.emission));
    const bool lights = scene_.light_count > 0 || scene_.environment_count > 0;
    state_->lit = scatters && lights;
    if (!state_->lit && (!acts || !state_->attenuates) && request_.outputs == 0)
        return drop("airlight", !lights ? "no lights and no environment"
                                        : dense ? "the medium does not scatter" : "the medium's density is zero everywhere");
    if (brume_status s = check_tier())
        return s;
    if (brume_status s = need_camera())
        return s;
    if (!state_->lit && !(request_.outputs & BRUME_OUTPUT_LIGHT_AIRLIGHT)) {
        if (brume_status s = drop("gather", !lights ? "no lights and no environment" : "the medium does not scatter"))
            return s;
    } else if (brume_status s = plan_gather()) {
        return s;
    }
    const double pixels = double(state_->width) * state_->height;
    if (brume_status s =
            entry(true, "compose", state_->attenuates ? "attenuates the image and adds the airlight" : "adds the airlight",
                  pixels * (16 + 4 + 16 + (state_->lit ? 16 : 0)),
                  pixels * ((state_->parameters.reduction > 1 ? 100 : 60) + (state_->attenuates ? 20 : 0))))
        return s;
    if (request_.backend == BRUME_BACKEND_GL)
        if (brume_status s = compile_programs(services_, host_, request_.outputs, *state_))
            return s;
    out = std::move(state_);
    return BRUME_OK;
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
    const int lights = state.lit ? int(frame->scene->light_count) : 0;
    if (state.lit)
        if (brume_status s = refresh_lists(*services, host, *frame, state))
            return s;
    std::unique_ptr<Passes> passes;
    if (brume_status s = (state.compose ? make_gl_passes : make_cpu_passes)(*services, host, state, *frame, passes))
        return s;
    if (state.blobs_pending) {
        if (brume_status s = passes->blobs())
            return s;
        state.blobs_pending = false;
    }
    if (state.lit)
        if (brume_status s = passes->gather(
                {state.radiance, state.error, state.distances, state.parameters.reduction, 0, lights, true}))
            return s;
    for (uint32_t l = 0; l < frame->scene->light_count && frame->light_airlight; ++l)
        if (frame->light_airlight[l])
            if (brume_status s = passes->gather({frame->light_airlight[l], nullptr, nullptr, 1, std::min(int(l), lights),
                                                 std::min(int(l) + 1, lights), false}))
                return s;
    return passes->compose();
}

}  // namespace
}  // namespace airlight

BRUME_PLUGIN_EXPORT const brume_effect *brume_plugin_effect(uint32_t host_abi)
{
    using namespace airlight;
    static const brume_effect effect{sizeof(brume_effect),
                                     BRUME_PLUGIN_ABI,
                                     "airlight",
                                     "adds what the scene's lights scatter toward the camera (Zhou et al. 2007, Sun et al. 2005)",
                                     200,
                                     BRUME_THREADS_SAFE,
                                     BRUME_WANTED_WITH_LIGHTS,
                                     own_outputs,
                                     1,
                                     uint32_t(parameter_table().size()),
                                     parameter_table().data(),
                                     plan,
                                     execute,
                                     [](void *state) { delete static_cast<State *>(state); },
                                     offer};
    return host_abi == BRUME_PLUGIN_ABI ? &effect : nullptr;
}
