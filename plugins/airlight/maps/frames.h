// Which directions and distances each light's attenuation map covers.
#pragma once
#include <array>
#include <vector>

#include <brume/brume_plugin.h>

namespace airlight::maps {

// A window of the octahedral square about an axis: where the light shines and those Gaussians are that the view sees lit. Of
// directional lights a box about those Gaussians [m], from the camera.
struct Frame {
    std::array<double, 3> u{1, 0, 0}, v{0, 1, 0};  // axes of the world; the square's middle is across both
    double low[2] = {0, 0}, size[2] = {1, 1};
    float near = 0, far = 1;      // of directional lights along them
    double after[3] = {0, 0, 0};  // where a directional light's box begins, from where that about all Gaussians does
};

class Frames {
public:
    // moved: not the camera alone. everywhere: spots' light too, for some of it has been scattered. Returns whether maps
    // have to be made again.
    bool place(const brume_plugin_scene &scene, int width, int height, bool everywhere, bool moved);

    std::vector<float> texels;  // attenuation_frames of shaders/lib/attenuation.glsl

private:
    std::vector<Frame> frames_;
};

}  // namespace airlight::maps
