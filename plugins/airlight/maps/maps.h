// Method `maps`: attenuation maps of the lights (Gautron et al.) and a grid of density along the view's rays.
#pragma once
#include <brume/brume_plugin.h>

#include "maps/frames.h"
#include "maps/sizes.h"
#include "scene_maths.hpp"
#include "work.h"

namespace airlight {

struct State;

struct Maps {
    bool used = false;
    brume::maths_float::GridSettings settings{};
    int kept = 0;  // maps that there is room for
    brume_plugin_image attenuation = nullptr;
    brume_plugin_image density = nullptr;                    // grid_density
    brume_plugin_image lights = nullptr;                     // grid_lights
    brume_plugin_image radiance = nullptr, error = nullptr;  // of the lights so far, in turn with State's
    brume_pass attenuation_pass = nullptr;
    brume_pass density_pass = nullptr;
    brume_pass lights_pass = nullptr;
    brume_pass gather_pass = nullptr;

    brume::maths_float::ivec2 room{0};  // size of the grid's images

    // Refreshed when something moved.
    brume_plugin_image slices = nullptr;
    std::vector<float> distances;
    brume_plugin_image frames = nullptr;  // attenuation_frames
    bool maps_pending = false;
    bool grid_pending = false;
    brume::maths_float::ivec2 in_grid{0};   // the lights whose attenuation or sums grid_lights has
    brume::maths_float::ivec2 in_front{0};  // those whose sums it had as far as a frame's picture showed
    maps::Frames placed;
};

// What gathers from maps, by a name of its own: it takes another time an operation than what integrates by nodes.
constexpr const char *maps_gather = "lookup";

struct MapsOffer {
    maps::Sizes sizes;
    bool suits;  // may be taken unasked
    // Of a frame in which all moved.
    Work of_pixels, of_grid, of_maps;

    Work work() const { return of_pixels + of_grid + of_maps; }
};
MapsOffer offer_maps(const brume_plugin_request &request, const State &state);

// At planning: images, passes and their entries.
brume_status plan_maps(const brume_services &services, brume_host host, const brume_plugin_scene &scene,
                       const MapsOffer &offer, State &state);

// Of a frame whose lights, Gaussians or camera moved. moved: not the camera alone.
brume_status refresh_maps(const brume_services &services, brume_host host, const brume_plugin_scene &scene, bool moved,
                          State &state);

// The airlight of the lights [first, last) into an image.
struct MappedGather {
    int first;
    int last;
    brume_plugin_image radiance;
    brume_plugin_image error;
    brume_plugin_image distances;
    bool environment;
    int reduction;
};
brume_status gather_by_maps(const brume_services &services, brume_host host, const brume_plugin_frame &frame, State &state,
                            const MappedGather &wanted);

}  // namespace airlight
