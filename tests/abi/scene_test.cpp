// Scenes through the C ABI: what setters take and refuse. What scene files may hold is tested in tests/unit.
#include "client.h"

using namespace client;

namespace {

class SceneCalls : public testing::Test {
protected:
    Context context = make_context();
    Scene scene = make_scene(context, R"({"brume": 1})");

    brume_scene_info info_of(brume_scene of)
    {
        brume_scene_info info = BRUME_SCENE_INFO_INIT;
        EXPECT_EQ(brume_scene_get_info(of, &info), BRUME_OK) << message(context.get());
        return info;
    }
    void refused(brume_status status, const std::string &named)
    {
        expect_status(context.get(), status, BRUME_ERROR_ARGUMENT, named);
    }
    uint32_t camera_given()
    {
        uint32_t given = 99;
        EXPECT_EQ(brume_scene_get_camera_given(scene.get(), &given), BRUME_OK);
        return given;
    }
};

}  // namespace

TEST_F(SceneCalls, TextFailsWithLineAndColumn)
{
    const std::string text = "{\n  \"brume\": 1,\n  \"mediun\": {}\n}";
    auto broken = reinterpret_cast<brume_scene>(1);
    brume_status status = brume_scene_create_from_text(context.get(), text.data(), text.size(), "night.json", &broken);
    expect_status(context.get(), status, BRUME_ERROR_SCENE, "night.json:3:");
    EXPECT_NE(message(context.get()).find("medium"), std::string::npos);
    EXPECT_EQ(broken, nullptr);
    status = brume_scene_create_from_text(context.get(), text.data(), text.size(), nullptr, &broken);
    expect_status(context.get(), status, BRUME_ERROR_SCENE, "scene:3:");
}

TEST_F(SceneCalls, TextNeedsNoTerminator)
{
    const std::string text = std::string(R"({"brume": 1})") + "and more";
    brume_scene made = nullptr;
    ASSERT_EQ(brume_scene_create_from_text(context.get(), text.data(), 12, nullptr, &made), BRUME_OK);
    brume_scene_destroy(made);
}

TEST_F(SceneCalls, MediumRefusesNonsense)
{
    struct Case {
        std::function<void(brume_medium &, brume_density_term &)> change;
        const char *named;
    };
    const Case cases[] = {
        {[](auto &m, auto &) { m.scattering[1] = -1; }, "scattering[1]"},
        {[](auto &m, auto &) { m.scattering[2] = NAN; }, "scattering[2]"},
        {[](auto &m, auto &) { m.absorption[0] = INFINITY; }, "absorption[0]"},
        {[](auto &m, auto &) { m.emission[2] = -1e-9; }, "emission[2]"},
        {[](auto &m, auto &) { m.g = 1.01; }, "medium.g"},
        {[](auto &m, auto &) { m.g = NAN; }, "medium.g"},
        {[](auto &m, auto &) { m.visibility = -5; }, "visibility"},
        {[](auto &m, auto &) { m.droplet_diameter = 4; }, "droplet_diameter"},
        {[](auto &m, auto &) { m.terms = nullptr; }, "terms"},
        {[](auto &m, auto &) { m.term_count = 1000000; }, "term_count"},
        {[](auto &, auto &t) { t.type = 2; }, "terms[0].type"},
        {[](auto &, auto &t) { t.value = -1; }, "terms[0].value"},
        {[](auto &, auto &t) { t.falloff = NAN; }, "terms[0].falloff"},
        {[](auto &, auto &t) { t.direction[1] = 0; }, "terms[0].direction"},
        {[](auto &, auto &t) { t.origin[1] = NAN; }, "terms[0].origin"},
    };
    for (const Case &c : cases) {
        brume_medium medium = BRUME_MEDIUM_INIT;
        brume_density_term term = BRUME_DENSITY_TERM_INIT;
        term.type = BRUME_DENSITY_EXPONENTIAL;
        medium.term_count = 1;
        medium.terms = &term;
        c.change(medium, term);
        refused(brume_scene_set_medium(scene.get(), &medium), c.named);
    }
}

TEST_F(SceneCalls, MediumTakesSixteenExponentialTerms)
{
    std::vector<brume_density_term> terms(40, brume_density_term BRUME_DENSITY_TERM_INIT);
    for (size_t i = 0; i < BRUME_MAX_DENSITY_TERMS; ++i)
        terms[i].type = BRUME_DENSITY_EXPONENTIAL;
    brume_medium medium = BRUME_MEDIUM_INIT;
    medium.terms = terms.data();
    medium.term_count = uint32_t(terms.size());
    EXPECT_EQ(brume_scene_set_medium(scene.get(), &medium), BRUME_OK) << message(context.get());
    terms[20].type = BRUME_DENSITY_EXPONENTIAL;
    refused(brume_scene_set_medium(scene.get(), &medium), "terms");
}

TEST_F(SceneCalls, GaussiansRefuseNonsense)
{
    struct Case {
        std::function<void(brume_medium &, brume_gaussian &)> change;
        const char *named;
    };
    const Case cases[] = {
        {[](auto &m, auto &) { m.gaussians = nullptr; }, "gaussians: NULL"},
        {[](auto &m, auto &) { m.gaussian_count = BRUME_MAX_GAUSSIANS + 1; }, "gaussian_count: 1000001"},
        {[](auto &, auto &g) { g.center[2] = NAN; }, "gaussians[1].center[2]: nan"},
        {[](auto &, auto &g) { g.scale = 0; }, "gaussians[1].scale: 0"},
        {[](auto &, auto &g) { g.amplitude = -1; }, "gaussians[1].amplitude: -1"},
        {[](auto &, auto &g) { g.amplitude = INFINITY; }, "gaussians[1].amplitude: inf"},
        {[](auto &, auto &g) { g.color[1] = 1.5; }, "gaussians[1].color[1]: 1.5"},
        {[](auto &, auto &g) { g.struct_size = 0; }, "gaussians[1].struct_size: 0"},
    };
    for (const Case &c : cases) {
        brume_medium medium = BRUME_MEDIUM_INIT;
        brume_gaussian gaussians[] = {BRUME_GAUSSIAN_INIT, BRUME_GAUSSIAN_INIT};
        medium.gaussian_count = 2;
        medium.gaussians = gaussians;
        EXPECT_EQ(brume_scene_set_medium(scene.get(), &medium), BRUME_OK) << message(context.get());
        c.change(medium, gaussians[1]);
        refused(brume_scene_set_medium(scene.get(), &medium), c.named);
    }
}

TEST_F(SceneCalls, LightsRefuseNonsense)
{
    struct Case {
        uint32_t type;
        std::function<void(brume_light &)> change;
        const char *named;  // nullptr: not looked at by this type
    };
    const Case cases[] = {
        {BRUME_LIGHT_POINT, [](auto &l) { l.type = 3; }, "lights[1].type: 3"},
        {BRUME_LIGHT_POINT, [](auto &l) { l.position[0] = NAN; }, "lights[1].position[0]"},
        {BRUME_LIGHT_POINT, [](auto &l) { l.intensity[2] = -1; }, "lights[1].intensity[2]: -1"},
        {BRUME_LIGHT_POINT, [](auto &l) { l.radius = -1; }, "lights[1].radius: -1"},
        {BRUME_LIGHT_POINT, [](auto &l) { l.surfaces = 2; }, "lights[1].surfaces: 2; expected a BRUME_SURFACES_..."},
        {BRUME_LIGHT_POINT, [](auto &l) { l.shadow_kind = BRUME_SHADOW_LATLONG; },
         "lights[1].shadow_depth: 0; expected BRUME_DEPTH_RAY of a map all around"},
        {BRUME_LIGHT_DIRECTIONAL, [](auto &l) { l.shadow_kind = BRUME_SHADOW_LATLONG; }, "lights[1].shadow_kind: 3"},
        {BRUME_LIGHT_POINT,
         [](auto &l) {
             l.shadow_kind = BRUME_SHADOW_PERSPECTIVE;
             l.shadow_depth = BRUME_DEPTH_NORMALIZED;
         },
         "lights[1].shadow_depth: 3; expected BRUME_DEPTH_PLANAR, _RAY or _DEVICE"},
        {BRUME_LIGHT_POINT,
         [](auto &l) {
             l.shadow_kind = BRUME_SHADOW_PERSPECTIVE;
             l.shadow_depth = BRUME_DEPTH_DEVICE;
             l.shadow_range[0] = 2, l.shadow_range[1] = 2;
         },
         "lights[1].shadow_range: (2, 2); expected two distances above 0 that differ"},
        {BRUME_LIGHT_DIRECTIONAL,
         [](auto &l) {
             l.shadow_kind = BRUME_SHADOW_ORTHOGRAPHIC;
             l.shadow_depth = BRUME_DEPTH_DEVICE;
             l.shadow_range[1] = INFINITY;
         },
         "lights[1].shadow_range: (0, inf); expected two finite distances that differ"},
        {BRUME_LIGHT_POINT, [](auto &l) { l.reserved = 7; }, "lights[1].reserved: 7; expected 0"},
        {BRUME_LIGHT_POINT, [](auto &l) { l.direction[2] = l.angle = l.distance = NAN; }, nullptr},
        {BRUME_LIGHT_SPOT, [](auto &l) { l.direction[2] = 0; }, "lights[1].direction: (0, 0, 0)"},
        {BRUME_LIGHT_SPOT, [](auto &l) { l.angle = 3.2; }, "lights[1].angle: 3.2"},
        {BRUME_LIGHT_SPOT, [](auto &l) { l.penumbra = 1.01; }, "lights[1].penumbra: 1.01"},
        {BRUME_LIGHT_SPOT, [](auto &l) { l.distance = NAN; }, nullptr},
        {BRUME_LIGHT_DIRECTIONAL, [](auto &l) { l.direction[0] = INFINITY; }, "lights[1].direction[0]"},
        {BRUME_LIGHT_DIRECTIONAL, [](auto &l) { l.distance = -1; }, "lights[1].distance: -1"},
        {BRUME_LIGHT_DIRECTIONAL, [](auto &l) { l.position[0] = l.radius = l.penumbra = NAN; }, nullptr},
    };
    for (const Case &c : cases) {
        brume_light lights[] = {BRUME_LIGHT_INIT, BRUME_LIGHT_INIT};
        lights[1].type = c.type;
        EXPECT_EQ(brume_scene_set_lights(scene.get(), lights, 2), BRUME_OK) << message(context.get());
        c.change(lights[1]);
        if (c.named)
            refused(brume_scene_set_lights(scene.get(), lights, 2), c.named);
        else
            EXPECT_EQ(brume_scene_set_lights(scene.get(), lights, 2), BRUME_OK) << message(context.get());
    }
    brume_light light = BRUME_LIGHT_INIT;
    refused(brume_scene_set_lights(scene.get(), nullptr, 1), "lights: NULL");
    refused(brume_scene_set_lights(scene.get(), &light, BRUME_MAX_LIGHTS + 1), "count: 4097");
    EXPECT_EQ(brume_scene_set_lights(scene.get(), nullptr, 0), BRUME_OK);
    EXPECT_EQ(brume_scene_set_lights(nullptr, nullptr, 0), BRUME_ERROR_ARGUMENT);
}

TEST_F(SceneCalls, EnvironmentRefusesNonsense)
{
    std::vector<double> values(3 * 36, -0.5);
    for (uint32_t count : {0u, 1u, 4u, 9u, 16u, 25u, 36u})
        EXPECT_EQ(brume_scene_set_environment(scene.get(), values.data(), count), BRUME_OK) << message(context.get());
    for (uint32_t count : {2u, 35u, 49u, UINT32_MAX})
        refused(brume_scene_set_environment(scene.get(), values.data(), count), "count: " + std::to_string(count));
    refused(brume_scene_set_environment(scene.get(), nullptr, 1), "coefficients: NULL");
    values[5] = NAN;
    refused(brume_scene_set_environment(scene.get(), values.data(), 4), "environment[1][2]: nan");
    EXPECT_EQ(brume_scene_set_environment(nullptr, values.data(), 0), BRUME_ERROR_ARGUMENT);
}

TEST_F(SceneCalls, EnvironmentFileIsToldUntilItIsResolved)
{
    const auto named = [](brume_scene of) {
        std::string name(brume_scene_environment_file(of, nullptr, 0), '#');
        brume_scene_environment_file(of, name.data(), name.size());
        name.pop_back();
        return name;
    };
    EXPECT_EQ(named(scene.get()), "");
    EXPECT_EQ(named(nullptr), "");

    const std::string text = R"({"brume": 1, "environment": {"file": "sky.exr", "up": "z"}})";
    brume_scene made = nullptr;
    ASSERT_EQ(brume_scene_create_from_text(context.get(), text.data(), text.size(), "shots/fog.json", &made), BRUME_OK);
    const Scene owned(made);
    EXPECT_EQ(named(made), "shots/sky.exr");
    EXPECT_EQ(info_of(made).environment_up, BRUME_UP_Z);
    EXPECT_EQ(info_of(made).environment_count, 0u);
    const double grey[] = {1, 1, 1};
    EXPECT_EQ(brume_scene_set_environment(made, grey, 1), BRUME_OK);
    EXPECT_EQ(named(made), "");
    EXPECT_EQ(info_of(made).environment_count, 1u);
}

TEST_F(SceneCalls, InfoCounts)
{
    EXPECT_EQ(info_of(scene.get()).light_count, 0u);
    EXPECT_EQ(info_of(scene.get()).gaussian_count, 0u);
    EXPECT_EQ(info_of(scene.get()).environment_up, BRUME_UP_Y);
    const brume_light lights[] = {BRUME_LIGHT_INIT, BRUME_LIGHT_INIT};
    const brume_gaussian gaussians[] = {BRUME_GAUSSIAN_INIT, BRUME_GAUSSIAN_INIT, BRUME_GAUSSIAN_INIT};
    brume_medium medium = BRUME_MEDIUM_INIT;
    medium.gaussians = gaussians;
    medium.gaussian_count = 3;
    EXPECT_EQ(brume_scene_set_medium(scene.get(), &medium), BRUME_OK);
    EXPECT_EQ(brume_scene_set_lights(scene.get(), lights, 2), BRUME_OK);
    EXPECT_EQ(info_of(scene.get()).light_count, 2u);
    EXPECT_EQ(info_of(scene.get()).gaussian_count, 3u);
    EXPECT_EQ(brume_scene_get_info(nullptr, nullptr), BRUME_ERROR_ARGUMENT);
    EXPECT_EQ(brume_scene_get_info(scene.get(), nullptr), BRUME_ERROR_ARGUMENT);
}

TEST_F(SceneCalls, CameraRefusesNonsense)
{
    struct Case {
        std::function<void(brume_camera &)> change;
        const char *named;
    };
    const Case cases[] = {
        {[](auto &c) { c.vertical_fov = 0; }, "vertical_fov"},
        {[](auto &c) { c.vertical_fov = 3.2; }, "vertical_fov"},
        {[](auto &c) { c.vertical_fov = NAN; }, "vertical_fov"},
        {[](auto &c) { c.pixel_aspect = 0; }, "pixel_aspect"},
        {[](auto &c) { c.center[1] = INFINITY; }, "center"},
        {[](auto &c) { c.camera_to_world[3] = NAN; }, "camera_to_world"},
        {[](auto &c) { c.camera_to_world[0] = 2; }, "camera_to_world"},
        {[](auto &c) { c.camera_to_world[1] = 0.5; }, "camera_to_world"},
        {[](auto &c) { c.camera_to_world[0] = -1; }, "camera_to_world"},
        {[](auto &c) { c.camera_to_world[12] = 1; }, "camera_to_world"},
        {[](auto &c) { c.given = 4; }, "given"},
    };
    for (const Case &c : cases) {
        brume_camera camera = BRUME_CAMERA_INIT;
        camera.given = BRUME_CAMERA_FIELD_OF_VIEW | BRUME_CAMERA_POSE;
        c.change(camera);
        refused(brume_scene_set_camera(scene.get(), &camera), c.named);
    }
    EXPECT_EQ(camera_given(), 0u);
    // What is not given is not looked at.
    brume_camera camera = BRUME_CAMERA_INIT;
    camera.given = BRUME_CAMERA_FIELD_OF_VIEW;
    camera.camera_to_world[0] = NAN;
    EXPECT_EQ(brume_scene_set_camera(scene.get(), &camera), BRUME_OK);
    EXPECT_EQ(camera_given(), BRUME_CAMERA_FIELD_OF_VIEW);
    camera.given = 0;
    EXPECT_EQ(brume_scene_set_camera(scene.get(), &camera), BRUME_OK);
    EXPECT_EQ(camera_given(), 0u);
}

TEST_F(SceneCalls, UnitsAndWeights)
{
    for (double metres : {0.0, -1.0, double(NAN), double(INFINITY)})
        refused(brume_scene_set_metres_per_unit(scene.get(), metres), "metres");
    EXPECT_EQ(brume_scene_set_metres_per_unit(scene.get(), 0.01), BRUME_OK);
    const double heavy[] = {0.5, 0.5, 0.5}, negative[] = {-0.1, 1, 0.1}, nan[] = {NAN, 0.5, 0.5}, good[] = {0.3, 0.6, 0.1};
    refused(brume_scene_set_luminance_weights(scene.get(), heavy), "weights");
    refused(brume_scene_set_luminance_weights(scene.get(), negative), "weights");
    refused(brume_scene_set_luminance_weights(scene.get(), nan), "weights");
    EXPECT_EQ(brume_scene_set_luminance_weights(scene.get(), good), BRUME_OK);
}

TEST_F(SceneCalls, SchemaIsCopiedAsMessagesAre)
{
    const size_t size = brume_scene_schema(context.get(), nullptr, 0);
    ASSERT_GT(size, 100u);
    std::string schema(size, '#');
    EXPECT_EQ(brume_scene_schema(context.get(), schema.data(), size), size);
    EXPECT_EQ(schema.back(), '\0');
    EXPECT_EQ(schema.front(), '{');
    EXPECT_NE(schema.find("multiscatter"), std::string::npos);
    char text[3] = "##";
    EXPECT_EQ(brume_scene_schema(context.get(), text, 2), size);
    EXPECT_STREQ(text, "{");
}
