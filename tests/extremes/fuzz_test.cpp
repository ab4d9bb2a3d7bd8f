// 10^5 random scene files through the C ABI: parse, plan, execute. No crash, errors that name what is wrong, and nothing but
// finite values out of finite pixels.
#include <chrono>

#include <gtest/gtest.h>

#include "fog.h"
#include "random_scene.h"

using namespace extremes;
using fog::Picture;

namespace {

constexpr int texts = 60000;
constexpr int planned_share = 2;   // of the texts that are scenes, one in so many
constexpr int executed_share = 3;  // of the plans

struct Size {
    int width, height;
};

// References integrate for each pixel.
Size size_of(const std::string &text)
{
    return text.find("\"reference\"") == std::string::npos ? Size{8, 6} : Size{3, 2};
}

struct Destroy {
    void operator()(brume_scene scene) const { brume_scene_destroy(scene); }
    void operator()(brume_plan plan) const { brume_plan_destroy(plan); }
};
using Scene = std::unique_ptr<brume_scene_t, Destroy>;
using Plan = std::unique_ptr<brume_plan_t, Destroy>;

class Fuzz : public testing::Test {
protected:
    Fuzz() : random_(20260101, parameters_of(context_))
    {
        for (const char *key : {"brume", "metres_per_unit", "camera", "medium", "lights", "environment", "effects", "format",
                                "scene", "frame"})
            names_.insert(key);
        for (const ParameterKind &p : parameters_of(context_)) {
            names_.insert(p.effect);
            names_.insert(p.name);
        }
    }

    std::string message() const
    {
        char text[1024];
        brume_message(context_, text, sizeof text);
        return text;
    }

    // Parsing names the place.
    Scene parse(const std::string &text)
    {
        brume_scene scene = nullptr;
        const brume_status status = brume_scene_create_from_text(context_, text.data(), text.size(), "fuzz", &scene);
        if (status != BRUME_OK) {
            EXPECT_EQ(status, BRUME_ERROR_SCENE) << message() << "\n" << text;
            int line = 0, column = 0, read = 0;
            EXPECT_EQ(sscanf(message().c_str(), "fuzz:%d:%d: %n", &line, &column, &read), 2) << message() << "\n" << text;
            EXPECT_GT(message().size(), size_t(read)) << message();
        }
        return Scene(scene);
    }

    // What fails later names a part of the scene or a parameter before the first colon.
    void expect_named(const std::string &text) const
    {
        const std::string what = message(), named = what.substr(0, what.find(':'));
        const bool known =
            std::any_of(names_.begin(), names_.end(), [&](auto &name) { return named.find(name) != std::string::npos; });
        EXPECT_TRUE(known && named.size() < what.size()) << what << "\n" << text;
    }

    Plan plan(const Scene &scene, const std::string &text)
    {
        brume_format format = BRUME_FORMAT_INIT;
        format.width = size_of(text).width;
        format.height = size_of(text).height;
        format.depth_kind = uint32_t(random_.below(3));
        format.sky = uint32_t(random_.below(3));
        format.sky_distance = random_.magnitude(-3, 10);
        format.nonpositive = uint32_t(random_.below(2));
        brume_plan plan = nullptr;
        if (brume_plan_create(scene.get(), &format, &plan) != BRUME_OK)
            expect_named(text);
        return Plan(plan);
    }

    bool execute(const Plan &plan, const std::string &text)
    {
        const auto [width, height] = size_of(text);
        Picture color(width, height, 4), depth(width, height, 1), output(width, height, 4);
        for (float &v : color.data)
            v = float(random_.magnitude(-45, 38)) * (random_.chance(0.1) ? -1.0f : 1.0f);
        for (float &v : depth.data)
            v = random_.chance(0.1) ? (random_.chance(0.5) ? NAN : INFINITY) : float(random_.magnitude(-45, 38));
        brume_image images[] = {fog::describe(color), fog::describe(depth), fog::describe(output)};
        brume_frame frame = BRUME_FRAME_INIT;
        frame.color = &images[0];
        frame.depth = &images[1];
        frame.output = &images[2];
        frame.frame = random_.uniform(-2, 6);
        if (brume_plan_execute(plan.get(), &frame) != BRUME_OK) {
            expect_named(text);
            return false;
        }
        for (size_t i = 0; i < output.data.size(); ++i)
            EXPECT_TRUE(std::isfinite(output.data[i]) && (i % 4 != 3 || output.data[i] == color.data[i]))
                << output.data[i] << " of " << color.data[i] << "\n"
                << text;
        return true;
    }

    fog::Context context_{BRUME_BACKEND_CPU, 1};
    RandomScenes random_;
    std::set<std::string> names_;
};

}  // namespace

TEST_F(Fuzz, RandomScenesAreFoggedOrRefusedWithAReason)
{
    const auto start = std::chrono::steady_clock::now();
    int scenes = 0, plans = 0, refused = 0, frames = 0;
    for (int i = 0; i < texts && !HasFailure(); ++i) {
        // A third of each: good, with bad values, with bad text.
        std::string text = random_.scene(i % 3 == 1 ? 0.02 : 0).dump(i % 2 ? -1 : 1);
        if (i % 3 == 2)
            text = random_.mutated(text);
        SCOPED_TRACE("text " + std::to_string(i));
        const Scene scene = parse(text);
        if (!scene || scenes++ % planned_share)
            continue;
        const Plan plan = this->plan(scene, text);
        refused += !plan;
        if (plan && plans++ % executed_share == 0)
            frames += execute(plan, text);
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    printf("%d texts: %d scenes, of which %d planned (1 in %d) and %d refused, %d frames (1 in %d plans), %.0f s\n", texts,
           scenes, plans, planned_share, refused, frames, executed_share, seconds.count());
    EXPECT_GT(scenes, texts / 3);
    EXPECT_GT(plans, texts / 20);
    EXPECT_GT(frames, texts / 50);
}
