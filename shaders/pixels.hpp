// Pixels of the host's images on the CPU, and loops over them.
#pragma once
#include "scene_maths.hpp"

namespace brume_pixels {

using brume::maths_float::vec2;
using brume::maths_float::vec4;

inline float *at(const brume_plugin_pixels &p, int x, int y)
{
    return p.data + y * p.row_stride + int64_t(x) * p.channels;
}

inline vec4 load(const brume_plugin_pixels &p, int x, int y)
{
    const float *v = at(p, x, y);
    return vec4(v[0], v[1], v[2], v[3]);
}

inline void store(const brume_plugin_pixels &p, int x, int y, vec4 value)
{
    float *v = at(p, x, y);
    v[0] = value.x;
    v[1] = value.y;
    v[2] = value.z;
    v[3] = value.w;
}

inline vec2 pixel_centre(int x, int y)
{
    return vec2(float(x) + 0.5f, float(y) + 0.5f);
}

// function(x, y) for each pixel of the rows first to last (exclusive) of a pass's grid.
template <class Function>
brume_status for_pixels(const brume_plugin_rows &call, int32_t first, int32_t last, Function function)
{
    for (int32_t y = first; y < last; ++y)
        for (int32_t x = 0; x < call.width; ++x)
            function(x, y);
    return BRUME_OK;
}

}  // namespace brume_pixels
