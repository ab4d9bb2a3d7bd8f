#include "passes.h"

#include <iterator>
#include <string>
#include <string_view>

#include "order.h"
#include "settings.h"
#include "state.h"

namespace airlight {

std::string_view pass_text(std::string_view name);

namespace {

using namespace brume_passes;
using brume::maths_float::ivec2;

constexpr brume_slot blobs_slots[] = {fetch("gaussians"), fetch("lights"), fetch("light_gaussians"), write("density")};
static_assert(std::size(blobs_slots) == blobs::slot_count);

constexpr brume_slot around_slots[] = {fetch("depth"), fetch("lights"), write("surroundings")};
static_assert(std::size(around_slots) == around::slot_count);

constexpr brume_slot bounds_slots[] = {fetch("depth"), fetch("tiles"), fetch("lights"), write("bounds")};
static_assert(std::size(bounds_slots) == bounds::slot_count);

constexpr brume_slot order_slots[] = {fetch("bounds"), write("lamp_order")};
static_assert(std::size(order_slots) == order::slot_count);

constexpr brume_slot gather_slots[] = {
    fetch("depth"),         fetch("gaussian_density"), fetch("tiles"),           fetch("gaussians"),
    fetch("lights"),        fetch("tile_gaussians"),   fetch("light_gaussians"), fetch("blob_density"),
    fetch("sun_table"),     fetch("surroundings"),     fetch("environment"),     fetch("environment_table"),
    fetch("light_shadows"), fetch("shadow_maps"),      fetch("lamp_order"),      write("radiance"),
    write("error"),         write("distances")};
static_assert(std::size(gather_slots) == gather::slot_count);

constexpr brume_slot compose_slots[] = {fetch("color"),
                                        fetch("density"),
                                        fetch("density_rgb"),
                                        fetch("radiance"),
                                        fetch("error"),
                                        fetch("distances"),
                                        write("result"),
                                        write("transmittance_out"),
                                        write("optical_depth_out"),
                                        write("airlight_out"),
                                        write("airlight_error_out")};
static_assert(std::size(compose_slots) == compose::slot_count);

constexpr brume_constant constants_table[] = {BRUME_AIRLIGHT_SETTINGS(Constants),
                                              BRUME_CONSTANT_OF(Constants, around, kind),
                                              BRUME_CONSTANT_OF(Constants, around, axis),
                                              BRUME_CONSTANT_OF(Constants, around, height),
                                              BRUME_CONSTANT(Constants, size),
                                              BRUME_CONSTANT(Constants, light_range),
                                              BRUME_CONSTANT(Constants, reduction),
                                              BRUME_CONSTANT(Constants, ordered)};

template <size_t Slots> brume_pass_desc pass(const char *name, const brume_slot (&slots)[Slots], int32_t grain)
{
    brume_pass_desc desc = described(name, slots, constants_table, sizeof(Constants));
    desc.grain = grain;
    return desc;
}

brume_status create_gather(const brume_services &services, brume_host host, State &state)
{
    // Black layers of lights are too little work for an entry of their own.
    brume_pass_desc desc =
        pass(state.lit ? "gather" : "compose", gather_slots, state.parameters.tier == Tier::reference ? 1 : 4);
    if (state.parameters.tier != Tier::reference)
        return create(services, host, desc, "airlight_gather.comp", pass_text("airlight_gather.comp"),
                      define("TIER", tier_of(state)) + define("SHADOWED", state.shadowed) +
                          define("ORDERS", gathers_orders(state)),
                      tier_of(state) == brume::maths_float::airlight_nodes ? gather_nodes_rows : gather_rows, state.gather);
    desc.rows = gather_reference_rows;
    return services.create_pass(host, &desc, &state.gather);
}

class Frame {
public:
    Frame(const brume_services &services, brume_host host, const brume_plugin_frame &frame, const State &state)
        : services_(services), host_(host), frame_(frame), state_(state)
    {
        constants_.airlight = settings_of(state, *frame.scene);
        constants_.around = surroundings_settings(state, *frame.scene);
        constants_.size = ivec2(state.width, state.height);
        constants_.reduction = state.parameters.reduction;
        constants_.tier = tier_of(state);
        constants_.lit = state.lit;
        constants_.attenuates = state.attenuates;
    }

    brume_status blobs();
    brume_status around();
    brume_status order();
    brume_status gather_all(brume_plugin_image radiance, brume_plugin_image error);
    brume_status gather_light(uint32_t light, brume_plugin_image radiance);
    brume_status compose();

private:
    brume_plugin_image product(Product of, uint32_t index = 0) const
    {
        const brume_plugin_product &product = brume::products_in(frame_)[of];
        return index < product.image_count ? product.images[index] : nullptr;
    }
    brume_status gather(const Constants &constants, brume_plugin_image radiance, brume_plugin_image error,
                        brume_plugin_image distances);

    const brume_services &services_;
    brume_host host_;
    const brume_plugin_frame &frame_;
    const State &state_;
    Constants constants_{};
};

brume_status Frame::blobs()
{
    using namespace airlight::blobs;
    const int values = constants_.airlight.gaussian_count * (1 + constants_.airlight.light_count);
    brume_plugin_image images[slot_count] = {};
    images[gaussians] = product(product_gaussians);
    images[lights] = product(product_lights);
    images[light_gaussians] = product(product_light_gaussians);
    images[density] = state_.blob_density;
    return services_.run(host_, state_.blobs, images, &constants_, BRUME_DATA_WIDTH,
                         (values + BRUME_DATA_WIDTH - 1) / BRUME_DATA_WIDTH, nullptr);
}

brume_status Frame::around()
{
    using namespace airlight::around;
    const int values = brume::maths_float::sides * constants_.airlight.light_count;
    brume_plugin_image images[slot_count] = {};
    images[depth] = frame_.depth;
    images[lights] = product(product_lights);
    images[surroundings] = state_.surroundings;
    return services_.run(host_, state_.around, images, &constants_, BRUME_DATA_WIDTH,
                         (values + BRUME_DATA_WIDTH - 1) / BRUME_DATA_WIDTH, nullptr);
}

brume_status Frame::order()
{
    const ivec2 tiles = (constants_.size + brume::maths_float::tile_size - 1) / brume::maths_float::tile_size;
    const int lights = constants_.airlight.light_count;
    // Frames may come with more lights than the plan had.
    if (lights < 2 || int64_t(tiles.x) * tiles.y * lights > state_.order_texels)
        return BRUME_OK;
    constants_.ordered = lights;
    {
        using namespace airlight::bounds;
        brume_plugin_image images[slot_count] = {};
        images[depth] = frame_.depth;
        images[airlight::bounds::tiles] = product(product_gaussians, 1);
        images[airlight::bounds::lights] = product(product_lights);
        images[airlight::bounds::bounds] = state_.lamp_bounds;
        if (brume_status s = services_.run(host_, state_.bounds, images, &constants_, tiles.x, tiles.y, nullptr))
            return s;
    }
    brume_plugin_image images[airlight::order::slot_count] = {};
    images[airlight::order::bounds] = state_.lamp_bounds;
    images[airlight::order::lamp_order] = state_.lamp_order;
    return services_.run(host_, state_.order, images, &constants_, lights, tiles.x * tiles.y, nullptr);
}

brume_status Frame::gather(const Constants &constants, brume_plugin_image to, brume_plugin_image to_error,
                           brume_plugin_image to_distances)
{
    using namespace airlight::gather;
    brume_plugin_image images[slot_count] = {};
    images[depth] = frame_.depth;
    images[gaussian_density] = product(product_gaussian_density);
    images[tiles] = product(product_gaussians, 1);
    images[gaussians] = product(product_gaussians);
    images[lights] = product(product_lights);
    images[tile_gaussians] = product(product_gaussians, 2);
    images[light_gaussians] = product(product_light_gaussians);
    images[blob_density] = state_.blob_density;
    images[sun_table] = state_.sun_table;
    images[surroundings] = state_.surroundings;
    images[environment] = state_.environment;
    images[environment_table] = state_.environment_table;
    images[light_shadows] = product(product_light_shadows);
    images[shadow_maps] = product(product_light_shadows, 1);
    images[lamp_order] = constants.ordered > 0 ? state_.lamp_order : nullptr;
    images[radiance] = to;
    images[error] = to_error;
    images[distances] = to_distances;
    const ivec2 grid = brume::maths_float::reduced_size(constants.size, constants.reduction);
    return services_.run(host_, state_.gather, images, &constants, grid.x, grid.y, nullptr);
}

brume_status Frame::gather_all(brume_plugin_image radiance, brume_plugin_image error)
{
    Constants constants = constants_;
    constants.light_range = ivec2(0, int(frame_.scene->light_count));
    return gather(constants, radiance, error, state_.distances);
}

brume_status Frame::gather_light(uint32_t light, brume_plugin_image radiance)
{
    Constants constants = constants_;
    constants.airlight.environment_order = 0;
    constants.light_range = state_.lit ? ivec2(int(light), int(light) + 1) : ivec2(0);
    constants.ordered = 0;
    constants.reduction = 1;
    return gather(constants, radiance, nullptr, nullptr);
}

brume_status Frame::compose()
{
    using namespace airlight::compose;
    brume_plugin_image images[slot_count] = {};
    images[color] = frame_.color;
    images[density] = product(product_density);
    images[density_rgb] = state_.layered ? product(product_density_rgb) : nullptr;
    images[radiance] = state_.radiance;
    images[error] = state_.error;
    images[distances] = state_.distances;
    images[result] = frame_.output;
    images[transmittance_out] = frame_.layers[layer_transmittance].image;
    images[optical_depth_out] = frame_.layers[layer_optical_depth].image;
    images[airlight_out] = frame_.layers[layer_airlight].image;
    images[airlight_error_out] = frame_.layers[layer_airlight_error].image;
    return services_.run(host_, state_.compose, images, &constants_, state_.width, state_.height, nullptr);
}

brume_status gather_all(const brume_services &services, brume_host host, const brume_plugin_frame &frame, Frame &passes,
                        State &state)
{
    const Scattered &of = state.scattered;
    const int lights = int(frame.scene->light_count), reduction = state.parameters.reduction;
    const brume_plugin_image radiance = of.used ? of.radiance : state.radiance, error = of.used ? of.error : state.error;
    if (brume_status s = state.maps.used ? gather_by_maps(services, host, frame, state,
                                                          {0, lights, radiance, error, state.distances, true, reduction})
                                         : passes.gather_all(radiance, error))
        return s;
    return of.used ? add_rescattered(services, host, frame, state, {0, lights, state.radiance, state.error, reduction, true})
                   : BRUME_OK;
}

brume_status gather_light(const brume_services &services, brume_host host, const brume_plugin_frame &frame, Frame &passes,
                          State &state, uint32_t light, brume_plugin_image result)
{
    const bool again = state.scattered.used && state.lit;
    const brume_plugin_image radiance = again ? state.scattered.radiance : result;
    const int l = int(light);
    if (brume_status s = state.maps.used && state.lit
                             ? gather_by_maps(services, host, frame, state, {l, l + 1, radiance, nullptr, nullptr, false, 1})
                             : passes.gather_light(light, radiance))
        return s;
    return again ? add_rescattered(services, host, frame, state, {l, l + 1, result, nullptr, 1, false}) : BRUME_OK;
}

}  // namespace

brume_status create_passes(const brume_services &services, brume_host host, uint32_t outputs, State &state)
{
    if ((state.lit && !state.maps.used) || (!state.lit && (outputs & (1u << layer_light_airlight))))
        if (brume_status s = create_gather(services, host, state))
            return s;
    if (state.has_blobs)
        if (brume_status s = create(services, host, pass("blobs", blobs_slots, 1), "airlight_blobs.comp",
                                    pass_text("airlight_blobs.comp"), "", blobs_rows, state.blobs))
            return s;
    if (state.surroundings)
        if (brume_status s = create(services, host, pass("around", around_slots, 1), "airlight_surroundings.comp",
                                    pass_text("airlight_surroundings.comp"), "", around_rows, state.around))
            return s;
    if (state.lamp_order) {
        if (brume_status s = create(services, host, pass("gather", bounds_slots, 1), "airlight_lamp_bounds.comp",
                                    pass_text("airlight_lamp_bounds.comp"), "", bounds_rows, state.bounds))
            return s;
        if (brume_status s = create(services, host, pass("gather", order_slots, 64), "airlight_lamp_order.comp",
                                    pass_text("airlight_lamp_order.comp"), "", order_rows, state.order))
            return s;
    }
    return create(services, host, pass("compose", compose_slots, 8), "airlight_compose.comp",
                  pass_text("airlight_compose.comp"),
                  define("LIT", state.lit) + define("ATTENUATES", state.attenuates) + define("LAYERED", state.layered) +
                      define("REDUCTION", state.parameters.reduction) + define("OUTPUTS", int(outputs)),
                  state.layered ? compose_rows<true> : compose_rows<false>, state.compose);
}

brume_status run_passes(const brume_services &services, brume_host host, const brume_plugin_frame &frame, State &state)
{
    Frame passes(services, host, frame, state);
    if (state.blobs_pending) {
        if (brume_status s = passes.blobs())
            return s;
        state.blobs_pending = false;
    }
    if (state.around)
        if (brume_status s = passes.around())
            return s;
    if (state.lamp_order)
        if (brume_status s = passes.order())
            return s;
    if (state.lit)
        if (brume_status s = gather_all(services, host, frame, passes, state))
            return s;
    const brume_plugin_image *of_lights = frame.layers[layer_light_airlight].of_lights;
    for (uint32_t l = 0; of_lights && l < frame.scene->light_count; ++l)
        if (of_lights[l])
            if (brume_status s = gather_light(services, host, frame, passes, state, l, of_lights[l]))
                return s;
    return passes.compose();
}

}  // namespace airlight
