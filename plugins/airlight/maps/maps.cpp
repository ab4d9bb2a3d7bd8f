#include "maps/maps.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "maps/passes.h"
#include "maps/sizes.h"
#include "maps/slices.h"
#include "settings.h"
#include "state.h"
#include "uploads.h"

namespace airlight {

std::string_view pass_text(std::string_view name);

namespace {

using namespace brume_passes;
using brume::maths_float::GridSettings;
using brume::maths_float::ivec2;
using maps::Constants;

constexpr int most_depths = brume::maths_float::grid_lights_at_once;

// Lights whose maps are kept; more have theirs made in every frame.
constexpr int most_kept_maps = 64;

constexpr uint64_t most_map_bytes = uint64_t(64) << 20;
constexpr int widest = 8192, tallest = 16384;  // of the grid's images

// A cell whose lights are summed, as seen from the camera: a share of the angle that a step may have from a light.
constexpr float widest_summed = 0.05f;

// The angle that a cell may have as seen from a light where the phase function is even, as a share of a step's. Across it
// the logarithm of 1 / d^2 is then straight to a few thousandths at worst, less in the mean.
constexpr double smooth_angle = 0.65;

// Unasked, maps are for many Gaussians and errors that their grid reaches.
constexpr uint32_t fewest_gaussians = 8;
constexpr double least_error = 0.005;

constexpr brume_slot attenuation_slots[] = {fetch("light_gaussians"), fetch("attenuation_frames"), fetch("lights"),
                                            write("result")};
static_assert(std::size(attenuation_slots) == maps::attenuation::slot_count);

constexpr brume_slot density_slots[] = {fetch("gaussians"), fetch("tiles"), fetch("tile_gaussians"), fetch("slices"),
                                        write("result")};
static_assert(std::size(density_slots) == maps::density::slot_count);

constexpr brume_slot lights_slots[] = {fetch("attenuation"), fetch("attenuation_frames"), fetch("lights"),
                                       fetch("slices"),      fetch("grid_density"),       fetch("depth"),
                                       write("result")};
static_assert(std::size(lights_slots) == maps::lights::slot_count);

constexpr brume_slot gather_slots[] = {fetch("depth"),
                                       fetch("gaussian_density"),
                                       fetch("slices"),
                                       linear("grid_density"),
                                       linear("grid_lights"),
                                       fetch("attenuation"),
                                       fetch("attenuation_frames"),
                                       fetch("lights"),
                                       fetch("environment"),
                                       fetch("environment_table"),
                                       fetch("surroundings"),
                                       fetch("light_shadows"),
                                       fetch("shadow_maps"),
                                       fetch("previous"),
                                       fetch("previous_error"),
                                       write("radiance"),
                                       write("error"),
                                       write("distances")};
static_assert(std::size(gather_slots) == maps::gather::slot_count);

constexpr brume_constant constants_table[] = {BRUME_GRID_SETTINGS(Constants), BRUME_AIRLIGHT_SETTINGS(Constants),
                                              BRUME_CONSTANT(Constants, light_range), BRUME_CONSTANT(Constants, reduction),
                                              BRUME_CONSTANT(Constants, whole)};

template <size_t Slots> brume_pass_desc pass(const char *name, const brume_slot (&slots)[Slots], int32_t grain)
{
    brume_pass_desc desc = described(name, slots, constants_table, sizeof(Constants));
    desc.grain = grain;
    return desc;
}

// Pixels of a reduced picture are not to share a cell's side.
int least_cell(const Parameters &p)
{
    return p.reduction > 1 ? 2 * p.reduction : 1;
}

int corners(int size, int cell)
{
    return (size + cell - 1) / cell + 1;
}

// That a step may have from a light, so that what the light gives it is smooth enough for one value [rad].
float step_angle(const brume_plugin_scene &scene, double max_error)
{
    return float(maps::fineness_of(max_error).angle *
                 std::clamp(1.5 * (1 - std::abs(double(scene.medium->asymmetry))), 0.2, 1.0));
}

// Shadow maps and orders tell pixels and lights apart, and across wide cells little is smooth enough to be summed.
bool sums_lights(const brume_plugin_scene &scene, const State &state, bool orders, int cell)
{
    const auto angle = float(maps::fineness_of(state.parameters.max_error).angle);
    return !state.error && !state.shadowed && !orders && float(cell) < widest_summed * angle * scene.camera->focal[0];
}

ivec2 grid_size(const GridSettings &s)
{
    return ivec2(s.across * s.columns, (s.slices + s.across) / s.across * s.rows);
}

// A grid in images of this width.
void lay_out(GridSettings &s, const maps::Sizes &sizes, int width)
{
    s.cell = sizes.cell;
    s.columns = corners(s.size.x, s.cell);
    s.rows = corners(s.size.y, s.cell);
    s.slices = sizes.slices;
    s.across = std::clamp(width / s.columns, 1, s.slices + 1);
}

uint64_t bytes_of(ivec2 grid)
{
    return uint64_t(grid.x) * uint64_t(grid.y) * 32;
}

// The images that a plan's grids have: Gaussians may shrink to half in later frames; of those of files it knows nothing
// yet.
ivec2 room_for(const GridSettings &s, const brume_plugin_scene &scene, const maps::Sizes &sizes, const Parameters &p)
{
    const ivec2 needed = grid_size(s);
    const auto most = uint64_t(p.memory * 1e6);
    const uint64_t wanted = scene.gaussians ? std::min(4 * sizes.bytes, most) : most;
    const int height = int(std::min<uint64_t>(wanted / (uint64_t(needed.x) * 32), tallest));
    return ivec2(needed.x, std::max(needed.y, height));
}

// As a frame's Gaussians want it, as far as there is room.
void fit_grid(const brume_plugin_scene &scene, State &state)
{
    GridSettings &s = state.maps.settings;
    const ivec2 room = state.maps.room;
    maps::Sizes sizes = maps::sizes_of(scene, state.width, state.height, least_cell(state.parameters),
                                       maps::fineness_of(state.parameters.max_error), bytes_of(room));
    do {
        lay_out(s, sizes, room.x);
        sizes.cell *= 2;
    } while (grid_size(s).x > room.x || grid_size(s).y > room.y);
}

brume_status create_map_passes(const brume_services &services, brume_host host, State &state)
{
    Maps &m = state.maps;
    const maps::Rows &rows = maps::rows_of_this_machine();
    if (brume_status s = create(services, host, pass("maps", attenuation_slots, 4), "airlight_map_attenuation.comp",
                                pass_text("airlight_map_attenuation.comp"), "", rows.attenuation, m.attenuation_pass))
        return s;
    if (brume_status s = create(services, host, pass("grid", density_slots, 1), "airlight_map_density.comp",
                                pass_text("airlight_map_density.comp"), "", rows.density, m.density_pass))
        return s;
    if (brume_status s = create(services, host, pass("grid", lights_slots, 1), "airlight_map_lights.comp",
                                pass_text("airlight_map_lights.comp"), "", rows.lights, m.lights_pass))
        return s;
    return create(services, host, pass(maps_gather, gather_slots, 4), "airlight_map_gather.comp",
                  pass_text("airlight_map_gather.comp"),
                  define("ESTIMATE", state.error != nullptr) + define("ORDERS", gathers_orders(state)), rows.gather,
                  m.gather_pass);
}

}  // namespace

MapsOffer offer_maps(const brume_plugin_request &request, const State &state)
{
    const brume_plugin_scene &scene = *request.scene;
    const Parameters &p = state.parameters;
    const maps::Fineness fineness = maps::fineness_of(p.max_error);
    MapsOffer offer{maps::sizes_of(scene, state.width, state.height, least_cell(p), fineness, uint64_t(p.memory * 1e6)),
                    false,
                    {},
                    {},
                    {}};
    offer.suits = p.max_error >= least_error && offer.sizes.fine &&
                  (scene.gaussians ? scene.gaussian_count >= fewest_gaussians : scene.gaussian_count > 0);
    // Orders beyond the first go pixel by pixel.
    const bool orders = p.orders == Orders::all && !takes_grid(state, scene),
               summed = sums_lights(scene, state, orders, offer.sizes.cell);
    const double lights = scene.light_count, looked_up = (summed ? 1 : lights) * (orders ? 20 : 1),
                 pixels = double(state.width) * state.height / (p.reduction * p.reduction), slices = offer.sizes.slices,
                 side = fineness.side, listed = std::sqrt(1 + 0.1 * scene.gaussian_count),
                 points = double(corners(state.width, offer.sizes.cell)) * corners(state.height, offer.sizes.cell);
    constexpr Work of_list{0, 124, 6}, of_point{0, 14, 0.4}, of_light{0, 18, 1};
    // Where neighbours have cells of their own they share nothing.
    offer.of_pixels =
        pixels * slices *
        (offer.sizes.cell < 2 * p.reduction ? Work{56 + 42 * looked_up} : Work{0, 26, 1} + looked_up * of_light);
    offer.of_grid = points * (slices * (of_point + lights * of_light) + listed * of_list);
    offer.of_maps = lights * side * side * listed * of_list;
    return offer;
}

brume_status plan_maps(const brume_services &services, brume_host host, const brume_plugin_scene &scene,
                       const MapsOffer &offer, State &state)
{
    const maps::Sizes &sizes = offer.sizes;
    const Parameters &p = state.parameters;
    const maps::Fineness fineness = maps::fineness_of(p.max_error);
    Maps &m = state.maps;
    GridSettings &s = m.settings;
    s.size = ivec2(state.width, state.height);
    lay_out(s, sizes, widest);
    m.room = room_for(s, scene, sizes, p);
    s.side = fineness.side;
    s.nodes = fineness.nodes;
    const brume_plugin_medium &medium = *scene.medium;
    auto grey = [](const float(&v)[3]) { return v[0] == v[1] && v[1] == v[2]; };
    s.grey = grey(medium.scattering) && grey(medium.absorption);
    s.depth = float(fineness.depth);
    s.bend = float(2 * smooth_angle * smooth_angle * fineness.angle * fineness.angle);
    s.doubt = float(fineness.doubt);
    const uint64_t map_bytes = uint64_t(s.side) * uint64_t(s.side) * uint64_t(s.nodes) * 4;
    const int room = std::clamp(int(most_map_bytes / map_bytes), most_depths, std::min(most_kept_maps, 16384 / s.side));
    m.kept = std::clamp(int(scene.light_count), most_depths, room);

    auto image = [&](const char *label, ivec2 size, int32_t channels, brume_plugin_image &out) {
        return services.create_image(host, label, size.x, size.y, channels, &out);
    };
    if (brume_status e = image("attenuation maps", ivec2(s.side * s.nodes, s.side * m.kept), 1, m.attenuation))
        return e;
    if (brume_status e = image("grid of density", m.room, 4, m.density))
        return e;
    if (brume_status e = image("grid of the lights", m.room, 4, m.lights))
        return e;
    const ivec2 reduced = brume::maths_float::reduced_size(s.size, p.reduction);
    if (brume_status e = image("airlight so far", reduced, 4, m.radiance))
        return e;
    if (state.error)
        if (brume_status e = image("airlight error so far", reduced, 4, m.error))
            return e;

    auto entry = [&](const char *name, const std::string &reason, double bytes, const Work &work) {
        const brume_plugin_entry e = running(name, reason, bytes, work);
        return services.add_entry(host, &e);
    };
    const double lights = scene.light_count, points = double(grid_size(s).x) * grid_size(s).y;
    if (brume_status e =
            entry("maps",
                  std::to_string(s.side) + " x " + std::to_string(s.side) + " directions, " + std::to_string(s.nodes) +
                      " distances around each light, when a light or the medium moved",
                  lights * double(map_bytes), offer.of_maps))
        return e;
    if (brume_status e = entry("grid",
                               "cells of " + std::to_string(s.cell) + " px, " + std::to_string(s.slices) + " distances, " +
                                   std::to_string((bytes_of(m.room) + 500000) / 1000000) + " MB, when something moved",
                               points * 32, offer.of_grid))
        return e;
    return create_map_passes(services, host, state);
}

brume_status refresh_maps(const brume_services &services, brume_host host, const brume_plugin_scene &scene, bool moved,
                          State &state)
{
    Maps &m = state.maps;
    fit_grid(scene, state);
    maps::place_slices(scene, m.settings.slices, m.distances);
    if (brume_status s = upload(services, host, upload_slices, 1, m.distances, m.slices))
        return s;
    if (scene.light_count == 0)
        return BRUME_OK;
    const bool again = m.placed.place(scene, state.width, state.height, gathers_orders(state), moved);
    if (brume_status s = upload(services, host, upload_attenuation_frames, 4, m.placed.texels, m.frames))
        return s;
    m.settings.gaussians = int(scene.gaussian_count);
    m.settings.angle = step_angle(scene, state.parameters.max_error);
    m.maps_pending = m.maps_pending || again;
    m.grid_pending = true;
    m.in_grid = ivec2(0);
    m.in_front = ivec2(0);
    return BRUME_OK;
}

namespace {

class Run {
public:
    Run(const brume_services &services, brume_host host, const brume_plugin_frame &frame, State &state)
        : services_(services), host_(host), frame_(frame), state_(state), maps_(state.maps)
    {
        constants_.grid = maps_.settings;
        constants_.airlight = settings_of(state, *frame.scene);
        constants_.estimate = state.error != nullptr;
        constants_.grid.summed = sums_lights(*frame.scene, state, gathers_orders(state), constants_.grid.cell);
    }

    bool has_sums() const { return constants_.grid.summed; }
    int lights_at_once() const { return constants_.grid.summed ? maps_.kept : most_depths; }
    // Whether there is room for the maps of all lights.
    bool keeps() const { return int(frame_.scene->light_count) <= maps_.kept; }
    brume_status maps_of(int first, int last);
    brume_status density();
    brume_status lights(int first, int last, bool whole);
    brume_status gather(const MappedGather &wanted, brume_plugin_image previous, brume_plugin_image previous_error);

private:
    brume_plugin_image product(Product of, uint32_t index = 0) const
    {
        const brume_plugin_product &product = brume::products_in(frame_)[of];
        return index < product.image_count ? product.images[index] : nullptr;
    }

    const brume_services &services_;
    brume_host host_;
    const brume_plugin_frame &frame_;
    State &state_;
    Maps &maps_;
    Constants constants_{};
};

brume_status Run::maps_of(int first, int last)
{
    using namespace maps::attenuation;
    Constants constants = constants_;
    constants.grid.mapped = keeps() ? 0 : first;
    brume_plugin_image images[slot_count] = {};
    images[light_gaussians] = product(product_light_gaussians);
    images[frames] = maps_.frames;
    images[maps::attenuation::lights] = product(product_lights);
    images[result] = maps_.attenuation;
    return services_.run(host_, maps_.attenuation_pass, images, &constants, constants.grid.side,
                         constants.grid.side * (last - first), nullptr);
}

brume_status Run::density()
{
    using namespace maps::density;
    brume_plugin_image images[slot_count] = {};
    images[gaussians] = product(product_gaussians);
    images[tiles] = product(product_gaussians, 1);
    images[tile_gaussians] = product(product_gaussians, 2);
    images[slices] = maps_.slices;
    images[result] = maps_.density;
    return services_.run(host_, maps_.density_pass, images, &constants_, constants_.grid.columns, constants_.grid.rows,
                         nullptr);
}

brume_status Run::lights(int first, int last, bool whole)
{
    namespace slot = maps::lights;
    Constants constants = constants_;
    constants.light_range = ivec2(first, last);
    constants.grid.mapped = keeps() ? 0 : first;
    constants.whole = whole;
    brume_plugin_image images[slot::slot_count] = {};
    images[slot::attenuation] = maps_.attenuation;
    images[slot::frames] = maps_.frames;
    images[slot::lights] = product(product_lights);
    images[slot::slices] = maps_.slices;
    images[slot::grid_density] = maps_.density;
    images[slot::depth] = frame_.depth;
    images[slot::result] = maps_.lights;
    return services_.run(host_, maps_.lights_pass, images, &constants, constants.grid.columns, constants.grid.rows, nullptr);
}

brume_status Run::gather(const MappedGather &wanted, brume_plugin_image before, brume_plugin_image before_error)
{
    namespace slot = maps::gather;
    Constants constants = constants_;
    constants.light_range = ivec2(wanted.first, wanted.last);
    constants.grid.mapped = keeps() ? 0 : wanted.first;
    constants.reduction = wanted.reduction;
    if (!wanted.environment)
        constants.airlight.environment_order = 0;
    brume_plugin_image images[slot::slot_count] = {};
    images[slot::depth] = frame_.depth;
    images[slot::gaussian_density] = product(product_gaussian_density);
    images[slot::slices] = maps_.slices;
    images[slot::grid_density] = maps_.density;
    images[slot::grid_lights] = maps_.lights;
    images[slot::attenuation] = maps_.attenuation;
    images[slot::frames] = maps_.frames;
    images[slot::lights] = product(product_lights);
    images[slot::environment] = state_.environment;
    images[slot::environment_table] = state_.environment_table;
    images[slot::surroundings] = state_.surroundings;
    images[slot::light_shadows] = product(product_light_shadows);
    images[slot::shadow_maps] = product(product_light_shadows, 1);
    images[slot::previous] = before;
    images[slot::previous_error] = before_error;
    images[slot::radiance] = wanted.radiance;
    images[slot::error] = wanted.error;
    images[slot::distances] = wanted.distances;
    const ivec2 grid = brume::maths_float::reduced_size(constants.grid.size, wanted.reduction);
    return services_.run(host_, maps_.gather_pass, images, &constants, grid.x, grid.y, nullptr);
}

}  // namespace

brume_status gather_by_maps(const brume_services &services, brume_host host, const brume_plugin_frame &frame, State &state,
                            const MappedGather &wanted)
{
    Maps &m = state.maps;
    Run run(services, host, frame, state);
    if (m.maps_pending && run.keeps()) {
        if (brume_status s = run.maps_of(0, int(frame.scene->light_count)))
            return s;
        m.maps_pending = false;
    }
    if (m.grid_pending) {
        if (brume_status s = run.density())
            return s;
        m.grid_pending = false;
    }
    const int at_once = run.lights_at_once(), rounds = std::max(1, (wanted.last - wanted.first + at_once - 1) / at_once);
    for (int round = 0; round < rounds; ++round) {
        MappedGather now = wanted;
        now.first = wanted.first + round * at_once;
        now.last = std::min(now.first + at_once, wanted.last);
        const ivec2 range(now.first, now.last);
        if (range.x < range.y && m.in_grid != range) {
            if (!run.keeps())
                if (brume_status s = run.maps_of(range.x, range.y))
                    return s;
            // Sums of a frame in which something moved go as far as its picture shows. In the next they are made whole and
            // stay, whatever pictures show: no bit of the picture depends on it.
            const bool whole = !run.has_sums() || m.in_front == range;
            if (brume_status s = run.lights(range.x, range.y, whole))
                return s;
            (whole ? m.in_grid : m.in_front) = range;
        }
        now.environment = wanted.environment && round == 0;
        // Two images in turn, so that the last round writes what is wanted.
        brume_plugin_image before = m.radiance, before_error = m.error;
        if ((rounds - 1 - round) % 2 != 0) {
            std::swap(now.radiance, before);
            if (wanted.error)
                std::swap(now.error, before_error);
        }
        if (brume_status s =
                run.gather(now, round > 0 ? before : nullptr, round > 0 && wanted.error ? before_error : nullptr))
            return s;
    }
    return BRUME_OK;
}

}  // namespace airlight
