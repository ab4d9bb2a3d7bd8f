// Where the grid has its points, and the peaks that it has apart.
#pragma once
#include <vector>

#include <brume/brume_plugin.h>

namespace airlight::scattered {

// Keeps its memory from frame to frame.
class Placement {
public:
    // steps + 1 distances [m], the first 0: dense where the view has lamps and Gaussians, and before the end in growing
    // steps. angle: between the grid's rays.
    const std::vector<float> &distances(const brume_plugin_scene &scene, int width, int height, int steps, double angle);

    // w_0 and those of the lights, of shaders/lib/airlight_scattered.glsl.
    const std::vector<float> &peaks(const brume_plugin_scene &scene);

private:
    struct Lamp {
        double distance, width, weight;
    };

    std::vector<Lamp> lamps_;
    std::vector<double> shares_, weights_;
    std::vector<float> distances_, peaks_;
};

}  // namespace airlight::scattered
