#include <algorithm>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "effects/effects.h"
#include "scene/scene.h"

namespace brume {
namespace {

using Json = nlohmann::json;

EffectRegistry loaded()
{
    EffectRegistry effects;
    effects.load({BRUME_TEST_PLUGIN_DIR}, {});
    return effects;
}

TEST(SceneSchema, ListsEveryParameterOfEveryEffect)
{
    const EffectRegistry effects = loaded();
    const Json properties = Json::parse(scene_schema(effects))["properties"]["effects"]["properties"];
    size_t taken = 0;
    for (const Effect &effect : effects.all()) {
        if (!effect.refusal.empty())
            continue;
        ++taken;
        ASSERT_TRUE(properties.contains(effect.name)) << effect.name;
        const auto aliases = std::count_if(effect.parameters.begin(), effect.parameters.end(),
                                           [](const Parameter &parameter) { return !parameter.alias.empty(); });
        EXPECT_EQ(properties[effect.name]["properties"].size(), effect.parameters.size() + size_t(aliases));
        for (const Parameter &parameter : effect.parameters)
            EXPECT_TRUE(properties[effect.name]["properties"].contains(parameter.name)) << parameter.name;
    }
    EXPECT_EQ(properties.size(), taken);

    const Json well_behaved = properties["well_behaved"]["properties"];
    EXPECT_EQ(well_behaved["strength"], Json::parse(R"({"type": "number", "minimum": 0.0, "maximum": 10.0,
                                                        "default": 0.5, "description": "How much [stops]"})"));
    EXPECT_EQ(well_behaved["levels"], Json::parse(R"({"type": "integer", "minimum": 1, "maximum": 12, "default": 4,
                                                      "description": "How many"})"));
    EXPECT_EQ(well_behaved["masking"], Json::parse(R"({"type": "boolean", "default": true, "description": "Whether"})"));
    Json alias = well_behaved["filter"];
    EXPECT_EQ(alias["deprecated"], true);
    EXPECT_EQ(alias["enum"], well_behaved["kernel"]["enum"]);
    EXPECT_EQ(well_behaved["kernel"], Json::parse(R"({"enum": ["paper", "reference"], "default": "reference",
                                                      "description": "Which"})"));
}

void expect_closed(const Json &schema)
{
    if (schema.is_object() && schema.contains("properties") && schema.contains("type")) {
        EXPECT_EQ(schema["additionalProperties"], false) << schema.dump();
    }
    if (schema.is_structured())
        for (const Json &child : schema)
            expect_closed(child);
}

TEST(SceneSchema, RefusesUnknownKeys)
{
    const Json schema = Json::parse(scene_schema(loaded()));
    EXPECT_EQ(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
    EXPECT_EQ(schema["required"], Json::parse(R"(["brume"])"));
    expect_closed(schema);
}

TEST(SceneSchema, SaysWhatIsThereWhereNothingIsWritten)
{
    const Json schema = Json::parse(scene_schema(loaded()))["properties"];
    const Json lights = schema["lights"]["items"]["oneOf"],
               terms = schema["medium"]["properties"]["density"]["items"]["oneOf"];
    EXPECT_EQ(lights[1]["properties"]["angle"]["default"], 45);
    EXPECT_EQ(lights[1]["properties"]["penumbra"]["default"], 0.1);
    EXPECT_FALSE(lights[1]["properties"]["intensity"].contains("default"));  // it must be written
    EXPECT_EQ(terms[1]["properties"]["direction"]["default"], Json({0, 1, 0}));
    EXPECT_EQ(terms[2]["properties"]["colour"]["default"], 1);
    EXPECT_EQ(schema["camera"]["properties"]["center"]["default"], Json({0.5, 0.5}));
    EXPECT_FALSE(schema["camera"]["properties"]["vertical_fov"].contains("default"));
}

}  // namespace
}  // namespace brume
