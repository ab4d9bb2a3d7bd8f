#include <algorithm>
#include <cstring>

#include <brume/brume.h>
#include <brume/brume_media.h>

namespace {

// `size` is the caller's: its header may be older than this library, and its struct shorter.
template <class Struct> void fill(Struct *out, const Struct &defaults, size_t size)
{
    if (!out || size < sizeof out->struct_size)
        return;
    auto bytes = reinterpret_cast<unsigned char *>(out);
    const size_t known = std::min(size, sizeof defaults);
    std::memcpy(bytes, &defaults, known);
    std::memset(bytes + known, 0, size - known);
    const auto struct_size = uint32_t(size);
    std::memcpy(bytes, &struct_size, sizeof struct_size);
}

}  // namespace

#define INIT(name, defaults)                                                                                                \
    void name##_init(name *out, size_t size)                                                                                \
    {                                                                                                                       \
        fill(out, name defaults, size);                                                                                     \
    }

extern "C" {
INIT(brume_context_desc, BRUME_CONTEXT_DESC_INIT)
INIT(brume_context_info, BRUME_CONTEXT_INFO_INIT)
INIT(brume_effect_info, BRUME_EFFECT_INFO_INIT)
INIT(brume_parameter_info, BRUME_PARAMETER_INFO_INIT)
INIT(brume_density_term, BRUME_DENSITY_TERM_INIT)
INIT(brume_gaussian, BRUME_GAUSSIAN_INIT)
INIT(brume_medium, BRUME_MEDIUM_INIT)
INIT(brume_light, BRUME_LIGHT_INIT)
INIT(brume_camera, BRUME_CAMERA_INIT)
INIT(brume_quality, BRUME_QUALITY_INIT)
INIT(brume_scene_info, BRUME_SCENE_INFO_INIT)
INIT(brume_format, BRUME_FORMAT_INIT)
INIT(brume_plan_info, BRUME_PLAN_INFO_INIT)
INIT(brume_plan_entry, BRUME_PLAN_ENTRY_INIT)
INIT(brume_image, BRUME_IMAGE_INIT)
INIT(brume_layer, BRUME_LAYER_INIT)
INIT(brume_layer_info, BRUME_LAYER_INFO_INIT)
INIT(brume_frame, BRUME_FRAME_INIT)
INIT(brume_media_info, BRUME_MEDIA_INFO_INIT)
INIT(brume_media_view, BRUME_MEDIA_VIEW_INIT)
INIT(brume_media_stroke, BRUME_MEDIA_STROKE_INIT)
INIT(brume_media_paint, BRUME_MEDIA_PAINT_INIT)
INIT(brume_media_erase, BRUME_MEDIA_ERASE_INIT)
INIT(brume_media_emitter, BRUME_MEDIA_EMITTER_INIT)
INIT(brume_media_airbrush, BRUME_MEDIA_AIRBRUSH_INIT)
}  // extern "C"
