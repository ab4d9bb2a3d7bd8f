#include <random>

#include <gtest/gtest.h>

#include "core/effects.h"
#include "core/error.h"
#include "core/scene.h"

namespace brume {
namespace {

const std::string good = R"({ "brume": 1,
  "metres_per_unit": 1,
  "camera": { "vertical_fov": 50, "camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,{"keys":[[1,2.5],[9,3]]}],[0,0,0,1]] },
  "medium": { "scattering": [0.02,0.02,0.02], "absorption": 1e-3, "g": {"keys": [[1, 0.8], [2, 0.9]]},
              "density": [ {"type":"constant","value":1},
                           {"type":"exponential","value":1,"falloff":0.25,"direction":[0,0,1],"origin":[0,0,0]},
                           {"type":"gaussian","center":[0,5,1],"scale":0.5,"amplitude":0.3} ] },
  "lights": [ {"type":"point","position":[0,5,2],"intensity":[10,8,6],"radius":0.1},
              {"type":"spot","position":[0,5,2],"direction":[0,-1,0],"intensity":3,"angle":40,"penumbra":0.5} ],
  "environment": {"sh": [[1,2,3]]},
  "effects": { "well_behaved": {"strength": 2.5, "levels": 3, "masking": true, "kernel": "paper"} } })";

const std::string fragments[] = {"{",
                                 "}",
                                 "[",
                                 "]",
                                 ",",
                                 ":",
                                 "\"",
                                 "\\",
                                 "null",
                                 "true",
                                 "-",
                                 "1e308",
                                 "1e-320",
                                 "0.1",
                                 "\"keys\":",
                                 "[[1,2]]",
                                 "\n",
                                 "\xff",
                                 "\xc3\xa9",
                                 "\\ud800",
                                 "\\u00e9",
                                 "//",
                                 "\"density\":",
                                 "\t",
                                 "\r\n",
                                 "[[[[[",
                                 "\"medium\":",
                                 "{}",
                                 "99999999999999999999",
                                 "\xed\xa0\x80",
                                 "NaN"};

std::string mutated(std::mt19937 &random)
{
    const auto below = [&](size_t n) { return std::uniform_int_distribution<size_t>(0, n - 1)(random); };
    std::string text = good;
    for (size_t edits = 1 + below(4); edits > 0; --edits) {
        const size_t at = below(text.size() + 1);
        const size_t length = below(1 + std::min<size_t>(text.size() - at, 12));
        switch (below(6)) {
        case 0:
            text.replace(at, length, 1, char(below(256)));
            break;
        case 1:
            text.erase(at, length);
            break;
        case 2:
            text.insert(at, text.substr(at, length));
            break;
        case 3:
            text.insert(below(text.size() + 1), text.substr(at, length));
            break;
        case 4:
            text.replace(at, below(2) ? length : 0, fragments[below(std::size(fragments))]);
            break;
        default:
            text.resize(below(8) ? text.size() : at);
        }
        if (text.empty())
            text = good;
    }
    return text;
}

// Every mutation is a scene, which then evaluates or says why not, or an error with a place.
TEST(SceneFuzz, MutatedFilesAreScenesOrErrors)
{
    EffectRegistry effects;
    effects.load({BRUME_TEST_PLUGIN_DIR}, {});
    ASSERT_NO_THROW(parse_scene(good, "good", effects));
    constexpr std::array<double, 16> identity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    std::mt19937 random(20260101);
    int scenes = 0, errors = 0;
    for (int i = 0; i < 20000; ++i) {
        const std::string text = mutated(random);
        Scene scene;
        try {
            scene = parse_scene(text, "fuzz", effects);
            ++scenes;
        } catch (const Error &error) {
            ASSERT_EQ(error.status(), BRUME_ERROR_SCENE) << error.what() << "\n" << text;
            ASSERT_EQ(std::string(error.what()).rfind("fuzz:", 0), 0u) << error.what();
            ++errors;
            continue;
        }
        try {
            brume_plugin_medium medium;
            evaluate_medium(scene, 1.5, identity, medium);
            std::vector<brume_plugin_light> lights;
            evaluate_lights(scene, 1.5, identity, lights);
            std::vector<brume_plugin_gaussian> gaussians;
            evaluate_gaussians(scene, 1.5, identity, gaussians);
        } catch (const Error &error) {
            ASSERT_EQ(error.status(), BRUME_ERROR_ARGUMENT) << error.what() << "\n" << text;
        }
    }
    EXPECT_GT(scenes, 500);
    EXPECT_GT(errors, 5000);
}

}  // namespace
}  // namespace brume
