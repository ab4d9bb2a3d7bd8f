// Extremes of images and cameras: sizes, pixel types, single pixels, uniform ones, cameras far from the origin.
#include <random>

#include <gtest/gtest.h>

#include "columns.h"
#include "base/half.h"

using namespace extremes;
using fog::Frame;
using fog::Picture;
using fog::Result;
using fog::Worst;

namespace {

// With Gaussians, for the columns that know them.
Condition ordinary(const Column &column)
{
    Condition c{"ordinary", "", ordinary_medium(), ordinary_lights()};
    if (column.tier() == "sun")
        c.medium["density"] = {fog::constant(1)};
    return c;
}

class Images : public testing::TestWithParam<const char *> {
protected:
    const bool on_gl = std::string(GetParam()) == "gl";

    brume_context context() const { return fog::backend(GetParam()); }
    std::vector<Column> all() const
    {
        std::vector<Column> some;
        for (const Column &column : columns())
            if (!on_gl || !column.cpu_only)
                some.push_back(column);
        return some;
    }
    Result run(const Column &column, const Condition &c, const Picture &color, const Picture &depth) const
    {
        return fog::run(context(), column.scene(c), color, depth, options_of(column));
    }
};

INSTANTIATE_TEST_SUITE_P(Extremes, Images, testing::ValuesIn(fog::backend_names),
                         [](auto &info) { return std::string(info.param); });

// One of the images of a frame, as floats or halves.
struct Stored {
    Stored(const Picture &picture, uint32_t pixel) : image(fog::describe(picture)), floats(picture.data)
    {
        image.pixel = pixel;
        for (float v : floats)
            halves.push_back(brume::float_to_half(v));
        image.data = pixel == BRUME_PIXEL_F16 ? static_cast<void *>(halves.data()) : floats.data();
    }
    Stored(const Stored &) = delete;

    brume_image image;
    std::vector<float> floats;
    std::vector<uint16_t> halves;
};

float nearest_half(float v)
{
    return brume::half_to_float(brume::float_to_half(v));
}

uint16_t saturated_half(float v)
{
    return brume::float_to_half(std::isfinite(v) ? std::clamp(v, -65504.0f, 65504.0f) : v);
}

}  // namespace

TEST_P(Images, Sizes)
{
    for (const Column &column : all())
        for (auto [w, h] : {std::pair(1, 1), {1, 2}, {2, 1}, {3, 5}, {1, 4096}, {4096, 1}, {16384, 2}}) {
            // Exact splatting takes minutes for images as wide as that.
            if (w > 4096 && column.cpu_only)
                continue;
            // Software GL takes up to a minute for the large ones of the tiers.
            if (on_gl && w * h > 100 && column.name != "calibrated" && !(column.name == "nodes" && w == 4096))
                continue;
            SCOPED_TRACE(column.name + " " + std::to_string(w) + " x " + std::to_string(h));
            Frame frame = fog::lit_frame(w, h);
            frame.color.at(w / 2, h / 2)[1] = 500;
            const Result r = run(column, ordinary(column), frame.color, frame.depth);
            for (float v : r.output.data)
                ASSERT_TRUE(std::isfinite(v) && v >= 0) << v;
            for (float v : r.airlight.data)
                ASSERT_TRUE(std::isfinite(v) && v > 0) << v;
        }
}

// Halves in are the floats they stand for, halves out the nearest to what floats would be.
TEST_P(Images, PixelTypes)
{
    Frame frame = fog::lit_frame(16, 12);
    const float extremes[] = {0, 6e-8f, -6e-8f, 6e-5f, 65504, -65504, NAN, INFINITY, -INFINITY, 1e-3f};
    for (int i = 0; i < 10; ++i) {
        frame.color.at(i + 1, 2)[i % 3] = extremes[i];
        frame.depth.at(i + 1, 9)[0] = extremes[i];
    }
    for (Picture *p : {&frame.color, &frame.depth})
        for (float &v : p->data)
            v = nearest_half(v);
    for (const Column &column : all())
        for (double intensity : {1.0, 1e9}) {
            // Images are the host's, whatever runs between; software GL takes seconds to compile each of the rest.
            if (on_gl && column.name != "calibrated" && column.name != "nodes")
                continue;
            SCOPED_TRACE(column.name + ", intensity " + std::to_string(intensity));
            Condition c = ordinary(column);
            c.lights[0]["intensity"] = intensity;
            fog::Options options = options_of(column);
            const fog::Plan plan(context(), column.scene(c), 16, 12, options);
            const Result expected = plan.execute(frame.color, frame.depth, options);
            const Picture &expected_layer = column.lit() ? expected.airlight : expected.transmittance;
            for (int kinds = 0; kinds < 8; ++kinds) {
                auto pixel = [&](int bit) { return kinds >> bit & 1 ? BRUME_PIXEL_F16 : BRUME_PIXEL_F32; };
                Stored color(frame.color, pixel(0)), depth(frame.depth, pixel(1)), output(frame.color, pixel(2)),
                    further(expected_layer, pixel(2));
                const brume_layer layer = fog::layer(column.lit() ? "airlight" : "transmittance", &further.image);
                brume_frame f = BRUME_FRAME_INIT;
                f.color = &color.image;
                f.depth = &depth.image;
                f.output = &output.image;
                f.outputs = &layer;
                f.output_count = 1;
                fog::Context::check(brume_plan_execute(plan, &f), context());
                for (size_t i = 0; i < output.floats.size(); ++i) {
                    const float in = frame.color.data[i], wanted = expected.output.data[i];
                    const float got =
                        pixel(2) == BRUME_PIXEL_F16 ? brume::half_to_float(output.halves[i]) : output.floats[i];
                    ASSERT_EQ(std::isfinite(got), std::isfinite(in)) << i << ": " << got << " of " << in;
                    if (pixel(2) == BRUME_PIXEL_F16) {
                        ASSERT_EQ(output.halves[i], saturated_half(wanted)) << i << ": " << got << " of " << wanted;
                    } else if (!std::isnan(wanted)) {
                        ASSERT_EQ(got, wanted) << i;
                    }
                }
                for (size_t i = 0; i < further.halves.size() && pixel(2) == BRUME_PIXEL_F16; ++i)
                    ASSERT_EQ(further.halves[i], saturated_half(expected_layer.data[i])) << i;
            }
            if (column.lit() && intensity > 1) {
                EXPECT_GT(*std::max_element(expected.airlight.data.begin(), expected.airlight.data.end()), 65504);
            }
        }
}

TEST_P(Images, OneBadPixelStaysAlone)
{
    for (const Column &column : all()) {
        SCOPED_TRACE(column.name);
        Frame frame = fog::lit_frame(48, 40), clean = frame;
        clean.color.at(30, 31)[0] = clean.color.at(31, 31)[1] = 0;
        frame.color.at(30, 31)[0] = NAN;
        frame.color.at(31, 31)[1] = INFINITY;
        Result r = run(column, ordinary(column), frame.color, frame.depth);
        const Result expected = run(column, ordinary(column), clean.color, clean.depth);
        EXPECT_TRUE(std::isnan(r.output.at(30, 31)[0]));
        EXPECT_EQ(r.output.at(31, 31)[1], INFINITY);
        r.output.at(30, 31)[0] = expected.output.at(30, 31)[0];
        r.output.at(31, 31)[1] = expected.output.at(31, 31)[1];
        EXPECT_EQ(r.output.data, expected.output.data);
    }
}

// What is scattered of one lit pixel arrives somewhere; the paper's mask, which loses it, is off.
TEST_P(Images, OneLitPixelAmongZeros)
{
    for (const Column &filter : all()) {
        if (!filter.filters() || filter.lit())
            continue;
        Column column = filter;
        column.effects["multiscatter"]["masking"] = false;
        for (float l : {1e-30f, 1.0f, 65504.0f, 1e10f}) {
            SCOPED_TRACE(column.name + " " + std::to_string(l));
            Condition c{"one pixel", "", {{"scattering", 0.03}, {"g", 0.9}}, Json::array()};
            Picture color(65, 65, 4, 0), depth(65, 65, 1, 30);
            color.at(32, 32)[2] = l;
            const Result r = run(column, c, color, depth);
            double total = 0;
            for (size_t i = 2; i < r.output.data.size(); i += 4) {
                ASSERT_TRUE(r.output.data[i] >= 0 && r.output.data[i] <= l);
                total += r.output.data[i];
            }
            EXPECT_GT(total, 0.5 * l);
            EXPECT_LT(total, 1.01 * l);
        }
    }
}

// In a medium that absorbs nothing a uniform image stays as it is, whatever lies where. (The kernels of the paper do not say
// so: their blurs are the receivers'.)
TEST_P(Images, WhiteFurnace)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<float> u(0, 1);
    double most = 0;
    for (auto [w, h] : {std::pair(1, 1), {64, 48}, {37, 23}, {1, 200}, {130, 7}, {2, 2}, {16384, 1}}) {
        Picture depth(w, h, 1);
        for (float &d : depth.data)
            d = u(random) < 0.2f ? INFINITY : 100 * u(random);
        const Picture color(w, h, 4, 3.5f);
        for (const char *medium :
             {R"({"scattering": 0.02, "g": 0.3})", R"({"scattering": [0.05, 0.02, 0.01], "g": 0.9})",
              R"({"scattering": 2, "g": -0.5})", R"({"scattering": 1e4})", R"({"scattering": [1e-12, 0, 1e-4]})",
              R"({"scattering": 0.1, "density": [{"type": "exponential", "falloff": 0.25,
                                       "direction": [0.1, 1, 0.2]}]})"})
            for (int levels : {0, 3}) {
                Column column = extremes::column("calibrated");
                column.effects["multiscatter"]["levels"] = levels;
                const Condition c{"furnace", medium, Json::parse(medium), Json::array()};
                const Worst worst = fog::compare(run(column, c, color, depth).output, color, 1e-3);
                EXPECT_LT(worst.error, 1e-5)
                    << w << "x" << h << " " << medium << " levels " << levels << " " << worst.describe();
                most = std::max(most, worst.error);
            }
    }
    printf("%s, white furnace: calibrated %.1e\n", GetParam(), most);
}

// The same relative scene near the origin and 1e6 m away.
TEST_P(Images, CamerasFarFromTheOrigin)
{
    const Frame frame = fog::lit_frame(20, 16);
    std::vector<fog::NamedScene> scenes = fog::lit_scenes();
    if (on_gl)
        scenes = {scenes[1]};
    Json exponential{
        {"scattering", 0.05},
        {"density", {{{"type", "exponential"}, {"falloff", 0.2}, {"direction", {0, 1, 0}}, {"origin", {0, -2, 0}}}}}};
    scenes.push_back({"exponential", fog::lit_scene(exponential, ordinary_lights()), {"nodes"}});
    double most = 0;
    for (const auto &[name, near, tiers] : scenes) {
        Json far = near;
        if (!far["medium"].contains("density"))
            far["medium"]["density"] = {fog::constant(1)};
        const fog::Vector shift{1e6, -1e6, 1e6};
        auto move = [&](Json &point) {
            for (size_t i = 0; i < 3; ++i)
                point[i] = point[i].get<double>() + shift[i];
        };
        far["camera"]["camera_to_world"] = fog::pose(shift);
        for (Json &light : far["lights"])
            if (light.contains("position"))
                move(light["position"]);
        for (Json &term : far["medium"]["density"])
            if (term["type"] == "gaussian") {
                move(term["center"]);
            } else if (term["type"] == "exponential") {
                Json origin = term.value("origin", Json{0, 0, 0});
                move(origin);
                term["origin"] = origin;
            }
        for (const Column &column : all()) {
            if (on_gl && column.name != "calibrated" && column.name != "nodes")
                continue;
            if (column.lit() && std::find(tiers.begin(), tiers.end(), column.tier()) == tiers.end())
                continue;
            Json one = near, other = far;
            one["effects"] = other["effects"] = column.effects;
            const Worst worst = fog::compare(fog::run(context(), other.dump(), frame.color, frame.depth).output,
                                             fog::run(context(), one.dump(), frame.color, frame.depth).output, 1e-2);
            EXPECT_LT(worst.error, column.lit() ? 1e-5 : 1e-6) << name << ", " << column.name << " " << worst.describe();
            most = std::max(most, worst.error);
        }
    }
    printf("%s, cameras 1e6 m from the origin: %.1e\n", GetParam(), most);
}
