// Introspection of effects and their parameters, and setting them.
#include <map>
#include <set>
#include <sstream>

#include "client.h"

using namespace client;

namespace {

class Parameters : public testing::Test {
protected:
    Context context = make_context();
    Scene scene = make_scene(context, R"({"brume": 1})");

    // Calls function(effect, parameter) for every parameter of every effect.
    template <class Function> void for_each(Function function)
    {
        for (uint32_t i = 0; i < brume_effect_count(context.get()); ++i) {
            brume_effect_info effect = BRUME_EFFECT_INFO_INIT;
            ASSERT_EQ(brume_effect_get_info(context.get(), i, &effect), BRUME_OK);
            for (uint32_t k = 0; k < effect.parameter_count; ++k) {
                brume_parameter_info parameter = BRUME_PARAMETER_INFO_INIT;
                ASSERT_EQ(brume_parameter_get_info(context.get(), effect.name, k, &parameter), BRUME_OK);
                SCOPED_TRACE(std::string(effect.name) + "." + parameter.name);
                function(effect, parameter);
            }
        }
    }
    brume_status set(const brume_effect_info &effect, const brume_parameter_info &parameter, const std::string &text)
    {
        return brume_scene_set_text(scene.get(), effect.name, parameter.name, text.c_str());
    }
    brume_status set(const brume_effect_info &effect, const brume_parameter_info &parameter, double number)
    {
        return brume_scene_set_number(scene.get(), effect.name, parameter.name, number);
    }
};

std::vector<std::string> split(const std::string &text)
{
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, '|');)
        parts.push_back(part);
    return parts;
}

std::string written(double number)
{
    std::ostringstream stream;
    stream.precision(17);
    stream << number;
    return stream.str();
}

}  // namespace

TEST_F(Parameters, EffectsAreComplete)
{
    ASSERT_GE(brume_effect_count(context.get()), 1u);
    for (uint32_t i = 0; i < brume_effect_count(context.get()); ++i) {
        brume_effect_info effect = BRUME_EFFECT_INFO_INIT;
        ASSERT_EQ(brume_effect_get_info(context.get(), i, &effect), BRUME_OK);
        EXPECT_EQ(effect.refusal, nullptr) << effect.refusal;
        EXPECT_STRNE(effect.name, "");
        EXPECT_STRNE(effect.help, "");
        EXPECT_EQ(effect.file[0], '/');
        brume_parameter_info past = BRUME_PARAMETER_INFO_INIT;
        expect_status(context.get(), brume_parameter_get_info(context.get(), effect.name, effect.parameter_count, &past),
                      BRUME_ERROR_ARGUMENT, "index");
    }
    brume_effect_info past = BRUME_EFFECT_INFO_INIT;
    expect_status(context.get(), brume_effect_get_info(context.get(), brume_effect_count(context.get()), &past),
                  BRUME_ERROR_ARGUMENT, "index");
}

TEST_F(Parameters, AreComplete)
{
    std::set<std::string> names;
    for_each([&](auto &effect, auto &p) {
        EXPECT_TRUE(names.insert(std::string(effect.name) + "." + p.name).second);
        EXPECT_STRNE(p.help, "");
        EXPECT_EQ(std::string(p.help).find('\n'), std::string::npos);
        EXPECT_NE(p.unit, nullptr);
        ASSERT_NE(p.choices, nullptr);
        const auto choices = split(p.choices);
        if (p.type == BRUME_PARAMETER_CHOICE) {
            EXPECT_GE(choices.size(), 2u);
            EXPECT_EQ(p.default_number, std::floor(p.default_number));
            EXPECT_LT(p.default_number, double(choices.size()));
            EXPECT_EQ(std::set<std::string>(choices.begin(), choices.end()).size(), choices.size());
        } else {
            EXPECT_TRUE(choices.empty());
        }
        if (p.type == BRUME_PARAMETER_NUMBER || p.type == BRUME_PARAMETER_INTEGER) {
            EXPECT_LE(p.minimum, p.default_number);
            EXPECT_LE(p.default_number, p.maximum);
            EXPECT_LT(p.minimum, p.maximum);
        }
        EXPECT_LE(p.type, BRUME_PARAMETER_CHOICE);
    });
    EXPECT_GE(names.size(), 10u);
}

TEST_F(Parameters, TakeWhatTheyDescribe)
{
    for_each([&](auto &effect, auto &p) {
        EXPECT_EQ(set(effect, p, p.default_number), BRUME_OK) << message(context.get());
        if (p.type == BRUME_PARAMETER_CHOICE) {
            for (const std::string &choice : split(p.choices))
                EXPECT_EQ(set(effect, p, choice), BRUME_OK) << message(context.get());
        } else if (p.type == BRUME_PARAMETER_BOOLEAN) {
            for (const char *text : {"true", "false"})
                EXPECT_EQ(set(effect, p, text), BRUME_OK) << message(context.get());
            for (double number : {0.0, 1.0})
                EXPECT_EQ(set(effect, p, number), BRUME_OK) << message(context.get());
        } else {
            for (double number : {p.minimum, p.default_number, p.maximum}) {
                EXPECT_EQ(set(effect, p, number), BRUME_OK) << message(context.get());
                EXPECT_EQ(set(effect, p, written(number)), BRUME_OK) << message(context.get());
            }
        }
    });
}

TEST_F(Parameters, RefuseTheRest)
{
    for_each([&](auto &effect, auto &p) {
        const std::string named = std::string(effect.name) + "." + p.name;
        const auto refuse = [&](auto value) {
            expect_status(context.get(), set(effect, p, value), BRUME_ERROR_ARGUMENT, named);
            EXPECT_NE(message(context.get()).find("expected"), std::string::npos);
        };
        refuse(std::string(""));
        refuse(std::string("perhaps"));
        refuse(std::string("1 "));
        refuse(double(NAN));
        refuse(double(INFINITY));
        if (p.type == BRUME_PARAMETER_NUMBER || p.type == BRUME_PARAMETER_INTEGER) {
            refuse(p.maximum + std::max(1.0, std::abs(p.maximum)));
            refuse(p.minimum - 1);
            refuse(std::string("nan"));
        }
        if (p.type != BRUME_PARAMETER_NUMBER)
            refuse(0.5);
        if (p.type == BRUME_PARAMETER_CHOICE)
            refuse(double(split(p.choices).size()));
        if (p.type == BRUME_PARAMETER_BOOLEAN)
            refuse(2.0);
    });
}

TEST_F(Parameters, UnknownNamesNameTheNearest)
{
    const auto not_found = [&](brume_status status, const char *nearest) {
        expect_status(context.get(), status, BRUME_ERROR_NOT_FOUND, nearest);
    };
    brume_parameter_info info = BRUME_PARAMETER_INFO_INIT;
    not_found(brume_scene_set_text(scene.get(), "multiscater", nullptr, nullptr), "multiscatter");
    not_found(brume_scene_set_text(scene.get(), "multiscatter", "methd", "paper"), "method");
    not_found(brume_scene_set_number(scene.get(), "multiscatter", "level", 1), "levels");
    not_found(brume_scene_set_number(scene.get(), "zzz", "levels", 1), "multiscatter");
    not_found(brume_parameter_get_info(context.get(), "multiscatterr", 0, &info), "multiscatter");
    expect_status(context.get(), brume_scene_set_text(scene.get(), "multiscatter", "kernel", "papre"), BRUME_ERROR_ARGUMENT,
                  "paper");
}

// Names of before go on naming the same; tables have them beside the new ones.
TEST_F(Parameters, AliasesNameTheSame)
{
    const auto result_of = [&](const char *parameter, const char *value) {
        Scene fog = make_scene(context, foggy);
        EXPECT_EQ(brume_scene_set_text(fog.get(), "multiscatter", parameter, value), BRUME_OK) << message(context.get());
        Plan plan = make_plan(context, fog, ray_format(40, 30));
        Picture color(40, 30), depth(40, 30, {.channels = 1}), output(40, 30);
        paint(color);
        paint_depth(depth);
        EXPECT_EQ(execute(plan.get(), color, depth, output), BRUME_OK) << message(context.get());
        return output.memory();
    };
    EXPECT_EQ(result_of("kernel", "paper"), result_of("method", "paper"));
    EXPECT_NE(result_of("kernel", "paper"), result_of("lobes", "second"));
    EXPECT_EQ(brume_scene_set_number(scene.get(), "airlight", "tier", 0), BRUME_OK) << message(context.get());
    std::map<std::string, std::string> aliases;
    for_each([&](const brume_effect_info &effect, const brume_parameter_info &parameter) {
        if (*parameter.alias)
            aliases[effect.name + std::string(".") + parameter.name] = parameter.alias;
    });
    EXPECT_EQ(aliases, (std::map<std::string, std::string>{{"multiscatter.method", "kernel"}, {"airlight.method", "tier"}}));
}

// Text and number are two ways to the same value: plans made of either give the same bits, and other values other bits.
TEST_F(Parameters, TextAndNumberSetTheSame)
{
    const auto result_of = [&](std::function<void(brume_scene)> change) {
        Scene fog = make_scene(context, foggy);
        brume_scene_set_text(fog.get(), "multiscatter", "kernel", "paper");
        change(fog.get());
        Plan plan = make_plan(context, fog, ray_format(40, 30));
        Picture color(40, 30), depth(40, 30, {.channels = 1}), output(40, 30);
        paint(color);
        paint_depth(depth);
        EXPECT_EQ(execute(plan.get(), color, depth, output), BRUME_OK) << message(context.get());
        return output.memory();
    };
    const auto defaults = result_of([](brume_scene) {});
    EXPECT_EQ(result_of([](brume_scene s) { brume_scene_set_text(s, "multiscatter", nullptr, nullptr); }), defaults);
    const auto by_text = result_of([](brume_scene s) { brume_scene_set_text(s, "multiscatter", "kernel_size", "6x6"); });
    const auto by_number = result_of([](brume_scene s) { brume_scene_set_number(s, "multiscatter", "kernel_size", 2); });
    EXPECT_EQ(by_text, by_number);
    EXPECT_NE(by_text, defaults);
    EXPECT_EQ(result_of([](brume_scene s) { brume_scene_set_text(s, "multiscatter", "masking", "false"); }),
              result_of([](brume_scene s) { brume_scene_set_number(s, "multiscatter", "masking", 0); }));
    EXPECT_EQ(result_of([](brume_scene s) { brume_scene_set_text(s, "multiscatter", "level_scale", "1.25"); }),
              result_of([](brume_scene s) { brume_scene_set_number(s, "multiscatter", "level_scale", 1.25); }));
}
