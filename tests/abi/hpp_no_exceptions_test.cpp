// brume.hpp in a file without exceptions, beside one with them in the same program.
#include <vector>

#include <gtest/gtest.h>

#include <brume/brume.hpp>

#ifdef __cpp_exceptions
#error "this file is to be compiled without exceptions"
#endif

namespace {

brume::Context cpu()
{
    brume_context_desc desc = BRUME_CONTEXT_DESC_INIT;
    desc.backend = BRUME_BACKEND_CPU;
    return brume::Context(desc);
}

}  // namespace

TEST(HppWithoutExceptions, FogsAnImage)
{
    brume::Context context = cpu();
    ASSERT_TRUE(context) << context.message();
    brume::Scene scene(context, R"({"brume": 1, "medium": {"absorption": 0.1}})", "fog.json");
    ASSERT_TRUE(scene) << context.message();
    EXPECT_EQ(scene.set_metres_per_unit(2), BRUME_OK);
    brume_format format = brume::format(2, 2);
    format.depth_kind = BRUME_DEPTH_RAY;
    brume::Plan plan(scene, format);
    ASSERT_TRUE(plan) << context.message();
    EXPECT_EQ(plan.status(), BRUME_OK);
    const std::vector<float> color(16, 1), depth(4, 5);
    std::vector<float> output(16);
    EXPECT_EQ(plan.execute(brume::image(color.data(), 2, 2, 4), brume::image(depth.data(), 2, 2, 1),
                           brume::image(output.data(), 2, 2, 4)),
              BRUME_OK)
        << context.message();
    EXPECT_NEAR(output[0], 0.36787944, 1e-6);
}

TEST(HppWithoutExceptions, FailuresAreStatuses)
{
    brume_context_desc desc = BRUME_CONTEXT_DESC_INIT;
    desc.threads = 5000;
    brume::Context none(desc);
    EXPECT_FALSE(none);
    EXPECT_EQ(none.status(), BRUME_ERROR_ARGUMENT);
    EXPECT_NE(none.message().find("threads: 5000"), std::string::npos) << none.message();
    EXPECT_TRUE(none.effects().empty());
    EXPECT_EQ(brume::Scene(none).status(), BRUME_ERROR_ARGUMENT);

    brume::Context context = cpu();
    brume::Scene broken(context, "{", "broken.json");
    EXPECT_FALSE(broken);
    EXPECT_EQ(broken.status(), BRUME_ERROR_SCENE);
    EXPECT_NE(context.message().find("broken.json:1"), std::string::npos) << context.message();

    brume::Scene scene(context);
    EXPECT_EQ(scene.set("multiscatter", "nothing", 1), BRUME_ERROR_NOT_FOUND);
    brume::Plan plan(scene, brume::format(0, 0));
    EXPECT_FALSE(plan);
    EXPECT_EQ(plan.status(), BRUME_ERROR_ARGUMENT);
    EXPECT_TRUE(plan.entries().empty());
    EXPECT_EQ(plan.execute(brume_frame BRUME_FRAME_INIT), BRUME_ERROR_ARGUMENT);
}
