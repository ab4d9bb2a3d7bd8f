#include "effects/effects.h"

#include <algorithm>
#include <map>

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/names.h"

namespace brume {
namespace {

struct CollectedLog {
    std::vector<std::string> warnings;

    Log log()
    {
        const auto collect = [](void *user, uint32_t level, const char *message) {
            if (level == BRUME_LOG_WARNING)
                static_cast<CollectedLog *>(user)->warnings.push_back(message);
        };
        return {collect, this, BRUME_LOG_DEBUG};
    }
};

std::string file_name(const Effect &effect)
{
    return effect.file.substr(effect.file.rfind('/') + 1);
}

template <class Function> std::string error_of(brume_status status, Function function)
{
    try {
        function();
    } catch (const Error &error) {
        EXPECT_EQ(error.status(), status) << error.what();
        return error.what();
    }
    ADD_FAILURE() << "nothing was thrown";
    return "";
}

class EffectsTest : public testing::Test {
protected:
    void SetUp() override { registry.load({BRUME_TEST_PLUGIN_DIR}, collected.log()); }

    const Effect &from_file(const std::string &name) const
    {
        const auto found = std::find_if(registry.all().begin(), registry.all().end(),
                                        [&](const Effect &effect) { return file_name(effect) == name; });
        if (found == registry.all().end())
            throw std::runtime_error(name + " was not loaded");
        return *found;
    }

    CollectedLog collected;
    EffectRegistry registry;
};

TEST_F(EffectsTest, TakesAGoodPlugin)
{
    const Effect &effect = registry.find("well_behaved");
    EXPECT_EQ(effect.refusal, "");
    EXPECT_EQ(effect.file, BRUME_TEST_PLUGIN_DIR "/well_behaved.so");
    EXPECT_EQ(effect.order, 200);
    ASSERT_NE(effect.table, nullptr);
    ASSERT_EQ(effect.parameters.size(), 4u);
    EXPECT_EQ(effect.parameters[0].unit, "stops");
    EXPECT_EQ(effect.parameters[2].maximum, 1.0);
    EXPECT_EQ(effect.parameters[3].choices, (std::vector<std::string>{"paper", "reference"}));
    EXPECT_EQ(effect.parameters[3].maximum, 1.0);
}

TEST_F(EffectsTest, TakesPluginsThatMisbehaveLater)
{
    for (const char *name : {"throws_in_plan", "throws_in_execute", "throws_int_in_execute", "throws_in_rows",
                             "throws_in_destroy", "throws_int_in_destroy", "nonsense_status", "nonsense_status_in_plan",
                             "fails_without_message", "plan_without_entry"})
        EXPECT_EQ(registry.find(name).refusal, "") << name;
}

TEST_F(EffectsTest, RefusesWithTheReason)
{
    const std::string effect_size = std::to_string(sizeof(brume_effect));
    const std::map<std::string, std::string> refusals{
        {"missing_symbol", "does not export brume_plugin_effect"},
        {"wrong_abi", "made for plugin ABI 100; this library knows ABI 2"},
        {"null_table", "brume_plugin_effect returned NULL: it cannot work with plugin ABI 2"},
        {"throws_in_entry", "brume_plugin_effect threw an exception: \"thrown in entry\""},
        {"throws_int_in_entry", "brume_plugin_effect threw something that is not a std::exception"},
        {"struct_size_zero", "effect.struct_size: 0; expected " + effect_size},
        {"struct_size_huge", "effect.struct_size: 4294967295; expected " + effect_size},
        {"unknown_fields", "effect: uses fields that this library does not know (" +
                               std::to_string(sizeof(brume_effect) + 8) + " bytes; expected " + effect_size + ")"},
        {"bad_name", "effect.name: \"Bad Name\"; expected [a-z][a-z0-9_]*, at most 63 bytes"},
        {"null_name", "effect.name: NULL; expected a string"},
        {"null_help", "effect.help: NULL; expected a string"},
        {"two_lines", "effect.help: \"One line?and another\"; expected one line"},
        {"endless_help", "effect.help: longer than 4095 bytes"},
        {"not_utf8", "effect.help: \"caf?\"; expected UTF-8"},
        {"null_execute", "effect.execute: NULL; expected a function"},
        {"bad_thread_safety", "effect.thread_safety: 7; expected a BRUME_THREADS_... of this library"},
        {"bad_wanted", "effect.wanted: 7; expected a BRUME_WANTED_... of this library"},
        {"billion_parameters", "parameters: 1000000000 of them; expected at most 256"},
        {"null_parameters", "parameters: NULL; expected 2 of them"},
        {"null_parameter_name", "parameters[1].name: NULL; expected a string"},
        {"duplicate_parameter", "parameters[1].name: \"first\"; another parameter has that name"},
        {"nan_default", "parameter \"second\": range 0 to 1, default nan; expected finite numbers"},
        {"default_out_of_range", "parameter \"second\": default 2; expected one in the range 0 to 1"},
        {"infinite_range", "parameter \"second\": range 0 to inf, default 0.5; expected finite numbers"},
        {"half_integer", "parameter \"second\": range 0 to 1, default 0.5; expected integers"},
        {"bad_type", "parameter \"second\".type: 99; expected a BRUME_PARAMETER_... of this library"},
        {"empty_choice", "parameter \"second\".choices: \"paper||reference\"; expected words of letters, digits and _-+. "
                         "with | between them"},
        {"choice_twice", "parameter \"second\".choices: \"paper|paper\"; \"paper\" is there twice"},
        {"default_choice_missing", "parameter \"second\": default 2; expected one in the range 0 to 1"},
        {"choices_of_number", "parameter \"second\".choices: \"paper|reference\"; expected \"\" for a parameter that is "
                              "no choice"},
        {"bad_stride", "parameters[1].struct_size: 7; expected " + std::to_string(sizeof(brume_parameter_info))},
        {"too_many_layers", "layers: 65 of them; expected at most 64"},
        {"null_layers", "layers: NULL; expected 2 of them"},
        {"null_layer_name", "layers[1].name: NULL; expected a string"},
        {"bad_layer_name", "layers[1].name: \"Depth Of Field\"; expected [a-z][a-z0-9_]*, at most 63 bytes"},
        {"null_layer_help", "layers[1].help: NULL; expected a string"},
        {"layer_without_direction", "layers[1].flags: 0x0; expected one of BRUME_LAYER_INPUT and BRUME_LAYER_OUTPUT"},
        {"layer_of_both_directions", "layers[1].flags: 0x3; expected one of BRUME_LAYER_INPUT and BRUME_LAYER_OUTPUT"},
        {"unknown_layer_flag", "layers[1].flags: 0x102; expected BRUME_LAYER_... flags of this library"},
        {"needed_output", "layers[1].flags: 0x6; expected BRUME_LAYER_NEEDED of inputs only"},
        {"layer_of_two_channels", "layers[1].channels: 2; expected 1 or 3"},
        {"duplicate_layer", "layers[1].name: \"normals\"; another layer has that name"},
        {"bad_layer_stride", "layers[1].struct_size: 12; expected " + std::to_string(sizeof(brume_layer_info))},
        {"too_many_makes", "makes: 65 of them; expected at most 64"},
        {"null_makes", "makes: NULL; expected at most 64"},
        {"null_make", "makes[1]: NULL; expected a string"},
        {"bad_make", "makes[1]: \"Second\"; expected [a-z][a-z0-9_]*, at most 63 bytes"},
        {"make_twice", "makes[1]: \"first_product\" is there twice"},
        {"too_many_uses", "uses: 65 of them; expected at most 64"},
        {"null_use", "uses[1]: NULL; expected a string"},
        {"use_twice", "uses[1]: \"density\" is there twice"},
        {"well_behaved_again",
         "the effect \"well_behaved\" is there already, from " BRUME_TEST_PLUGIN_DIR "/well_behaved.so"},
    };
    for (const auto &[name, refusal] : refusals) {
        const Effect &effect = from_file(name + ".so");
        EXPECT_EQ(effect.refusal, refusal) << name;
        EXPECT_EQ(effect.name, name + ".so");
        EXPECT_EQ(effect.table, nullptr);
        EXPECT_TRUE(effect.parameters.empty());
        const std::string warning = "plugin " + effect.file + " refused: " + refusal;
        EXPECT_EQ(std::count(collected.warnings.begin(), collected.warnings.end(), warning), 1) << warning;
    }
    EXPECT_EQ(from_file("empty.so").refusal.rfind("cannot be loaded: ", 0), 0u) << from_file("empty.so").refusal;
    EXPECT_EQ(collected.warnings.size(), refusals.size() + 1);
}

TEST_F(EffectsTest, LoadsInOrderOfFileNames)
{
    std::vector<std::string> files;
    for (const Effect &effect : registry.all())
        files.push_back(effect.file);
    EXPECT_TRUE(std::is_sorted(files.begin(), files.end()));
}

TEST_F(EffectsTest, LoadsAgainAndUnloads)
{
    for (int i = 0; i < 3; ++i) {
        EffectRegistry other;
        other.load({BRUME_TEST_PLUGIN_DIR}, {});
        EXPECT_EQ(other.all().size(), registry.all().size());
    }
    EXPECT_EQ(registry.find("well_behaved").table->abi, BRUME_PLUGIN_ABI);
}

TEST(Effects, MissingAndRelativeDirectoriesAreWarnedOf)
{
    CollectedLog collected;
    EffectRegistry registry;
    registry.load({"/nowhere/at/all", "relative"}, collected.log());
    EXPECT_TRUE(registry.all().empty());
    EXPECT_EQ(collected.warnings,
              (std::vector<std::string>{"plugin directory \"/nowhere/at/all\": No such file or directory",
                                        "plugin directory \"relative\": expected an absolute path"}));
}

TEST_F(EffectsTest, FindNamesTheNearest)
{
    EXPECT_EQ(error_of(BRUME_ERROR_NOT_FOUND, [&] { registry.find("wel_behaved"); }),
              "no effect \"wel_behaved\"; did you mean \"well_behaved\"?");
    EXPECT_EQ(error_of(BRUME_ERROR_NOT_FOUND, [&] { registry.find("wrong_abi"); }),
              "no effect \"wrong_abi\": the plugin " BRUME_TEST_PLUGIN_DIR
              "/wrong_abi.so was refused: made for plugin ABI 100; this library knows ABI 2");
    EXPECT_EQ(error_of(BRUME_ERROR_NOT_FOUND, [] { EffectRegistry().find("fog"); }), "no effect \"fog\"");
}

TEST_F(EffectsTest, FindsParameters)
{
    const Effect &effect = registry.find("well_behaved");
    EXPECT_EQ(find_parameter(effect, "masking"), 2u);
    EXPECT_EQ(error_of(BRUME_ERROR_NOT_FOUND, [&] { find_parameter(effect, "level"); }),
              "effect \"well_behaved\" has no parameter \"level\"; did you mean \"levels\"?");
    EXPECT_EQ(error_of(BRUME_ERROR_NOT_FOUND, [&] { find_parameter(effect, "colour"); }),
              "effect \"well_behaved\" has no parameter \"colour\"; expected one of strength, levels, masking, kernel");
}

TEST_F(EffectsTest, ParametersFromText)
{
    const Effect &effect = registry.find("well_behaved");
    const auto parse = [&](size_t index, const char *text) {
        return parameter_from_text(effect, effect.parameters[index], text);
    };
    EXPECT_EQ(parse(0, "2.5e0"), 2.5);
    EXPECT_EQ(parse(1, "12"), 12.0);
    EXPECT_EQ(parse(2, "true"), 1.0);
    EXPECT_EQ(parse(2, "false"), 0.0);
    EXPECT_EQ(parse(3, "reference"), 1.0);

    const std::tuple<size_t, const char *, const char *> bad[] = {
        {0, "", "strength: \"\"; expected a number from 0 to 10"},
        {0, "1x", "strength: \"1x\"; expected a number from 0 to 10"},
        {0, " 1", "strength: \" 1\"; expected a number from 0 to 10"},
        {0, "nan", "strength: nan; expected a number from 0 to 10"},
        {0, "inf", "strength: inf; expected a number from 0 to 10"},
        {0, "-1", "strength: -1; expected a number from 0 to 10"},
        {0, "1e999", "strength: \"1e999\"; expected a number from 0 to 10"},
        {1, "2.5", "levels: 2.5; expected an integer from 1 to 12"},
        {1, "13", "levels: 13; expected an integer from 1 to 12"},
        {2, "1", "masking: \"1\"; expected true or false"},
        {3, "papr", "kernel: \"papr\"; expected one of paper, reference"},
    };
    for (const auto &[index, text, message] : bad)
        EXPECT_EQ(error_of(BRUME_ERROR_ARGUMENT, [&, i = index, t = text] { parse(i, t); }),
                  std::string("well_behaved.") + message);
}

TEST_F(EffectsTest, ParametersFromNumbers)
{
    const Effect &effect = registry.find("well_behaved");
    const auto check = [&](size_t index, double value) {
        return parameter_from_number(effect, effect.parameters[index], value);
    };
    EXPECT_EQ(check(0, 10.0), 10.0);
    EXPECT_EQ(check(2, 1.0), 1.0);
    EXPECT_EQ(check(3, 0.0), 0.0);
    EXPECT_EQ(error_of(BRUME_ERROR_ARGUMENT, [&] { check(2, 0.5); }), "well_behaved.masking: 0.5; expected true or false");
    EXPECT_EQ(error_of(BRUME_ERROR_ARGUMENT, [&] { check(3, 2.0); }),
              "well_behaved.kernel: 2; expected one of paper, reference");
}

TEST(Effects, NearestName)
{
    const std::vector<std::string> names{"scattering", "absorption", "g"};
    EXPECT_EQ(nearest_name("scatering", names), "scattering");
    EXPECT_EQ(nearest_name("Absorbtion", names), "absorption");
    EXPECT_EQ(nearest_name("G", names), "g");
    EXPECT_EQ(nearest_name("visibility", names), "");
    EXPECT_EQ(nearest_name(std::string(1 << 20, 'g'), names), "");
}

}  // namespace
}  // namespace brume
