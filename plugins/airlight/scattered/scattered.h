// All orders by a grid over the view: what arrives scattered before is made once at its points and integrated along each
// pixel's ray.
#pragma once
#include <vector>

#include <brume/brume_plugin.h>

#include "scattered/distances.h"
#include "scattered/maths.h"

namespace airlight {

struct State;

struct Scattered {
    bool used = false;
    brume::maths_float::ScatteredSettings settings{};
    brume_plugin_image grid = nullptr;
    brume_plugin_image radiance = nullptr, error = nullptr;  // of what has been scattered once
    brume_pass make = nullptr;
    brume_pass add = nullptr;

    // Refreshed when something moved.
    brume_plugin_image distances = nullptr;
    scattered::Placement placement;
};

// Whether a plan's light of all orders comes from a grid; the exact way is for errors that it does not reach.
bool takes_grid(const State &state, const brume_plugin_scene &scene);

// At planning: images, passes and their entry. of_lights: layers of single lights are wanted, which have all pixels.
brume_status plan_scattered(const brume_services &services, brume_host host, const brume_plugin_scene &scene, bool of_lights,
                            State &state);

// Of a frame whose lights, Gaussians or camera moved.
brume_status refresh_scattered(const brume_services &services, brume_host host, const brume_plugin_scene &scene,
                               State &state);

// Adds the lights [first, last) to what Scattered's images have of them.
struct RescatteredGather {
    int first;
    int last;
    brume_plugin_image radiance;
    brume_plugin_image error;
    int reduction;
    bool environment;  // all of its orders, too
};
brume_status add_rescattered(const brume_services &services, brume_host host, const brume_plugin_frame &frame, State &state,
                             const RescatteredGather &wanted);

}  // namespace airlight
