#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include <brume/brume_plugin.h>

namespace brume {

// Which Gaussians can lie between an origin (0: the camera, 1 + l: light l) and a point in some direction from it, as the
// data image of shaders/lib/shadow.glsl has it: product "light_gaussians".
//
// A grid of direction cells won over a tree of cones and over intervals (Fogshop sec. 5.1): a shader finds its list with one
// fetch, and building it descends a quadtree over the cells, about as many steps as the lists have entries.
class LightGaussians {
public:
    // moved: lights, Gaussians or medium changed; else only the camera did, whose own lists alone are then built again.
    // Throws Error(BRUME_ERROR_UNSUPPORTED) if the lists grow beyond what a float can count.
    void refresh(const brume_plugin_scene &scene, bool moved, bool with_camera);

    std::vector<float> texels;

private:
    struct Entry {
        uint32_t cell;
        uint32_t gaussian;
    };
    // In world axes, from the camera.
    struct Sphere {
        std::array<double, 3> center;
        double reach;
    };

    // refresh() with a grid of grid_.
    bool build(const brume_plugin_scene &scene, bool moved, bool with_camera);
    void add_around(const std::array<double, 3> &origin, uint32_t first_cell);
    void add_across(const brume_plugin_scene &scene, uint32_t light, uint32_t first_cell, float *texels, bool moved);
    bool sort_entries(uint32_t first_cell, uint32_t cell_count);

    int grid_ = 1;               // cells a side, a power of two
    size_t first_cell_ = 0;      // texels
    size_t first_gaussian_ = 0;  // pairs of texels
    std::vector<Sphere> spheres_;
    std::vector<Entry> entries_;
    std::vector<uint32_t> counts_;
    size_t lights_end_ = 0;  // of texels, before the camera's entries
};

}  // namespace brume
