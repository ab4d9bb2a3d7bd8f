// In which order tiles of the screen take their lights (lamp_order.glsl), so that pixels end where the rest cannot matter.
#pragma once
#include <brume/brume_plugin.h>

namespace airlight {

struct Constants;
struct State;

namespace bounds {
enum Slot { depth, tiles, lights, bounds, slot_count };
}

namespace order {
enum Slot { bounds, lamp_order, slot_count };
}

brume_status bounds_rows(const brume_plugin_rows *call, int32_t first, int32_t last);
brume_status order_rows(const brume_plugin_rows *call, int32_t first, int32_t last);

// At planning: its images, where there are lights to choose from.
brume_status plan_order(const brume_services &services, brume_host host, const brume_plugin_scene &scene, State &state);

}  // namespace airlight
