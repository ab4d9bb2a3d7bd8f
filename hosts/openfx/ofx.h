// What the plugin and its test host need of the OpenFX interface (version 1.4, openfx.readthedocs.io): tables of C functions
// that are asked for by name, and properties and actions that are known by strings. Order and types are the interface's.
#pragma once
#include <cstddef>

namespace ofx {

using Status = int;
constexpr Status ok = 0, failed = 1, fatal = 2, unknown = 3, missing_host_feature = 4, unsupported = 5, exists = 6,
                 out_of_memory = 8, bad_handle = 9, bad_index = 10, bad_value = 11, reply_default = 14,
                 gl_out_of_memory = 1001,
                 gl_render_failed = 1002;  // of the last the host renders the same frame on the CPU

using PropertySet = struct PropertySetTag *;
using EffectHandle = struct EffectTag *;
using ParameterSet = struct ParameterSetTag *;
using ParameterHandle = struct ParameterTag *;
using ClipHandle = struct ClipTag *;
using MemoryHandle = struct MemoryTag *;
using MutexHandle = struct MutexTag *;
using Time = double;

struct PointD {
    double x, y;
};
struct RectI {
    int x1, y1, x2, y2;
    bool operator==(const RectI &) const = default;
};
struct RectD {
    double x1, y1, x2, y2;
};
struct RangeD {
    double min, max;
};

extern "C" {

struct Host {
    PropertySet properties;
    const void *(*fetch_suite)(PropertySet host, const char *name, int version);
};

struct Plugin {
    const char *api;
    int api_version;
    const char *identifier;
    unsigned int major;
    unsigned int minor;
    void (*set_host)(Host *host);
    Status (*main)(const char *action, const void *handle, PropertySet in, PropertySet out);
};

struct PropertySuite {
    Status (*set_pointer)(PropertySet, const char *name, int index, void *value);
    Status (*set_string)(PropertySet, const char *name, int index, const char *value);
    Status (*set_double)(PropertySet, const char *name, int index, double value);
    Status (*set_int)(PropertySet, const char *name, int index, int value);
    Status (*set_pointers)(PropertySet, const char *name, int count, void *const *values);
    Status (*set_strings)(PropertySet, const char *name, int count, const char *const *values);
    Status (*set_doubles)(PropertySet, const char *name, int count, const double *values);
    Status (*set_ints)(PropertySet, const char *name, int count, const int *values);
    Status (*get_pointer)(PropertySet, const char *name, int index, void **value);
    Status (*get_string)(PropertySet, const char *name, int index, char **value);
    Status (*get_double)(PropertySet, const char *name, int index, double *value);
    Status (*get_int)(PropertySet, const char *name, int index, int *value);
    Status (*get_pointers)(PropertySet, const char *name, int count, void **values);
    Status (*get_strings)(PropertySet, const char *name, int count, char **values);
    Status (*get_doubles)(PropertySet, const char *name, int count, double *values);
    Status (*get_ints)(PropertySet, const char *name, int count, int *values);
    Status (*reset)(PropertySet, const char *name);
    Status (*get_dimension)(PropertySet, const char *name, int *count);
};

struct EffectSuite {
    Status (*get_property_set)(EffectHandle, PropertySet *properties);
    Status (*get_parameter_set)(EffectHandle, ParameterSet *parameters);
    Status (*clip_define)(EffectHandle, const char *name, PropertySet *properties);
    Status (*clip_get_handle)(EffectHandle, const char *name, ClipHandle *clip, PropertySet *properties);
    Status (*clip_get_property_set)(ClipHandle, PropertySet *properties);
    Status (*clip_get_image)(ClipHandle, Time time, const RectD *region, PropertySet *image);
    Status (*clip_release_image)(PropertySet image);
    Status (*clip_get_region_of_definition)(ClipHandle, Time time, RectD *bounds);
    int (*abort)(EffectHandle);
    Status (*memory_alloc)(EffectHandle, size_t bytes, MemoryHandle *memory);
    Status (*memory_free)(MemoryHandle);
    Status (*memory_lock)(MemoryHandle, void **pointer);
    Status (*memory_unlock)(MemoryHandle);
};

struct ParameterSuite {
    Status (*define)(ParameterSet, const char *type, const char *name, PropertySet *properties);
    Status (*get_handle)(ParameterSet, const char *name, ParameterHandle *parameter, PropertySet *properties);
    Status (*get_set_properties)(ParameterSet, PropertySet *properties);
    Status (*get_properties)(ParameterHandle, PropertySet *properties);
    Status (*get_value)(ParameterHandle, ...);
    Status (*get_value_at_time)(ParameterHandle, Time time, ...);
    Status (*get_derivative)(ParameterHandle, Time time, ...);
    Status (*get_integral)(ParameterHandle, Time from, Time to, ...);
    Status (*set_value)(ParameterHandle, ...);
    Status (*set_value_at_time)(ParameterHandle, Time time, ...);
    Status (*get_key_count)(ParameterHandle, unsigned int *count);
    Status (*get_key_time)(ParameterHandle, unsigned int index, Time *time);
    Status (*get_key_index)(ParameterHandle, Time time, int direction, int *index);
    Status (*delete_key)(ParameterHandle, Time time);
    Status (*delete_all_keys)(ParameterHandle);
    Status (*copy)(ParameterHandle to, ParameterHandle from, Time offset, const RangeD *range);
    Status (*edit_begin)(ParameterSet, const char *name);
    Status (*edit_end)(ParameterSet);
};

// Version 1 ends with `message`.
struct MessageSuite {
    Status (*message)(void *handle, const char *type, const char *id, const char *format, ...);
    Status (*set_persistent)(void *handle, const char *type, const char *id, const char *format, ...);
    Status (*clear_persistent)(void *handle);
};

struct ThreadSuite {
    Status (*run)(void (*function)(unsigned int index, unsigned int count, void *user), unsigned int count, void *user);
    Status (*cpu_count)(unsigned int *count);
    Status (*thread_index)(unsigned int *index);
    int (*is_spawned_thread)();
    Status (*mutex_create)(MutexHandle *mutex, int lock_count);
    Status (*mutex_destroy)(MutexHandle);
    Status (*mutex_lock)(MutexHandle);
    Status (*mutex_unlock)(MutexHandle);
    Status (*mutex_try_lock)(MutexHandle);
};

struct GlSuite {
    // No format: the host's choice; no region: all.
    Status (*clip_load_texture)(ClipHandle, Time time, const char *format, const RectD *region, PropertySet *texture);
    Status (*clip_free_texture)(PropertySet texture);
    Status (*flush_resources)();
};

}  // extern "C"

constexpr const char *api = "OfxImageEffectPluginAPI";

namespace suite {
constexpr const char *properties = "OfxPropertySuite", *effects = "OfxImageEffectSuite", *parameters = "OfxParameterSuite",
                     *messages = "OfxMessageSuite", *threads = "OfxMultiThreadSuite",
                     *gl = "OfxImageEffectOpenGLRenderSuite";
}

namespace action {
constexpr const char *load = "OfxActionLoad", *unload = "OfxActionUnload", *describe = "OfxActionDescribe",
                     *describe_in_context = "OfxImageEffectActionDescribeInContext",
                     *create_instance = "OfxActionCreateInstance", *destroy_instance = "OfxActionDestroyInstance",
                     *purge_caches = "OfxActionPurgeCaches",
                     *region_of_definition = "OfxImageEffectActionGetRegionOfDefinition",
                     *regions_of_interest = "OfxImageEffectActionGetRegionsOfInterest",
                     *clip_preferences = "OfxImageEffectActionGetClipPreferences",
                     *is_identity = "OfxImageEffectActionIsIdentity", *render = "OfxImageEffectActionRender",
                     *begin_sequence = "OfxImageEffectActionBeginSequenceRender",
                     *end_sequence = "OfxImageEffectActionEndSequenceRender",
                     *gl_attached = "OfxActionOpenGLContextAttached",
                     // The interface's header has it with a k, unlike any other; its documentation without.
                         *gl_detached = "kOfxActionOpenGLContextDetached",
                     *gl_detached_as_documented = "OfxActionOpenGLContextDetached";
}

namespace context {
constexpr const char *general = "OfxImageEffectContextGeneral", *filter = "OfxImageEffectContextFilter";
}

namespace pixels {
constexpr const char *rgba = "OfxImageComponentRGBA", *rgb = "OfxImageComponentRGB", *alpha = "OfxImageComponentAlpha",
                     *byte = "OfxBitDepthByte", *half = "OfxBitDepthHalf", *floating = "OfxBitDepthFloat";
}

namespace clip {
constexpr const char *source = "Source", *depth = "Depth", *output = "Output";
}

namespace type {
constexpr const char *number = "OfxParamTypeDouble", *choice = "OfxParamTypeChoice", *rgb = "OfxParamTypeRGB",
                     *string = "OfxParamTypeString", *group = "OfxParamTypeGroup";
}

namespace message {
constexpr const char *error = "OfxMessageError";
}

namespace property {
// of any object
constexpr const char *name = "OfxPropName", *label = "OfxPropLabel", *time = "OfxPropTime",
                     *instance_data = "OfxPropInstanceData", *description = "OfxPropPluginDescription";
// of effects
constexpr const char *supported_contexts = "OfxImageEffectPropSupportedContexts",
                     *supported_depths = "OfxImageEffectPropSupportedPixelDepths",
                     *supported_components = "OfxImageEffectPropSupportedComponents", *context = "OfxImageEffectPropContext",
                     *grouping = "OfxImageEffectPluginPropGrouping",
                     *thread_safety = "OfxImageEffectPluginRenderThreadSafety",
                     *instance_safe = "OfxImageEffectRenderInstanceSafe",
                     *frame_threading = "OfxImageEffectPluginPropHostFrameThreading",
                     *tiles = "OfxImageEffectPropSupportsTiles",
                     *multi_resolution = "OfxImageEffectPropSupportsMultiResolution",
                     *multiple_depths = "OfxImageEffectPropMultipleClipDepths",
                     *multiple_aspects = "OfxImageEffectPropSupportsMultipleClipPARs",
                     *project_size = "OfxImageEffectPropProjectSize", *project_offset = "OfxImageEffectPropProjectOffset",
                     *frame_varying = "OfxImageEffectFrameVarying";
constexpr const char *gl_supported = "OfxImageEffectPropOpenGLRenderSupported", *gl_depths = "OfxOpenGLPropPixelDepth";
// of actions
constexpr const char *gl_enabled = "OfxImageEffectPropOpenGLEnabled";
constexpr const char *render_scale = "OfxImageEffectPropRenderScale", *render_window = "OfxImageEffectPropRenderWindow",
                     *region_of_definition = "OfxImageEffectPropRegionOfDefinition",
                     *region_of_interest = "OfxImageEffectPropRegionOfInterest",
                     *clip_region = "OfxImageClipPropRoI_";  // and the clip's name
// of clips and images
constexpr const char *optional = "OfxImageClipPropOptional", *connected = "OfxImageClipPropConnected",
                     *components = "OfxImageEffectPropComponents", *depth = "OfxImageEffectPropPixelDepth",
                     *pixel_aspect = "OfxImagePropPixelAspectRatio", *data = "OfxImagePropData",
                     *bounds = "OfxImagePropBounds", *row_bytes = "OfxImagePropRowBytes";
constexpr const char *texture = "OfxImageEffectPropOpenGLTextureIndex",
                     *texture_target = "OfxImageEffectPropOpenGLTextureTarget";
// of parameters
constexpr const char *initial = "OfxParamPropDefault", *least = "OfxParamPropMin", *most = "OfxParamPropMax",
                     *display_least = "OfxParamPropDisplayMin", *display_most = "OfxParamPropDisplayMax",
                     *digits = "OfxParamPropDigits", *hint = "OfxParamPropHint", *option = "OfxParamPropChoiceOption",
                     *parent = "OfxParamPropParent", *string_mode = "OfxParamPropStringMode",
                     *file_path = "OfxParamStringIsFilePath", *file_exists = "OfxParamPropStringFilePathExists";
}  // namespace property

}  // namespace ofx
