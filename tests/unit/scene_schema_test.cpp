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
        EXPECT_EQ(properties[effect.name]["properties"].size(), effect.parameters.size());
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
    EXPECT_EQ(well_behaved["kernel"], Json::parse(R"({"enum": ["paper", "reference"], "default": "reference",
                                                      "description": "Which"})"));
}

void expect_closed_and_resolved(const Json &schema, const Json &root)
{
    if (schema.is_object()) {
        if (schema.contains("properties") && schema.contains("type")) {
            EXPECT_EQ(schema["additionalProperties"], false) << schema.dump();
        }
        if (schema.contains("$ref")) {
            const std::string reference = schema["$ref"].get<std::string>().substr(1);
            EXPECT_TRUE(root.contains(Json::json_pointer(reference))) << reference;
        }
    }
    if (schema.is_structured())
        for (const Json &child : schema)
            expect_closed_and_resolved(child, root);
}

TEST(SceneSchema, RefusesUnknownKeysAndResolvesItsReferences)
{
    const Json schema = Json::parse(scene_schema(loaded()));
    EXPECT_EQ(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
    EXPECT_EQ(schema["required"], Json::parse(R"(["brume"])"));
    expect_closed_and_resolved(schema, schema);
}

}  // namespace
}  // namespace brume
