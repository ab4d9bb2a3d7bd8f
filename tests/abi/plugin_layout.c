/* Sizes of the structs between the library and its effects on x86-64; offsets where a member is easily moved. */
#include <brume/brume_plugin.h>

#if defined(__x86_64__) && defined(__LP64__)

#define NAME2(a, b) a##b
#define NAME(a, b) NAME2(a, b)
#define EXPECT(condition) typedef char NAME(expect_line_, __LINE__)[(condition) ? 1 : -1]
#define SIZE(type, bytes) EXPECT(sizeof(type) == (bytes))
#define FIELD(type, field, offset) EXPECT(offsetof(type, field) == (offset))

SIZE(brume_plugin_medium, 332);
FIELD(brume_plugin_medium, asymmetry, 64);
FIELD(brume_plugin_medium, term_count, 72);
FIELD(brume_plugin_medium, terms, 76);
SIZE(brume_plugin_camera, 92);
FIELD(brume_plugin_camera, depth_kind, 24);
FIELD(brume_plugin_camera, far_distance, 40);
FIELD(brume_plugin_camera, nonpositive, 52);
SIZE(brume_plugin_scene, 504);
FIELD(brume_plugin_scene, medium, 8);
FIELD(brume_plugin_scene, camera, 340);
FIELD(brume_plugin_scene, output_limit, 432);
SIZE(brume_plugin_request, 56);
FIELD(brume_plugin_request, parameters, 24);
FIELD(brume_plugin_request, scene, 32);
FIELD(brume_plugin_request, animated, 40);
SIZE(brume_plugin_entry, 40);
SIZE(brume_plugin_frame, 136);
FIELD(brume_plugin_frame, color, 16);
FIELD(brume_plugin_frame, blur_radius, 64);
SIZE(brume_plugin_binding, 24);
SIZE(brume_plugin_uniform, 32);
SIZE(brume_plugin_pass, 56);
FIELD(brume_plugin_pass, uniform_count, 40);
SIZE(brume_plugin_pixels, 32);
SIZE(brume_services, 80);
FIELD(brume_services, fail, 8);
FIELD(brume_services, pixels, 64);
SIZE(brume_effect, 80);
FIELD(brume_effect, name, 8);
FIELD(brume_effect, order, 24);
FIELD(brume_effect, parameters, 48);
FIELD(brume_effect, destroy, 72);

#endif

typedef int brume_test_plugin_layout_holds;
