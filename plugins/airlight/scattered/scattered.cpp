#include "scattered/scattered.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <string_view>

#include "maps/passes.h"
#include "pass_tables.hpp"
#include "scattered/distances.h"
#include "scattered/passes.h"
#include "state.h"
#include "uploads.h"

namespace airlight {

std::string_view pass_text(std::string_view name);

namespace {

using namespace brume_passes;
using brume::maths_float::ivec2;
using brume::maths_float::ScatteredSettings;
using scattered::Constants;

constexpr int cells = 40;  // along the longer side
constexpr int widest = 8192;
constexpr double least_error = 0.005;

constexpr brume_slot make_slots[] = {fetch("distances"), fetch("lights"), fetch("surroundings"), fetch("light_gaussians"),
                                     write("result")};
static_assert(std::size(make_slots) == scattered::make::slot_count);

constexpr brume_slot add_slots[] = {fetch("depth"),          fetch("gaussian_density"),  fetch("tiles"),
                                    fetch("gaussians"),      fetch("tile_gaussians"),    fetch("lights"),
                                    fetch("distances"),      linear("scattered"),        linear("grid_density"),
                                    fetch("environment"),    fetch("environment_table"), fetch("previous"),
                                    fetch("previous_error"), write("radiance"),          write("error")};
static_assert(std::size(add_slots) == scattered::add::slot_count);

constexpr brume_constant constants_table[] = {
    BRUME_CONSTANT_OF(Constants, settings, size),   BRUME_CONSTANT_OF(Constants, settings, columns),
    BRUME_CONSTANT_OF(Constants, settings, rows),   BRUME_CONSTANT_OF(Constants, settings, slices),
    BRUME_CONSTANT_OF(Constants, settings, across), BRUME_CONSTANT_OF(Constants, settings, lights),
    BRUME_CONSTANT_OF(Constants, settings, mapped), BRUME_CONSTANT_OF(Constants, settings, gaussians),
    BRUME_CONSTANT_OF(Constants, settings, cell),   BRUME_GRID_SETTINGS(Constants),
    BRUME_CONSTANT(Constants, light_range),         BRUME_CONSTANT(Constants, reduction),
    BRUME_CONSTANT(Constants, environment_order)};

template <size_t Slots> brume_pass_desc pass(const char *name, const brume_slot (&slots)[Slots], int32_t grain)
{
    brume_pass_desc desc = described(name, slots, constants_table, sizeof(Constants));
    desc.grain = grain;
    return desc;
}

int corners(int size, float cell)
{
    return int(std::ceil(float(size) / cell)) + 1;
}

ivec2 grid_size(const ScatteredSettings &s)
{
    return ivec2(s.across * s.columns, (s.slices + s.across) / s.across * s.rows);
}

}  // namespace

bool takes_grid(const State &state, const brume_plugin_scene &scene)
{
    const Parameters &p = state.parameters;
    return p.orders == Orders::all && p.tier != Tier::reference && !is_published(p.tier) && p.max_error >= least_error &&
           scene.light_count > 0;
}

brume_status plan_scattered(const brume_services &services, brume_host host, const brume_plugin_scene &scene, bool of_lights,
                            State &state)
{
    const Parameters &p = state.parameters;
    Scattered &of = state.scattered;
    ScatteredSettings &s = of.settings;
    s.size = ivec2(state.width, state.height);
    s.cell = std::max(float(std::max(state.width, state.height)) / cells, float(p.reduction));
    s.columns = corners(state.width, s.cell);
    s.rows = corners(state.height, s.cell);
    s.slices = brume::maths_float::most_scattered_steps;
    s.across = std::clamp(widest / s.columns, 1, 7);
    s.mapped = state.maps.used;
    const ivec2 size = grid_size(s), reduced = of_lights ? s.size : brume::maths_float::reduced_size(s.size, p.reduction);
    auto image = [&](const char *label, ivec2 of_size, brume_plugin_image &out) {
        return services.create_image(host, label, of_size.x, of_size.y, 4, &out);
    };
    if (brume_status e = image("grid of scattered light", size, of.grid))
        return e;
    if (brume_status e = image("airlight scattered once", reduced, of.radiance))
        return e;
    if (state.error)
        if (brume_status e = image("airlight error scattered once", reduced, of.error))
            return e;
    const double points = double(s.columns) * s.rows * (s.slices + 1), bytes = 16.0 * size.x * size.y,
                 pixels = double(state.width) * state.height / (p.reduction * p.reduction);
    const std::string reason =
        std::to_string(s.columns) + " x " + std::to_string(s.rows) + " rays of " + std::to_string(s.slices + 1) +
        " points, " + std::to_string(int(std::ceil(bytes / 1e5)) / 10) + "." +
        std::to_string(int(std::ceil(bytes / 1e5)) % 10) + " MB, have what arrives scattered more than once";
    brume_plugin_entry entry = running("scattered", reason, bytes, {points * scene.light_count * 1000});
    if (brume_status e = services.add_entry(host, &entry))
        return e;
    entry.name = "rescattered";
    entry.reason = "adds what is scattered more than once, from that grid";
    entry.bytes = uint64_t(pixels * 36);
    entry.operations = uint64_t(pixels * s.slices * (60 + 10 * scene.light_count));
    if (brume_status e = services.add_entry(host, &entry))
        return e;
    if (brume_status e = create(services, host, pass("scattered", make_slots, 1), "airlight_scattered.comp",
                                pass_text("airlight_scattered.comp"), "", scattered::make_rows, of.make))
        return e;
    return create(services, host, pass("rescattered", add_slots, 4), "airlight_rescattered.comp",
                  pass_text("airlight_rescattered.comp"), "", scattered::add_rows_of_this_machine(), of.add);
}

brume_status refresh_scattered(const brume_services &services, brume_host host, const brume_plugin_scene &scene,
                               State &state)
{
    Scattered &of = state.scattered;
    ScatteredSettings &s = of.settings;
    s.lights = int(scene.light_count);
    s.gaussians = int(scene.gaussian_count);
    const double angle = s.cell * double(std::abs(scene.camera->tangent_scale[0]));
    const std::vector<float> &distances = of.placement.distances(scene, state.width, state.height, s.slices, angle);
    const std::vector<float> &slices = state.maps.distances;
    state.values.clear();
    for (float t : distances) {
        float slice = 0, place = 0;
        if (state.maps.used) {
            const auto next = std::upper_bound(slices.begin(), slices.end(), t);
            const size_t before = size_t(std::max(next - slices.begin() - 1, ptrdiff_t(0)));
            slice = float(before);
            if (before + 1 < slices.size())
                place = std::clamp((t - slices[before]) / (slices[before + 1] - slices[before]), 0.0f, 1.0f);
        }
        state.values.insert(state.values.end(), {t, slice, place, 0.0f});
    }
    for (float w : of.placement.peaks(scene))
        state.values.insert(state.values.end(), {w, 0.0f, 0.0f, 0.0f});
    return upload(services, host, upload_distances, 4, state.values, of.distances);
}

brume_status add_rescattered(const brume_services &services, brume_host host, const brume_plugin_frame &frame, State &state,
                             const RescatteredGather &wanted)
{
    const Scattered &of = state.scattered;
    auto product = [&](Product which, uint32_t index = 0) -> brume_plugin_image {
        const brume_plugin_product &p = brume::products_in(frame)[which];
        return index < p.image_count ? p.images[index] : nullptr;
    };
    Constants constants{};
    constants.settings = of.settings;
    constants.grid = state.maps.settings;
    constants.light_range = ivec2(wanted.first, wanted.last);
    constants.reduction = wanted.reduction;
    constants.environment_order = wanted.environment ? state.environment_order : 0;
    {
        using namespace scattered::make;
        brume_plugin_image images[slot_count] = {};
        images[distances] = of.distances;
        images[lights] = product(product_lights);
        images[surroundings] = state.surroundings;
        images[light_gaussians] = product(product_light_gaussians);
        images[result] = of.grid;
        const ivec2 size = grid_size(of.settings);
        if (brume_status s = services.run(host, of.make, images, &constants, size.x, size.y, nullptr))
            return s;
    }
    using namespace scattered::add;
    brume_plugin_image images[slot_count] = {};
    images[depth] = frame.depth;
    images[gaussian_density] = product(product_gaussian_density);
    images[tiles] = product(product_gaussians, 1);
    images[gaussians] = product(product_gaussians);
    images[tile_gaussians] = product(product_gaussians, 2);
    images[lights] = product(product_lights);
    images[distances] = of.distances;
    images[scattered::add::scattered] = of.grid;
    images[grid_density] = state.maps.density;
    images[environment] = state.environment;
    images[environment_table] = state.environment_table;
    images[previous] = of.radiance;
    images[previous_error] = wanted.error ? of.error : nullptr;
    images[radiance] = wanted.radiance;
    images[error] = wanted.error;
    const ivec2 size = brume::maths_float::reduced_size(of.settings.size, wanted.reduction);
    return services.run(host, of.add, images, &constants, size.x, size.y, nullptr);
}

}  // namespace airlight
