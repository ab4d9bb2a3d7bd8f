// airlight: what the scene's lights scatter once toward the camera (Zhou et al. 2007, Sun et al. 2005).
#include <algorithm>
#include <cstdio>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>

#include "encounters.h"
#include "layers.h"
#include "order.h"
#include "orders.h"
#include "passes.h"
#include "scene_maths.hpp"
#include "scenes.h"
#include "settings.h"
#include "state.h"
#include "work.h"

namespace airlight {
namespace {

bool any(const float (&v)[3])
{
    return v[0] > 0 || v[1] > 0 || v[2] > 0;
}

std::string percent(double share)
{
    char text[16];
    snprintf(text, sizeof text, "%.2g %%", 100 * share);
    return text;
}

class Planner {
public:
    Planner(const brume_services &services, brume_host host, const brume_plugin_request &request)
        : services_(services), host_(host), request_(request), scene_(*request.scene), state_(std::make_unique<State>())
    {
        state_->parameters = read_parameters(request.parameters);
        state_->width = request.width;
        state_->height = request.height;
        state_->attenuates = services.made(host, "attenuated_radiance") != BRUME_MADE_EARLIER;
        state_->layered = services.made(host, "density_rgb") == BRUME_MADE_EARLIER;
        state_->environment_scatters =
            scene_.environment_count > 0 && services.made(host, "environment_scattering") != BRUME_MADE_EARLIER;
        for (uint32_t i = 0; i < layer_count; ++i)
            outputs_ |= request.layers[i] && layer_table[i].flags & BRUME_LAYER_OUTPUT ? 1u << i : 0;
    }

    brume_status plan(std::unique_ptr<State> &out);

private:
    brume_status run(const char *name, const std::string &reason, double bytes, const Work &work)
    {
        const brume_plugin_entry e = running(name, reason, bytes, work);
        return services_.add_entry(host_, &e);
    }
    brume_status drop(const char *name, const std::string &reason)
    {
        const brume_plugin_entry e{sizeof e, 0, name, reason.c_str(), 0, 0, 0, 0};
        return services_.add_entry(host_, &e);
    }
    brume_status fail(const std::string &message) { return services_.fail(host_, BRUME_ERROR_UNSUPPORTED, message.c_str()); }

    brume_status check_tier();
    brume_status explain_orders();
    brume_status plan_shadows();
    brume_status need_camera();
    Work gather_work() const;
    double nanoseconds(const Work &work) const;
    brume_status plan_gather();
    const char *why_unlit(bool dense) const;
    bool takes_maps(const MapsOffer &offer, const Work &other) const;

    const brume_services &services_;
    brume_host host_;
    const brume_plugin_request &request_;
    const brume_plugin_scene &scene_;
    std::unique_ptr<State> state_;
    uint32_t outputs_ = 0;  // those wanted: bits by the order of the layers table
};

// The published tiers know less of media than the others; a wrong picture would be worse than none.
brume_status Planner::check_tier()
{
    const Tier tier = state_->parameters.tier;
    const auto &m = *scene_.medium;
    if (tier == Tier::reference && request_.backend != BRUME_BACKEND_CPU)
        return fail("method: reference on OpenGL; expected nodes, or the CPU, on which alone references run");
    if (!is_published(tier))
        return BRUME_OK;
    const std::string name = tier == Tier::sun ? "sun" : "fogshop";
    if (tier == Tier::sun && (m.term_count > 0 || scene_.gaussian_count > 0))
        return fail(
            "method: sun in a medium that is not constant; expected method nodes: Sun et al. know homogeneous media only");
    if (m.phase[0] != 0 || m.phase[3] != 0)
        return fail("method: " + name + " with a phase function that is not isotropic; expected method nodes, or g 0");
    return BRUME_OK;
}

brume_status Planner::explain_orders()
{
    const Parameters &p = state_->parameters;
    if (p.orders == Orders::all)
        return BRUME_OK;
    const double share = scattered_on_the_way(scene_, state_->width, state_->height);
    if (share <= p.max_error)
        return BRUME_OK;
    return drop("orders", "scattered once: about " + percent(share) + " of the lamps' light is scattered again" +
                              (state_->attenuates ? ", as no effect before this one scatters the picture's either" : ""));
}

brume_status Planner::plan_shadows()
{
    uint32_t brought = 0, made = 0;
    for (const brume_plugin_light &light : brume::lights_in(scene_))
        if (light.shadow_kind > 0)
            ++(light.shadow_screen > 0 ? made : brought);
    if (brought > 0 && !request_.layers[layer_shadow])
        if (brume_status s =
                drop("shadows", std::to_string(brought) + " lights have a shadow map; frames bring no layer shadow"))
            return s;
    if (made == 0 && (brought == 0 || !request_.layers[layer_shadow]))
        return BRUME_OK;
    const Tier tier = state_->parameters.tier;
    if (is_published(tier))
        return fail(std::string("method: ") + (tier == Tier::sun ? "sun" : "fogshop") +
                    " with a shadow map; expected method nodes: the published methods know no shadows");
    state_->shadowed = true;
    return BRUME_OK;
}

brume_status Planner::need_camera()
{
    if (state_->lit)
        return services_.need_camera(host_, BRUME_CAMERA_FIELD_OF_VIEW | BRUME_CAMERA_POSE,
                                     "the lights are placed in the world");
    if (state_->layered)
        return BRUME_OK;
    if (request_.pose_matters)
        return services_.need_camera(host_, BRUME_CAMERA_FIELD_OF_VIEW | BRUME_CAMERA_POSE,
                                     "the medium's density changes with the position");
    if (scene_.camera->depth_kind != BRUME_DEPTH_RAY)
        return services_.need_camera(host_, BRUME_CAMERA_FIELD_OF_VIEW,
                                     "the depth is planar and the field of view turns it into distance along the ray");
    return BRUME_OK;
}

// Of one evaluation; measured for tier `nodes`.
Work Planner::gather_work() const
{
    const Parameters &p = state_->parameters;
    const double lights = scene_.light_count;
    const Encounters met = encounters(scene_, state_->width, state_->height);
    if (is_published(p.tier))
        return {100 + 150 * lights + met.of_sight * (100 + 150 * lights)};
    const int finer = p.max_error > 0.05 ? 0 : p.max_error >= 0.005 ? 1 : 2;
    constexpr double of_terms[] = {1, 1.2, 1.5}, of_gaussians[] = {1, 2.3, 5};
    constexpr Work of_light{0, 0, 333}, of_term{1750, 0, 167};
    const double of_orders = p.orders == Orders::all && !takes_grid(*state_, scene_) ? 3 : 1;
    const Work work =
        Work{100} + of_orders * of_terms[finer] * lights * (of_light + double(scene_.medium->term_count) * of_term);
    if (scene_.gaussian_count == 0)
        return work;
    return work + Work{of_gaussians[finer] *
                       (5000 * std::min(met.of_sight, 1.0) + 250 * met.of_sight + 1500 * lights * met.of_light)};
}

double Planner::nanoseconds(const Work &work) const
{
    const brume_plugin_entry entry = running("", "", 0, work);
    return services_.nanoseconds(host_, &entry);
}

// Maps serve many Gaussians; where there are few, nodes are both nearer and faster. Where the grid cannot be as fine as the
// Gaussians are small, they are not taken unasked.
bool Planner::takes_maps(const MapsOffer &offer, const Work &other) const
{
    if (scene_.gaussian_count == 0 || scene_.light_count == 0)
        return false;
    const Tier tier = state_->parameters.tier;
    if (tier != Tier::automatic)
        return tier == Tier::maps;
    // Of Gaussians that come with the frames nobody knows how many; nodes would take minutes for some hundreds.
    return offer.suits && (!scene_.gaussians || 2 * nanoseconds(offer.work()) < nanoseconds(other));
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
    if (outputs_ & (1u << layer_airlight_error))
        if (brume_status s = image("airlight error", 4, state.error))
            return s;
    if (reduction > 1)
        if (brume_status s = image("airlight distances", 1, state.distances))
            return s;
    if (state.parameters.orders == Orders::all && scene_.light_count > 0) {
        constexpr int values = brume::maths_float::sides * int(BRUME_MAX_LIGHTS);
        if (brume_status s =
                services_.create_image(host_, "airlight surroundings", BRUME_DATA_WIDTH,
                                       (values + BRUME_DATA_WIDTH - 1) / BRUME_DATA_WIDTH, 4, &state.surroundings))
            return s;
        if (brume_status s =
                run("around",
                    state.parameters.ground == Ground::automatic ? "what the picture shows of surfaces around each lamp"
                                                                 : "what is around each lamp, as ground says",
                    4096, {scene_.light_count * 6.0 * 1296 * 40}))
            return s;
    }
    if (brume_status s = plan_tables(services_, host_, scene_, state))
        return s;
    const double pixels = double(width) * height;
    const Work work = pixels * gather_work();
    const MapsOffer maps = offer_maps(request_, state);
    state.maps.used = takes_maps(maps, work);
    state.scattered.used = takes_grid(state, scene_);
    if (state.maps.used)
        if (brume_status s = plan_maps(services_, host_, scene_, maps, state))
            return s;
    if (!state.maps.used && tier_of(state) == brume::maths_float::airlight_nodes)
        if (brume_status s = plan_order(services_, host_, scene_, state))
            return s;
    state.has_blobs = state.parameters.tier == Tier::fogshop && scene_.gaussian_count > 0;
    if (state.has_blobs)
        if (brume_status s =
                run("blobs", "density from the camera and each light to each Gaussian, when something moved", 0, {}))
            return s;
    if (brume_status s = run(
            state.maps.used ? maps_gather : "gather",
            std::to_string(scene_.light_count) + (scene_.light_count == 1 ? " light" : " lights") +
                (state.environment_scatters ? " and the environment" : "") +
                (state.parameters.orders == Orders::all
                     ? " scattered any number of times, about " +
                           percent(scattered_on_the_way(scene_, state.width, state.height)) + " of it more than once"
                     : " scattered once") +
                (state.shadowed ? ", in the shadows of solid things" : "") +
                (reduction > 1 ? ", at every " + std::string(reduction == 2 ? "second" : "fourth") + " pixel each way" : ""),
            pixels * (4 + 16), state.maps.used ? maps.of_pixels : work))
        return s;
    if (!state.scattered.used)
        return BRUME_OK;
    return plan_scattered(services_, host_, scene_, (outputs_ & (1u << layer_light_airlight)) != 0, state);
}

const char *Planner::why_unlit(bool dense) const
{
    if (scene_.light_count == 0 && scene_.environment_count == 0)
        return "no lights and no environment";
    if (scene_.light_count == 0 && !state_->environment_scatters)
        return "no lights, and the environment is what surrounds the picture for an effect before this one";
    if (state_->layered)
        return "the density is a layer's total along each ray, which does not say where the lights meet the medium";
    return dense ? "the medium does not scatter" : "the medium's density is zero everywhere";
}

brume_status Planner::plan(std::unique_ptr<State> &out)
{
    if (!scene_.has_medium)
        return drop("airlight", "the scene has no medium");
    const auto &m = *scene_.medium;
    State &state = *state_;
    const bool dense = state.layered || m.constant > 0 || m.term_count > 0 || scene_.gaussian_count > 0;
    const bool scatters = dense && any(m.scattering);
    const bool acts = dense && (scatters || any(m.absorption) || any(m.emission));
    state.lit = scatters && !state.layered && (scene_.light_count > 0 || state.environment_scatters);
    if (!state.lit && (!acts || !state.attenuates) && outputs_ == 0)
        return drop("airlight", why_unlit(dense));
    if (brume_status s = check_tier())
        return s;
    if (brume_status s = need_camera())
        return s;
    if (state.lit)
        if (brume_status s = plan_shadows())
            return s;
    if (state.lit)
        if (brume_status s = explain_orders())
            return s;
    if (brume_status s = state.lit ? plan_gather() : drop("gather", why_unlit(dense)))
        return s;
    const double pixels = double(state.width) * state.height;
    if (brume_status s =
            run("compose", state.attenuates ? "attenuates the image and adds the airlight" : "adds the airlight",
                pixels * (16 + 8 + 16 + (state.layered ? 16 : 0) + (state.lit ? 16 : 0)),
                {pixels * ((state.parameters.reduction > 1 ? 100 : 60) + (state.attenuates ? 20 : 0))}))
        return s;
    if (brume_status s = create_passes(services_, host_, outputs_, state))
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
    if (state.lit)
        if (brume_status s = refresh(*services, host, *frame->scene, state))
            return s;
    return run_passes(*services, host, *frame, state);
}

// Whether all orders are asked for, and can be had: the published tiers know single scattering only. Alone, this effect is
// Zhou et al.'s equation 29, in which nothing scatters twice.
brume_status settle(const brume_services *services, brume_host host, const brume_plugin_request *request, double *values)
{
    const Parameters p = read_parameters(values);
    if (p.orders != Orders::automatic)
        return BRUME_OK;
    const bool able = !is_published(p.tier);
    const bool beside = services->made(host, "attenuated_radiance") == BRUME_MADE_EARLIER &&
                        services->made(host, "density_rgb") != BRUME_MADE_EARLIER;
    settle_orders(values,
                  able && beside && scattered_on_the_way(*request->scene, request->width, request->height) > p.max_error
                      ? Orders::all
                      : Orders::single);
    return BRUME_OK;
}

// The published tiers know single scattering only.
uint32_t makes_with(const double *values, uint32_t index)
{
    const Parameters p = read_parameters(values);
    return made[index] != std::string_view("all_scattering") || (p.orders == Orders::all && !is_published(p.tier));
}

// What lies between the camera and each Gaussian is what tier fogshop asks.
uint32_t uses_with(const double *values, uint32_t index)
{
    return index != product_camera_gaussians || read_parameters(values).tier == Tier::fogshop;
}

}  // namespace
}  // namespace airlight

BRUME_PLUGIN_EXPORT const brume_effect *brume_plugin_effect(uint32_t host_abi)
{
    using namespace airlight;
    static const std::vector<const char *> scenes = [] {
        std::vector<const char *> texts;
        for (const std::string &text : calibration_scenes())
            texts.push_back(text.c_str());
        return texts;
    }();
    static const brume_effect effect = [] {
        brume_effect e{};
        e.struct_size = sizeof e;
        e.abi = BRUME_PLUGIN_ABI;
        e.name = "airlight";
        e.help = "adds what the scene's lights scatter toward the camera (Zhou et al. 2007, Sun et al. 2005)";
        e.order = 200;
        e.thread_safety = BRUME_THREADS_SAFE;
        e.wanted = BRUME_WANTED_WITH_LIGHTS;
        e.parameters = parameter_table().data();
        e.parameter_count = uint32_t(parameter_table().size());
        e.layers = layer_table;
        e.layer_count = layer_count;
        e.makes = made;
        e.make_count = uint32_t(std::size(made));
        e.uses = used;
        e.use_count = product_count;
        e.plan = plan;
        e.execute = execute;
        e.destroy = [](void *state) { delete static_cast<State *>(state); };
        e.makes_with = makes_with;
        e.offer = offer;
        e.settle = settle;
        e.uses_with = uses_with;
        e.scenes = scenes.data();
        e.scene_count = uint32_t(scenes.size());
        return e;
    }();
    return host_abi == BRUME_PLUGIN_ABI ? &effect : nullptr;
}
