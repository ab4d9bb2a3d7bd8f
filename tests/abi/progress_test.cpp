// How far a long call has come, and its end before that.
#include <thread>

#include "client.h"

using namespace client;

namespace {

struct Told {
    std::vector<double> fractions;
    std::thread::id thread = std::this_thread::get_id();
    size_t cancel_at = SIZE_MAX;  // which call asks for the end

    static int32_t tell(void *user, double fraction)
    {
        Told &told = *static_cast<Told *>(user);
        EXPECT_EQ(std::this_thread::get_id(), told.thread);
        told.fractions.push_back(fraction);
        return told.fractions.size() > told.cancel_at ? 1 : 0;
    }
};

Context make_telling(uint32_t backend, Told &told, uint32_t threads = 2)
{
    brume_context_desc desc = BRUME_CONTEXT_DESC_INIT;
    desc.backend = backend;
    desc.threads = threads;
    desc.progress = Told::tell;
    desc.progress_user = &told;
    return make_context(desc);
}

// Large enough to take several times as long as lies between two reports.
constexpr int width = 1600, height = 900;

class ProgressOfAFrame : public testing::Test {
protected:
    void SetUp() override
    {
        paint(color);
        paint_depth(depth);
    }

    Told told;
    Context context = make_telling(BRUME_BACKEND_CPU, told);
    Plan plan = make_plan(context, make_scene(context, foggy), ray_format(width, height));
    Picture color{width, height}, depth{width, height, {.channels = 1}}, output{width, height};
};

void expect_rising(const std::vector<double> &fractions)
{
    for (size_t i = 0; i < fractions.size(); ++i) {
        EXPECT_GE(fractions[i], i ? fractions[i - 1] : 0);
        EXPECT_LE(fractions[i], 1);
    }
}

}  // namespace

TEST_F(ProgressOfAFrame, RisesFromZeroToOne)
{
    ASSERT_EQ(execute(plan.get(), color, depth, output), BRUME_OK) << message(context.get());
    ASSERT_GE(told.fractions.size(), 3u);
    EXPECT_EQ(told.fractions.front(), 0);
    EXPECT_EQ(told.fractions.back(), 1);
    EXPECT_GT(told.fractions[1], 0);
    EXPECT_LT(told.fractions[1], 1);
    expect_rising(told.fractions);
}

// The frames after a cancelled one are those of a plan that never was.
TEST_F(ProgressOfAFrame, CanBeCancelledAnywhere)
{
    ASSERT_EQ(execute(plan.get(), color, depth, output), BRUME_OK) << message(context.get());
    const Picture expected = output;
    const size_t calls = told.fractions.size();
    for (size_t at : {size_t(0), size_t(1), calls / 2}) {
        told.fractions.clear();
        told.cancel_at = at;
        expect_status(context.get(), execute(plan.get(), color, depth, output), BRUME_ERROR_CANCELLED, "progress callback");
        EXPECT_EQ(told.fractions.size(), at + 1) << "asked again after it said no";
        told.cancel_at = SIZE_MAX;
        Picture again(width, height);
        ASSERT_EQ(execute(plan.get(), color, depth, again), BRUME_OK) << message(context.get());
        expect_same_bits(expected, again);
    }
}

class ProgressOfABackend : public EachBackend {};

TEST_P(ProgressOfABackend, IsAskedAtBeginAndEnd)
{
    Told told;
    Context telling = make_telling(GetParam(), told);
    Plan plan = make_plan(telling, make_scene(telling, foggy), ray_format(16, 9));
    EXPECT_TRUE(told.fractions.empty());
    Picture color(16, 9), depth(16, 9, {.channels = 1}), output(16, 9);
    paint(color);
    paint_depth(depth);
    ASSERT_EQ(execute(plan.get(), color, depth, output), BRUME_OK) << message(telling.get());
    ASSERT_GE(told.fractions.size(), 2u);
    EXPECT_EQ(told.fractions.front(), 0);
    EXPECT_EQ(told.fractions.back(), 1);
    const Picture before(16, 9);
    Picture untouched(16, 9);
    told.fractions.clear();
    told.cancel_at = 0;
    expect_status(telling.get(), execute(plan.get(), color, depth, untouched), BRUME_ERROR_CANCELLED, "");
    expect_same_bits(before, untouched);
}

INSTANTIATE_EACH_BACKEND(ProgressOfABackend);

TEST(ProgressOfACalibration, RisesAndCanBeCancelled)
{
    Told told;
    told.cancel_at = 8;
    Context context = make_telling(BRUME_BACKEND_CPU, told);
    expect_status(context.get(), brume_context_calibrate(context.get()), BRUME_ERROR_CANCELLED, "progress callback");
    ASSERT_EQ(told.fractions.size(), 9u);
    EXPECT_EQ(told.fractions.front(), 0);
    EXPECT_GT(told.fractions.back(), 0);
    EXPECT_LT(told.fractions.back(), 1);
    expect_rising(told.fractions);
    EXPECT_EQ(brume_context_calibration(context.get(), nullptr, 0), 1u) << "rates of half a measurement";
    Plan plan = make_plan(context, make_scene(context, foggy), ray_format(16, 9));
    Picture color(16, 9), depth(16, 9, {.channels = 1}), output(16, 9);
    told.cancel_at = SIZE_MAX;
    EXPECT_EQ(execute(plan.get(), color, depth, output), BRUME_OK) << message(context.get());
}
