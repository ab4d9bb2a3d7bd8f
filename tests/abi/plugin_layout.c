/* Sizes of the structs between the library and its effects on x86-64; offsets where a member is easily moved. */
#include <brume/brume_plugin.h>

#if defined(__x86_64__) && defined(__LP64__)

#define NAME2(a, b) a##b
#define NAME(a, b) NAME2(a, b)
#define EXPECT(condition) typedef char NAME(expect_line_, __LINE__)[(condition) ? 1 : -1]
#define SIZE(type, bytes) EXPECT(sizeof(type) == (bytes))
#define FIELD(type, field, offset) EXPECT(offsetof(type, field) == (offset))

SIZE(brume_plugin_medium, 360);
FIELD(brume_plugin_medium, phase, 48);
FIELD(brume_plugin_medium, noise, 64);
FIELD(brume_plugin_medium, asymmetry, 92);
FIELD(brume_plugin_medium, term_count, 100);
FIELD(brume_plugin_medium, terms, 104);
SIZE(brume_plugin_camera, 92);
FIELD(brume_plugin_camera, depth_kind, 24);
FIELD(brume_plugin_camera, far_distance, 40);
FIELD(brume_plugin_camera, nonpositive, 52);
FIELD(brume_plugin_camera, right, 56);
FIELD(brume_plugin_camera, back, 80);
SIZE(brume_plugin_gaussian, 32);
FIELD(brume_plugin_gaussian, scale, 12);
FIELD(brume_plugin_gaussian, amplitude, 16);
FIELD(brume_plugin_gaussian, color, 20);
SIZE(brume_plugin_light, 144);
FIELD(brume_plugin_light, radius, 12);
FIELD(brume_plugin_light, direction, 16);
FIELD(brume_plugin_light, cos_outer, 28);
FIELD(brume_plugin_light, intensity, 32);
FIELD(brume_plugin_light, cos_inner, 44);
FIELD(brume_plugin_light, type, 48);
FIELD(brume_plugin_light, shadow_rows, 64);
FIELD(brume_plugin_light, shadow_kind, 112);
FIELD(brume_plugin_light, distance, 52);
SIZE(brume_plugin_scene, 112);
FIELD(brume_plugin_scene, medium, 8);
FIELD(brume_plugin_scene, camera, 16);
FIELD(brume_plugin_scene, lights, 24);
FIELD(brume_plugin_scene, gaussians, 32);
FIELD(brume_plugin_scene, environment, 40);
FIELD(brume_plugin_scene, medium_size, 48);
FIELD(brume_plugin_scene, gaussian_size, 60);
FIELD(brume_plugin_scene, light_count, 64);
FIELD(brume_plugin_scene, environment_count, 72);
FIELD(brume_plugin_scene, output_limit, 76);
FIELD(brume_plugin_scene, position, 80);
FIELD(brume_plugin_scene, revision, 104);
SIZE(brume_plugin_layer, 24);
FIELD(brume_plugin_layer, of_lights, 8);
FIELD(brume_plugin_layer, kind, 16);
SIZE(brume_plugin_product, 32);
FIELD(brume_plugin_product, image_count, 4);
FIELD(brume_plugin_product, images, 8);
FIELD(brume_plugin_product, revision, 16);
FIELD(brume_plugin_product, count, 24);
SIZE(brume_plugin_request, 72);
FIELD(brume_plugin_request, parameter_count, 16);
FIELD(brume_plugin_request, parameters, 24);
FIELD(brume_plugin_request, layers, 32);
FIELD(brume_plugin_request, scene, 40);
FIELD(brume_plugin_request, animated, 48);
FIELD(brume_plugin_request, transmittance, 56);
FIELD(brume_plugin_request, detail, 64);
SIZE(brume_plugin_entry, 56);
FIELD(brume_plugin_entry, operations, 32);
FIELD(brume_plugin_entry, alike, 40);
FIELD(brume_plugin_entry, turns, 48);
SIZE(brume_slot, 16);
FIELD(brume_slot, access, 8);
SIZE(brume_constant, 24);
FIELD(brume_constant, type, 8);
FIELD(brume_constant, offset, 20);
SIZE(brume_plugin_pixels, 32);
FIELD(brume_plugin_pixels, row_stride, 8);
FIELD(brume_plugin_pixels, channels, 24);
SIZE(brume_plugin_rows, 48);
FIELD(brume_plugin_rows, slot_count, 12);
FIELD(brume_plugin_rows, slots, 16);
FIELD(brume_plugin_rows, constants, 24);
FIELD(brume_plugin_rows, scene, 32);
FIELD(brume_plugin_rows, user, 40);
SIZE(brume_pass_desc, 80);
FIELD(brume_pass_desc, slot_count, 4);
FIELD(brume_pass_desc, slots, 16);
FIELD(brume_pass_desc, constants, 24);
FIELD(brume_pass_desc, constant_size, 36);
FIELD(brume_pass_desc, source, 40);
FIELD(brume_pass_desc, defines, 56);
FIELD(brume_pass_desc, rows, 64);
FIELD(brume_pass_desc, grain, 72);
SIZE(brume_plugin_frame, 64);
FIELD(brume_plugin_frame, layer_count, 4);
FIELD(brume_plugin_frame, scene, 16);
FIELD(brume_plugin_frame, color, 24);
FIELD(brume_plugin_frame, output, 40);
FIELD(brume_plugin_frame, layers, 48);
FIELD(brume_plugin_frame, products, 56);
SIZE(brume_services, 88);
FIELD(brume_services, fail, 8);
FIELD(brume_services, create_pass, 40);
FIELD(brume_services, made, 48);
FIELD(brume_services, run, 56);
FIELD(brume_services, upload, 64);
FIELD(brume_services, publish, 72);
FIELD(brume_services, nanoseconds, 80);
SIZE(brume_effect, 160);
FIELD(brume_effect, name, 8);
FIELD(brume_effect, order, 24);
FIELD(brume_effect, layer_count, 40);
FIELD(brume_effect, parameters, 56);
FIELD(brume_effect, layers, 64);
FIELD(brume_effect, uses, 80);
FIELD(brume_effect, plan, 88);
FIELD(brume_effect, destroy, 104);
FIELD(brume_effect, makes_with, 112);
FIELD(brume_effect, offer, 120);
FIELD(brume_effect, settle, 128);
FIELD(brume_effect, uses_with, 136);
FIELD(brume_effect, scenes, 144);
FIELD(brume_effect, scene_count, 152);

#endif

typedef int brume_test_plugin_layout_holds;
