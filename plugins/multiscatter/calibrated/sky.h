#pragma once
#include <vector>

#include "scene_maths.hpp"

namespace multiscatter {

// The scene's environment in the directions that a picture shows, as shaders/lib/sky.glsl reads it.
class Sky {
public:
    // Whether it is another one than before.
    bool follow(const brume_plugin_scene &scene, brume::maths_float::ivec2 size);
    // Four channels; no allocation once warm.
    const std::vector<float> &values() const { return values_; }

private:
    std::vector<float> made_of_, asked_;  // what the values depend on
    std::vector<float> values_;
};

// log2 of the density integral that its first depth stands for.
float first_sky(const brume_plugin_scene &scene);

}  // namespace multiscatter
