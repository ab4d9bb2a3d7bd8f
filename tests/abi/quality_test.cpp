// Quality and calibration through the C ABI.
#include "client.h"

using namespace client;

namespace {

brume_quality quality(uint32_t preset, double max_error = 0, double budget_ms = 0)
{
    brume_quality q = BRUME_QUALITY_INIT;
    q.preset = preset;
    q.max_error = max_error;
    q.budget_ms = budget_ms;
    return q;
}

std::string calibration(const Context &context)
{
    std::string text(brume_context_calibration(context.get(), nullptr, 0), '\0');
    brume_context_calibration(context.get(), text.data(), text.size());
    text.pop_back();
    return text;
}

}  // namespace

TEST(Quality, IsWhatWasSetAndOneThingAtATime)
{
    Context context = make_context();
    Scene scene = make_scene(context, foggy);
    brume_quality got = BRUME_QUALITY_INIT;
    ASSERT_EQ(brume_scene_get_quality(scene.get(), &got), BRUME_OK);
    EXPECT_EQ(got.preset, BRUME_PRESET_NONE);
    brume_quality asked = quality(BRUME_PRESET_NONE, 0.2);
    asked.transmittance = 0.5;
    asked.detail = 2;
    ASSERT_EQ(brume_scene_set_quality(scene.get(), &asked), BRUME_OK);
    ASSERT_EQ(brume_scene_get_quality(scene.get(), &got), BRUME_OK);
    EXPECT_EQ(got.max_error, 0.2);
    EXPECT_EQ(got.transmittance, 0.5);
    EXPECT_EQ(got.detail, 2.0);

    Plan plan = make_plan(context, scene, ray_format(64, 48));
    brume_plan_info info = BRUME_PLAN_INFO_INIT;
    ASSERT_EQ(brume_plan_get_info(plan.get(), &info), BRUME_OK);
    EXPECT_EQ(std::string(info.quality).rfind("max_error 0.2: multiscatter ", 0), 0u) << info.quality;
    EXPECT_GT(info.predicted_error, 0);
    EXPECT_LE(info.predicted_error, 0.2);

    auto refused = [&](const brume_quality &q, const std::string &named) {
        expect_status(context.get(), brume_scene_set_quality(scene.get(), &q), BRUME_ERROR_ARGUMENT, named);
    };
    refused(quality(9), "preset");
    refused(quality(BRUME_PRESET_NONE, -1), "max_error: -1");
    refused(quality(BRUME_PRESET_NONE, NAN), "max_error");
    refused(quality(BRUME_PRESET_NONE, 0, -1), "budget_ms: -1");
    refused(quality(BRUME_PRESET_DRAFT, 0.1), "expected one of them");
    asked = quality(BRUME_PRESET_NONE, 0.2);
    asked.transmittance = 2;
    refused(asked, "transmittance: 2");
    ASSERT_EQ(brume_scene_get_quality(scene.get(), &got), BRUME_OK);
    EXPECT_EQ(got.detail, 2.0) << "what was refused changed nothing";
    EXPECT_EQ(brume_scene_set_quality(scene.get(), nullptr), BRUME_OK);
    EXPECT_EQ(brume_scene_set_quality(nullptr, nullptr), BRUME_ERROR_ARGUMENT);
}

TEST(Calibration, IsTextOfThisDeviceOrRefused)
{
    Context context = make_context();
    EXPECT_EQ(calibration(context), "");
    const std::string good =
        R"({"brume_calibration":2,"library":")" + std::to_string(BRUME_VERSION_MAJOR) + "." +
        std::to_string(BRUME_VERSION_MINOR) + "." + std::to_string(BRUME_VERSION_PATCH) +
        R"(","device":"CPU","threads":2,"passes":{"multiscatter/compose":{"start_ms":0,"ms_per_operation":1}}})";
    auto set = [&](const std::string &text) {
        return brume_context_set_calibration(context.get(), text.data(), text.size());
    };
    ASSERT_EQ(set(good), BRUME_OK) << message(context.get());
    EXPECT_NE(calibration(context).find("multiscatter/compose"), std::string::npos);

    auto with = [&](const std::string &from, const std::string &to) {
        std::string text = good;
        return text.replace(text.find(from), from.size(), to);
    };
    // A millisecond an operation: the plan says so, and what each frame takes besides.
    auto predicted = [&] {
        Scene scene = make_scene(context, foggy);
        Plan plan = make_plan(context, scene, ray_format(64, 48));
        brume_plan_info info = BRUME_PLAN_INFO_INIT;
        EXPECT_EQ(brume_plan_get_info(plan.get(), &info), BRUME_OK);
        return info.predicted_ms;
    };
    const double without_start = predicted();
    EXPECT_GT(without_start, 64 * 48);
    ASSERT_EQ(set(with("\"start_ms\":0", "\"start_ms\":1e6")), BRUME_OK) << message(context.get());
    EXPECT_NEAR(predicted(), without_start + 1e6, 1);
    ASSERT_EQ(set(good), BRUME_OK);

    auto refused = [&](const std::string &text, const std::string &named) {
        expect_status(context.get(), set(text), BRUME_ERROR_ARGUMENT, named);
    };
    refused("", "not a JSON object");
    refused("[1]", "not a JSON object");
    refused(with("\"CPU\"", "\"GPU\""), "calibration.device: \"GPU\"; expected \"CPU\"");
    refused(with("\"threads\":2", "\"threads\":3"), "calibration.threads: 3; expected 2");
    refused(with("\"brume_calibration\":2", "\"brume_calibration\":1"), "calibration.brume_calibration: 1; expected 2");
    refused(with("{\"multiscatter/compose\":{\"start_ms\":0,\"ms_per_operation\":1}}", "{}"), "calibration.passes");
    refused(with("{\"start_ms\":0,\"ms_per_operation\":1}", "1"), "multiscatter/compose.start_ms: null");
    refused(with("\"start_ms\":0", "\"start_ms\":-1"), "multiscatter/compose.start_ms: -1");
    refused(with(":1}}", ":-1}}"), "multiscatter/compose.ms_per_operation: -1");
    refused(with(":1}}", ":\"fast\"}}"), "multiscatter/compose.ms_per_operation: \"fast\"");
    EXPECT_NE(calibration(context).find("multiscatter/compose"), std::string::npos) << "what was refused changed nothing";
    EXPECT_EQ(brume_context_set_calibration(context.get(), nullptr, 0), BRUME_ERROR_ARGUMENT);
    EXPECT_EQ(brume_context_calibrate(nullptr), BRUME_ERROR_ARGUMENT);
    EXPECT_EQ(brume_context_calibration(nullptr, nullptr, 0), 1u);
}
