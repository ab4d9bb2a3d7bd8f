// What airlight_grid.glsl asks of lights with shadow maps and of light that has been scattered before. Needs shadow_map.glsl,
// airlight_orders.glsl. Pixels side by side have neither (lanes_types.inc).

#define MAPPED_IMAGES int shadowed, int orders, sampler2D surroundings, SHADOW_MAP_IMAGES
#define MAPPED_PASSED(settings) (settings).shadowed, (settings).orders, surroundings, SHADOW_MAP_PASSED

// Of each of the lights: its ray in its shadow map, and what is around it.
#define MAPPED_STATES \
    ShadowRay shadow[grid_lights_at_once]; \
    Surroundings around[grid_lights_at_once];
#define MAPPED_BEGIN(i) \
    shadow[i] = shadow_ray(camera, SHADOW_MAP_PASSED, shadowed, first + i, direction, distance); \
    around[i] = open_surroundings(); \
    if (orders == orders_all) \
        around[i] = surroundings_of(surroundings, first + i);
#define MAPPED_SHARE(i, low, high) (shadow[i].kind != 0 ? lit_share(shadow_maps, shadow[i], low, high) : R(1.0))
#define MAPPED_ORDERS(i, t, depth) \
    if (orders == orders_all) \
        arriving += rescattered_strength(medium, camera, light[i], aspect[i], around[i], direction, t, depth);
