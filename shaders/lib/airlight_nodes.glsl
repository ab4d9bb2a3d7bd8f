// The tier `nodes`. Needs airlight_orders.glsl, airlight_cells.glsl.

PURE Airlight airlight_by_nodes(IN(Medium) medium, IN(Camera) camera, IN(AirlightSettings) settings, AIRLIGHT_IMAGES,
                                IN(Sight) sight, sampler2D lamp_order, int order, int first_light, int last_light)
{
    Airlight total;
    if (sight.count <= settings.dense_from) {
        total = airlight_by_parts(medium, camera, settings, AIRLIGHT_PASSED, sight, lamp_order, order, first_light, last_light);
        if (settings.orders == orders_all) {
            Airlight again =
                orders_by_parts(medium, camera, settings, AIRLIGHT_PASSED, sight, first_light, last_light, total.radiance);
            total.radiance += again.radiance;
            total.error += again.error;
        }
    } else {
        total = airlight_by_cells(medium, camera, settings, AIRLIGHT_PASSED, sight, first_light, last_light);
    }
    total.radiance = min(total.radiance, vec3(radiance_limit));
    return Airlight(total.radiance, min(total.error + settings.culled * total.radiance, vec3(radiance_limit)));
}
