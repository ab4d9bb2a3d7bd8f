/* Sizes and offsets of every struct of the C ABI on x86-64. A change here breaks programs that were built already:
 * append fields instead, and extend this file. */
#include <brume/brume.h>
#include <brume/brume_media.h>

#if defined(__x86_64__) && defined(__LP64__)

#define NAME2(a, b) a##b
#define NAME(a, b) NAME2(a, b)
#define EXPECT(condition) typedef char NAME(expect_line_, __LINE__)[(condition) ? 1 : -1]
#define SIZE(type, bytes) EXPECT(sizeof(type) == (bytes))
#define FIELD(type, field, offset, bytes) \
  EXPECT(offsetof(type, field) == (offset) && sizeof(((type *)0)->field) == (bytes))

SIZE(brume_status, 4);
EXPECT((brume_status)-1 < 0);

SIZE(brume_context_desc, 64);
FIELD(brume_context_desc, struct_size, 0, 4);
FIELD(brume_context_desc, backend, 4, 4);
FIELD(brume_context_desc, gl_context, 8, 4);
FIELD(brume_context_desc, gl_state, 12, 4);
FIELD(brume_context_desc, threads, 16, 4);
FIELD(brume_context_desc, log_level, 20, 4);
FIELD(brume_context_desc, log, 24, 8);
FIELD(brume_context_desc, log_user, 32, 8);
FIELD(brume_context_desc, plugin_directory, 40, 8);
FIELD(brume_context_desc, progress, 48, 8);
FIELD(brume_context_desc, progress_user, 56, 8);

SIZE(brume_context_info, 40);
FIELD(brume_context_info, struct_size, 0, 4);
FIELD(brume_context_info, backend, 4, 4);
FIELD(brume_context_info, threads, 8, 4);
FIELD(brume_context_info, reserved, 12, 4);
FIELD(brume_context_info, host_bytes, 16, 8);
FIELD(brume_context_info, device_bytes, 24, 8);
FIELD(brume_context_info, device, 32, 8);

SIZE(brume_effect_info, 40);
FIELD(brume_effect_info, struct_size, 0, 4);
FIELD(brume_effect_info, parameter_count, 4, 4);
FIELD(brume_effect_info, name, 8, 8);
FIELD(brume_effect_info, help, 16, 8);
FIELD(brume_effect_info, file, 24, 8);
FIELD(brume_effect_info, refusal, 32, 8);

SIZE(brume_parameter_info, 72);
FIELD(brume_parameter_info, struct_size, 0, 4);
FIELD(brume_parameter_info, type, 4, 4);
FIELD(brume_parameter_info, minimum, 8, 8);
FIELD(brume_parameter_info, maximum, 16, 8);
FIELD(brume_parameter_info, default_number, 24, 8);
FIELD(brume_parameter_info, name, 32, 8);
FIELD(brume_parameter_info, unit, 40, 8);
FIELD(brume_parameter_info, help, 48, 8);
FIELD(brume_parameter_info, choices, 56, 8);
FIELD(brume_parameter_info, alias, 64, 8);

SIZE(brume_layer_info, 32);
FIELD(brume_layer_info, struct_size, 0, 4);
FIELD(brume_layer_info, flags, 4, 4);
FIELD(brume_layer_info, channels, 8, 4);
FIELD(brume_layer_info, reserved, 12, 4);
FIELD(brume_layer_info, name, 16, 8);
FIELD(brume_layer_info, help, 24, 8);

SIZE(brume_density_term, 72);
FIELD(brume_density_term, struct_size, 0, 4);
FIELD(brume_density_term, type, 4, 4);
FIELD(brume_density_term, value, 8, 8);
FIELD(brume_density_term, falloff, 16, 8);
FIELD(brume_density_term, direction, 24, 24);
FIELD(brume_density_term, origin, 48, 24);

SIZE(brume_gaussian, 72);
FIELD(brume_gaussian, struct_size, 0, 4);
FIELD(brume_gaussian, reserved, 4, 4);
FIELD(brume_gaussian, center, 8, 24);
FIELD(brume_gaussian, scale, 32, 8);
FIELD(brume_gaussian, amplitude, 40, 8);
FIELD(brume_gaussian, color, 48, 24);

SIZE(brume_light, 280);
FIELD(brume_light, struct_size, 0, 4);
FIELD(brume_light, type, 4, 4);
FIELD(brume_light, position, 8, 24);
FIELD(brume_light, direction, 32, 24);
FIELD(brume_light, intensity, 56, 24);
FIELD(brume_light, radius, 80, 8);
FIELD(brume_light, angle, 88, 8);
FIELD(brume_light, penumbra, 96, 8);
FIELD(brume_light, distance, 104, 8);
FIELD(brume_light, shadow_kind, 112, 4);
FIELD(brume_light, shadow_depth, 116, 4);
FIELD(brume_light, shadow_extent, 120, 8);
FIELD(brume_light, shadow_to_world, 128, 128);
FIELD(brume_light, surfaces, 256, 4);
FIELD(brume_light, reserved, 260, 4);
FIELD(brume_light, shadow_range, 264, 16);

SIZE(brume_medium, 168);
FIELD(brume_medium, struct_size, 0, 4);
FIELD(brume_medium, term_count, 4, 4);
FIELD(brume_medium, scattering, 8, 24);
FIELD(brume_medium, absorption, 32, 24);
FIELD(brume_medium, emission, 56, 24);
FIELD(brume_medium, g, 80, 8);
FIELD(brume_medium, visibility, 88, 8);
FIELD(brume_medium, droplet_diameter, 96, 8);
FIELD(brume_medium, terms, 104, 8);
FIELD(brume_medium, gaussians, 112, 8);
FIELD(brume_medium, gaussian_count, 120, 4);
FIELD(brume_medium, noise_seed, 124, 4);
FIELD(brume_medium, noise_strength, 128, 8);
FIELD(brume_medium, noise_scale, 136, 8);
FIELD(brume_medium, noise_offset, 144, 24);

SIZE(brume_scene_info, 24);
FIELD(brume_scene_info, struct_size, 0, 4);
FIELD(brume_scene_info, light_count, 4, 4);
FIELD(brume_scene_info, gaussian_count, 8, 4);
FIELD(brume_scene_info, environment_count, 12, 4);
FIELD(brume_scene_info, environment_up, 16, 4);
FIELD(brume_scene_info, reserved, 20, 4);

SIZE(brume_camera, 168);
FIELD(brume_camera, struct_size, 0, 4);
FIELD(brume_camera, given, 4, 4);
FIELD(brume_camera, vertical_fov, 8, 8);
FIELD(brume_camera, pixel_aspect, 16, 8);
FIELD(brume_camera, center, 24, 16);
FIELD(brume_camera, camera_to_world, 40, 128);

SIZE(brume_format, 96);
FIELD(brume_format, struct_size, 0, 4);
FIELD(brume_format, width, 4, 4);
FIELD(brume_format, height, 8, 4);
FIELD(brume_format, display_x, 12, 4);
FIELD(brume_format, display_y, 16, 4);
FIELD(brume_format, display_width, 20, 4);
FIELD(brume_format, display_height, 24, 4);
FIELD(brume_format, depth_kind, 28, 4);
FIELD(brume_format, depth_range, 32, 16);
FIELD(brume_format, far_distance, 48, 8);
FIELD(brume_format, sky, 56, 4);
FIELD(brume_format, input_count, 60, 4);
FIELD(brume_format, sky_distance, 64, 8);
FIELD(brume_format, nonpositive, 72, 4);
FIELD(brume_format, output_count, 76, 4);
FIELD(brume_format, inputs, 80, 8);
FIELD(brume_format, outputs, 88, 8);

SIZE(brume_quality, 40);
FIELD(brume_quality, struct_size, 0, 4);
FIELD(brume_quality, preset, 4, 4);
FIELD(brume_quality, max_error, 8, 8);
FIELD(brume_quality, budget_ms, 16, 8);
FIELD(brume_quality, transmittance, 24, 8);
FIELD(brume_quality, detail, 32, 8);
SIZE(brume_plan_info, 64);
FIELD(brume_plan_info, struct_size, 0, 4);
FIELD(brume_plan_info, entry_count, 4, 4);
FIELD(brume_plan_info, does_nothing, 8, 4);
FIELD(brume_plan_info, camera_needs, 12, 4);
FIELD(brume_plan_info, camera_reason, 16, 8);
FIELD(brume_plan_info, image_bytes, 24, 8);
FIELD(brume_plan_info, predicted_ms, 32, 8);
FIELD(brume_plan_info, predicted_error, 40, 8);
FIELD(brume_plan_info, quality, 48, 8);
FIELD(brume_plan_info, clamped_values, 56, 8);

SIZE(brume_plan_entry, 64);
FIELD(brume_plan_entry, struct_size, 0, 4);
FIELD(brume_plan_entry, runs, 4, 4);
FIELD(brume_plan_entry, effect, 8, 8);
FIELD(brume_plan_entry, name, 16, 8);
FIELD(brume_plan_entry, reason, 24, 8);
FIELD(brume_plan_entry, bytes, 32, 8);
FIELD(brume_plan_entry, operations, 40, 8);
FIELD(brume_plan_entry, predicted_ms, 48, 8);
FIELD(brume_plan_entry, measured_ms, 56, 8);

SIZE(brume_image, 80);
FIELD(brume_image, struct_size, 0, 4);
FIELD(brume_image, kind, 4, 4);
FIELD(brume_image, pixel, 8, 4);
FIELD(brume_image, channels, 12, 4);
FIELD(brume_image, width, 16, 4);
FIELD(brume_image, height, 20, 4);
FIELD(brume_image, origin, 24, 4);
FIELD(brume_image, gl_texture, 28, 4);
FIELD(brume_image, data, 32, 8);
FIELD(brume_image, pixel_stride, 40, 8);
FIELD(brume_image, row_stride, 48, 8);
FIELD(brume_image, plane_stride, 56, 8);
FIELD(brume_image, x, 64, 4);
FIELD(brume_image, y, 68, 4);
FIELD(brume_image, whole_width, 72, 4);
FIELD(brume_image, whole_height, 76, 4);

SIZE(brume_layer, 32);
FIELD(brume_layer, struct_size, 0, 4);
FIELD(brume_layer, kind, 4, 4);
FIELD(brume_layer, name, 8, 8);
FIELD(brume_layer, image, 16, 8);
FIELD(brume_layer, light, 24, 4);
FIELD(brume_layer, reserved, 28, 4);

SIZE(brume_frame, 72);
FIELD(brume_frame, struct_size, 0, 4);
FIELD(brume_frame, input_count, 4, 4);
FIELD(brume_frame, color, 8, 8);
FIELD(brume_frame, depth, 16, 8);
FIELD(brume_frame, output, 24, 8);
FIELD(brume_frame, inputs, 32, 8);
FIELD(brume_frame, outputs, 40, 8);
FIELD(brume_frame, output_count, 48, 4);
FIELD(brume_frame, reserved, 52, 4);
FIELD(brume_frame, camera, 56, 8);
FIELD(brume_frame, frame, 64, 8);

SIZE(brume_media_info, 24);
FIELD(brume_media_info, struct_size, 0, 4);
FIELD(brume_media_info, gaussian_count, 4, 4);
FIELD(brume_media_info, selected_count, 8, 4);
FIELD(brume_media_info, clipboard_count, 12, 4);
FIELD(brume_media_info, undo_count, 16, 4);
FIELD(brume_media_info, redo_count, 20, 4);

SIZE(brume_media_view, 32);
FIELD(brume_media_view, struct_size, 0, 4);
FIELD(brume_media_view, reserved, 4, 4);
FIELD(brume_media_view, camera, 8, 8);
FIELD(brume_media_view, format, 16, 8);
FIELD(brume_media_view, depth, 24, 8);

SIZE(brume_media_stroke, 72);
FIELD(brume_media_stroke, struct_size, 0, 4);
FIELD(brume_media_stroke, point_count, 4, 4);
FIELD(brume_media_stroke, points, 8, 8);
FIELD(brume_media_stroke, view, 16, 8);
FIELD(brume_media_stroke, plane_point, 24, 24);
FIELD(brume_media_stroke, plane_normal, 48, 24);

SIZE(brume_media_paint, 72);
FIELD(brume_media_paint, struct_size, 0, 4);
FIELD(brume_media_paint, seed, 4, 4);
FIELD(brume_media_paint, stroke, 8, 8);
FIELD(brume_media_paint, scale, 16, 8);
FIELD(brume_media_paint, amplitude, 24, 8);
FIELD(brume_media_paint, color, 32, 24);
FIELD(brume_media_paint, spacing, 56, 8);
FIELD(brume_media_paint, jitter, 64, 8);

SIZE(brume_media_erase, 32);
FIELD(brume_media_erase, struct_size, 0, 4);
FIELD(brume_media_erase, reserved, 4, 4);
FIELD(brume_media_erase, stroke, 8, 8);
FIELD(brume_media_erase, radius, 16, 8);
FIELD(brume_media_erase, strength, 24, 8);

SIZE(brume_media_emitter, 176);
FIELD(brume_media_emitter, struct_size, 0, 4);
FIELD(brume_media_emitter, seed, 4, 4);
FIELD(brume_media_emitter, position, 8, 24);
FIELD(brume_media_emitter, radius, 32, 8);
FIELD(brume_media_emitter, velocity, 40, 24);
FIELD(brume_media_emitter, spread, 64, 8);
FIELD(brume_media_emitter, acceleration, 72, 24);
FIELD(brume_media_emitter, rate, 96, 8);
FIELD(brume_media_emitter, duration, 104, 8);
FIELD(brume_media_emitter, lifetime, 112, 8);
FIELD(brume_media_emitter, scale, 120, 16);
FIELD(brume_media_emitter, amplitude, 136, 16);
FIELD(brume_media_emitter, color, 152, 24);

SIZE(brume_media_airbrush, 144);
FIELD(brume_media_airbrush, struct_size, 0, 4);
FIELD(brume_media_airbrush, seed, 4, 4);
FIELD(brume_media_airbrush, view, 8, 8);
FIELD(brume_media_airbrush, position, 16, 24);
FIELD(brume_media_airbrush, velocity, 40, 24);
FIELD(brume_media_airbrush, spread, 64, 8);
FIELD(brume_media_airbrush, drag, 72, 8);
FIELD(brume_media_airbrush, diffusion, 80, 8);
FIELD(brume_media_airbrush, rate, 88, 8);
FIELD(brume_media_airbrush, duration, 96, 8);
FIELD(brume_media_airbrush, scale, 104, 8);
FIELD(brume_media_airbrush, amplitude, 112, 8);
FIELD(brume_media_airbrush, color, 120, 24);

#endif

/* Every INIT macro is a valid initialiser of its struct in C. */
void brume_test_initialisers(void);
void brume_test_initialisers(void)
{
  brume_context_desc context_desc = BRUME_CONTEXT_DESC_INIT;
  brume_context_info context_info = BRUME_CONTEXT_INFO_INIT;
  brume_effect_info effect_info = BRUME_EFFECT_INFO_INIT;
  brume_parameter_info parameter_info = BRUME_PARAMETER_INFO_INIT;
  brume_density_term density_term = BRUME_DENSITY_TERM_INIT;
  brume_gaussian gaussian = BRUME_GAUSSIAN_INIT;
  brume_light light = BRUME_LIGHT_INIT;
  brume_medium medium = BRUME_MEDIUM_INIT;
  brume_scene_info scene_info = BRUME_SCENE_INFO_INIT;
  brume_camera camera = BRUME_CAMERA_INIT;
  brume_format format = BRUME_FORMAT_INIT;
  brume_plan_info plan_info = BRUME_PLAN_INFO_INIT;
  brume_plan_entry plan_entry = BRUME_PLAN_ENTRY_INIT;
  brume_image image = BRUME_IMAGE_INIT;
  brume_layer layer = BRUME_LAYER_INIT;
  brume_layer_info layer_info = BRUME_LAYER_INFO_INIT;
  brume_frame frame = BRUME_FRAME_INIT;
  brume_media_info media_info = BRUME_MEDIA_INFO_INIT;
  brume_media_view media_view = BRUME_MEDIA_VIEW_INIT;
  brume_media_stroke media_stroke = BRUME_MEDIA_STROKE_INIT;
  brume_media_paint media_paint = BRUME_MEDIA_PAINT_INIT;
  brume_media_erase media_erase = BRUME_MEDIA_ERASE_INIT;
  brume_media_emitter media_emitter = BRUME_MEDIA_EMITTER_INIT;
  brume_media_airbrush media_airbrush = BRUME_MEDIA_AIRBRUSH_INIT;
  (void)context_desc, (void)context_info, (void)effect_info, (void)parameter_info, (void)density_term, (void)medium;
  (void)camera, (void)format, (void)plan_info, (void)plan_entry, (void)image, (void)layer, (void)layer_info, (void)frame;
  (void)gaussian, (void)light, (void)scene_info;
  (void)media_info, (void)media_view, (void)media_stroke, (void)media_paint, (void)media_erase, (void)media_emitter;
  (void)media_airbrush;
}
