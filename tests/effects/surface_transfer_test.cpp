// Effect surface where frames bring the surfaces' transfer.
#include <deque>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "lit_scene.h"
#include "relit.h"
#include "scene_maths.hpp"

using namespace fog;

namespace {

namespace f64 = brume::maths_double;

// All y_lm of degrees 0 to 3 as shaders/lib/environment.glsl has them.
std::array<double, 16> harmonics(const f64::vec3 &d)
{
    std::array<double, 16> all;
    for (size_t i = 0; i < 16; ++i) {
        float one[36 * 4] = {};
        one[4 * i] = 1;
        const f64::Data environment(one, 36, 4);
        const f64::Degrees degrees = f64::environment_degrees(environment.texture(), 6, d);
        all[i] = 0;
        for (const f64::vec3 &degree : degrees.of)
            all[i] += degree.x;
    }
    return all;
}

using Coefficients = std::array<double, 16>;

Coefficients cosine_transfer(const f64::vec3 &normal)
{
    const double of_degree[] = {1, 2 / 3.0, 0.25, 0};
    Coefficients all = harmonics(normal);
    for (int l = 0; l < 4; ++l)
        for (int i = l * l; i < (l + 1) * (l + 1); ++i)
            all[size_t(i)] *= of_degree[l];
    return all;
}

constexpr int size = 8;

f64::vec3 normal_at(int x, int y)
{
    return glm::normalize(f64::vec3(0.4 * x - 1.5, 0.3 * y - 1, 1.2));
}

const Json turned = pose({0, 0, 0}, 0.7, -0.4);

// In the axes of that camera.
f64::vec3 in_camera(const f64::vec3 &d)
{
    f64::vec3 turned_back(0);
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            turned_back[i] += double(turned[size_t(k)][size_t(i)]) * d[k];
    return turned_back;
}

// As many layers as so many degrees take; of(x, y) gives a pixel's coefficients.
template <class Function> void add_transfer(std::map<std::string, Picture> &layers, int order, const Function &of)
{
    const int count = (order * order + 2) / 3;
    for (int layer = 0; layer < count; ++layer) {
        Picture &picture = layers["transfer_" + std::to_string(layer)] = Picture(size, size, layer == 5 ? 1 : 3);
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x)
                for (int k = 0; k < picture.channels; ++k)
                    picture.at(x, y)[k] = float(of(x, y)[size_t(3 * layer + k)]);
    }
}

class SurfaceTransferOn : public testing::TestWithParam<std::tuple<const char *, const char *>> {
protected:
    brume_context context() const { return backend(std::get<0>(GetParam())); }
    Json scene() const
    {
        const Json lights{
            point_light({2, 1, -3}, 40),
            {{"type", "point"}, {"position", {-3, -1, -9}}, {"intensity", {50, 30, 20}}},
            {{"type", "spot"}, {"position", {0, 3, -4}}, {"direction", {-0.2, -1, -0.3}}, {"angle", 60}, {"intensity", 60}},
            {{"type", "directional"}, {"direction", {0.3, -1, -0.4}}, {"intensity", 2}, {"distance", 6}}};
        Json all = lit_scene({{"scattering", {0.05, 0.1, 0.2}},
                              {"absorption", {0, 0.01, 0.02}},
                              {"density", Json::array({constant(0.7), gaussian({0, 0, -6}, 0.4, 1)})}},
                             lights);
        all["camera"]["camera_to_world"] = turned;
        std::mt19937 random(3);
        std::uniform_real_distribution<double> u(-0.3, 0.3);
        Json sh = Json::array({{2, 1.5, 1}});
        while (sh.size() < 36)
            sh.push_back({u(random), u(random), u(random)});
        all["environment"]["sh"] = sh;
        all["effects"] = {{"surface", {{"method", std::get<1>(GetParam())}}}};
        return all;
    }
    // kind: of the transfer's layers; all others are of the world.
    Picture relit_with(const std::map<std::string, Picture> &layers, const Json &text, uint32_t kind = BRUME_LAYER_WORLD,
                       const std::vector<Picture> &groups = {}) const
    {
        brume_scene scene = nullptr;
        const std::string of_scene = text.dump();
        Context::check(brume_scene_create_from_text(context(), of_scene.data(), of_scene.size(), "test.json", &scene),
                       context());
        std::deque<brume_image> images;
        std::vector<brume_layer> named, given;
        for (auto &[name, picture] : layers) {
            const uint32_t of = name.starts_with("transfer") ? kind : BRUME_LAYER_WORLD;
            named.push_back(layer(name.c_str()));
            given.push_back(layer(name.c_str(), &images.emplace_back(describe(picture))));
            named.back().kind = given.back().kind = of;
        }
        for (uint32_t l = 0; l < groups.size(); ++l) {
            if (l == 0)
                named.push_back(layer("light_group"));
            given.push_back(layer("light_group", &images.emplace_back(describe(groups[l])), l));
        }
        brume_format format = BRUME_FORMAT_INIT;
        format.width = format.height = size;
        format.sky = BRUME_SKY_CLAMP;
        format.sky_distance = 9;
        format.inputs = named.data();
        format.input_count = uint32_t(named.size());
        brume_plan plan = nullptr;
        Context::check(brume_plan_create(scene, &format, &plan), context());
        const Picture color(size, size, 3, 0.4f), depth(size, size, 1, 5);
        Picture output(size, size, 3);
        brume_frame frame = BRUME_FRAME_INIT;
        const brume_image in = describe(color), far = describe(depth), out = describe(output);
        frame.color = &in;
        frame.depth = &far;
        frame.output = &out;
        frame.inputs = given.data();
        frame.input_count = uint32_t(given.size());
        Context::check(brume_plan_execute(plan, &frame), context());
        brume_plan_destroy(plan);
        brume_scene_destroy(scene);
        return output;
    }
    std::map<std::string, Picture> material(float albedo) const
    {
        std::map<std::string, Picture> layers{{"albedo", Picture(size, size, 3, albedo)},
                                              {"normal", Picture(size, size, 3)}};
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x)
                for (int k = 0; k < 3; ++k)
                    layers["normal"].at(x, y)[k] = float(normal_at(x, y)[k]);
        return layers;
    }
    std::string entry_of(const std::map<std::string, Picture> &layers, const Json &text, bool runs) const
    {
        Options options;
        options.inputs = layers;
        const Plan plan(context(), text.dump(), size, size, options);
        brume_plan_info info = BRUME_PLAN_INFO_INIT;
        brume_plan_get_info(plan, &info);
        for (uint32_t i = 0; i < info.entry_count; ++i) {
            brume_plan_entry entry = BRUME_PLAN_ENTRY_INIT;
            brume_plan_get_entry(plan, i, &entry);
            if (std::string(entry.name) == "transfer" && bool(entry.runs) == runs)
                return entry.reason;
        }
        return {};
    }
};
INSTANTIATE_TEST_SUITE_P(All, SurfaceTransferOn,
                         testing::Combine(testing::Values("cpu"), testing::Values("calibrated", "psf")),
                         [](auto &info) { return std::get<0>(info.param) + std::string(std::get<1>(info.param)); });

// Any coefficients, larger ones of low degrees.
Coefficients any_transfer(int x, int y)
{
    std::mt19937 random(unsigned(100 * y + x));
    std::uniform_real_distribution<double> u(-0.08, 0.08);
    Coefficients all = cosine_transfer(normal_at(x, y));
    for (double &c : all)
        c = 0.6 * c + u(random);
    return all;
}

}  // namespace

// Coefficients are those of environments, in order and sign.
TEST(SurfaceTransfer, HarmonicsAreTheEnvironments)
{
    for (const f64::vec3 &d : {f64::vec3(0.3, -0.5, 0.8), f64::vec3(-0.9, 0.2, 0.1), f64::vec3(0.1, 0.6, -0.4)}) {
        const f64::vec3 unit = glm::normalize(d);
        const std::array<double, 16> want = harmonics(unit);
        for (int i = 0; i < 16; ++i) {
            f64::Transfer transfer{};
            transfer.of[i / 3][i % 3] = 1;
            const f64::Sent sent = f64::sent_toward(transfer, 4, unit, 0);
            double got = i == 0 ? sent.of[0] : sent.of[1] + sent.of[2] + sent.of[3];
            EXPECT_NEAR(got, want[size_t(i)], 1e-9) << "coefficient " << i;
        }
    }
}

// A cosine's degrees are those that method psf has of a Lambert surface.
TEST(SurfaceTransfer, TheCosineIsTheLobeOfExponentOne)
{
    for (double cosine : {-1.0, -0.3, 0.0, 0.6, 1.0}) {
        const f64::Sent sent = f64::sent_by_cosine(cosine);
        for (int l = 0; l < f64::transfer_degrees; ++l)
            EXPECT_NEAR(sent.of[l],
                        f64::lobe_degree(l, 1) * std::legendre(unsigned(l), cosine) * (2 * l + 1) / (4 * std::numbers::pi),
                        1e-9)
                << l << ", " << cosine;
    }
}

TEST_P(SurfaceTransferOn, OfNothingAroundIsAsWithoutALayer)
{
    const auto layers = material(0.7f);
    const Picture without = relit_with(layers, scene());
    for (int order = 1; order <= 4; ++order) {
        auto with = layers;
        add_transfer(with, order, [](int x, int y) { return cosine_transfer(normal_at(x, y)); });
        EXPECT_LT(compare(relit_with(with, scene()), without, 1e-3).error, 1e-5) << order;
    }
}

TEST_P(SurfaceTransferOn, LampsWithLayersOfTheirOwnAreTheSame)
{
    const std::vector<Picture> groups{Picture(size, size, 3, 0.1f), Picture(size, size, 3, 0.05f)};
    auto layers = material(0.7f);
    const Picture without = relit_with(layers, scene(), BRUME_LAYER_WORLD, groups);
    add_transfer(layers, 4, [](int x, int y) { return cosine_transfer(normal_at(x, y)); });
    EXPECT_LT(compare(relit_with(layers, scene(), BRUME_LAYER_WORLD, groups), without, 1e-3).error, 1e-5);
}

// What comes straight stays the picture's.
TEST_P(SurfaceTransferOn, OfAClosedPointLetsNothingIn)
{
    auto layers = material(0.7f);
    add_transfer(layers, 4, [](int, int) { return Coefficients{}; });
    EXPECT_LT(compare(relit_with(layers, scene()), relit_with(material(0), scene()), 1e-3).error, 1e-6);
}

TEST_P(SurfaceTransferOn, ShadowsLampsOnTheSideThatIsClosed)
{
    Json left = scene();
    left.erase("environment");
    left["camera"]["camera_to_world"] = pose({0, 0, 0});
    left["lights"] = Json::array({point_light({-6, 0, -3}, 40)});
    Json right = left;
    right["lights"] = Json::array({point_light({6, 0, -3}, 40)});
    // Half a sky: y_lm times the cosine of a wall that faces the camera, where x > 0.
    auto half = material(0.7f);
    for (int i = 0; i < size * size; ++i)
        std::copy_n(std::array<float, 3>{0, 0, 1}.data(), 3, half["normal"].data.data() + 3 * i);
    const auto open = half;
    Coefficients coefficients{};
    const int steps = 200;
    for (int i = 0; i < steps; ++i)
        for (int k = 0; k < steps; ++k) {
            const double z = (i + 0.5) / steps, phi = std::numbers::pi * ((k + 0.5) / steps - 0.5), s = std::sqrt(1 - z * z);
            const auto y = harmonics({s * std::cos(phi), s * std::sin(phi), z});
            for (size_t c = 0; c < 16; ++c)
                coefficients[c] += y[c] * z / steps / steps;
        }
    add_transfer(half, 4, [&](int, int) { return coefficients; });
    const auto brought = [&](const std::map<std::string, Picture> &layers, const Json &text) {
        auto none = layers;
        none["albedo"] = Picture(size, size, 3);
        return relit_with(layers, text).at(4, 4)[1] - relit_with(none, text).at(4, 4)[1];
    };
    const double seen = brought(half, right) / brought(open, right), hidden = brought(half, left) / brought(open, left);
    printf("of light from aside, half a sky leaves %.3f on the lamp's side, %.3f on the other\n", seen, hidden);
    EXPECT_GT(seen, 0.6);
    EXPECT_LT(seen, 1.01);
    EXPECT_LT(hidden, 0.4);
    EXPECT_GT(hidden, 0.0);
}

TEST_P(SurfaceTransferOn, InCameraAxesIsTheSame)
{
    auto world = material(0.7f), camera = world;
    // Of the same direction in either's axes, and half as open. Degree 3 turns, too.
    const f64::vec3 to_window = glm::normalize(f64::vec3(0.2, -0.7, 0.5));
    const auto window = [](const f64::vec3 &d) {
        Coefficients all = harmonics(d);
        for (size_t i = 0; i < 16; ++i)
            all[i] *= i == 0 ? 0.15 : i < 4 ? 0.1 : i < 9 ? 0.06 : 0.04;
        return all;
    };
    add_transfer(world, 4, [&](int, int) { return window(to_window); });
    add_transfer(camera, 4, [&](int, int) { return window(in_camera(to_window)); });
    const Picture of_world = relit_with(world, scene()), of_camera = relit_with(camera, scene(), BRUME_LAYER_CAMERA);
    EXPECT_LT(compare(of_camera, of_world, 1e-3).error, 1e-5);
    EXPECT_GT(compare(relit_with(camera, scene()), of_world, 1e-3).error, 1e-3) << "the axes are of no consequence";
}

TEST_P(SurfaceTransferOn, IsFiniteWhateverTheLayers)
{
    auto layers = material(0.7f);
    add_transfer(layers, 4, [](int x, int y) {
        const double odd[] = {NAN, INFINITY, -INFINITY, 1e30, -1e30, 1e-40, 0, -1};
        Coefficients all{};
        for (size_t i = 0; i < 16; ++i)
            all[i] = odd[(size_t(x) + i * size_t(y)) % 8];
        return all;
    });
    for (float v : relit_with(layers, scene()).data)
        ASSERT_TRUE(std::isfinite(v) && v >= 0) << v;
}

TEST_P(SurfaceTransferOn, ThePlanSaysWhatOfItCounts)
{
    auto layers = material(0.7f);
    add_transfer(layers, 3, [](int x, int y) { return any_transfer(x, y); });
    EXPECT_NE(entry_of(layers, scene(), true).find("3 degrees"), std::string::npos) << entry_of(layers, scene(), true);
    Json other = scene();
    other["effects"]["surface"]["method"] = "sun";
    EXPECT_NE(entry_of(layers, other, false).find("method"), std::string::npos);
    auto without_first = layers;
    without_first.erase("transfer_0");
    EXPECT_NE(entry_of(without_first, scene(), false).find("no layer transfer_0"), std::string::npos);
    layers.erase("albedo");
    EXPECT_NE(entry_of(layers, scene(), false).find("albedo"), std::string::npos);
}

#ifdef BRUME_GL
namespace {
class GpuAgainstCpuTransfer : public SurfaceTransferOn {};
INSTANTIATE_TEST_SUITE_P(All, GpuAgainstCpuTransfer,
                         testing::Combine(testing::Values("gl"), testing::Values("calibrated", "psf")),
                         [](auto &info) { return std::string(std::get<1>(info.param)); });
}  // namespace

TEST_P(GpuAgainstCpuTransfer, AgreesForAnyTransfer)
{
    auto layers = material(0.7f);
    add_transfer(layers, 4, [](int x, int y) { return any_transfer(x, y); });
    const Picture got = relit_with(layers, scene());
    const Json text = scene();
    Options options;
    options.inputs = layers;
    options.format = [](brume_format &format) {
        format.sky = BRUME_SKY_CLAMP;
        format.sky_distance = 9;
    };
    const Picture want = run(cpu(), text.dump(), Picture(size, size, 3, 0.4f), Picture(size, size, 1, 5), options).output;
    EXPECT_LT(compare(got, want, 1e-3).error, 2e-5);
}
#endif
