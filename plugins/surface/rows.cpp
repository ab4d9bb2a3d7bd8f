// The passes on the CPU: loops over rows around the functions of shaders/lib/surface.glsl.
#include <algorithm>
#include <cstring>
#include <limits>

#include "lanes.hpp"
#include "passes.h"
#include "pixels.hpp"

namespace surface {

namespace {

using brume_pixels::at;

const Constants &constants_of(const brume_plugin_rows &call)
{
    return *static_cast<const Constants *>(call.constants);
}

struct Rows {
    brume_rows_function transfer, group, compose;
};

namespace pixels {

using namespace brume::maths_float;

struct Group {
    int x, y;

    vec2 centre() const { return brume_pixels::pixel_centre(x, y); }
};

template <class Function>
brume_status for_groups(const brume_plugin_rows &call, int32_t first, int32_t last, Function function)
{
    return brume_pixels::for_pixels(call, first, last, [&](int x, int y) { function(Group{x, y}); });
}

Texture texture_at(const brume_plugin_pixels &p)
{
    return texture_of(p);
}

float load_channel(const brume_plugin_pixels &image, const Group &g)
{
    return *at(image, g.x, g.y);
}

vec4 load_texels(const brume_plugin_pixels &image, const Group &g)
{
    return brume_pixels::load(image, g.x, g.y);
}

void store_texels(const brume_plugin_pixels &image, const Group &g, const vec4 &value)
{
    brume_pixels::store(image, g.x, g.y, value);
}

const SurfaceSettings &settings_of(const Constants &constants)
{
    return constants.settings;
}

#include "rows.inc"

}  // namespace pixels

#define BRUME_LANES_BODY "rows_lanes.inc"
#include "lanes_bodies.inc"

// Published methods go pixel by pixel: they are for comparison.
const Rows &rows_for(const brume_plugin_rows &call)
{
    if (constants_of(call).settings.method != brume::maths_float::method_calibrated)
        return pixels::rows;
    return BRUME_OF_THIS_MACHINE(rows);
}

}  // namespace

brume_status normals_rows(const brume_plugin_rows *call, int32_t first, int32_t last)
{
    return BRUME_OF_THIS_MACHINE(normals_rows)(call, first, last);
}

brume_status transfer_rows(const brume_plugin_rows *call, int32_t first, int32_t last)
{
    return rows_for(*call).transfer(call, first, last);
}

brume_status group_rows(const brume_plugin_rows *call, int32_t first, int32_t last)
{
    return rows_for(*call).group(call, first, last);
}

brume_status compose_rows(const brume_plugin_rows *call, int32_t first, int32_t last)
{
    return rows_for(*call).compose(call, first, last);
}

}  // namespace surface
