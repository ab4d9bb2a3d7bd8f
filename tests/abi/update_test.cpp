// Plans that are given other scenes: the frames of a new plan, bit for bit, or a refusal that leaves the plan as it was.
#include "client.h"

using namespace client;

namespace {

constexpr int width = 32, height = 24;

class Updates : public EachBackend {
protected:
    Picture color{width, height}, depth{width, height, {.channels = 1}};

    void SetUp() override
    {
        EachBackend::SetUp();
        paint(color);
        paint_depth(depth);
    }

    Picture frame(const Plan &plan)
    {
        Picture output(width, height);
        EXPECT_EQ(execute(plan.get(), color, depth, output), BRUME_OK) << message(context.get());
        return output;
    }

    // From one scene to the other and back.
    void same_as_new(const std::string &from, const std::string &to)
    {
        Scene first = make_scene(context, from), second = make_scene(context, to);
        Plan plan = make_plan(context, first, ray_format(width, height)),
             fresh = make_plan(context, second, ray_format(width, height));
        const Picture before = frame(plan), expected = frame(fresh);
        EXPECT_NE(before.memory(), expected.memory()) << "nothing to tell the scenes apart";
        ASSERT_EQ(brume_plan_update(plan.get(), second.get(), nullptr), BRUME_OK) << message(context.get());
        expect_same_bits(expected, frame(plan));
        ASSERT_EQ(brume_plan_update(plan.get(), first.get(), nullptr), BRUME_OK) << message(context.get());
        expect_same_bits(before, frame(plan));
    }

    void refused(const std::string &from, const std::string &to, const std::string &part)
    {
        SCOPED_TRACE(part);
        Scene first = make_scene(context, from), second = make_scene(context, to);
        Plan plan = make_plan(context, first, ray_format(width, height));
        const Picture before = frame(plan);
        expect_status(context.get(), brume_plan_update(plan.get(), second.get(), nullptr), BRUME_ERROR_FORMAT, part);
        expect_same_bits(before, frame(plan));
    }
};
INSTANTIATE_EACH_BACKEND(Updates);

std::string replaced(std::string text, const std::string &what, const std::string &by)
{
    const size_t at = text.find(what);
    if (at == std::string::npos)
        throw std::logic_error("no " + what);
    return text.replace(at, what.size(), by);
}

const char *const lit = R"({"brume": 1,
    "camera": {"vertical_fov": 50, "camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]},
    "medium": {"scattering": [0.05, 0.06, 0.07], "absorption": 0.01,
               "density": [{"type": "constant", "value": 0.5},
                           {"type": "gaussian", "center": [1,0,-8], "scale": 0.5, "amplitude": 2}]},
    "lights": [{"type": "point", "position": [-1,0.5,-6], "intensity": 30, "radius": 0.2}]})";

}  // namespace

TEST_P(Updates, OfTheMedium)
{
    std::string thicker = replaced(foggy, "[0.03, 0.03, 0.034]", "[0.05, 0.02, 0.07]");
    thicker = replaced(thicker, "\"emission\": 0.001, \"g\": 0.7", "\"emission\": [0.002, 0.001, 0.004], \"g\": 0.3");
    thicker = replaced(thicker, "\"value\": 1, \"falloff\": 0.2", "\"value\": 2, \"falloff\": 0.1");
    same_as_new(foggy, thicker);
    same_as_new(R"({"brume": 1, "medium": {"absorption": 0.02}})", R"({"brume": 1, "medium": {"absorption": 0.05}})");
}

TEST_P(Updates, OfTheKernelsOfThePaper)
{
    const std::string paper = std::string(foggy).substr(0, std::string(foggy).rfind('}')) +
                              R"(, "effects": {"multiscatter": {"kernel": "paper"}}})";
    same_as_new(paper, replaced(paper, "[0.03, 0.03, 0.034]", "[0.05, 0.02, 0.07]"));
}

TEST_P(Updates, OfLightsAndGaussians)
{
    same_as_new(lit, replaced(replaced(lit, "[-1,0.5,-6]", "[1.5,-0.5,-9]"), "[0.05, 0.06, 0.07]", "[0.09, 0.06, 0.05]"));
    same_as_new(lit,
                replaced(lit, "\"lights\": [", R"("lights": [{"type": "spot", "position": [2,3,-7], "direction": [0,-1,0],
        "intensity": [50,20,10]},)"));
    same_as_new(lit, replaced(lit, "{\"type\": \"gaussian\",", R"({"type": "gaussian", "center": [-2,1,-5], "scale": 1,
        "amplitude": 3}, {"type": "gaussian",)"));
}

TEST_P(Updates, OfTheCamera)
{
    same_as_new(lit, replaced(lit, "\"vertical_fov\": 50", "\"vertical_fov\": 30"));
    same_as_new(lit, replaced(lit, "[[1,0,0,0],[0,1,0,0],[0,0,1,0]", "[[0,0,1,2],[0,1,0,1],[-1,0,0,-3]"));
    same_as_new(lit, replaced(lit, "\"medium\"", "\"metres_per_unit\": 2, \"medium\""));
}

TEST_P(Updates, OfTheFormat)
{
    Scene scene = make_scene(context, foggy);
    Plan plan = make_plan(context, scene, ray_format(width, height));
    frame(plan);
    brume_format other = ray_format(width, height);
    other.far_distance = 60;
    other.sky = BRUME_SKY_CLAMP;
    other.sky_distance = 90;
    Plan fresh = make_plan(context, scene, other);
    ASSERT_EQ(brume_plan_update(plan.get(), scene.get(), &other), BRUME_OK) << message(context.get());
    expect_same_bits(frame(fresh), frame(plan));

    const Picture before = frame(plan);
    brume_format wide = other;
    wide.width = width + 1;
    expect_status(context.get(), brume_plan_update(plan.get(), scene.get(), &wide), BRUME_ERROR_FORMAT,
                  "width: 32 when planned, 33 now");
    const std::vector<brume_layer> outputs{layer("transmittance")};
    brume_format with_layer = other;
    with_layer.outputs = outputs.data();
    with_layer.output_count = 1;
    expect_status(context.get(), brume_plan_update(plan.get(), scene.get(), &with_layer), BRUME_ERROR_FORMAT, "layers");
    brume_format planar = other;
    planar.depth_kind = BRUME_DEPTH_PLANAR;
    expect_status(context.get(), brume_plan_update(plan.get(), scene.get(), &planar), BRUME_ERROR_FORMAT,
                  "depth kind: 1 when planned, 0 now");
    brume_format cropped = other;
    cropped.display_width = 64;
    cropped.display_height = 48;
    expect_status(context.get(), brume_plan_update(plan.get(), scene.get(), &cropped), BRUME_ERROR_FORMAT, "display window");
    expect_same_bits(before, frame(plan));
}

TEST_P(Updates, OfAnotherStructureAreRefused)
{
    const std::string thin = R"({"brume": 1, "camera": {"vertical_fov": 50}, "medium": {"scattering": 0.02}})";
    refused(thin, R"({"brume": 1})", "medium: 1 when planned, 0 now");
    refused(thin, replaced(thin, "0.02", "[0.02, 0.02, 0]"), "medium.scattering[2] above 0: 1 when planned, 0 now");
    refused(thin, replaced(thin, "0.02", "0.02, \"absorption\": 0.01"),
            "medium.absorption[0] above 0: 0 when planned, 1 now");
    refused(thin, replaced(thin, "0.02", "0.02, \"emission\": 0.01"), "medium.emission[0] above 0: 0 when planned, 1 now");
    refused(thin, replaced(thin, "0.02", "[0.02, 0.03, 0.04]"), "grey scattering: 1 when planned, 0 now");
    refused(lit, replaced(lit, "\"absorption\": 0.01", "\"absorption\": [0.01, 0.02, 0.03]"), "grey absorption");
    refused(lit, replaced(lit, "{\"type\": \"constant\", \"value\": 0.5},", ""), "constant density");
    refused(foggy, replaced(foggy, "\"falloff\": 0.2", "\"falloff\": 0"), "exponential density: 1 when planned, 0 now");
    refused(
        lit,
        replaced(
            lit,
            ",\n                           {\"type\": \"gaussian\", \"center\": [1,0,-8], \"scale\": 0.5, \"amplitude\": 2}",
            ""),
        "Gaussians");
    refused(lit, replaced(lit, "\"lights\"", "\"environment\": {\"sh\": [[1,1,1]]}, \"lights\""),
            "environment coefficients: 0 when planned, 1 now");
    const std::string sky = replaced(lit, "\"lights\"", "\"environment\": {\"sh\": [[1,1,1]]}, \"lights\"");
    refused(sky, replaced(sky, R"({"type": "point", "position": [-1,0.5,-6], "intensity": 30, "radius": 0.2})", ""),
            "lights: 1 when planned, 0 now");
    const std::string set = thin.substr(0, thin.rfind('}')) + R"(, "effects": {"multiscatter": {"levels": 3}}})";
    refused(thin, set, "effects");
    refused(set, replaced(set, "\"levels\": 3", "\"levels\": 4"), "effects");
}

// What a plan left out, because its scene was so thin, is no reason to leave out another scene's fog.
TEST_P(Updates, OfAPlanThatDoesNothing)
{
    const std::string nothing = R"({"brume": 1, "camera": {"vertical_fov": 50}, "medium": {"scattering": 1e-12}})";
    Scene thin = make_scene(context, nothing), thick = make_scene(context, replaced(nothing, "1e-12", "0.05"));
    brume_format format = ray_format(width, height);
    format.sky = BRUME_SKY_KEEP;
    format.far_distance = 1000;
    Plan plan = make_plan(context, thin, format), fresh = make_plan(context, thick, format);
    brume_plan_info info = BRUME_PLAN_INFO_INIT;
    ASSERT_EQ(brume_plan_get_info(plan.get(), &info), BRUME_OK);
    ASSERT_EQ(info.does_nothing, 1u);
    if (brume_plan_update(plan.get(), thick.get(), nullptr) == BRUME_OK)
        expect_same_bits(frame(fresh), frame(plan));
    else
        EXPECT_NE(message(context.get()).find("expected a new plan"), std::string::npos) << message(context.get());
}

// Whatever it was left out for: the medium, its density, lengths, and how far frames show.
TEST_P(Updates, ThatWakeWhatWasDroppedAreRefused)
{
    const std::string thin = R"({"brume": 1, "metres_per_unit": 1, "camera": {"vertical_fov": 50},
        "medium": {"scattering": 1e-12, "density": [{"type": "constant", "value": 2}]}})";
    Scene scene = make_scene(context, thin), alike = make_scene(context, replaced(thin, "1e-12", "2e-12"));
    brume_format format = ray_format(width, height);
    format.sky = BRUME_SKY_KEEP;
    format.far_distance = 1000;
    Plan plan = make_plan(context, scene, format);
    ASSERT_EQ(brume_plan_update(plan.get(), alike.get(), &format), BRUME_OK) << message(context.get());
    const std::string reason = "multiscatter: dropped when planned, it would run now";
    for (const auto &[what, by] : {std::pair("1e-12", "1e-3"), std::pair("\"value\": 2", "\"value\": 2e9"),
                                   std::pair("\"metres_per_unit\": 1", "\"metres_per_unit\": 1e9")}) {
        Scene dense = make_scene(context, replaced(thin, what, by));
        expect_status(context.get(), brume_plan_update(plan.get(), dense.get(), nullptr), BRUME_ERROR_FORMAT, reason);
    }
    brume_format far = format;
    far.far_distance = 1e15;
    expect_status(context.get(), brume_plan_update(plan.get(), alike.get(), &far), BRUME_ERROR_FORMAT, reason);
    far = format;
    far.sky = BRUME_SKY_FOG;
    expect_status(context.get(), brume_plan_update(plan.get(), alike.get(), &far), BRUME_ERROR_FORMAT, reason);
    ASSERT_EQ(brume_plan_update(plan.get(), scene.get(), nullptr), BRUME_OK) << message(context.get());
}

// Depth that has become planar needs what a new plan for it would need.
TEST_P(Updates, NeedTheCameraThatANewPlanNeeds)
{
    Scene scene = make_scene(context, R"({"brume": 1, "medium": {"absorption": 0.02}})");
    Plan plan = make_plan(context, scene, ray_format(width, height));
    frame(plan);
    brume_format planar = ray_format(width, height);
    planar.depth_kind = BRUME_DEPTH_PLANAR;
    if (brume_plan_update(plan.get(), scene.get(), &planar) != BRUME_OK)
        return;
    Picture output(width, height);
    expect_status(context.get(), execute(plan.get(), color, depth, output), BRUME_ERROR_CAMERA, "field of view");
}

TEST_P(Updates, OfQuality)
{
    const std::string text = R"({"brume": 1, "camera": {"vertical_fov": 50}, "medium": {"scattering": 0.02}})";
    Scene scene = make_scene(context, text), other = make_scene(context, text);
    brume_quality quality = BRUME_QUALITY_INIT;
    quality.max_error = 0.3;
    ASSERT_EQ(brume_scene_set_quality(scene.get(), &quality), BRUME_OK);
    Plan plan = make_plan(context, scene, ray_format(width, height));
    const Picture before = frame(plan);
    expect_status(context.get(), brume_plan_update(plan.get(), other.get(), nullptr), BRUME_ERROR_FORMAT, "");
    quality.max_error = 0.01;
    ASSERT_EQ(brume_scene_set_quality(other.get(), &quality), BRUME_OK);
    expect_status(context.get(), brume_plan_update(plan.get(), other.get(), nullptr), BRUME_ERROR_FORMAT, "quality");
    expect_same_bits(before, frame(plan));
    ASSERT_EQ(brume_plan_update(plan.get(), scene.get(), nullptr), BRUME_OK) << message(context.get());
    expect_same_bits(before, frame(plan));
}

TEST_P(Updates, RefuseNothing)
{
    Scene scene = make_scene(context, foggy);
    Plan plan = make_plan(context, scene, ray_format(width, height));
    expect_status(context.get(), brume_plan_update(plan.get(), nullptr, nullptr), BRUME_ERROR_ARGUMENT, "scene: NULL");
    expect_status(nullptr, brume_plan_update(nullptr, scene.get(), nullptr), BRUME_ERROR_ARGUMENT, "plan: NULL");
}
