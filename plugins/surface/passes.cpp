#include "passes.h"

#include <algorithm>
#include <iterator>
#include <string_view>

#include "pass_tables.hpp"
#include "state.h"
#include "transfer.h"

namespace surface {

std::string_view pass_text(std::string_view name);

namespace {

using namespace brume_passes;
namespace maths = brume::maths_float;

constexpr brume_slot normals_slots[] = {fetch("depth"), write("normals")};
static_assert(std::size(normals_slots) == normals::slot_count);

// In the order of shared::Slot.
#define OF_ALL                                                                                                              \
    fetch("depth"), fetch("normals"), fetch("lights"), fetch("ungrouped"), fetch("light_gaussians"), fetch("table"),        \
        fetch("albedo")
#define OF_PARTS OF_ALL, fetch("specular"), fetch("roughness"), fetch("rest"), fetch("lit")
#define OF_GROUPS fetch("group_0"), fetch("group_1"), fetch("group_2"), fetch("group_3")

constexpr brume_slot transfer_slots[] = {OF_ALL,
                                         fetch("environment"),
                                         fetch("in_axes"),
                                         fetch("transfer_0"),
                                         fetch("transfer_1"),
                                         fetch("transfer_2"),
                                         fetch("transfer_3"),
                                         fetch("transfer_4"),
                                         fetch("transfer_5"),
                                         write("brought")};
static_assert(std::size(transfer_slots) == transfer::slot_count);

constexpr brume_slot group_slots[] = {OF_PARTS, OF_GROUPS, write("rest_out"), write("lit_out")};
static_assert(std::size(group_slots) == group::slot_count);

constexpr brume_slot compose_groups_slots[] = {OF_PARTS, OF_GROUPS, fetch("color"), write("result"), write("surface_out")};
static_assert(std::size(compose_groups_slots) == compose::slot_count);

constexpr brume_slot compose_slots[] = {OF_PARTS,      fetch("environment"), fetch("light_shadows"), fetch("shadow_maps"),
                                        fetch("none"), fetch("color"),       write("result"),        write("surface_out")};
static_assert(std::size(compose_slots) == compose::slot_count);

constexpr brume_constant constants_table[] = {BRUME_CONSTANT_OF(Constants, settings, method),
                                              BRUME_CONSTANT_OF(Constants, settings, light_count),
                                              BRUME_CONSTANT_OF(Constants, settings, gaussian_count),
                                              BRUME_CONSTANT_OF(Constants, settings, environment_order),
                                              BRUME_CONSTANT_OF(Constants, settings, world_normals),
                                              BRUME_CONSTANT_OF(Constants, settings, material),
                                              BRUME_CONSTANT_OF(Constants, settings, shadowed),
                                              BRUME_CONSTANT_OF(Constants, settings, without),
                                              BRUME_CONSTANT_OF(Constants, settings, transfer),
                                              BRUME_CONSTANT_OF(Constants, settings, world_transfer),
                                              BRUME_CONSTANT_OF(Constants, settings, ground),
                                              BRUME_CONSTANT(Constants, of_lights),
                                              BRUME_CONSTANT(Constants, groups),
                                              BRUME_CONSTANT(Constants, first)};

template <size_t Slots>
brume_status create_pass(const brume_services &services, brume_host host, const char *name, const brume_slot (&slots)[Slots],
                         const std::string &defines, brume_rows_function rows, brume_pass &out)
{
    const std::string file = "surface_" + std::string(name) + ".comp";
    return create(services, host, described(name, slots, constants_table, sizeof(Constants)), file.c_str(), pass_text(file),
                  defines, rows, out);
}

// Sets so many values to value(i); whether any changed. Of as many as before nothing is allocated.
template <class Value> bool changes(std::vector<float> &values, size_t count, Value value)
{
    bool changed = values.size() != count;
    values.resize(count);
    for (size_t i = 0; i < count; ++i) {
        const float now = value(i);
        changed = changed || values[i] != now;
        values[i] = now;
    }
    return changed;
}

// Of SurfaceSettings::without.
int scene_without(const brume_plugin_scene &scene)
{
    int without = maths::without_suns | maths::without_spots;
    for (const brume_plugin_light &light : brume::lights_in(scene)) {
        if (light.surfaces == float(BRUME_SURFACES_UNLIT))
            continue;
        if (int(light.type) == maths::light_directional)
            without &= ~maths::without_suns;
        if (int(light.type) == maths::light_spot)
            without &= ~maths::without_spots;
    }
    const brume_plugin_medium &m = *scene.medium;
    const auto alike = [&](int a, int b) {
        return m.scattering[a] == m.scattering[b] && m.absorption[a] == m.absorption[b];
    };
    return without | (alike(0, 1) ? maths::without_green : 0) | (alike(1, 2) ? maths::without_blue : 0);
}

class Frame {
public:
    Frame(const brume_services &services, brume_host host, const brume_plugin_frame &frame, State &state)
        : services_(services), host_(host), frame_(frame), state_(state), scene_(*frame.scene)
    {
        constants_.settings.method = int32_t(state.method);
        constants_.settings.ground = state.ground;
        constants_.settings.light_count = int32_t(scene_.light_count);
        constants_.settings.gaussian_count = int32_t(scene_.gaussian_count);
        constants_.settings.environment_order = brume::maths_float::environment_order(scene_);
        const brume_plugin_layer &normal = frame.layers[layer_normal];
        constants_.settings.world_normals = normal.image && normal.kind == BRUME_LAYER_WORLD;
        constants_.settings.material = state.material;
        constants_.settings.shadowed = state.shadowed;
        constants_.settings.transfer = state.transfer;
        constants_.settings.world_transfer = frame.layers[layer_transfer].kind == BRUME_LAYER_WORLD;
        normals_ = normal.image ? normal.image : state.normals;
        constants_.first = 1;
        rest_ = frame.color;
    }

    brume_status upload();
    brume_status normals();
    brume_status transfer();
    brume_status groups();
    brume_status compose();

private:
    brume_plugin_image product(Product of, uint32_t index = 0) const
    {
        const brume_plugin_product &product = brume::products_in(frame_)[of];
        return index < product.image_count ? product.images[index] : nullptr;
    }
    bool lights_surfaces(uint32_t light) const
    {
        return brume::lights_in(scene_)[light].surfaces != float(BRUME_SURFACES_UNLIT);
    }
    brume_plugin_image group_of(uint32_t light) const
    {
        const brume_plugin_image *groups = frame_.layers[layer_light_group].of_lights;
        return groups && lights_surfaces(light) ? groups[light] : nullptr;
    }
    brume_status run(brume_pass pass, const brume_plugin_image *images)
    {
        return services_.run(host_, pass, images, &constants_, state_.width, state_.height, nullptr);
    }
    // One that goes through lights.
    brume_status run_for_lights(const Variants &variants, const brume_plugin_image *images)
    {
        constants_.settings.without = without_;
        return run(variants.fitting(without_).pass, images);
    }
    int frame_without() const
    {
        bool ungrouped = false;
        for (uint32_t l = 0; l < scene_.light_count; ++l)
            ungrouped = ungrouped || (lights_surfaces(l) && !group_of(l));
        return scene_without(scene_) | (ungrouped ? 0 : maths::without_ungrouped);
    }
    void bind_all(brume_plugin_image *images) const;
    void bind_parts(brume_plugin_image *images) const;
    void take_group(uint32_t light);
    brume_status divide();
    // So much is lit by now.
    void wrote(brume_plugin_image lit)
    {
        lit_ = lit;
        constants_.first = 0;
    }

    const brume_services &services_;
    brume_host host_;
    const brume_plugin_frame &frame_;
    State &state_;
    const brume_plugin_scene &scene_;
    Constants constants_{};
    brume_plugin_image normals_ = nullptr;
    brume_plugin_image rest_ = nullptr, lit_ = nullptr;  // of the picture, what is still to be divided, and what was
    brume_plugin_image groups_[groups_at_once] = {};     // that the next pass takes
    int now_ = 1;                                        // which of the state's pairs was written last
    int without_ = 0;
};

brume_status Frame::upload()
{
    without_ = frame_without();
    const auto send = [&](Upload slot, int32_t channels, const std::vector<float> &values, brume_plugin_image &out) {
        return services_.upload(host_, slot, channels, values.data(), values.size() / size_t(channels), &out);
    };
    const auto part = [&](size_t light) {
        const uint32_t l = uint32_t(light);
        return float(!lights_surfaces(l) ? maths::part_none : group_of(l) ? maths::part_grouped : maths::part_ungrouped);
    };
    if (changes(state_.ungrouped_values, scene_.light_count, part))
        if (brume_status s = send(upload_ungrouped, 1, state_.ungrouped_values, state_.ungrouped))
            return s;
    if (scene_.environment_count == 0)
        return BRUME_OK;
    const auto coefficient = [&](size_t i) { return i % 4 < 3 ? scene_.environment[i / 4][i % 4] : 0.0f; };
    const bool other_sky = changes(state_.environment_values, 4 * size_t(scene_.environment_count), coefficient);
    if (other_sky)
        if (brume_status s = send(upload_environment, 4, state_.environment_values, state_.environment))
            return s;
    if (constants_.settings.transfer == 0 || constants_.settings.world_transfer)
        return BRUME_OK;
    const brume_plugin_camera &camera = *scene_.camera;
    const float *const axes[] = {camera.right, camera.up, camera.back};
    const bool turned = changes(state_.axes, 9, [&](size_t i) { return axes[i / 3][i % 3]; });
    if (!turned && !other_sky && state_.turned)
        return BRUME_OK;
    return send(upload_turned, 4, environment_in_camera(scene_), state_.turned);
}

brume_status Frame::normals()
{
    using namespace surface::normals;
    if (frame_.layers[layer_normal].image)
        return BRUME_OK;
    brume_plugin_image images[slot_count] = {};
    images[depth] = frame_.depth;
    images[Slot::normals] = state_.normals;
    return run(state_.normals_pass, images);
}

void Frame::bind_all(brume_plugin_image *images) const
{
    using namespace shared;
    images[depth] = frame_.depth;
    images[shared::normals] = normals_;
    images[lights] = product(product_lights);
    images[ungrouped] = state_.ungrouped;
    images[light_gaussians] = product(product_light_gaussians);
    images[table] = state_.table;
    images[albedo] = frame_.layers[layer_albedo].image;
}

void Frame::bind_parts(brume_plugin_image *images) const
{
    using namespace shared;
    bind_all(images);
    images[specular] = frame_.layers[layer_specular].image;
    images[roughness] = frame_.layers[layer_roughness].image;
    images[rest] = rest_;
    images[lit] = lit_;
    std::copy_n(groups_, constants_.groups, images + group_0);
}

brume_status Frame::transfer()
{
    using namespace surface::transfer;
    if (state_.transfer == 0)
        return BRUME_OK;
    brume_plugin_image images[slot_count] = {};
    bind_all(images);
    images[environment] = state_.environment;
    images[in_axes] = constants_.settings.world_transfer ? state_.environment : state_.turned;
    for (int i = layer_transfer; i <= layer_last_transfer; ++i)
        images[transfer_0 + i - layer_transfer] = frame_.layers[i].image;
    images[brought] = state_.lit[1];
    wrote(state_.lit[1]);
    return run_for_lights(state_.transfer_pass, images);
}

void Frame::take_group(uint32_t light)
{
    constants_.of_lights[constants_.groups] = int32_t(light);
    groups_[constants_.groups++] = group_of(light);
}

// Takes the groups from what is still to be divided.
brume_status Frame::divide()
{
    using namespace surface::group;
    if (constants_.groups == 0)
        return BRUME_OK;
    brume_plugin_image images[slot_count] = {};
    bind_parts(images);
    now_ = 1 - now_;
    images[rest_out] = state_.rest[now_];
    images[lit_out] = state_.lit[now_];
    const brume_status s = run_for_lights(state_.group_pass, images);
    rest_ = state_.rest[now_];
    wrote(state_.lit[now_]);
    constants_.groups = 0;
    return s;
}

brume_status Frame::groups()
{
    for (uint32_t l = 0; l < scene_.light_count; ++l) {
        if (!group_of(l))
            continue;
        if (constants_.groups == groups_at_once)
            if (brume_status s = divide())
                return s;
        take_group(l);
    }
    return state_.composes_groups ? BRUME_OK : divide();
}

brume_status Frame::compose()
{
    using namespace surface::compose;
    brume_plugin_image images[slot_count] = {};
    bind_parts(images);
    images[color] = frame_.color;
    if (!state_.composes_groups) {
        images[environment] = state_.environment;
        images[light_shadows] = product(product_light_shadows);
        images[shadow_maps] = product(product_light_shadows, 1);
    }
    images[result] = frame_.output;
    images[surface_out] = frame_.layers[layer_surface].image;
    return run_for_lights(state_.compose_pass, images);
}

// `name` once for each of these, none of which is twice.
template <size_t Slots>
brume_status create_variants(const brume_services &services, brume_host host, const char *name,
                             const brume_slot (&slots)[Slots], std::initializer_list<int> without,
                             const std::string &defines, brume_rows_function rows, Variants &out)
{
    for (int each : without) {
        if (!out.all.empty() && out.all.back().without == each)
            continue;
        out.all.push_back({each, nullptr});
        if (brume_status s =
                create_pass(services, host, name, slots, defines + define("WITHOUT", each), rows, out.all.back().pass))
            return s;
    }
    return BRUME_OK;
}

}  // namespace

brume_status create_passes(const brume_services &services, brume_host host, const brume_plugin_request &request,
                           State &state)
{
    const bool reference = state.method == Method::reference;
    if (state.normals)
        if (brume_status s = create_pass(services, host, "normals", normals_slots, "", normals_rows, state.normals_pass))
            return s;
    const brume_plugin_scene &scene = *request.scene;
    const auto &absorption = scene.medium->absorption;
    const bool absorbs = std::any_of(absorption, std::end(absorption), [](float a) { return a > 0; });
    const std::string defines = define("METHOD", int(state.method)) + define("MATERIAL", state.material) +
                                define("ENVIRONMENT", state.sky) + define("SHADOWED", state.shadowed) +
                                define("TRANSFER", state.transfer) + define("TERMS", scene.medium->term_count > 0) +
                                define("GAUSSIANS", scene.gaussian_count > 0) + define("ABSORBS", absorbs) +
                                define("GROUPS", state.composes_groups) +
                                define("SURFACE_OUT", request.layers[layer_surface] != 0);
    const auto &composing = state.composes_groups ? compose_groups_slots : compose_slots;
    const int lights = scene_without(scene), grouped = lights | maths::without_ungrouped;
    if (state.transfer > 0)
        if (brume_status s = create_variants(services, host, "transfer", transfer_slots, {lights, 0}, defines, transfer_rows,
                                             state.transfer_pass))
            return s;
    if (!state.rest[0])
        return create_variants(services, host, "compose", composing, {lights, 0}, defines,
                               reference ? compose_reference_rows : compose_rows, state.compose_pass);
    if (brume_status s = create_variants(services, host, "group", group_slots, {lights, 0}, defines,
                                         reference ? group_reference_rows : group_rows, state.group_pass))
        return s;
    return create_variants(services, host, "compose", composing, {grouped, lights, 0}, defines,
                           reference ? compose_reference_rows : compose_rows, state.compose_pass);
}

brume_status run_passes(const brume_services &services, brume_host host, const brume_plugin_frame &frame, State &state)
{
    Frame passes(services, host, frame, state);
    if (brume_status s = passes.upload())
        return s;
    if (brume_status s = passes.normals())
        return s;
    if (brume_status s = passes.transfer())
        return s;
    if (brume_status s = passes.groups())
        return s;
    return passes.compose();
}

}  // namespace surface
