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

constexpr brume_slot normals_slots[] = {fetch("depth"), write("normals")};
static_assert(std::size(normals_slots) == normals::slot_count);

constexpr brume_slot transfer_slots[] = {fetch("depth"),      fetch("normals"),     fetch("lights"),     fetch("ungrouped"),
                                         fetch("gaussians"),  fetch("environment"), fetch("in_axes"),    fetch("table"),
                                         fetch("albedo"),     fetch("transfer_0"),  fetch("transfer_1"), fetch("transfer_2"),
                                         fetch("transfer_3"), fetch("transfer_4"),  fetch("transfer_5"), write("brought")};
static_assert(std::size(transfer_slots) == transfer::slot_count);

constexpr brume_slot group_slots[] = {fetch("rest"),    fetch("lit"),      fetch("group"),     fetch("depth"),
                                      fetch("normals"), fetch("lights"),   fetch("gaussians"), fetch("table"),
                                      fetch("albedo"),  fetch("specular"), fetch("roughness"), write("rest_out"),
                                      write("lit_out")};
static_assert(std::size(group_slots) == group::slot_count);

constexpr brume_slot compose_slots[] = {
    fetch("color"),  fetch("rest"),       fetch("lit"),       fetch("depth"),         fetch("normals"),
    fetch("lights"), fetch("ungrouped"),  fetch("gaussians"), fetch("environment"),   fetch("table"),
    fetch("albedo"), fetch("specular"),   fetch("roughness"), fetch("light_shadows"), fetch("shadow_maps"),
    write("result"), write("surface_out")};
static_assert(std::size(compose_slots) == compose::slot_count);

constexpr brume_constant constants_table[] = {BRUME_CONSTANT_OF(Constants, settings, method),
                                              BRUME_CONSTANT_OF(Constants, settings, light_count),
                                              BRUME_CONSTANT_OF(Constants, settings, gaussian_count),
                                              BRUME_CONSTANT_OF(Constants, settings, environment_order),
                                              BRUME_CONSTANT_OF(Constants, settings, world_normals),
                                              BRUME_CONSTANT_OF(Constants, settings, material),
                                              BRUME_CONSTANT_OF(Constants, settings, shadowed),
                                              BRUME_CONSTANT_OF(Constants, settings, lamps_alone),
                                              BRUME_CONSTANT_OF(Constants, settings, transfer),
                                              BRUME_CONSTANT_OF(Constants, settings, world_transfer),
                                              BRUME_CONSTANT_OF(Constants, settings, ground),
                                              BRUME_CONSTANT(Constants, light),
                                              BRUME_CONSTANT(Constants, first)};

template <size_t Slots>
brume_status create_pass(const brume_services &services, brume_host host, const char *name, const brume_slot (&slots)[Slots],
                         const std::string &defines, brume_rows_function rows, brume_pass &out)
{
    const std::string file = "surface_" + std::string(name) + ".comp";
    return create(services, host, described(name, slots, constants_table, sizeof(Constants)), file.c_str(), pass_text(file),
                  defines, rows, out);
}

// The data image in `out` has these values from now on.
brume_status refresh(const brume_services &services, brume_host host, Upload slot, int32_t channels,
                     std::vector<float> values, std::vector<float> &last, brume_plugin_image &out)
{
    if (values.empty() || (out && values == last))
        return BRUME_OK;
    last = std::move(values);
    return services.upload(host, slot, channels, last.data(), last.size() / size_t(channels), &out);
}

class Frame {
public:
    Frame(const brume_services &services, brume_host host, const brume_plugin_frame &frame, State &state)
        : services_(services), host_(host), frame_(frame), state_(state), scene_(*frame.scene)
    {
        constants_.settings.method = int32_t(state.method);
        constants_.settings.ground = state.ground;
        constants_.settings.light_count = int32_t(scene_.light_count);
        constants_.settings.gaussian_count = scene_.gaussian_count <= most_gaussians ? int32_t(scene_.gaussian_count) : 0;
        constants_.settings.environment_order = brume::maths_float::environment_order(scene_);
        const brume_plugin_layer &normal = frame.layers[layer_normal];
        constants_.settings.world_normals = normal.image && normal.kind == BRUME_LAYER_WORLD;
        const bool glossy = frame.layers[layer_specular].image && frame.layers[layer_roughness].image;
        constants_.settings.material = frame.layers[layer_albedo].image ? (glossy ? 2 : 1) : 0;
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
        const brume_plugin_product &product = frame_.products[of];
        return index < product.image_count ? product.images[index] : nullptr;
    }
    bool lights_surfaces(uint32_t light) const { return scene_.lights[light].surfaces != float(BRUME_SURFACES_UNLIT); }
    brume_plugin_image group_of(uint32_t light) const
    {
        const brume_plugin_image *groups = frame_.layers[layer_light_group].of_lights;
        return groups && lights_surfaces(light) ? groups[light] : nullptr;
    }
    brume_status run(brume_pass pass, const brume_plugin_image *images)
    {
        return services_.run(host_, pass, images, &constants_, state_.width, state_.height, nullptr);
    }
    // One that goes through these lights.
    brume_status run_for_lights(const brume_pass (&passes)[2], uint32_t first, uint32_t last,
                                const brume_plugin_image *images)
    {
        const bool lamps_alone =
            std::none_of(scene_.lights + first, scene_.lights + last, [](const brume_plugin_light &light) {
                return int(light.type) == brume::maths_float::light_directional;
            });
        constants_.settings.lamps_alone = lamps_alone;
        return run(passes[lamps_alone], images);
    }
    // This light was written last.
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
};

brume_status Frame::upload()
{
    namespace maths = brume::maths_float;
    std::vector<float> ungrouped;
    for (uint32_t l = 0; l < scene_.light_count; ++l)
        ungrouped.push_back(float(!lights_surfaces(l) ? maths::part_none
                                  : group_of(l)       ? maths::part_grouped
                                                      : maths::part_ungrouped));
    if (brume_status s =
            refresh(services_, host_, upload_ungrouped, 1, std::move(ungrouped), state_.ungrouped_values, state_.ungrouped))
        return s;
    if (brume_status s = refresh(services_, host_, upload_environment, 4, maths::environment_of(scene_).values,
                                 state_.environment_values, state_.environment))
        return s;
    if (constants_.settings.transfer == 0 || constants_.settings.world_transfer)
        return BRUME_OK;
    return refresh(services_, host_, upload_turned, 4, environment_in_camera(scene_), state_.turned_values, state_.turned);
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

brume_status Frame::transfer()
{
    using namespace surface::transfer;
    if (state_.transfer == 0)
        return BRUME_OK;
    brume_plugin_image images[slot_count] = {};
    images[depth] = frame_.depth;
    images[Slot::normals] = normals_;
    images[lights] = product(product_lights);
    images[ungrouped] = state_.ungrouped;
    images[gaussians] = product(product_gaussians);
    images[environment] = state_.environment;
    images[in_axes] = constants_.settings.world_transfer ? state_.environment : state_.turned;
    images[table] = state_.table;
    images[albedo] = frame_.layers[layer_albedo].image;
    for (int i = layer_transfer; i <= layer_last_transfer; ++i)
        images[transfer_0 + i - layer_transfer] = frame_.layers[i].image;
    images[brought] = state_.lit[1];
    wrote(state_.lit[1]);
    return run_for_lights(state_.transfer_pass, 0, scene_.light_count, images);
}

brume_status Frame::groups()
{
    using namespace surface::group;
    int now = 1;  // which of the state's pairs was written last
    for (uint32_t l = 0; l < scene_.light_count; ++l) {
        if (!group_of(l))
            continue;
        brume_plugin_image images[slot_count] = {};
        images[rest] = rest_;
        images[lit] = lit_;
        images[Slot::group] = group_of(l);
        images[depth] = frame_.depth;
        images[Slot::normals] = normals_;
        images[lights] = product(product_lights);
        images[gaussians] = product(product_gaussians);
        images[table] = state_.table;
        images[albedo] = frame_.layers[layer_albedo].image;
        images[specular] = frame_.layers[layer_specular].image;
        images[roughness] = frame_.layers[layer_roughness].image;
        now = 1 - now;
        images[rest_out] = state_.rest[now];
        images[lit_out] = state_.lit[now];
        constants_.light = int32_t(l);
        if (brume_status s = run_for_lights(state_.group_pass, l, l + 1, images))
            return s;
        rest_ = state_.rest[now];
        wrote(state_.lit[now]);
    }
    return BRUME_OK;
}

brume_status Frame::compose()
{
    using namespace surface::compose;
    brume_plugin_image images[slot_count] = {};
    images[color] = frame_.color;
    images[rest] = constants_.first ? nullptr : rest_;
    images[lit] = lit_;
    images[depth] = frame_.depth;
    images[Slot::normals] = normals_;
    images[lights] = product(product_lights);
    images[ungrouped] = state_.ungrouped;
    images[gaussians] = product(product_gaussians);
    images[environment] = state_.environment;
    images[table] = state_.table;
    images[albedo] = frame_.layers[layer_albedo].image;
    images[specular] = frame_.layers[layer_specular].image;
    images[roughness] = frame_.layers[layer_roughness].image;
    images[light_shadows] = product(product_light_shadows);
    images[shadow_maps] = product(product_light_shadows, 1);
    images[result] = frame_.output;
    images[surface_out] = frame_.layers[layer_surface].image;
    return run_for_lights(state_.compose_pass, 0, scene_.light_count, images);
}

}  // namespace

brume_status create_passes(const brume_services &services, brume_host host, State &state)
{
    const bool reference = state.method == Method::reference;
    if (state.normals)
        if (brume_status s = create_pass(services, host, "normals", normals_slots, "", normals_rows, state.normals_pass))
            return s;
    for (int lamps_alone = 0; lamps_alone < 2; ++lamps_alone) {
        const std::string lights = define("METHOD", int(state.method)) + define("MATERIAL", state.material) +
                                   define("LAMPS_ALONE", lamps_alone),
                          sky = define("ENVIRONMENT", state.sky);
        if (state.transfer > 0)
            if (brume_status s = create_pass(services, host, "transfer", transfer_slots,
                                             lights + sky + define("TRANSFER", state.transfer), transfer_rows,
                                             state.transfer_pass[lamps_alone]))
                return s;
        if (state.rest[0])
            if (brume_status s = create_pass(services, host, "group", group_slots, lights,
                                             reference ? group_reference_rows : group_rows, state.group_pass[lamps_alone]))
                return s;
        if (brume_status s =
                create_pass(services, host, "compose", compose_slots, lights + sky + define("SHADOWED", state.shadowed),
                            reference ? compose_reference_rows : compose_rows, state.compose_pass[lamps_alone]))
            return s;
    }
    return BRUME_OK;
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
