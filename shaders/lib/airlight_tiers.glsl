// Airlight of the lights [first_light, last_light) by the tier asked for; `reference` has no form here.
PURE Airlight airlight_of_tier(int tier, IN(Medium) medium, IN(Camera) camera, IN(AirlightSettings) settings, AIRLIGHT_IMAGES,
                               IN(Sight) sight, sampler2D lamp_order, int order, int first_light, int last_light)
{
    if (tier == airlight_sun)
        return airlight_by_table(medium, AIRLIGHT_PASSED, sight, first_light, last_light);
    if (tier == airlight_fogshop)
        return airlight_by_projection(medium, camera, settings, AIRLIGHT_PASSED, sight, first_light, last_light);
    return airlight_by_nodes(medium, camera, settings, AIRLIGHT_PASSED, sight, lamp_order, order, first_light, last_light);
}
