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
FIELD(brume_plugin_gaussian, colour, 20);
SIZE(brume_plugin_light, 64);
FIELD(brume_plugin_light, radius, 12);
FIELD(brume_plugin_light, direction, 16);
FIELD(brume_plugin_light, cos_outer, 28);
FIELD(brume_plugin_light, intensity, 32);
FIELD(brume_plugin_light, cos_inner, 44);
FIELD(brume_plugin_light, type, 48);
FIELD(brume_plugin_light, distance, 52);
SIZE(brume_plugin_scene, 536);
FIELD(brume_plugin_scene, medium, 8);
FIELD(brume_plugin_scene, camera, 368);
FIELD(brume_plugin_scene, output_limit, 460);
FIELD(brume_plugin_scene, light_count, 464);
FIELD(brume_plugin_scene, lights, 480);
FIELD(brume_plugin_scene, environment, 496);
FIELD(brume_plugin_scene, position, 504);
FIELD(brume_plugin_scene, revision, 528);
SIZE(brume_plugin_request, 72);
FIELD(brume_plugin_request, parameters, 24);
FIELD(brume_plugin_request, scene, 32);
FIELD(brume_plugin_request, animated, 40);
FIELD(brume_plugin_request, attenuated, 48);
FIELD(brume_plugin_request, transmittance, 56);
FIELD(brume_plugin_request, detail, 64);
SIZE(brume_plugin_entry, 40);
SIZE(brume_plugin_frame, 136);
FIELD(brume_plugin_frame, color, 16);
FIELD(brume_plugin_frame, blur_radius, 64);
FIELD(brume_plugin_frame, light_airlight, 88);
FIELD(brume_plugin_frame, gaussian_density, 96);
FIELD(brume_plugin_frame, tile_gaussians, 128);
SIZE(brume_plugin_binding, 24);
SIZE(brume_plugin_uniform, 32);
SIZE(brume_plugin_pass, 56);
FIELD(brume_plugin_pass, uniform_count, 40);
SIZE(brume_plugin_pixels, 32);
SIZE(brume_services, 80);
FIELD(brume_services, fail, 8);
FIELD(brume_services, pixels, 64);
FIELD(brume_services, upload, 72);
SIZE(brume_effect, 88);
FIELD(brume_effect, name, 8);
FIELD(brume_effect, order, 24);
FIELD(brume_effect, parameters, 48);
FIELD(brume_effect, destroy, 72);
FIELD(brume_effect, offer, 80);

#endif

typedef int brume_test_plugin_layout_holds;
