#pragma once
#include <cstdint>
#include <vector>

#include <brume/brume_plugin.h>

#include "plan/layers.h"

namespace brume {

struct Rectangle {
    int32_t x = 0, y = 0, width = 0, height = 0;
};

// Puts rectangles of these sizes side by side, no two over each other; returns the size of all together, which is beyond
// `largest` where they do not fit.
Rectangle pack(std::vector<Rectangle> &rectangles, int32_t largest);

// Product light_shadows: all lights' shadow maps in one image, so that whatever their number passes read one. Maps that
// frames bring are copied there, others are made of the picture's depth.
class ShadowMaps {
public:
    // Throws Error, as execute().
    void plan(brume_host_t &host, const brume_plugin_scene &scene, const FrameLayers &layers);
    void execute(brume_host_t &host, const brume_plugin_scene &scene, brume_plugin_image depth, const FrameLayers &layers);

private:
    void take(const brume_plugin_scene &scene, const brume_plugin_image *brought);
    void place(brume_host_t &host, const brume_plugin_scene &scene);
    void upload(brume_host_t &host, const brume_plugin_scene &scene);
    void run(brume_host_t &host, const brume_plugin_scene &scene, brume_plugin_image depth);

    struct Map {
        uint32_t light;
        brume_plugin_image image;  // null: made of the picture's depth
    };

    bool brought_ = false;                                    // frames bring maps
    brume_pass copy_pass_ = nullptr, screen_pass_ = nullptr;  // null: not needed
    brume_plugin_image image_ = nullptr, table_ = nullptr;
    std::vector<Map> maps_;
    std::vector<Rectangle> rectangles_;
    std::vector<float> texels_;
    uint64_t revision_ = 0;
};

}  // namespace brume
