// What moving lights, Gaussians and cameras cost the host, as brume_plan_update() in brume.h says.
#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "allocations.h"
#include "client.h"

using namespace client;

namespace {

struct Moving {
    Moving(const std::string &medium, const std::string &effects, int side, size_t count = 64)
        : lights(count), color(side, side), depth(side, side, {.channels = 1}), output(side, side)
    {
        const std::string text =
            R"({"brume": 1, "camera": {"vertical_fov": 50, "camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]},
                "medium": )" +
            medium + R"(, "effects": {"multiscatter": {}, )" + effects + "}}";
        scene = make_scene(context, text);
        set_lights(0);
        plan = make_plan(context, scene, ray_format(side, side));
        paint(color);
        paint_depth(depth);
    }

    void set_lights(int frame)
    {
        for (size_t i = 0; i < lights.size(); ++i) {
            lights[i] = BRUME_LIGHT_INIT;
            lights[i].type = i % 4 == 0 ? BRUME_LIGHT_SPOT : BRUME_LIGHT_POINT;
            lights[i].radius = i % 2 ? 0.1 : 0.0;
            const double at[] = {double(i % 8) - 4 + 0.01 * frame, 2, -4.0 - double(i)};
            std::copy_n(at, 3, lights[i].position);
        }
        ASSERT_EQ(brume_scene_set_lights(scene.get(), lights.data(), uint32_t(lights.size())), BRUME_OK);
    }

    // Everything that an engine does for a frame in which lights and camera move.
    void show(int frame)
    {
        set_lights(frame);
        brume_camera camera = BRUME_CAMERA_INIT;
        camera.given = BRUME_CAMERA_FIELD_OF_VIEW | BRUME_CAMERA_POSE;
        camera.camera_to_world[3] = 0.02 * frame;
        ASSERT_EQ(brume_scene_set_camera(scene.get(), &camera), BRUME_OK);
        ASSERT_EQ(brume_plan_update(plan.get(), scene.get(), nullptr), BRUME_OK) << message(context.get());
        ASSERT_EQ(execute(plan.get(), color, depth, output), BRUME_OK) << message(context.get());
    }

    Context context = make_context(BRUME_BACKEND_CPU);
    Scene scene;
    Plan plan;
    std::vector<brume_light> lights;
    Picture color, depth, output;
};

size_t allocations_of(Moving &moving, int frames)
{
    for (int i = 0; i < 12; ++i)
        moving.show(i);
    const size_t before = allocations::count;
    for (int i = 0; i < frames; ++i)
        moving.show(12 + i);
    return allocations::count - before;
}

// Of the fastest frame.
double milliseconds_of(Moving &moving, int frames)
{
    using Clock = std::chrono::steady_clock;
    double least = 1e9;
    for (int i = 0; i < frames; ++i) {
        const auto start = Clock::now();
        moving.show(i);
        least = std::min(least, std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    }
    return least;
}

TEST(MovingLights, AllocateNothingOnceWarm)
{
    for (const auto &[effects, lights] :
         {std::pair(R"("airlight": {"orders": "single"})", 64), std::pair(R"("airlight": {"orders": "all"})", 4),
          std::pair(R"("airlight": {"tier": "sun"}, "surface": {})", 64)}) {
        Moving moving(R"({"scattering": 0.03})", effects, 8, size_t(lights));
        EXPECT_EQ(allocations_of(moving, 10), 0u) << "in ten frames of " << effects;
    }
}

// Meant to be below .1 ms; ten times as much is left to busy machines.
TEST(MovingLights, TakeLittleTime)
{
    Moving moving(R"({"scattering": 0.03})", R"("airlight": {"tier": "sun"})", 1);
    EXPECT_LT(milliseconds_of(moving, 100), 1.0);
}

// What was dropped for the medium is not planned again for other lights.
TEST(MovingLights, ThatAreDroppedCostNoMore)
{
    Moving moving(R"({"absorption": 0.03})", R"("airlight": {})", 1);
    EXPECT_EQ(allocations_of(moving, 10), 0u) << "in ten frames";
    EXPECT_LT(milliseconds_of(moving, 100), 1.0);
}

// A medium is made anew by each call, but takes no memory for each Gaussian.
TEST(MovingGaussians, AllocateAFewTimes)
{
    Moving moving(R"({"scattering": 0.03, "density": [{"type": "gaussian", "center": [0, 0, -9], "scale": 1}]})",
                  R"("airlight": {})", 1);
    std::vector<brume_gaussian> gaussians(10000, BRUME_GAUSSIAN_INIT);
    auto show = [&](int frame) {
        for (size_t i = 0; i < gaussians.size(); ++i) {
            gaussians[i].center[0] = double(i % 100) - 50 + 0.01 * frame;
            gaussians[i].center[2] = -5.0 - double(i / 100);
        }
        brume_medium medium = BRUME_MEDIUM_INIT;
        std::fill_n(medium.scattering, 3, 0.03);
        medium.gaussians = gaussians.data();
        medium.gaussian_count = uint32_t(gaussians.size());
        ASSERT_EQ(brume_scene_set_medium(moving.scene.get(), &medium), BRUME_OK);
        ASSERT_EQ(brume_plan_update(moving.plan.get(), moving.scene.get(), nullptr), BRUME_OK)
            << message(moving.context.get());
    };
    show(0);
    const size_t before = allocations::count;
    for (int i = 0; i < 10; ++i)
        show(1 + i);
    EXPECT_LE(allocations::count - before, 100u) << "in ten frames";
}

}  // namespace
