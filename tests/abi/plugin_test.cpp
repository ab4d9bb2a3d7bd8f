// Effects of strangers through the C ABI: good ones run, bad ones are refused or fail clearly, none takes the host down.
#include <filesystem>
#include <map>
#include <thread>

#include "client.h"

using namespace client;
namespace fs = std::filesystem;

namespace {

Context context_with(const char *directory, uint32_t backend = BRUME_BACKEND_CPU)
{
    brume_context_desc desc = BRUME_CONTEXT_DESC_INIT;
    desc.backend = backend;
    desc.threads = 2;
    desc.plugin_directory = directory;
    return make_context(desc);
}

std::map<std::string, brume_effect_info> effects_of(const Context &context)
{
    std::map<std::string, brume_effect_info> effects;
    for (uint32_t i = 0; i < brume_effect_count(context.get()); ++i) {
        brume_effect_info info = BRUME_EFFECT_INFO_INIT;
        EXPECT_EQ(brume_effect_get_info(context.get(), i, &info), BRUME_OK);
        effects[info.name] = info;
    }
    return effects;
}

std::string scene_with(const std::string &effect)
{
    return R"({"brume": 1, "effects": {")" + effect + R"(": {}}})";
}

class Strangers : public testing::Test {
protected:
    Context context = context_with(BRUME_TEST_PLUGIN_DIR);
    Picture color{16, 12}, depth{16, 12, {.channels = 1}}, output{16, 12};

    // Plans and executes; the first status that is not BRUME_OK.
    brume_status run(const std::string &effect)
    {
        Scene scene = make_scene(context, scene_with(effect));
        const brume_format format = ray_format(16, 12);
        brume_plan made = nullptr;
        if (brume_status status = brume_plan_create(scene.get(), &format, &made))
            return status;
        Plan plan(made);
        return execute(plan.get(), color, depth, output);
    }
};

}  // namespace

TEST_F(Strangers, AGoodOneRuns)
{
    paint(color);
    ASSERT_EQ(run("well_behaved"), BRUME_OK) << message(context.get());
    expect_same_bits(color, output);
    ASSERT_EQ(brume_scene_set_number(make_scene(context, scene_with("well_behaved")).get(), "well_behaved", "strength", 10),
              BRUME_OK);
}

TEST_F(Strangers, BadOnesFailWithAMessage)
{
    struct Case {
        const char *effect;
        brume_status status;
        const char *part;
    };
    const Case cases[] = {
        {"throws_in_plan", BRUME_ERROR_PLUGIN, "thrown in plan"},
        {"throws_in_execute", BRUME_ERROR_PLUGIN, "thrown in execute"},
        {"throws_int_in_execute", BRUME_ERROR_PLUGIN, "threw in execute"},
        {"throws_in_rows", BRUME_ERROR_PLUGIN, "thrown in rows"},
        {"nonsense_status", BRUME_ERROR_PLUGIN, "-123456789"},
        {"nonsense_status_in_plan", BRUME_ERROR_PLUGIN, "-123456789"},
        {"fails_without_message", BRUME_ERROR_UNSUPPORTED, "without a message"},
        {"plan_without_entry", BRUME_ERROR_PLUGIN, "no entry"},
        {"throws_in_destroy", BRUME_OK, ""},
        {"throws_destroying", BRUME_OK, ""},
        {"throws_int_destroying", BRUME_OK, ""},
        {"throws_destroying_and_planning", BRUME_ERROR_PLUGIN, "thrown in plan"},
        {"throws_settling", BRUME_ERROR_PLUGIN, "threw in settle: thrown in settle"},
        {"throws_choosing", BRUME_ERROR_PLUGIN, "threw in uses_with"},
        {"uses_nothing", BRUME_OK, ""},
    };
    Context both = context_with(BRUME_ODD_EFFECT_DIR);
    for (const Case &c : cases) {
        SCOPED_TRACE(c.effect);
        const bool odd = effects_of(both).count(c.effect) != 0;
        std::swap(context, odd ? both : context);
        const brume_status status = run(c.effect);
        expect_status(context.get(), status, c.status, c.part);
        if (status) {
            EXPECT_NE(message(context.get()).find(c.effect), std::string::npos) << message(context.get());
        }
        // The context is as good as before.
        if (!odd) {
            paint(color);
            EXPECT_EQ(run("well_behaved"), BRUME_OK) << message(context.get());
        }
        std::swap(context, odd ? both : context);
    }
}

// Neither odd effect reads it, but one names it among what it may use.
TEST_F(Strangers, ProductsThatNobodyUsesAreNotMade)
{
    context = context_with(BRUME_ODD_EFFECT_DIR);
    auto makes_density = [&](const std::string &effect) {
        Scene scene =
            make_scene(context, R"({"brume": 1, "medium": {"visibility": 10}, "effects": {")" + effect + R"(": {}}})");
        const brume_format format = ray_format(16, 12);
        Plan plan = make_plan(context, scene, format);
        brume_plan_info info = BRUME_PLAN_INFO_INIT;
        EXPECT_EQ(brume_plan_get_info(plan.get(), &info), BRUME_OK);
        for (uint32_t i = 0; i < info.entry_count; ++i) {
            brume_plan_entry entry = BRUME_PLAN_ENTRY_INIT;
            EXPECT_EQ(brume_plan_get_entry(plan.get(), i, &entry), BRUME_OK);
            if (std::string_view(entry.name) == "density")
                return true;
        }
        return false;
    };
    EXPECT_TRUE(makes_density("not_thread_safe"));
    EXPECT_FALSE(makes_density("uses_nothing"));
}

TEST_F(Strangers, RefusalsSayWhy)
{
    const auto effects = effects_of(context);
    const std::pair<const char *, const char *> refused[] = {
        {"wrong_abi.so", "ABI"},
        {"null_table.so", "NULL"},
        {"throws_in_entry.so", "thrown in entry"},
        {"throws_int_in_entry.so", "threw"},
        {"struct_size_zero.so", "struct_size"},
        {"struct_size_huge.so", "struct_size"},
        {"bad_name.so", "name"},
        {"null_name.so", "name"},
        {"null_help.so", "help"},
        {"null_execute.so", "execute"},
        {"unknown_layer_flag.so", "layers[1].flags"},
        {"make_twice.so", "makes[1]"},
        {"use_twice.so", "uses[1]"},
        {"billion_parameters.so", "parameters: 1000000000"},
        {"null_parameters.so", "parameters"},
        {"nan_default.so", "default"},
        {"bad_type.so", "type"},
        {"missing_symbol.so", "brume_plugin_effect"},
        {"empty.so", "cannot be loaded"},
    };
    for (auto [file, part] : refused) {
        ASSERT_TRUE(effects.count(file)) << file;
        const brume_effect_info &info = effects.at(file);
        ASSERT_NE(info.refusal, nullptr) << file;
        EXPECT_NE(std::string(info.refusal).find(part), std::string::npos) << file << ": " << info.refusal;
        EXPECT_EQ(info.parameter_count, 0u);
        EXPECT_EQ(std::string(info.file), std::string(BRUME_TEST_PLUGIN_DIR) + "/" + file);
    }
    // Asking for one by the name of its file says that it is there and was refused.
    Scene scene = make_scene(context, R"({"brume": 1})");
    expect_status(context.get(), brume_scene_set_text(scene.get(), "wrong_abi", nullptr, nullptr), BRUME_ERROR_NOT_FOUND,
                  "refused");
    brume_parameter_info info = BRUME_PARAMETER_INFO_INIT;
    expect_status(context.get(), brume_parameter_get_info(context.get(), "wrong_abi.so", 0, &info), BRUME_ERROR_NOT_FOUND,
                  "wrong_abi");
    EXPECT_EQ(effects.count("multiscatter"), 1u);
    EXPECT_EQ(effects.at("multiscatter").refusal, nullptr);
}

TEST(PluginDirectory, ThatIsNotThereIsNoFailure)
{
    Context context = context_with("/nonexistent/brume/effects");
    EXPECT_EQ(effects_of(context).count("multiscatter"), 1u);
}

// Whoever can write to the working directory must not be able to put code into the host.
TEST(PluginDirectory, IsNeverTheWorkingDirectory)
{
    const fs::path before = fs::current_path(), here = fs::temp_directory_path() / ("brume_cwd_" + std::to_string(getpid()));
    for (const char *folder : {"brume", "lib/brume", "."}) {
        fs::create_directories(here / folder);
        fs::copy_file(fs::path(BRUME_TEST_PLUGIN_DIR) / "well_behaved.so", here / folder / "well_behaved.so");
    }
    fs::current_path(here);
    setenv("BRUME_PLUGIN_PATH", here.c_str(), 1);
    Context context = make_context();
    const auto effects = effects_of(context);
    fs::current_path(before);
    fs::remove_all(here);
    EXPECT_EQ(effects.count("well_behaved"), 0u);
    EXPECT_EQ(effects.count("multiscatter"), 1u);
}

// The effect counts how many of its calls overlap.
TEST(ThreadSafety, UnsafePluginsAreNeverCalledTwiceAtOnce)
{
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i)
        threads.emplace_back([] {
            Context context = context_with(BRUME_ODD_EFFECT_DIR);
            Picture color(16, 12), depth(16, 12, {.channels = 1}), output(16, 12);
            for (int k = 0; k < 20; ++k) {
                Scene scene = make_scene(context, scene_with("not_thread_safe"));
                Plan plan = make_plan(context, scene, ray_format(16, 12));
                EXPECT_EQ(execute(plan.get(), color, depth, output), BRUME_OK) << message(context.get());
            }
        });
    for (std::thread &thread : threads)
        thread.join();
}

// Where a plan has dropped an effect it is asked again for each other medium, but for what Gaussians do, and of those it
// then sees one.
TEST(Sleepers, AreAskedAgainForAnotherMediumOnly)
{
    Context context = context_with(BRUME_ODD_EFFECT_DIR);
    const auto scene = [&](double absorption, int gaussians) {
        std::string text =
            R"({"brume": 1, "camera": {"vertical_fov": 50, "camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]},
            "effects": {"sleeper": {}}, "medium": {"absorption": )" +
            std::to_string(absorption) + R"(, "density": [)";
        for (int i = 0; i < gaussians; ++i)
            text += (i ? "," : "") + std::string(R"({"type": "gaussian", "scale": 1, "amplitude": 1, "center": [0, 0, -)") +
                    std::to_string(2 + i) + "]}";
        return make_scene(context, text + "]}}");
    };
    const auto plans = [&] {
        Scene same = scene(0.1, 1);
        Plan plan = make_plan(context, same, ray_format(16, 12));
        brume_plan_entry entry = BRUME_PLAN_ENTRY_INIT;
        EXPECT_EQ(brume_plan_get_entry(plan.get(), 0, &entry), BRUME_OK);
        return std::stoi(entry.reason);
    };
    Scene first = scene(0.1, 1);
    Plan plan = make_plan(context, first, ray_format(16, 12));
    const auto update = [&](double absorption, int gaussians) {
        Scene next = scene(absorption, gaussians);
        return brume_plan_update(plan.get(), next.get(), nullptr);
    };
    const int before = plans();
    for (int i = 0; i < 5; ++i)
        EXPECT_EQ(update(0.1, 100 + 20 * i), BRUME_OK) << message(context.get());
    EXPECT_EQ(plans(), before + 1);
    for (int i = 0; i < 5; ++i)
        EXPECT_EQ(update(0.2 + 0.01 * i, 200), BRUME_OK) << message(context.get());
    EXPECT_EQ(plans(), before + 2 + 5);
    expect_status(context.get(), update(0.6, 200), BRUME_ERROR_FORMAT, "sleeper: dropped when planned, it would run now");
}

// A calibration measures what strangers' effects do, too, and goes on where one cannot be planned.
TEST(Calibration, MeasuresStrangers)
{
    Context context = context_with(BRUME_TEST_PLUGIN_DIR);
    ASSERT_EQ(brume_context_calibrate(context.get()), BRUME_OK) << message(context.get());
    std::string text(brume_context_calibration(context.get(), nullptr, 0), '\0');
    brume_context_calibration(context.get(), text.data(), text.size());
    for (const char *pass :
         {"well_behaved/copy", "surface/compose", "surface/transfer", "airlight/gather", "multiscatter/compose"})
        EXPECT_NE(text.find(std::string("\"") + pass + "\""), std::string::npos) << pass << " in " << text;
}

// What lies behind an older header's entry is not counted.
TEST_F(Strangers, OfAnOlderHeaderCountWhatTheyKnow)
{
    Scene scene = make_scene(context, scene_with("well_behaved"));
    Plan plan = make_plan(context, scene, ray_format(16, 12));
    brume_plan_entry entry = BRUME_PLAN_ENTRY_INIT;
    ASSERT_EQ(brume_plan_get_entry(plan.get(), 0, &entry), BRUME_OK);
    EXPECT_STREQ(entry.name, "copy");
    EXPECT_EQ(entry.operations, 7u);
}

// Effects run one after the other by their order, each on what the one before left.
TEST_F(Strangers, RunInOrderAfterOurs)
{
    Scene scene = make_scene(context, R"({"brume": 1, "camera": {"vertical_fov": 50}, "medium": {"scattering": 0.05},
        "effects": {"well_behaved": {}, "multiscatter": {}}})");
    Scene alone = make_scene(context, R"({"brume": 1, "camera": {"vertical_fov": 50}, "medium": {"scattering": 0.05}})");
    Plan plan = make_plan(context, scene, ray_format(16, 12)), plan_alone = make_plan(context, alone, ray_format(16, 12));
    brume_plan_info info = BRUME_PLAN_INFO_INIT;
    ASSERT_EQ(brume_plan_get_info(plan.get(), &info), BRUME_OK);
    brume_plan_entry last = BRUME_PLAN_ENTRY_INIT;
    ASSERT_EQ(brume_plan_get_entry(plan.get(), info.entry_count - 1, &last), BRUME_OK);
    EXPECT_STREQ(last.effect, "well_behaved");
    paint(color);
    paint_depth(depth);
    Picture expected(16, 12);
    ASSERT_EQ(execute(plan.get(), color, depth, output), BRUME_OK) << message(context.get());
    ASSERT_EQ(execute(plan_alone.get(), color, depth, expected), BRUME_OK) << message(context.get());
    expect_same_bits(expected, output);
}

// An effect of a stranger's makes an image, another one adds it to the picture.
class MadeByEffects : public EachBackend {
protected:
    void SetUp() override
    {
        EachBackend::SetUp();
        if (context)
            context = context_with(BRUME_TEST_PLUGIN_DIR, GetParam());
        paint(color);
    }
    Plan planned(const std::string &effects)
    {
        return make_plan(context, make_scene(context, R"({"brume": 1, "effects": {)" + effects + "}}"), ray_format(16, 12));
    }
    static std::vector<std::string> entries(const Plan &plan)
    {
        brume_plan_info info = BRUME_PLAN_INFO_INIT;
        EXPECT_EQ(brume_plan_get_info(plan.get(), &info), BRUME_OK);
        std::vector<std::string> entries;
        for (uint32_t i = 0; i < info.entry_count; ++i) {
            brume_plan_entry entry = BRUME_PLAN_ENTRY_INIT;
            EXPECT_EQ(brume_plan_get_entry(plan.get(), i, &entry), BRUME_OK);
            entries.push_back(std::string(entry.effect) + ": " + entry.reason);
        }
        return entries;
    }
    void expect_added(const Plan &plan, float share)
    {
        ASSERT_EQ(execute(plan.get(), color, depth, output), BRUME_OK) << message(context.get());
        for (int y = 0; y < 12; ++y)
            for (int x = 0; x < 16; ++x)
                for (int c = 0; c < 4; ++c)
                    ASSERT_EQ(output.get(x, y, c), color.get(x, y, c) + (c < 3 ? share * color.get(x, y, 0) : 0))
                        << x << ", " << y << ", " << c;
    }

    Picture color{16, 12}, depth{16, 12, {.channels = 1}}, output{16, 12};
};
INSTANTIATE_EACH_BACKEND(MadeByEffects);

TEST_P(MadeByEffects, ProductsReachThoseThatUseThem)
{
    const Plan plan = planned(R"("uses_shade": {}, "makes_shade": {"share": 0.5})");
    EXPECT_EQ(entries(plan), (std::vector<std::string>{"makes_shade: shade is asked for", "uses_shade: shade is made"}));
    expect_added(plan, 0.5f);
    // That of this frame, not of the one before.
    for (int x = 0; x < 16; ++x)
        color.set(x, 5, 0, float(x));
    expect_added(plan, 0.5f);
}

TEST_P(MadeByEffects, ProductsThatNobodyMakesHaveNoImages)
{
    const Plan alone = planned(R"("uses_shade": {})");
    EXPECT_EQ(entries(alone), std::vector<std::string>{"uses_shade: nobody makes shade"});
    expect_added(alone, 0);
    const Plan dropped = planned(R"("uses_shade": {}, "makes_shade": {"share": 0})");
    EXPECT_EQ(entries(dropped).back(), "uses_shade: nobody makes shade");
    expect_added(dropped, 0);
}

TEST_P(MadeByEffects, NoOtherProductsMayBePublished)
{
    const Plan plan = planned(R"("makes_shade": {"strays": true})");
    expect_status(context.get(), execute(plan.get(), color, depth, output), BRUME_ERROR_ARGUMENT,
                  "publish: gloom is not among what the effect's table says it makes");
}

#ifdef BRUME_GL
TEST(ThirdParty, CpuOnlyEffectOnGlSaysSo)
{
    Context context;
    try {
        context = context_with(BRUME_TEST_PLUGIN_DIR, BRUME_BACKEND_GL);
    } catch (const std::runtime_error &error) {
        GTEST_SKIP() << error.what();
    }
    Scene scene = make_scene(context, scene_with("well_behaved"));
    const brume_format format = ray_format(4, 4);
    brume_plan plan = nullptr;
    expect_status(context.get(), brume_plan_create(scene.get(), &format, &plan), BRUME_ERROR_UNSUPPORTED,
                  "CPU backend only");
}
#endif
