// What airlight_grid.glsl asks of lights with shadow maps and of light that has been scattered before. Needs shadow_map.glsl,
// airlight_orders.glsl. Pixels side by side have neither (lanes_types.inc).

#define MAPPED_IMAGES ivec4 shadowed, int orders, vec4 ground, SHADOW_MAP_IMAGES
#define MAPPED_PASSED(settings) (settings).shadowed, (settings).orders, (settings).ground, SHADOW_MAP_PASSED

// Of each of the lights: its ray in its shadow map.
#define MAPPED_STATES ShadowRay shadow[grid_lights_at_once];
#define MAPPED_BEGIN(i) \
    shadow[i] = shadow_ray(camera, SHADOW_MAP_PASSED, shadow_slot(shadowed, first + i), first + i, direction, distance);
#define MAPPED_SHARE(i, low, high) (shadow[i].slot >= 0 ? lit_share(SHADOW_MAP_PASSED, shadow[i], low, high) : R(1.0))
#define MAPPED_ORDERS(i, t, depth) \
    if (orders == orders_all) \
        arriving += rescattered_strength(medium, light[i], aspect[i], ground, direction, t, depth);
