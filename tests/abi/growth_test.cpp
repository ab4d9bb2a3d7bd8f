// Effects in a host whose lights, Gaussians and products are longer than theirs: the same pictures, bit for bit.
#include "client.h"

using namespace client;

namespace {

struct Size {
    int width, height;
};
constexpr Size usual{16, 12}, tiny{2, 1};  // what takes a reference seconds

const char *const two = R"([
    {"type": "point", "position": [-1, 0.5, -5], "intensity": [30, 20, 10]},
    {"type": "point", "position": [1.5, -0.5, -8], "intensity": 40}])";

const char *const lamps = R"([
    {"type": "point", "position": [-1, 0.5, -5], "intensity": [30, 20, 10], "radius": 0.2},
    {"type": "spot", "position": [2, 3, -9], "direction": [0, -1, 0], "intensity": 90, "angle": 50, "shadow": "screen"},
    {"type": "directional", "direction": [0.3, -1, -0.2], "intensity": 0.5},
    {"type": "point", "position": [1.5, -0.5, -8], "intensity": 40, "radius": 1.5}])";

const char *const even = R"({"scattering": 0.03, "absorption": 0.002})";

std::string banks(int count)
{
    std::string terms = R"({"type": "constant", "value": 0.3})";
    for (int i = 0; i < count; ++i)
        terms += R"(, {"type": "gaussian", "center": [)" + std::to_string(0.7 * i - 3) + ", " + std::to_string(0.2 * i - 1) +
                 ", " + std::to_string(-5 - i) + R"(], "scale": )" + std::to_string(0.5 + 0.1 * i) +
                 R"(, "amplitude": 1.5})";
    return R"({"scattering": [0.03, 0.04, 0.05], "absorption": 0.003, "density": [)" + terms + "]}";
}

struct Case {
    const char *name;
    std::string medium, effects;  // names begin with @
    const char *lights = lamps;
    Size size = usual;
};

void PrintTo(const Case &c, std::ostream *out)
{
    *out << c.effects;
}

std::string scene_of(const Case &c, const std::string &prefix)
{
    std::string effects = c.effects;
    for (size_t at; (at = effects.find('@')) != std::string::npos;)
        effects.replace(at, 1, prefix);
    return R"({"brume": 1, "camera": {"vertical_fov": 50, "camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]},
               "medium": )" +
           c.medium + R"(, "lights": )" + c.lights + R"(, "effects": {)" + effects + "}}";
}

class LongerStructs : public testing::TestWithParam<Case> {};

const std::vector<Case> cases{
    // The references look up lights only beside an effect that adds them.
    {"calibrated", banks(10), R"("@multiscatter": {})"},
    {"paper", banks(10), R"("@multiscatter": {"kernel": "paper"})"},
    {"reference", banks(10), R"("@multiscatter": {"kernel": "reference"}, "airlight": {"orders": "single"})"},
    {"paper_reference", banks(10), R"("@multiscatter": {"kernel": "paper_reference"}, "airlight": {"orders": "single"})"},
    {"nodes", banks(10), R"("@airlight": {"tier": "nodes", "orders": "single"})"},
    {"nodes_all", banks(10), R"("@airlight": {"tier": "nodes", "orders": "all", "max_error": 0.004})"},
    {"maps", banks(10), R"("@airlight": {"tier": "maps", "orders": "single"})"},
    {"maps_all", banks(10), R"("@airlight": {"tier": "maps", "orders": "all"})"},
    {"airlight_auto", banks(10), R"("@airlight": {})"},
    {"fogshop", banks(10), R"("@airlight": {"tier": "fogshop", "orders": "single"})", two},
    {"sun", even, R"("@airlight": {"tier": "sun", "orders": "single"})", two},
    {"airlight_reference", banks(2), R"("@airlight": {"tier": "reference", "orders": "single"})", two, tiny},
    {"surface", banks(10), R"("@surface": {})"},
    {"surface_sun", banks(10), R"("@surface": {"method": "sun"})"},
    {"surface_psf", banks(10), R"("@surface": {"method": "psf"})"},
    {"surface_reference", banks(2), R"("@surface": {"method": "reference"})", two, tiny},
    {"together", banks(10), R"("@multiscatter": {}, "@airlight": {}, "@surface": {})"},
};

}  // namespace

TEST_P(LongerStructs, GiveTheSamePicture)
{
    brume_context_desc desc = BRUME_CONTEXT_DESC_INIT;
    desc.backend = BRUME_BACKEND_CPU;
    desc.threads = 2;
    desc.plugin_directory = BRUME_WIDE_EFFECT_DIR;
    const Context context = make_context(desc);
    const auto [width, height] = GetParam().size;
    Picture color(width, height), depth(width, height, {.channels = 1}), albedo(width, height, {.channels = 3});
    paint(color);
    paint_depth(depth);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c)
                albedo.set(x, y, c, 0.25f + 0.125f * float((x + y + c) % 4));
    for (int y = 0; y < height; ++y)
        for (int x = width / 2; x < width; ++x)
            depth.set(x, y, 0, 8);  // where the last lamp is
    const brume_image albedo_image = albedo.image();
    const std::vector<brume_layer> inputs{layer("albedo", &albedo_image)};
    const bool takes_albedo = GetParam().effects.find("surface") != std::string::npos;
    auto picture = [&](const std::string &prefix) {
        const Scene scene = make_scene(context, scene_of(GetParam(), prefix));
        const std::vector<brume_layer> given = takes_albedo ? inputs : std::vector<brume_layer>{};
        const Plan plan = make_plan(context, scene, ray_format(color.width(), color.height(), {}, given));
        Picture output(color.width(), color.height());
        EXPECT_EQ(execute(plan.get(), color, depth, output, {}, given), BRUME_OK) << message(context.get());
        return output;
    };
    const Picture expected = picture("");
    ASSERT_NE(expected.memory(), color.memory()) << "nothing was done";
    expect_same_bits(expected, picture("wide_"));
}

INSTANTIATE_TEST_SUITE_P(, LongerStructs, testing::ValuesIn(cases), [](auto &info) { return std::string(info.param.name); });
