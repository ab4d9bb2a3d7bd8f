#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include <gtest/gtest.h>

#include "effects/effects.h"
#include "base/error.h"
#include "scene/scene.h"

namespace brume {
namespace {

const EffectRegistry &registry()
{
    static const EffectRegistry loaded = [] {
        EffectRegistry effects;
        effects.load({BRUME_TEST_PLUGIN_DIR}, {});
        return effects;
    }();
    return loaded;
}

Scene parse(const std::string &text)
{
    return parse_scene(text, "fog.json", registry());
}

std::string failure(const std::string &text)
{
    try {
        parse(text);
    } catch (const Error &error) {
        EXPECT_EQ(error.status(), BRUME_ERROR_SCENE) << error.what();
        return error.what();
    }
    return "accepted";
}

// A scene whose second line is `line`.
std::string with(const std::string &line)
{
    return "{ \"brume\": 1,\n" + line + " }";
}

TEST(SceneFile, ReadsEverything)
{
    const Scene scene = parse(R"({ "brume": 1,
        "metres_per_unit": 0.01,
        "camera": { "vertical_fov": 90, "pixel_aspect": 2, "center": [0.25, 0.75],
                    "camera_to_world": [[0,0,1,10],[1,0,0,20],[0,1,0,{"keys":[[1,30],[2,40]]}],[0,0,0,1]] },
        "medium": { "scattering": [0.01, 0.02, {"keys": [[0, 0.03], [10, 0.05]]}], "absorption": 0.5, "emission": [1,2,3],
                    "g": -0.5,
                    "density": [ {"type": "constant"}, {"type": "constant", "value": 0.5},
                                 {"type": "exponential", "value": 2, "falloff": 0.25, "direction": [0,0,2],
                                  "origin": [1,2,3]},
                                 {"type": "gaussian", "center": [1,2,{"keys": [[1,3],[2,4]]}], "scale": 0.5,
                                  "amplitude": {"keys": [[1,1],[2,0]]}, "colour": [1,0.5,0]} ] },
        "lights": [ {"type": "point", "position": [0,5,2], "intensity": [10,8,6], "radius": 0.1},
                    {"type": "spot", "position": [0,5,2], "direction": [0,-1,0], "intensity": 3, "angle": 40,
                     "penumbra": 0.25},
                    {"type": "directional", "direction": [0,-1,0], "intensity": {"keys": [[1,3],[2,5]]}, "distance": 7} ],
        "environment": { "sh": [[1,2,3], [4,5,6], [7,8,9], [-1,-2,-3]] },
        "effects": { "well_behaved": {"strength": 2, "levels": 3, "masking": false, "filter": "paper"} } })");
    EXPECT_EQ(scene.metres_per_unit, 0.01);
    EXPECT_NEAR(scene.camera.vertical_fov->at(0), std::numbers::pi / 2, 1e-15);
    EXPECT_FALSE(scene.camera.horizontal_fov);
    EXPECT_EQ(scene.camera.pixel_aspect.at(0), 2.0);
    EXPECT_EQ(scene.camera.center[1].at(0), 0.75);
    EXPECT_EQ((*scene.camera.camera_to_world)[7].at(0), 20.0);
    EXPECT_EQ((*scene.camera.camera_to_world)[11].at(1.5), 35.0);
    ASSERT_TRUE(scene.medium);
    EXPECT_EQ(scene.medium->scattering[1].at(0), 0.02);
    EXPECT_EQ(scene.medium->scattering[2].at(5), 0.04);
    EXPECT_EQ(scene.medium->absorption[2].at(0), 0.5);
    EXPECT_EQ(scene.medium->emission[2].at(0), 3.0);
    EXPECT_EQ(scene.medium->g.at(0), -0.5);
    ASSERT_EQ(scene.medium->density.size(), 3u);
    EXPECT_EQ(scene.medium->density[0].value.at(0), 1.0);
    EXPECT_EQ(scene.medium->density[2].type, BRUME_DENSITY_EXPONENTIAL);
    EXPECT_EQ(scene.medium->density[2].falloff.at(0), 0.25);
    EXPECT_EQ(scene.medium->density[2].direction[2].at(0), 2.0);
    EXPECT_EQ(scene.medium->density[2].origin[2].at(0), 3.0);
    ASSERT_EQ(scene.medium->gaussians.size(), 1u);
    EXPECT_EQ(scene.medium->gaussians[0].center[2].at(1.5), 3.5);
    EXPECT_EQ(scene.medium->gaussians[0].scale.at(0), 0.5);
    EXPECT_EQ(scene.medium->gaussians[0].amplitude.at(1.5), 0.5);
    EXPECT_EQ(scene.medium->gaussians[0].color[1].at(0), 0.5);
    ASSERT_EQ(scene.lights.size(), 3u);
    EXPECT_EQ(scene.lights[0].type, BRUME_LIGHT_POINT);
    EXPECT_EQ(scene.lights[0].position[1].at(0), 5.0);
    EXPECT_EQ(scene.lights[0].intensity[2].at(0), 6.0);
    EXPECT_EQ(scene.lights[0].radius.at(0), 0.1);
    EXPECT_EQ(scene.lights[1].type, BRUME_LIGHT_SPOT);
    EXPECT_NEAR(scene.lights[1].angle.at(0), std::numbers::pi * 40 / 180, 1e-15);
    EXPECT_EQ(scene.lights[1].penumbra.at(0), 0.25);
    EXPECT_EQ(scene.lights[1].direction[1].at(0), -1.0);
    EXPECT_EQ(scene.lights[2].type, BRUME_LIGHT_DIRECTIONAL);
    EXPECT_EQ(scene.lights[2].intensity[2].at(1.5), 4.0);
    EXPECT_EQ(scene.lights[2].distance.at(0), 7.0);
    ASSERT_EQ(scene.environment.coefficients.size(), 4u);
    EXPECT_EQ(scene.environment.coefficients[3][1], -2.0);
    EXPECT_EQ(scene.environment.file, "");
    ASSERT_EQ(scene.effects.size(), 1u);
    EXPECT_EQ(scene.effects[0].name, "well_behaved");
    EXPECT_EQ(scene.effects[0].parameters,
              (std::map<std::string, double>{{"strength", 2.0}, {"levels", 3.0}, {"masking", 0.0}, {"kernel", 0.0}}));
    EXPECT_TRUE(scene.animated());
    EXPECT_FALSE(scene.quality.asked());
}

TEST(SceneFile, QualityIsAPresetAnErrorOrATime)
{
    auto quality = [](const std::string &text) { return parse("{\"brume\": 1, \"quality\": " + text + "}").quality; };
    EXPECT_EQ(quality("\"draft\"").preset, BRUME_PRESET_DRAFT);
    EXPECT_EQ(quality("{\"preset\": \"reference\"}").preset, BRUME_PRESET_REFERENCE);
    EXPECT_EQ(quality("{\"budget_ms\": 8}").budget_ms, 8.0);
    const Quality asked = quality("{\"max_error\": 0.02, \"transmittance\": 0.5, \"detail\": 2}");
    EXPECT_EQ(asked.preset, BRUME_PRESET_NONE);
    EXPECT_EQ(asked.max_error, 0.02);
    EXPECT_EQ(asked.transmittance, 0.5);
    EXPECT_EQ(asked.detail, 2.0);
}

TEST(SceneFile, DefaultsAreThoseOfAnEmptyScene)
{
    const Scene scene = parse("\xef\xbb\xbf{\"brume\": 1.0, \"effects\": {}}");
    EXPECT_EQ(scene.metres_per_unit, 1.0);
    EXPECT_FALSE(scene.medium);
    EXPECT_FALSE(scene.camera.camera_to_world);
    EXPECT_TRUE(scene.effects.empty());
    EXPECT_EQ(scene.lights.size(), 0u);
    EXPECT_FALSE(scene.animated());

    const Scene droplets = parse(with(R"("medium": {"visibility": 200, "droplet_diameter": 12, "density": []})"));
    EXPECT_EQ(droplets.medium->visibility->at(0), 200.0);
    EXPECT_EQ(droplets.medium->droplet_diameter->at(0), 12.0);

    const Scene wide = parse(with(R"("camera": {"horizontal_fov": 60}, "effects": {"well_behaved": {}})"));
    EXPECT_NEAR(wide.camera.horizontal_fov->at(0), std::numbers::pi / 3, 1e-15);
    EXPECT_TRUE(wide.effects.at(0).parameters.empty());
}

struct BadScene {
    const char *line;     // the file's second line
    const char *message;  // after "fog.json:"
};

TEST(SceneFile, SaysWhereAndWhatIsWrong)
{
    const BadScene cases[] = {
        {R"("colour": 1)", R"(2:1: unknown key "colour"; expected one of brume, metres_per_unit, camera, medium, )"
                           "lights, environment, effects, quality"},
        {R"("medium": {"scatering": 1})", R"(2:12: unknown key "scatering"; did you mean "scattering"?)"},
        {R"("é": 1, "mediun": {})", R"(2:1: unknown key "é"; expected one of brume, metres_per_unit, camera, medium, )"
                                    "lights, environment, effects, quality"},
        {R"("lights": [], "mediun": {})", R"(2:15: unknown key "mediun"; did you mean "medium"?)"},
        {R"("medium": 1)", "2:11: medium: 1; expected an object"},
        {R"("medium": null)", "2:11: medium: null; expected an object"},
        {R"("medium": {"scattering": "thick"})",
         R"(2:26: medium.scattering: "thick"; expected a number from 0 to 1e+30, [r, g, b], or )"
         R"({"keys": [[frame, value], ...]})"},
        {R"("medium": {"scattering": [1, 2]})", "2:26: medium.scattering: an array of 2; expected an array of 3 numbers"},
        {R"("medium": {"scattering": [1, -0.5, 2]})", "2:30: medium.scattering[1]: -0.5; expected a number from 0 to 1e+30"},
        {R"("medium": {"scattering": [1, 1e31, 2]})",
         "2:30: medium.scattering[1]: 1e+31; expected a number from 0 to 1e+30"},
        {R"("medium": {"g": 1.5})", "2:17: medium.g: 1.5; expected a number from -1 to 1"},
        {R"("medium": {"g": true})",
         R"(2:17: medium.g: true; expected a number from -1 to 1, or {"keys": [[frame, value], ...]})"},
        {R"("medium": {"g": 0, "droplet_diameter": 8})",
         R"(2:20: "droplet_diameter" beside "g"; expected one of them: they say the same thing)"},
        {R"("medium": {"visibility": 9, "scattering": 8})",
         R"(2:29: "scattering" beside "visibility"; expected one of them: they say the same thing)"},
        {R"("medium": {"visibility": 0})", "2:26: medium.visibility: 0; expected a number from 1e-30 to 1e+30"},
        {R"("medium": {"droplet_diameter": 4})", "2:32: medium.droplet_diameter: 4; expected a number from 5 to 50"},
        {R"("medium": {"density": {}})", "2:23: medium.density: an object; expected an array of density terms"},
        {R"("medium": {"density": [{}]})", R"(2:24: medium.density[0]: has no "type"; expected one)"},
        {R"("medium": {"density": [{"type": "linear"}]})",
         R"(2:33: medium.density[0].type: "linear"; expected "constant", "exponential", "gaussian" or "gaussians")"},
        {R"("medium": {"density": [{"type": "gaussian", "center": [0,0,0]}]})",
         R"(2:24: medium.density[0]: has no "scale"; expected one)"},
        {R"("medium": {"density": [{"type": "gaussian", "center": [0,0,0], "scale": 0}]})",
         "2:73: medium.density[0].scale: 0; expected a number from 1e-30 to 1e+30"},
        {R"("medium": {"density": [{"type": "gaussian", "center": [0,0,0], "scale": 1, "colour": [2,0,0]}]})",
         "2:87: medium.density[0].colour[0]: 2; expected a number from 0 to 1"},
        {R"("medium": {"density": [{"type": "gaussian", "centre": [0,0,0]}]})",
         R"(2:45: unknown key "centre"; did you mean "center"?)"},
        {R"("medium": {"density": [{"type": "gaussians"}]})", R"(2:24: medium.density[0]: has no "file"; expected one)"},
        {R"("medium": {"density": [{"type": "gaussians", "file": 7}]})",
         "2:54: medium.density[0].file: 7; expected the name of a CSV or PLY file"},
        {R"("medium": {"density": [{"type": "gaussians", "file": "%d.####.csv"}]})",
         "2:54: medium.density[0].file: %d.####.csv: more than one frame number in the name; expected one"},
        {R"("medium": {"density": [{"type": "constant", "falloff": 1}]})",
         R"(2:45: unknown key "falloff"; expected one of type, value)"},
        {R"("medium": {"density": [{"type": "exponential", "direction": [0, 0, -0]}]})",
         "2:61: medium.density[0].direction: (0, 0, 0); expected a vector that is not zero"},
        {R"("medium": {"g": {"keys": []}})",
         "2:26: medium.g.keys: an array of 0; expected [frame, value] pairs, one at least"},
        {R"("medium": {"g": {"keys": [[1, 0], [1, 0.5]]}})",
         "2:36: medium.g.keys[1][0]: 1; expected a frame after 1: keys ascend"},
        {R"("medium": {"g": {"keys": [[1, 0], [2, 5]]}})", "2:39: medium.g.keys[1][1]: 5; expected a number from -1 to 1"},
        {R"("medium": {"g": {"keys": [[1, 0, 0]]}})",
         "2:27: medium.g.keys[0]: an array of 3; expected a [frame, value] pair"},
        {R"("medium": {"g": {"key": [[1, 0]]}})", R"(2:18: unknown key "key"; did you mean "keys"?)"},
        {R"("medium": {"g": {}})", R"(2:17: medium.g: has no "keys"; expected one)"},
        {R"("metres_per_unit": 0)", "2:20: metres_per_unit: 0; expected a number from 1e-30 to 1e+30"},
        {R"("metres_per_unit": {"keys": [[1, 1]]})",
         "2:20: metres_per_unit: an object; expected a number from 1e-30 to 1e+30"},
        {R"("camera": {"vertical_fov": 180})", "2:28: camera.vertical_fov: 180; expected a number above 0 and below 180"},
        {R"("camera": {"vertical_fov": 50, "horizontal_fov": 80})",
         R"(2:32: "horizontal_fov" beside "vertical_fov"; expected one of them: they say the same thing)"},
        {R"("camera": {"center": [0.5]})", "2:22: camera.center: an array of 1; expected an array of 2 numbers"},
        {R"("camera": {"camera_to_world": [[1,0,0,0],[0,1,0],[0,0,1,0],[0,0,0,1]]})",
         "2:42: camera.camera_to_world[1]: an array of 3; expected 4 rows of 4 numbers"},
        {R"("camera": {"camera_to_world": [[2,0,0,0],[0,2,0,0],[0,0,2,0],[0,0,0,1]]})",
         "2:31: camera.camera_to_world: column 0 has length 2; expected a rigid motion: orthonormal columns, "
         "determinant 1, last row 0 0 0 1"},
        {R"("camera": {"camera_to_world": [[1,0.6,0,0],[0,0.8,0,0],[0,0,1,0],[0,0,0,1]]})",
         "2:31: camera.camera_to_world: columns 0 and 1 have the product 0.6; expected a rigid motion: orthonormal "
         "columns, determinant 1, last row 0 0 0 1"},
        {R"("camera": {"camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,-1,0],[0,0,0,1]]})",
         "2:31: camera.camera_to_world: it mirrors: its determinant is negative; expected a rigid motion: orthonormal "
         "columns, determinant 1, last row 0 0 0 1"},
        {R"("camera": {"camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[5,0,0,1]]})",
         "2:31: camera.camera_to_world: last row 5 0 0 1; expected a rigid motion: orthonormal columns, determinant 1, "
         "last row 0 0 0 1"},
        {R"("camera": {"camera_to_world": [[{"keys":[[1,1],[7,3]]},0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]})",
         "2:31: camera.camera_to_world: column 0 has length 3 at frame 7; expected a rigid motion: orthonormal "
         "columns, "
         "determinant 1, last row 0 0 0 1"},
        {R"("lights": {})", "2:11: lights: an object; expected an array of lights"},
        {R"("lights": [{"type": "lamp"}])", R"(2:21: lights[0].type: "lamp"; expected "point", "spot" or "directional")"},
        {R"("lights": [{"type": "point", "position": [0,0,0]}])", R"(2:12: lights[0]: has no "intensity"; expected one)"},
        {R"("lights": [{"type": "point", "direction": [0,0,1]}])",
         R"(2:30: unknown key "direction"; expected one of type, intensity, position, radius, shadow, surfaces, group)"},
        {R"("lights": [{"type": "spot", "position": [0,0,0], "direction": [0,0,1], "intensity": 1, "angle": 181}])",
         "2:97: lights[0].angle: 181; expected a number from 0 to 180"},
        {R"("lights": [{"type": "point", "position": [0,0,0], "intensity": 1, "surfaces": 1}])",
         "2:79: lights[0].surfaces: 1; expected true or false"},
        {R"("lights": [{"type": "point", "position": [0,0,0], "intensity": 1, "surfaces": false, "group": "L0"}])",
         R"(2:95: lights[0].group: "L0"; expected no group, since surfaces is false)"},
        {R"("lights": [{"type": "point", "position": [0,0,0], "intensity": 1, "group": "L0"}, {"type": "point", "position": [0,0,0], "intensity": 1, "group": "L0"}])",
         R"(2:147: lights[1].group: "L0"; expected a group of its own: lights[0] has this one)"},
        {R"("environment": {})", R"(2:16: environment: has no "sh"; expected one)"},
        {R"("environment": {"sh": [[1,1,1]], "file": "sky.exr"})",
         R"(2:34: "file" beside "sh"; expected one of them: they say the same thing)"},
        {R"("environment": {"sh": [[1,1,1]], "up": "z"})", R"(2:34: unknown key "up"; expected one of sh)"},
        {R"("environment": {"sh": [[1,1,1], [1,1,1]]})",
         "2:23: environment.sh: an array of 2; expected 1, 4, 9, 16, 25 or 36 [r, g, b] triples"},
        {R"("environment": {"sh": [[1,1]]})", "2:24: environment.sh[0]: an array of 2; expected an [r, g, b] triple"},
        {R"("environment": {"sh": [[1,1,1e31]]})",
         "2:29: environment.sh[0][2]: 1e+31; expected a number from -1e+30 to 1e+30"},
        {R"("environment": {"file": "sky.exr", "up": "x"})", R"(2:42: environment.up: "x"; expected "y" or "z")"},
        {R"("effects": {"wel_behaved": {}})", R"(2:13: no effect "wel_behaved"; did you mean "well_behaved"?)"},
        {R"("effects": {"well_behaved": false})", "2:29: effects.well_behaved: false; expected an object"},
        {R"("effects": {"well_behaved": {"level": 1}})",
         R"(2:30: effect "well_behaved" has no parameter "level"; did you mean "levels"?)"},
        {R"("effects": {"well_behaved": {"levels": 2.5}})",
         "2:40: effects.well_behaved.levels: 2.5; expected an integer from 1 to 12"},
        {R"("effects": {"well_behaved": {"levels": "2"}})",
         R"(2:40: effects.well_behaved.levels: "2"; expected an integer from 1 to 12)"},
        {R"("effects": {"well_behaved": {"masking": 1}})", "2:41: effects.well_behaved.masking: 1; expected true or false"},
        {R"("effects": {"well_behaved": {"kernel": "papr"}})",
         R"(2:40: effects.well_behaved.kernel: "papr"; expected one of paper, reference)"},
        {R"("effects": {"well_behaved": {"kernel": "paper", "filter": "reference"}})",
         "2:49: kernel and filter are one parameter"},
        {R"("effects": {"well_behaved": {"filter": "papr"}})",
         R"(2:40: effects.well_behaved.filter: "papr"; expected one of paper, reference)"},
        {R"("effects": {"well_behaved": {"kernel": 0}})",
         "2:40: effects.well_behaved.kernel: 0; expected one of paper, reference"},
        {R"("effects": {"well_behaved": {"strength": {"keys": [[1, 1]]}}})",
         "2:42: effects.well_behaved.strength: an object; expected a number from 0 to 10; effects' parameters have no "
         "keys"},
        {R"("quality": {})", R"(2:12: quality: nothing is asked; expected a preset, max_error or budget_ms)"},
        {R"("quality": {"preset": "draft", "budget_ms": 5})",
         R"(2:32: "budget_ms" beside "preset"; expected one of them: they say the same thing)"},
        {R"("quality": "fine")", R"(2:12: quality: "fine"; expected one of draft, standard, final, reference)"},
        {R"("quality": {"max_error": 0})", R"(2:26: quality.max_error: 0; expected a number from 1e-06 to 10)"},
        {R"("quality": {"max_eror": 1})", R"(2:13: unknown key "max_eror"; did you mean "max_error"?)"},
        {R"("lights": [], "lights": [])", R"(2:15: duplicate key "lights")"},
        {R"("medium": {"g": NaN})", "2:17: syntax error while parsing value - invalid literal"},
        {R"("medium": {"g": 1e999})", "2:21: a number beyond the range of a double"},
        {R"("medium": {} /* fog */)", "2:14: syntax error while parsing object - invalid literal; expected '}'"},
        {"\"medium\": {\"g\": \"\xff\"}", "2:18: syntax error while parsing value - invalid string: ill-formed UTF-8 byte"},
    };
    for (const BadScene &bad : cases)
        EXPECT_EQ(failure(with(bad.line)), std::string("fog.json:") + bad.message) << bad.line;
}

TEST(SceneFile, DescribesShadowMapsByProjection)
{
    auto lights = [](const char *type, const std::string &shadow) {
        const std::string place = type == std::string("directional") ? R"("direction": [0,0,1])" : R"("position": [0,0,0])";
        return with(R"("lights": [{"type": ")" + std::string(type) + R"(", )" + place + R"(, "intensity": 1, "shadow": )" +
                    shadow + "}]");
    };
    auto map = [](const std::string &more) {
        return R"({"file": "lamp.exr", "camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]], )" + more + "}";
    };
    auto read = [&](const char *type, const std::string &shadow) {
        return parse(lights(type, shadow)).lights.front().shadow;
    };
    EXPECT_EQ(read("point", R"("screen")").kind, BRUME_SHADOW_SCREEN);
    EXPECT_EQ(read("point", map(R"("vertical_fov": 90)")).kind, BRUME_SHADOW_PERSPECTIVE);
    EXPECT_EQ(read("point", map(R"("projection": "perspective", "vertical_fov": 90)")).kind, BRUME_SHADOW_PERSPECTIVE);
    EXPECT_EQ(read("point", map(R"("projection": "latlong")")).depth, BRUME_DEPTH_RAY);
    EXPECT_EQ(read("directional", map(R"("orthographic_width": 9, "projection": "orthographic")")).kind,
              BRUME_SHADOW_ORTHOGRAPHIC);
    const LightShadow endless =
        read("point", map(R"("vertical_fov": 90, "depth": "device", "near": 0.5, "reversed": true)"));
    EXPECT_EQ(endless.depth, BRUME_DEPTH_DEVICE);
    EXPECT_EQ(endless.range, (std::array<double, 2>{std::numeric_limits<double>::infinity(), 0.5}));
    EXPECT_EQ(read("directional", map(R"("orthographic_width": 9, "depth": "device", "near": -1, "far": 5)")).range,
              (std::array<double, 2>{-1, 5}));
    struct Bad {
        const char *type;
        std::string shadow;
        const char *message;
    };
    const Bad cases[] = {
        {"point", R"("picture")", R"(shadow: "picture"; expected an object, or "screen")"},
        {"directional", R"("screen")", R"(shadow: "screen"; expected an object)"},
        {"point", map(R"("projection": "cube", "vertical_fov": 90)"),
         R"(projection: "cube"; expected "perspective" or "latlong")"},
        {"directional", map(R"("projection": "latlong")"), R"(projection: "latlong"; expected "orthographic")"},
        {"point", map(R"("projection": "latlong", "vertical_fov": 90)"), R"(unknown key "vertical_fov")"},
        {"point", map(R"("projection": "latlong", "depth": "planar")"), R"(depth: "planar"; expected "ray")"},
        {"point", map(R"("vertical_fov": 90, "near": 1)"), "near: 1; expected none: depth is not device"},
        {"point", map(R"("vertical_fov": 90, "depth": "device")"), R"(has no "near"; expected one)"},
        {"directional", map(R"("orthographic_width": 9, "depth": "device", "near": 1)"), R"(has no "far"; expected one)"},
        {"point", map(R"("vertical_fov": 90, "depth": "device", "near": 5, "far": 2)"),
         "far: 2; expected a number above near, 5"},
    };
    for (const Bad &bad : cases) {
        const std::string said = failure(lights(bad.type, bad.shadow));
        EXPECT_NE(said.find(bad.message), std::string::npos) << bad.shadow << ": " << said;
    }
}

TEST(SceneFile, RefusesWhatIsNoScene)
{
    EXPECT_EQ(failure(""), "fog.json:1:1: syntax error while parsing value - unexpected end of input; expected '[', '{', "
                           "or a literal");
    EXPECT_EQ(failure("{}"), "fog.json:1:1: has no \"brume\"; expected one");
    EXPECT_EQ(failure("[]"), "fog.json:1:1: an array of 0; expected an object");
    EXPECT_EQ(failure("{\"brume\": 2}"), "fog.json:1:11: brume: 2; expected 1, the version of this file format");
    EXPECT_EQ(failure("{\"brume\": \"1\"}"), "fog.json:1:11: brume: \"1\"; expected 1, the version of this file format");
    EXPECT_EQ(failure("{\"brume\": 1} x"),
              "fog.json:1:14: syntax error while parsing value - invalid literal; expected end of input");
    EXPECT_EQ(failure(std::string("{\"brume\": 1}\0x", 14)), "fog.json:1:13: NUL byte; expected JSON text");
    EXPECT_EQ(failure("{\"brume\": 1, \"" + std::string(500, 'x') + "\": 1}").size(), 207u);
    EXPECT_EQ(failure("\"" + std::string(1 << 20, 'x')),
              "fog.json:1:1048578: syntax error while parsing value - invalid string: missing closing quote");
    EXPECT_EQ(failure(std::string(100000, '[')), "fog.json:1:65: nested deeper than 64 levels");
    EXPECT_EQ(failure(std::string((8 << 20) + 1, ' ')), "fog.json: 8388609 bytes; expected at most 8388608");
}

TEST(SceneFile, FindsFilesBesideItself)
{
    const std::string folder = testing::TempDir() + "brume_scene_files";
    std::filesystem::create_directories(folder);
    std::ofstream(folder + "/puffs.csv") << "x,y,z,scale,amplitude\n1,2,3,0.5,0.25\n";
    const std::string text = R"({ "brume": 1, "environment": {"file": "sky.exr", "up": "z"}, "medium": {"density": [
        {"type": "gaussians", "file": "puffs.csv", "amplitude": 2}, {"type": "gaussians", "file": "smoke.####.ply"}]} })";
    const Scene scene = parse_scene(text, folder + "/fog.json", registry());
    std::filesystem::remove_all(folder);
    EXPECT_EQ(scene.environment.file, folder + "/sky.exr");
    EXPECT_EQ(scene.environment.file_up, BRUME_UP_Z);
    ASSERT_EQ(scene.medium->gaussian_sets.size(), 2u);
    const GaussianSet &fixed = scene.medium->gaussian_sets[0];
    ASSERT_TRUE(fixed.fixed);
    EXPECT_FALSE(fixed.frames);
    EXPECT_EQ(fixed.fixed->at(0).center[2], 3.0);
    EXPECT_EQ(fixed.amplitude.at(0), 2.0);
    EXPECT_TRUE(scene.medium->gaussian_sets[1].frames);
    EXPECT_TRUE(scene.animated());

    EXPECT_EQ(failure(with(R"("medium": {"density": [{"type": "gaussians", "file": "none.csv"}]})"))
                  .rfind("fog.json:2:54: medium.density[0].file: none.csv: ", 0),
              0u);
}

TEST(SceneFile, BoundsExponentialTerms)
{
    const auto scene = [](int count) {
        std::ostringstream out;
        out << R"("medium": {"density": [{"type": "constant"})";
        for (int i = 0; i < count; ++i)
            out << R"(,{"type": "exponential"})";
        out << "]}";
        return with(out.str());
    };
    EXPECT_EQ(parse(scene(16)).medium->density.size(), 17u);
    EXPECT_EQ(failure(scene(17)), "fog.json:2:429: medium.density[17]: exponential term 17; expected at most 16");
}

}  // namespace
}  // namespace brume
