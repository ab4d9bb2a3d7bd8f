// surface: what lamps give the surfaces of a picture that was made in clear air, with the medium between them.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "scene_maths.hpp"
#include "tables.h"
#include "state.h"

namespace surface {
namespace {

constexpr brume_layer_info transfer_layer(const char *name, const char *help)
{
    return {sizeof(brume_layer_info), BRUME_LAYER_INPUT, 3, 0, name, help};
}

constexpr brume_layer_info layer_table[] = {
    {sizeof(brume_layer_info), BRUME_LAYER_INPUT, 3, 0, "normal", "where surfaces face; without it, as depth has it"},
    {sizeof(brume_layer_info), BRUME_LAYER_INPUT | BRUME_LAYER_OF_LIGHT, 3, 0, "light_group",
     "what of the picture is one light's; without it, by what lights give in clear air"},
    {sizeof(brume_layer_info), BRUME_LAYER_INPUT, 3, 0, "albedo",
     "of diffuse reflection; with it, light that the medium brings into shadows and to sides turned away is added"},
    {sizeof(brume_layer_info), BRUME_LAYER_INPUT, 3, 0, "specular",
     "of glossy reflection; with albedo and roughness, lamps' highlights dim and widen"},
    {sizeof(brume_layer_info), BRUME_LAYER_INPUT, 1, 0, "roughness", "of glossy reflection, 0 to 1; 1: there is none"},
    transfer_layer("transfer_0",
                   "SH coefficients 0 to 2 of what a point of albedo 1 sends out under a sky of each harmonic: soft "
                   "shadows of the light that the medium brings; beside albedo, the first 1, 2, 3 or all 6 layers"),
    transfer_layer("transfer_1", "coefficients 3 to 5 of the same"),
    transfer_layer("transfer_2", "coefficients 6 to 8 of the same"),
    transfer_layer("transfer_3", "coefficients 9 to 11 of the same"),
    transfer_layer("transfer_4", "coefficients 12 to 14 of the same"),
    {sizeof(brume_layer_info), BRUME_LAYER_INPUT, 1, 0, "transfer_5", "coefficient 15 of the same"},
    {sizeof(brume_layer_info), BRUME_LAYER_INPUT | BRUME_LAYER_OF_LIGHT | BRUME_LAYER_ANY_SIZE, 1, 0, "shadow",
     "depth as seen from the light, where brume_light.shadow_kind says: what is in its shadow has no share of it"},
    {sizeof(brume_layer_info), BRUME_LAYER_OUTPUT, 3, 0, "surface",
     "the picture as the lights give it through the medium, before the medium in front of it"},
};
static_assert(std::size(layer_table) == layer_count);

// What there is on lights' ways.
constexpr const char *calibration_scenes[] = {
    R"({"brume":1,"camera":{"vertical_fov":50,"camera_to_world":[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]},
        "medium":{"scattering":[0.03,0.035,0.04],"absorption":0.002,"g":0.8},
        "lights":[{"type":"point","position":[2,1,-12],"intensity":40},{"type":"point","position":[-4,2,-20],"intensity":40}]})",
    R"({"brume":1,"camera":{"vertical_fov":50,"camera_to_world":[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]},
        "medium":{"scattering":0.05,"density":[{"type":"exponential","value":1,"falloff":0.2},
          {"type":"gaussian","center":[0,0,-10],"scale":0.3,"amplitude":2},{"type":"gaussian","center":[2,-2,-8],"scale":0.5,"amplitude":2}]},
        "lights":[{"type":"point","position":[2,1,-12],"intensity":40},{"type":"point","position":[-4,2,-20],"intensity":40}]})"};

constexpr const char *used[] = {"lights", "light_gaussians", "density_rgb", "light_shadows"};
static_assert(std::size(used) == product_count);

bool any(const float (&v)[3])
{
    return v[0] > 0 || v[1] > 0 || v[2] > 0;
}

class Planner {
public:
    Planner(const brume_services &services, brume_host host, const brume_plugin_request &request)
        : services_(services), host_(host), request_(request), scene_(*request.scene), state_(std::make_unique<State>())
    {
        state_->width = request.width;
        state_->height = request.height;
        state_->method = read_method(request.parameters);
        state_->ground = read_ground_albedo(request.parameters);
    }

    brume_status plan(std::unique_ptr<State> &out);

private:
    brume_status entry(bool runs, const char *name, const std::string &reason, double bytes, double operations)
    {
        brume_plugin_entry e{sizeof e, runs ? 1u : 0u, name, reason.c_str(), uint64_t(bytes), uint64_t(operations), 0, 0};
        return services_.add_entry(host_, &e);
    }
    brume_status image(const char *label, brume_plugin_image &out)
    {
        return services_.create_image(host_, label, state_->width, state_->height, 4, &out);
    }
    const char *why_not() const;
    brume_status plan_normals(double pixels);
    brume_status explain_material();
    brume_status plan_transfer(double pixels, double of_light);
    brume_status plan_method();
    bool has_shadows() const;
    brume_status plan_groups(double pixels, double of_light);

    const brume_services &services_;
    brume_host host_;
    const brume_plugin_request &request_;
    const brume_plugin_scene &scene_;
    std::unique_ptr<State> state_;
};

std::string about(Method method)
{
    const char *const methods[] = {"calibrated: scattered any number of times", "sun: scattered once (Sun et al. 2005)",
                                   "psf: scattered once, in spherical harmonics (Zhou et al. 2007)",
                                   "reference: scattered once, by quadrature"};
    return std::string("what lights give surfaces through the medium, method ") + methods[size_t(method)];
}

// Of one lamp at one pixel.
double operations_of(Method method, double followed)
{
    const double on_top[] = {0, 1000, 400, 1e6};
    return 200 + on_top[size_t(method)] + followed * (method == Method::reference ? 1e6 : 1);
}

// How many Gaussians are about on the way from a light to a surface; those that come with the frames nobody knows.
double gaussians_on_the_way(const brume_plugin_scene &scene)
{
    using namespace brume::maths_double;
    if (!scene.gaussians || scene.light_count == 0)
        return scene.gaussian_count;
    const Medium medium = medium_of(scene);
    vec3 low(1e30), high(-1e30);
    for (const brume_plugin_gaussian &g : brume::gaussians_in(scene)) {
        const vec3 center = gaussian_of(g).center;
        low = min(low, center);
        high = max(high, center);
    }
    const double across = length(high - low);
    double sum = 0;
    for (const brume_plugin_light &light : brume::lights_in(scene))
        for (const brume_plugin_gaussian &given : brume::gaussians_in(scene)) {
            const Gaussian g = gaussian_of(given);
            const vec3 position(light.position[0], light.position[1], light.position[2]);
            const bool parallel = light.type == BRUME_LIGHT_DIRECTIONAL;
            const double reach = gaussian_reach(medium, g),
                         sine = reach / std::max(parallel ? across + reach : length(g.center - position), reach);
            sum += parallel ? sine * sine : 0.5 - 0.5 * std::sqrt(1 - sine * sine);
        }
    return sum / scene.light_count;
}

// NULL: it runs.
const char *Planner::why_not() const
{
    if (!scene_.has_medium)
        return "the scene has no medium";
    const auto &m = *scene_.medium;
    if (services_.made(host_, "density_rgb") == BRUME_MADE_EARLIER)
        return "the density is a layer's total along each ray, which does not say what is between lights and surfaces";
    if (!(m.constant > 0 || m.term_count > 0 || scene_.gaussian_count > 0))
        return "the medium's density is zero everywhere";
    if (!any(m.scattering) && !any(m.absorption))
        return "the medium neither scatters nor absorbs";
    if (scene_.light_count > 0)
        return nullptr;
    const bool knows_sky = state_->method == Method::calibrated || state_->method == Method::psf;
    if (!knows_sky)
        return "no lights";
    if (scene_.environment_count == 0)
        return "no lights and no environment";
    return nullptr;
}

brume_status Planner::plan_normals(double pixels)
{
    if (request_.layers[layer_normal])
        return BRUME_OK;
    if (brume_status s = image("surface normals", state_->normals))
        return s;
    return entry(true, "normals", "no layer normal: from depth", pixels * (4 + 16), pixels * 80);
}

brume_status Planner::explain_material()
{
    const uint32_t *given = request_.layers;
    if (!given[layer_albedo])
        return entry(false, "material",
                     given[layer_specular] || given[layer_roughness]
                         ? "specular and roughness count with a layer albedo only"
                         : "no layer albedo: a factor of what the picture shows, which cannot light what is black",
                     0, 0);
    if (given[layer_specular] && given[layer_roughness])
        return BRUME_OK;
    return entry(false, "highlights", "no layers specular and roughness: highlights count as diffuse", 0, 0);
}

// Degrees of which the first layers bring all coefficients.
int transfer_order(const uint32_t *given)
{
    int layers = 0;
    while (layers < 6 && given[layer_transfer + layers])
        ++layers;
    return layers == 6 ? 4 : std::min(layers, 3);
}

brume_status Planner::plan_transfer(double pixels, double of_light)
{
    const uint32_t *given = request_.layers + layer_transfer;
    if (std::none_of(given, given + 6, [](uint32_t there) { return there != 0; }))
        return BRUME_OK;
    const int order = transfer_order(request_.layers);
    if (order == 0)
        return entry(false, "transfer", "no layer transfer_0; expected the first 1, 2, 3 or all 6 of them", 0, 0);
    if (!request_.layers[layer_albedo])
        return entry(false, "transfer", "the layers transfer_0 to transfer_5 count with a layer albedo only", 0, 0);
    if (state_->method != Method::calibrated && state_->method != Method::psf)
        return entry(false, "transfer", "methods sun and reference have no spherical harmonics of what arrives", 0, 0);
    state_->transfer = order;
    if (brume_status s = image("surface lit", state_->lit[1]))
        return s;
    return entry(true, "transfer",
                 std::to_string(order) + (order == 1 ? " degree" : " degrees") +
                     " of what surfaces send on: soft shadows of the light that the medium brings",
                 pixels * (4 + 16 + 16 + 16 + 16 * order), scene_.light_count * pixels * of_light);
}

brume_status Planner::plan_method()
{
    if (state_->method == Method::reference && request_.backend != BRUME_BACKEND_CPU)
        return services_.fail(
            host_, BRUME_ERROR_UNSUPPORTED,
            "method: reference on OpenGL; expected calibrated, sun or psf, or the CPU, on which alone references run");
    const auto &m = *scene_.medium;
    if (state_->method == Method::calibrated && scene_.environment_count > 0 && m.constant > 0 &&
        scene_.camera->sky != int32_t(BRUME_SKY_CLAMP))
        return entry(false, "environment",
                     "constant density has no end without a sky's distance: the environment's part stays as it is", 0, 0);
    if (state_->method != Method::sun && state_->method != Method::psf)
        return BRUME_OK;
    const bool psf = state_->method == Method::psf;
    if (m.phase[0] != 0 || m.phase[3] != 0)
        if (brume_status s = entry(false, "phase",
                                   std::string("method ") + (psf ? "psf" : "sun") +
                                       ": scattered alike in all directions, whatever the medium's phase function",
                                   0, 0))
            return s;
    if (psf && scene_.environment_count > 0 &&
        (m.term_count > 0 || (m.constant > 0 && scene_.camera->sky != int32_t(BRUME_SKY_CLAMP))))
        if (brume_status s =
                entry(false, "environment",
                      "constant and exponential density has no end without a sky's distance: the environment's part "
                      "stays as it is",
                      0, 0))
            return s;
    const std::vector<float> &table = psf ? psf_table() : lobe_table();
    const int32_t channels = psf ? 4 : 1;
    return services_.upload(host_, upload_table, channels, table.data(), table.size() / size_t(channels), &state_->table);
}

bool Planner::has_shadows() const
{
    for (const brume_plugin_light &light : brume::lights_in(scene_))
        if (light.shadow_kind > 0 && (light.shadow_screen > 0 || request_.layers[layer_shadow]))
            return true;
    return false;
}

brume_status Planner::plan_groups(double pixels, double of_light)
{
    if (!request_.layers[layer_light_group])
        return entry(false, "group", "no layer light_group: shares by what lights give in clear air", 0, 0);
    // Images that a program reads are 16 at most on some drivers.
    state_->composes_groups = !state_->sky && !state_->shadowed;
    for (int i = 0; i < 2; ++i) {
        if (brume_status s = image("surface rest", state_->rest[i]))
            return s;
        if (!state_->lit[i])
            if (brume_status s = image("surface lit", state_->lit[i]))
                return s;
    }
    return entry(true, "group", "each light's own layer", scene_.light_count * pixels * (5 * 16 + 4 + 16),
                 scene_.light_count * pixels * of_light);
}

brume_status Planner::plan(std::unique_ptr<State> &out)
{
    if (const char *reason = why_not())
        return entry(false, "surface", reason, 0, 0);
    if (brume_status s = services_.need_camera(host_, BRUME_CAMERA_FIELD_OF_VIEW | BRUME_CAMERA_POSE,
                                               "the lights are placed in the world"))
        return s;
    const double pixels = double(state_->width) * state_->height, lights = scene_.light_count;
    const double of_light =
        operations_of(state_->method, 30.0 * scene_.medium->term_count + 30.0 * gaussians_on_the_way(scene_));
    if (brume_status s = plan_normals(pixels))
        return s;
    if (brume_status s = explain_material())
        return s;
    if (brume_status s = plan_method())
        return s;
    state_->shadowed = has_shadows();
    state_->material = !request_.layers[layer_albedo]                                        ? 0
                       : request_.layers[layer_specular] && request_.layers[layer_roughness] ? 2
                                                                                             : 1;
    state_->sky = scene_.environment_count > 0;
    if (brume_status s = plan_transfer(pixels, of_light))
        return s;
    if (brume_status s = plan_groups(pixels, of_light))
        return s;
    constexpr uint32_t most = brume::maths_float::most_gaussians_around;
    if (state_->sky && scene_.gaussian_count > most)
        if (brume_status s =
                entry(false, "gaussians",
                      std::to_string(scene_.gaussian_count) + " Gaussians; between the sky and surfaces at most " +
                          std::to_string(most) + " are followed, between lights and surfaces all",
                      0, 0))
            return s;
    if (brume_status s = entry(true, "compose", about(state_->method), pixels * (16 + 4 + 16 + 16),
                               pixels * (40 + (state_->rest[0] ? 0 : lights * of_light))))
        return s;
    if (brume_status s = create_passes(services_, host_, request_, *state_))
        return s;
    out = std::move(state_);
    return BRUME_OK;
}

brume_status plan(const brume_services *services, brume_host host, const brume_plugin_request *request, void **out)
{
    std::unique_ptr<State> state;
    const brume_status s = Planner(*services, host, *request).plan(state);
    *out = state.release();
    return s;
}

brume_status execute(const brume_services *services, brume_host host, void *state, const brume_plugin_frame *frame)
{
    return run_passes(*services, host, *frame, *static_cast<State *>(state));
}

}  // namespace
}  // namespace surface

BRUME_PLUGIN_EXPORT const brume_effect *brume_plugin_effect(uint32_t host_abi)
{
    using namespace surface;
    static const brume_effect effect = [] {
        brume_effect e{};
        e.struct_size = sizeof e;
        e.abi = BRUME_PLUGIN_ABI;
        e.name = "surface";
        e.help = "lights the picture's surfaces as the scene's lamps do through the medium";
        e.order = 50;
        e.thread_safety = BRUME_THREADS_SAFE;
        // Pictures whose surfaces emit would be taken for lit ones, were it not for these layers.
        e.wanted = BRUME_WANTED_WITH_LAYERS;
        e.parameters = parameter_table().data();
        e.parameter_count = uint32_t(parameter_table().size());
        e.layers = layer_table;
        e.layer_count = layer_count;
        e.uses = used;
        e.use_count = product_count;
        e.plan = plan;
        e.execute = execute;
        e.destroy = [](void *state) { delete static_cast<State *>(state); };
        e.scenes = calibration_scenes;
        e.scene_count = uint32_t(std::size(calibration_scenes));
        return e;
    }();
    return host_abi == BRUME_PLUGIN_ABI ? &effect : nullptr;
}
