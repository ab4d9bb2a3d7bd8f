// Defaults for languages without the macros: each function fills what its macro says.
#include <brume/brume_media.h>

#include "client.h"

namespace {

template <class Struct> void check(void (*init)(Struct *, size_t), const Struct &defaults, const char *name)
{
    alignas(8) unsigned char bytes[sizeof(Struct) + 16];
    const auto filled = [&](size_t size) {
        std::memset(bytes, 0xa5, sizeof bytes);
        init(reinterpret_cast<Struct *>(bytes), size);
    };
    const auto untouched_from = [&](size_t first) {
        for (size_t i = first; i < sizeof bytes; ++i)
            if (bytes[i] != 0xa5)
                return false;
        return true;
    };
    filled(sizeof(Struct));
    EXPECT_EQ(std::memcmp(bytes, &defaults, sizeof defaults), 0) << name;
    EXPECT_TRUE(untouched_from(sizeof(Struct))) << name;

    // An older header's struct is shorter, a newer one's longer.
    const uint32_t shorter = sizeof(Struct) - 4, longer = sizeof(Struct) + 8;
    filled(shorter);
    EXPECT_EQ(std::memcmp(bytes, &shorter, 4), 0) << name;
    EXPECT_EQ(std::memcmp(bytes + 4, reinterpret_cast<const unsigned char *>(&defaults) + 4, shorter - 4), 0) << name;
    EXPECT_TRUE(untouched_from(shorter)) << name;
    filled(longer);
    EXPECT_EQ(std::memcmp(bytes, &longer, 4), 0) << name;
    for (size_t i = sizeof(Struct); i < longer; ++i)
        EXPECT_EQ(bytes[i], 0) << name;
    EXPECT_TRUE(untouched_from(longer)) << name;

    filled(3);
    EXPECT_TRUE(untouched_from(0)) << name;
    init(nullptr, sizeof(Struct));
}

}  // namespace

TEST(Init, FillsWhatTheMacroSays)
{
#define CHECK(name, macro) check<name>(name##_init, name macro, #name)
    CHECK(brume_context_desc, BRUME_CONTEXT_DESC_INIT);
    CHECK(brume_context_info, BRUME_CONTEXT_INFO_INIT);
    CHECK(brume_effect_info, BRUME_EFFECT_INFO_INIT);
    CHECK(brume_parameter_info, BRUME_PARAMETER_INFO_INIT);
    CHECK(brume_density_term, BRUME_DENSITY_TERM_INIT);
    CHECK(brume_gaussian, BRUME_GAUSSIAN_INIT);
    CHECK(brume_medium, BRUME_MEDIUM_INIT);
    CHECK(brume_light, BRUME_LIGHT_INIT);
    CHECK(brume_camera, BRUME_CAMERA_INIT);
    CHECK(brume_quality, BRUME_QUALITY_INIT);
    CHECK(brume_scene_info, BRUME_SCENE_INFO_INIT);
    CHECK(brume_format, BRUME_FORMAT_INIT);
    CHECK(brume_plan_info, BRUME_PLAN_INFO_INIT);
    CHECK(brume_plan_entry, BRUME_PLAN_ENTRY_INIT);
    CHECK(brume_image, BRUME_IMAGE_INIT);
    CHECK(brume_layer, BRUME_LAYER_INIT);
    CHECK(brume_layer_info, BRUME_LAYER_INFO_INIT);
    CHECK(brume_frame, BRUME_FRAME_INIT);
    CHECK(brume_media_info, BRUME_MEDIA_INFO_INIT);
    CHECK(brume_media_view, BRUME_MEDIA_VIEW_INIT);
    CHECK(brume_media_stroke, BRUME_MEDIA_STROKE_INIT);
    CHECK(brume_media_paint, BRUME_MEDIA_PAINT_INIT);
    CHECK(brume_media_erase, BRUME_MEDIA_ERASE_INIT);
    CHECK(brume_media_emitter, BRUME_MEDIA_EMITTER_INIT);
    CHECK(brume_media_airbrush, BRUME_MEDIA_AIRBRUSH_INIT);
}
