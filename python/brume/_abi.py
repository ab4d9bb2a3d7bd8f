"""brume.h for ctypes: constants, structs, functions. tests/python/test_abi.py holds it against the header."""
import ctypes
from ctypes import POINTER, Structure, c_char_p, c_double, c_int32, c_int64, c_size_t, c_uint32, c_uint64, c_void_p

OK = 0
ERROR_ARGUMENT = 1
ERROR_UNSUPPORTED = 2
ERROR_MEMORY = 3
ERROR_NOT_FOUND = 4
ERROR_SCENE = 5
ERROR_CAMERA = 6
ERROR_FORMAT = 7
ERROR_GL = 8
ERROR_PLUGIN = 9
ERROR_INTERNAL = 10
ERROR_CANCELLED = 11

BACKEND_AUTO, BACKEND_CPU, BACKEND_GL = range(3)
GL_OWNED, GL_BORROWED = range(2)
GL_STATE_PRESERVE, GL_STATE_DEFAULTS, GL_STATE_OWNED = range(3)
LOG_ERROR, LOG_WARNING, LOG_INFO, LOG_DEBUG = range(1, 5)
PARAMETER_NUMBER, PARAMETER_INTEGER, PARAMETER_BOOLEAN, PARAMETER_CHOICE = range(4)
LAYER_INPUT, LAYER_OUTPUT, LAYER_NEEDED, LAYER_OF_LIGHT, LAYER_ANY_SIZE = 1, 2, 4, 8, 16
DENSITY_CONSTANT, DENSITY_EXPONENTIAL = range(2)
MAX_DENSITY_TERMS = 16
MAX_GAUSSIANS = 1000000
LIGHT_POINT, LIGHT_SPOT, LIGHT_DIRECTIONAL = range(3)
SHADOW_NONE, SHADOW_PERSPECTIVE, SHADOW_ORTHOGRAPHIC, SHADOW_LATLONG, SHADOW_SCREEN = range(5)
SURFACES_LIT, SURFACES_UNLIT = range(2)
MAX_LIGHTS = 4096
CAMERA_FIELD_OF_VIEW, CAMERA_POSE = 1, 2
PRESET_NONE, PRESET_DRAFT, PRESET_STANDARD, PRESET_FINAL, PRESET_REFERENCE = range(5)
UP_Y, UP_Z = range(2)
IMAGE_HOST, IMAGE_GL_TEXTURE, IMAGE_GL_TEXTURE_TRUSTED = range(3)
PIXEL_F32, PIXEL_F16 = range(2)
ORIGIN_TOP_LEFT, ORIGIN_BOTTOM_LEFT = range(2)
LAYER_WORLD, LAYER_CAMERA = range(2)
MAX_LAYERS = 8192
DEPTH_PLANAR, DEPTH_RAY, DEPTH_INVERSE, DEPTH_NORMALIZED, DEPTH_DEVICE = range(5)
SKY_FOG, SKY_KEEP, SKY_CLAMP = range(3)
NONPOSITIVE_FAR, NONPOSITIVE_NEAR = range(2)

LogCallback = ctypes.CFUNCTYPE(None, c_void_p, c_uint32, c_char_p)
ProgressCallback = ctypes.CFUNCTYPE(c_int32, c_void_p, c_double)


class brume_context_desc(Structure):
    _fields_ = [("struct_size", c_uint32), ("backend", c_uint32), ("gl_context", c_uint32), ("gl_state", c_uint32),
                ("threads", c_uint32), ("log_level", c_uint32), ("log", LogCallback), ("log_user", c_void_p),
                ("plugin_directory", c_char_p), ("progress", ProgressCallback), ("progress_user", c_void_p)]


class brume_context_info(Structure):
    _fields_ = [("struct_size", c_uint32), ("backend", c_uint32), ("threads", c_uint32), ("reserved", c_uint32),
                ("host_bytes", c_uint64), ("device_bytes", c_uint64), ("device", c_char_p)]


class brume_effect_info(Structure):
    _fields_ = [("struct_size", c_uint32), ("parameter_count", c_uint32), ("name", c_char_p), ("help", c_char_p),
                ("file", c_char_p), ("refusal", c_char_p)]


class brume_parameter_info(Structure):
    _fields_ = [("struct_size", c_uint32), ("type", c_uint32), ("minimum", c_double), ("maximum", c_double),
                ("default_number", c_double), ("name", c_char_p), ("unit", c_char_p), ("help", c_char_p),
                ("choices", c_char_p), ("alias", c_char_p)]


class brume_layer_info(Structure):
    _fields_ = [("struct_size", c_uint32), ("flags", c_uint32), ("channels", c_uint32), ("reserved", c_uint32),
                ("name", c_char_p), ("help", c_char_p)]


class brume_density_term(Structure):
    _fields_ = [("struct_size", c_uint32), ("type", c_uint32), ("value", c_double), ("falloff", c_double),
                ("direction", c_double * 3), ("origin", c_double * 3)]


class brume_gaussian(Structure):
    _fields_ = [("struct_size", c_uint32), ("reserved", c_uint32), ("center", c_double * 3), ("scale", c_double),
                ("amplitude", c_double), ("color", c_double * 3)]


class brume_medium(Structure):
    _fields_ = [("struct_size", c_uint32), ("term_count", c_uint32), ("scattering", c_double * 3),
                ("absorption", c_double * 3), ("emission", c_double * 3), ("g", c_double), ("visibility", c_double),
                ("droplet_diameter", c_double), ("terms", POINTER(brume_density_term)),
                ("gaussians", POINTER(brume_gaussian)), ("gaussian_count", c_uint32), ("noise_seed", c_uint32),
                ("noise_strength", c_double), ("noise_scale", c_double), ("noise_offset", c_double * 3)]


class brume_light(Structure):
    _fields_ = [("struct_size", c_uint32), ("type", c_uint32), ("position", c_double * 3), ("direction", c_double * 3),
                ("intensity", c_double * 3), ("radius", c_double), ("angle", c_double), ("penumbra", c_double),
                ("distance", c_double), ("shadow_kind", c_uint32), ("shadow_depth", c_uint32),
                ("shadow_extent", c_double), ("shadow_to_world", c_double * 16), ("surfaces", c_uint32),
                ("reserved", c_uint32), ("shadow_range", c_double * 2)]


class brume_camera(Structure):
    _fields_ = [("struct_size", c_uint32), ("given", c_uint32), ("vertical_fov", c_double), ("pixel_aspect", c_double),
                ("center", c_double * 2), ("camera_to_world", c_double * 16)]


class brume_quality(Structure):
    _fields_ = [("struct_size", c_uint32), ("preset", c_uint32), ("max_error", c_double), ("budget_ms", c_double),
                ("transmittance", c_double), ("detail", c_double)]


class brume_scene_info(Structure):
    _fields_ = [("struct_size", c_uint32), ("light_count", c_uint32), ("gaussian_count", c_uint32),
                ("environment_count", c_uint32), ("environment_up", c_uint32), ("reserved", c_uint32)]


class brume_image(Structure):
    _fields_ = [("struct_size", c_uint32), ("kind", c_uint32), ("pixel", c_uint32), ("channels", c_uint32),
                ("width", c_int32), ("height", c_int32), ("origin", c_uint32), ("gl_texture", c_uint32),
                ("data", c_void_p), ("pixel_stride", c_int64), ("row_stride", c_int64), ("plane_stride", c_int64),
                ("x", c_int32), ("y", c_int32), ("whole_width", c_int32), ("whole_height", c_int32)]


class brume_layer(Structure):
    _fields_ = [("struct_size", c_uint32), ("kind", c_uint32), ("name", c_char_p), ("image", POINTER(brume_image)),
                ("light", c_uint32), ("reserved", c_uint32)]


class brume_format(Structure):
    _fields_ = [("struct_size", c_uint32), ("width", c_int32), ("height", c_int32), ("display_x", c_int32),
                ("display_y", c_int32), ("display_width", c_int32), ("display_height", c_int32),
                ("depth_kind", c_uint32), ("depth_range", c_double * 2), ("far_distance", c_double), ("sky", c_uint32),
                ("input_count", c_uint32), ("sky_distance", c_double), ("nonpositive", c_uint32),
                ("output_count", c_uint32), ("inputs", POINTER(brume_layer)), ("outputs", POINTER(brume_layer))]


class brume_plan_info(Structure):
    _fields_ = [("struct_size", c_uint32), ("entry_count", c_uint32), ("does_nothing", c_uint32),
                ("camera_needs", c_uint32), ("camera_reason", c_char_p), ("image_bytes", c_uint64),
                ("predicted_ms", c_double), ("predicted_error", c_double), ("quality", c_char_p),
                ("clamped_values", c_int64)]


class brume_plan_entry(Structure):
    _fields_ = [("struct_size", c_uint32), ("runs", c_uint32), ("effect", c_char_p), ("name", c_char_p),
                ("reason", c_char_p), ("bytes", c_uint64), ("operations", c_uint64), ("predicted_ms", c_double),
                ("measured_ms", c_double)]


class brume_frame(Structure):
    _fields_ = [("struct_size", c_uint32), ("input_count", c_uint32), ("color", POINTER(brume_image)),
                ("depth", POINTER(brume_image)), ("output", POINTER(brume_image)), ("inputs", POINTER(brume_layer)),
                ("outputs", POINTER(brume_layer)), ("output_count", c_uint32), ("reserved", c_uint32),
                ("camera", POINTER(brume_camera)), ("frame", c_double)]


STRUCTS = (brume_context_desc, brume_context_info, brume_effect_info, brume_parameter_info, brume_layer_info,
           brume_density_term, brume_gaussian, brume_medium, brume_light, brume_camera, brume_quality, brume_scene_info,
           brume_image, brume_layer, brume_format, brume_plan_info, brume_plan_entry, brume_frame)

# Handles are pointers to what only the library knows; brume_status is an int32_t.
_handle, _status = c_void_p, c_int32
_text = (c_void_p, c_size_t)  # a buffer that text is copied to

FUNCTIONS = {
    "brume_status_name": (c_char_p, _status),
    "brume_version": (c_uint32,),
    "brume_context_create": (_status, POINTER(brume_context_desc), POINTER(_handle)),
    "brume_context_destroy": (None, _handle),
    "brume_context_get_info": (_status, _handle, POINTER(brume_context_info)),
    "brume_context_trim": (_status, _handle),
    "brume_context_calibrate": (_status, _handle),
    "brume_context_calibration": (c_size_t, _handle, *_text),
    "brume_context_set_calibration": (_status, _handle, c_char_p, c_size_t),
    "brume_message": (c_size_t, _handle, *_text),
    "brume_effect_count": (c_uint32, _handle),
    "brume_effect_get_info": (_status, _handle, c_uint32, POINTER(brume_effect_info)),
    "brume_parameter_get_info": (_status, _handle, c_char_p, c_uint32, POINTER(brume_parameter_info)),
    "brume_layer_count": (c_uint32, _handle, c_char_p),
    "brume_layer_get_info": (_status, _handle, c_char_p, c_uint32, POINTER(brume_layer_info)),
    "brume_scene_create": (_status, _handle, POINTER(_handle)),
    "brume_scene_create_from_text": (_status, _handle, c_char_p, c_size_t, c_char_p, POINTER(_handle)),
    "brume_scene_destroy": (None, _handle),
    "brume_scene_light_group": (c_size_t, _handle, c_uint32, *_text),
    "brume_scene_schema": (c_size_t, _handle, *_text),
    "brume_scene_set_medium": (_status, _handle, POINTER(brume_medium)),
    "brume_scene_set_lights": (_status, _handle, POINTER(brume_light), c_uint32),
    "brume_scene_set_environment": (_status, _handle, POINTER(c_double), c_uint32),
    "brume_scene_environment_file": (c_size_t, _handle, *_text),
    "brume_scene_light_shadow_file": (c_size_t, _handle, c_uint32, *_text),
    "brume_scene_set_camera": (_status, _handle, POINTER(brume_camera)),
    "brume_scene_get_camera_given": (_status, _handle, POINTER(c_uint32)),
    "brume_scene_set_metres_per_unit": (_status, _handle, c_double),
    "brume_scene_set_luminance_weights": (_status, _handle, POINTER(c_double)),
    "brume_scene_set_text": (_status, _handle, c_char_p, c_char_p, c_char_p),
    "brume_scene_set_number": (_status, _handle, c_char_p, c_char_p, c_double),
    "brume_scene_set_quality": (_status, _handle, POINTER(brume_quality)),
    "brume_scene_get_quality": (_status, _handle, POINTER(brume_quality)),
    "brume_scene_get_info": (_status, _handle, POINTER(brume_scene_info)),
    "brume_plan_create": (_status, _handle, POINTER(brume_format), POINTER(_handle)),
    "brume_plan_destroy": (None, _handle),
    "brume_plan_update": (_status, _handle, _handle, POINTER(brume_format)),
    "brume_plan_get_info": (_status, _handle, POINTER(brume_plan_info)),
    "brume_plan_get_entry": (_status, _handle, c_uint32, POINTER(brume_plan_entry)),
    "brume_plan_execute": (_status, _handle, POINTER(brume_frame)),
}
FUNCTIONS.update({struct.__name__ + "_init": (None, POINTER(struct), c_size_t) for struct in STRUCTS})
