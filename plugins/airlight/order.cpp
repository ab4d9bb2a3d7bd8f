// The passes that put the lights of each tile of the screen in order, on the CPU.
#include "order.h"

#include "lanes.hpp"
#include "passes.h"
#include "pixels.hpp"
#include "state.h"

namespace airlight {
namespace {

namespace scalar = brume::maths_float;

const Constants &constants_of(const brume_plugin_rows &call)
{
    return *static_cast<const Constants *>(call.constants);
}

float &entry_at(const brume_plugin_pixels &image, int i)
{
    return *brume_pixels::at(image, i % BRUME_DATA_WIDTH, i / BRUME_DATA_WIDTH);
}

#define BRUME_LANES_BODY "order.inc"
#include "lanes_bodies.inc"

}  // namespace

brume_status plan_order(const brume_services &services, brume_host host, const brume_plugin_scene &scene, State &state)
{
    constexpr int64_t most_texels = 1 << 22;
    auto tiles = [](int pixels) { return int64_t((pixels + scalar::tile_size - 1) / scalar::tile_size); };
    const int64_t texels = tiles(state.width) * tiles(state.height) * scene.light_count;
    if (scene.light_count < 2 || texels > most_texels)
        return BRUME_OK;
    const int rows = int((texels + BRUME_DATA_WIDTH - 1) / BRUME_DATA_WIDTH);
    state.order_texels = texels;
    if (brume_status s =
            services.create_image(host, "airlight bounds by tiles", BRUME_DATA_WIDTH, rows, 1, &state.lamp_bounds))
        return s;
    return services.create_image(host, "airlight lights by tiles", BRUME_DATA_WIDTH, rows, 2, &state.lamp_order);
}

brume_status bounds_rows(const brume_plugin_rows *call, int32_t first, int32_t last)
{
    return BRUME_OF_THIS_MACHINE(bound)(call, first, last);
}

brume_status order_rows(const brume_plugin_rows *call, int32_t first, int32_t last)
{
    const int ordered = constants_of(*call).ordered;
    const scalar::Texture bounds = scalar::texture_of(call->slots[order::bounds]);
    for (int32_t tile = first; tile < last; ++tile)
        for (int l = 0; l < ordered; ++l) {
            const scalar::vec2 place = scalar::lamp_place(bounds, tile * ordered, ordered, l);
            float *entry = &entry_at(call->slots[order::lamp_order], tile * ordered + int(place.x));
            entry[0] = float(l);
            entry[1] = place.y;
        }
    return BRUME_OK;
}

}  // namespace airlight
