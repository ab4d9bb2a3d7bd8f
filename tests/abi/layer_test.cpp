// Layers by name: what is listed, what formats and frames may bring and ask for, and what they are told otherwise.
#include <map>

#include "client.h"

using namespace client;

namespace {

constexpr int width = 16, height = 12;

class Layers : public EachBackend {
protected:
    Picture color{width, height}, depth{width, height, {.channels = 1}}, output{width, height},
        tau{width, height, {.channels = 3}}, straight{width, height, {.channels = 3}};

    void SetUp() override
    {
        EachBackend::SetUp();
        paint(color);
        paint_depth(depth);
    }

    std::map<std::string, brume_layer_info> listed(const char *effect)
    {
        std::map<std::string, brume_layer_info> all;
        for (uint32_t i = 0; i < brume_layer_count(context.get(), effect); ++i) {
            brume_layer_info info = BRUME_LAYER_INFO_INIT;
            EXPECT_EQ(brume_layer_get_info(context.get(), effect, i, &info), BRUME_OK) << message(context.get());
            EXPECT_STRNE(info.help, "") << info.name;
            all[info.name] = info;
        }
        return all;
    }

    void format_refused(const std::vector<brume_layer> &outputs, const std::vector<brume_layer> &inputs, brume_status status,
                        const std::string &part)
    {
        Scene scene = make_scene(context, foggy);
        const brume_format format = ray_format(width, height, outputs, inputs);
        brume_plan plan = nullptr;
        expect_status(context.get(), brume_plan_create(scene.get(), &format, &plan), status, part);
        EXPECT_EQ(plan, nullptr);
    }
};
INSTANTIATE_EACH_BACKEND(Layers);

}  // namespace

TEST_P(Layers, AreListed)
{
    const auto of_library = listed(nullptr);
    for (const char *name : {"optical_depth", "transmittance"}) {
        ASSERT_EQ(of_library.count(name), 1u) << name;
        EXPECT_EQ(of_library.at(name).flags, BRUME_LAYER_INPUT) << name;
        EXPECT_EQ(of_library.at(name).channels, 3u) << name;
    }
    const auto of_filter = listed("multiscatter");
    for (const char *name : {"optical_depth", "transmittance", "scattered", "blur_radius"}) {
        ASSERT_EQ(of_filter.count(name), 1u) << name;
        EXPECT_EQ(of_filter.at(name).flags, BRUME_LAYER_OUTPUT) << name;
        EXPECT_EQ(of_filter.at(name).channels, std::string(name) == "blur_radius" ? 1u : 3u) << name;
    }
    const auto of_airlight = listed("airlight");
    ASSERT_EQ(of_airlight.count("light_airlight"), 1u);
    EXPECT_EQ(of_airlight.at("light_airlight").flags, BRUME_LAYER_OUTPUT | BRUME_LAYER_OF_LIGHT);

    brume_layer_info info = BRUME_LAYER_INFO_INIT;
    EXPECT_EQ(brume_layer_count(context.get(), "multiscater"), 0u);
    EXPECT_EQ(brume_layer_count(nullptr, nullptr), 0u);
    expect_status(context.get(), brume_layer_get_info(context.get(), "multiscater", 0, &info), BRUME_ERROR_NOT_FOUND,
                  "did you mean \"multiscatter\"");
    expect_status(context.get(), brume_layer_get_info(context.get(), nullptr, uint32_t(of_library.size()), &info),
                  BRUME_ERROR_ARGUMENT, "index");
    EXPECT_EQ(brume_layer_get_info(nullptr, nullptr, 0, &info), BRUME_ERROR_ARGUMENT);
    EXPECT_EQ(brume_layer_get_info(context.get(), nullptr, 0, nullptr), BRUME_ERROR_ARGUMENT);
}

TEST_P(Layers, FormatsNameThemOnceAndRight)
{
    format_refused({layer("transmitance")}, {}, BRUME_ERROR_UNSUPPORTED,
                   "format.outputs[0]: no effect fills a layer \"transmitance\"; did you mean \"transmittance\"?");
    format_refused({}, {layer("transmittance"), layer("optical_dept")}, BRUME_ERROR_UNSUPPORTED,
                   "format.inputs[1]: no effect reads a layer \"optical_dept\"; did you mean \"optical_depth\"?");
    format_refused({}, {layer("scattered")}, BRUME_ERROR_UNSUPPORTED, "no effect reads a layer \"scattered\"");
    format_refused({}, {layer("optical_depth"), layer("transmittance")}, BRUME_ERROR_ARGUMENT, "expected one of the two");
    format_refused({layer("scattered"), layer("scattered")}, {}, BRUME_ERROR_ARGUMENT,
                   "outputs[1] (scattered): given twice");
    format_refused({}, {layer("optical_depth"), layer("optical_depth")}, BRUME_ERROR_ARGUMENT,
                   "inputs[1] (optical_depth): given twice");
    format_refused({layer(nullptr)}, {}, BRUME_ERROR_ARGUMENT, "outputs[0].name: NULL");
    format_refused({layer("")}, {}, BRUME_ERROR_ARGUMENT, "outputs[0].name: empty");
    brume_layer odd = layer("optical_depth");
    odd.kind = 2;
    format_refused({}, {odd}, BRUME_ERROR_ARGUMENT, "inputs[0].kind: 2; expected a BRUME_LAYER_...");
}

TEST_P(Layers, FramesBringWhatTheFormatNames)
{
    Scene scene = make_scene(context, foggy);
    Plan first = make_plan(context, scene, ray_format(width, height, {layer("optical_depth")}));
    const brume_image tau_image = tau.image(), straight_image = straight.image();
    ASSERT_EQ(execute(first.get(), color, depth, output, {layer("optical_depth", &tau_image)}), BRUME_OK)
        << message(context.get());
    Plan plan = make_plan(
        context, scene, ray_format(width, height, {layer("transmittance"), layer("blur_radius")}, {layer("optical_depth")}));
    using List = std::vector<brume_layer>;
    const auto refused = [&](const List &outputs, const List &inputs, brume_status status, const std::string &part) {
        expect_status(context.get(), execute(plan.get(), color, depth, output, outputs, inputs), status, part);
    };
    const List good{layer("optical_depth", &tau_image)};
    refused({}, {}, BRUME_ERROR_ARGUMENT, "inputs: the layer optical_depth of the plan's format is missing");
    refused({}, {good[0], good[0]}, BRUME_ERROR_ARGUMENT, "inputs[1] (optical_depth): given twice");
    refused({}, {layer("transmittance", &tau_image)}, BRUME_ERROR_ARGUMENT,
            "inputs[0] (transmittance): expected a layer of the plan's format.inputs");
    refused({layer("scattered", &straight_image)}, good, BRUME_ERROR_ARGUMENT,
            "outputs[0] (scattered): expected a layer of the plan's format.outputs");
    refused({}, {layer("optical_depth", nullptr)}, BRUME_ERROR_ARGUMENT, "inputs[0] (optical_depth).image");
    brume_layer changed = good[0];
    changed.kind = BRUME_LAYER_CAMERA;
    refused({}, {changed}, BRUME_ERROR_ARGUMENT, "inputs[0] (optical_depth): kind 1; the plan was made for 0");
    changed = good[0];
    changed.light = 1;
    refused({}, {changed}, BRUME_ERROR_ARGUMENT, "inputs[0] (optical_depth): light 1; expected 0");
    Picture wide(width + 1, height, {.channels = 3});
    const brume_image wide_image = wide.image();
    refused({}, {layer("optical_depth", &wide_image)}, BRUME_ERROR_FORMAT, "optical_depth: 17 x 12");

    Picture two(width, height, {.channels = 2}), radius(width, height, {.channels = 1});
    const brume_image two_image = two.image(), radius_image = radius.image(), output_image = output.image();
    refused({layer("transmittance", &two_image)}, good, BRUME_ERROR_ARGUMENT,
            "outputs[0] (transmittance): 2 channels; expected 3 or 4");
    refused({layer("blur_radius", &straight_image)}, good, BRUME_ERROR_ARGUMENT,
            "outputs[0] (blur_radius): 3 channels; expected 1");
    refused({}, {layer("optical_depth", &output_image)}, BRUME_ERROR_ARGUMENT,
            "inputs[0] (optical_depth): shares memory with output");
    refused({layer("transmittance", &tau_image)}, good, BRUME_ERROR_ARGUMENT,
            "outputs[0] (transmittance): shares memory with optical_depth");
    refused({layer("transmittance", &straight_image), layer("transmittance", &straight_image)}, good, BRUME_ERROR_ARGUMENT,
            "outputs[1] (transmittance): given twice");

    // What was refused left the plan as it was, and all that is good is taken.
    ASSERT_EQ(execute(plan.get(), color, depth, output,
                      {layer("blur_radius", &radius_image), layer("transmittance", &straight_image)}, good),
              BRUME_OK)
        << message(context.get());
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c)
                if (tau.get(x, y, c) < 60) {
                    ASSERT_NEAR(straight.get(x, y, c), std::exp(-tau.get(x, y, c)), 1e-5) << x << ", " << y;
                }
}

// Images of one channel say the same of all three colours; colour itself may be a layer, too.
TEST_P(Layers, GreyInputsAreSpread)
{
    Scene scene = make_scene(context, absorbing);
    Plan plan = make_plan(context, scene, ray_format(width, height, {}, {layer("transmittance")}));
    Picture grey(width, height, {.channels = 1}), rgb(width, height, {.channels = 3}), other(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            grey.set(x, y, 0, 1 - 0.05f * float(x));
            for (int c = 0; c < 3; ++c)
                rgb.set(x, y, c, grey.get(x, y, 0));
        }
    const brume_image grey_image = grey.image(), rgb_image = rgb.image(), color_image = color.image();
    ASSERT_EQ(execute(plan.get(), color, depth, output, {}, {layer("transmittance", &grey_image)}), BRUME_OK)
        << message(context.get());
    ASSERT_EQ(execute(plan.get(), color, depth, other, {}, {layer("transmittance", &rgb_image)}), BRUME_OK)
        << message(context.get());
    expect_same_bits(output, other);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(output.get(x, y, c), color.get(x, y, c) * grey.get(x, y, 0), 1e-5 * (1 + color.get(x, y, c)))
                    << x << ", " << y;
    EXPECT_EQ(execute(plan.get(), color, depth, output, {}, {layer("transmittance", &color_image)}), BRUME_OK)
        << message(context.get());
}

// Where nothing reads an input the plan says so.
TEST_P(Layers, InputsThatNothingReadsAreDropped)
{
    Scene scene = make_scene(context, R"({"brume": 1})");
    Plan plan = make_plan(context, scene, ray_format(width, height, {}, {layer("transmittance")}));
    brume_plan_info info = BRUME_PLAN_INFO_INIT;
    ASSERT_EQ(brume_plan_get_info(plan.get(), &info), BRUME_OK);
    bool said = false;
    for (uint32_t i = 0; i < info.entry_count; ++i) {
        brume_plan_entry entry = BRUME_PLAN_ENTRY_INIT;
        ASSERT_EQ(brume_plan_get_entry(plan.get(), i, &entry), BRUME_OK);
        said = said || (std::string(entry.name) == "transmittance" && !entry.runs);
    }
    EXPECT_TRUE(said);
}
