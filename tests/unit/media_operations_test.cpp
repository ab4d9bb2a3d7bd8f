// What each operation does to a medium of Gaussians.
#include "media/base64.h"
#include "media/random.h"
#include "media_operations.h"

namespace brume::media {
namespace {

TEST(MediaRandom, IsUniformAndItsOwn)
{
    // Values that no compiler, library or machine may change.
    Random random(1, 2);
    const double first = random.next();
    EXPECT_EQ(first, Random(1, 2).next());
    EXPECT_NE(first, Random(1, 3).next());
    EXPECT_NE(first, Random(2, 2).next());
    EXPECT_EQ(first, 0x1.a5eda08e17c34p-1) << std::hexfloat << first;

    dvec3 mean(0.0), square(0.0);
    const int count = 40000;
    for (int i = 0; i < count; ++i) {
        const dvec3 v = Random(3, uint64_t(i)).in_ball();
        ASSERT_LT(glm::dot(v, v), 1);
        mean += v / double(count);
        square += v * v / double(count);
    }
    // Of a uniform ball: 0 and 1/5; the deviations of these estimates are .0022 and .0009.
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(mean[i], 0, 0.01);
        EXPECT_NEAR(square[i], 0.2, 0.005);
    }
}

TEST(MediaBase64, ComesBack)
{
    EXPECT_EQ(base64_of("f"), "Zg==");
    EXPECT_EQ(base64_of("fo"), "Zm8=");
    EXPECT_EQ(base64_of("foobar"), "Zm9vYmFy");
    std::string bytes;
    for (int i = 0; i < 600; ++i) {
        EXPECT_EQ(bytes_of_base64(base64_of(bytes)).value(), bytes);
        bytes += char(i * 37);
    }
    for (const char *bad : {"Zg=", "Zg", "Z=g=", "Zg==Zg==", "Z\n==", "===="})
        EXPECT_FALSE(bytes_of_base64(bad)) << bad;
}

TEST(MediaPaint, KeepsItsDistances)
{
    History history;
    Paint paint = stroke({{0, 0, 0}, {3, 0, 0}, {3, 4, 0}, {3, 4, 5}});
    paint.jitter = 0;
    history.apply(paint);
    const auto &gaussians = history.state().gaussians;
    // 12 of length at 0.75 / 2.
    ASSERT_EQ(gaussians.size(), 33u);
    for (size_t i = 0; i < gaussians.size(); ++i) {
        const double s = 0.375 * double(i);
        const dvec3 on_stroke = s <= 3 ? dvec3(s, 0, 0) : s <= 7 ? dvec3(3, s - 3, 0) : dvec3(3, 4, s - 7);
        EXPECT_NEAR(glm::distance(center(gaussians[i]), on_stroke), 0, 1e-12) << i;
        EXPECT_EQ(gaussians[i].scale, 2);
        EXPECT_EQ(gaussians[i].amplitude, 0.7);
        EXPECT_EQ(gaussians[i].color, (std::array<float, 3>{1, 0.5f, 0.25f}));
        EXPECT_EQ(history.state().selected[i], 0);
    }
    paint.spacing = 6;
    History wide;
    wide.apply(paint);
    EXPECT_EQ(wide.state().gaussians.size(), 3u);
}

TEST(MediaPaint, JittersAcrossTheStroke)
{
    History history;
    history.apply(stroke({{0, 0, 0}, {300, 300, 0}}));
    const dvec3 along = glm::normalize(dvec3(1, 1, 0));
    double mean_square = 0, largest = 0;
    const auto &gaussians = history.state().gaussians;
    for (size_t i = 0; i < gaussians.size(); ++i) {
        const dvec3 offset = center(gaussians[i]) - 0.375 * double(i) * along;
        EXPECT_NEAR(glm::dot(offset, along), 0, 1e-9);
        largest = std::max(largest, glm::length(offset));
        mean_square += glm::dot(offset, offset) / double(gaussians.size());
    }
    EXPECT_LT(largest, 0.5);  // 1 / scale
    EXPECT_GT(largest, 0.45);
    // Uniform in a disc of radius 0.5.
    EXPECT_NEAR(mean_square, 0.125, 0.01);
    // One point: the offset lies in the plane painted on.
    Paint dab = stroke({{1, 2, 3}});
    dab.normal = {0, 1, 0};
    History dabbed;
    dabbed.apply(dab);
    ASSERT_EQ(dabbed.state().gaussians.size(), 1u);
    EXPECT_EQ(dabbed.state().gaussians[0].center[1], 2);
    EXPECT_NE(dabbed.state().gaussians[0].center[0], 1);
}

TEST(MediaErase, TakesAmplitudeAndRemoves)
{
    History history;
    Put put;
    for (int i = 0; i <= 10; ++i)
        put.gaussians.push_back({{0.1 * i, 0, 0}, 1, 1, {}});
    put.gaussians.push_back({{0.5, 3, 0}, 1, 1, {}});
    history.apply(put);
    Erase erase;
    erase.points = {{0, 0, -1}, {0, 0, 1}};
    erase.radius = 0.5;
    erase.strength = 1;
    history.apply(erase);
    const auto &after = history.state().gaussians;
    // The one in the middle of the stroke has nothing left.
    ASSERT_EQ(after.size(), 11u);
    EXPECT_EQ(history.state().selected.size(), after.size());
    for (const Gaussian &gaussian : after) {
        const double d = std::min(1.0, gaussian.center[0] / 0.5), taken = std::pow(1 - d * d, 2);
        EXPECT_NEAR(gaussian.amplitude, gaussian.center[1] > 0 ? 1 : 1 - taken, 1e-12);
    }
    erase.strength = 1e9;
    history.apply(erase);
    EXPECT_EQ(history.state().gaussians.size(), 7u);
}

TEST(MediaEmit, FliesOnParabolas)
{
    Emit emit = steam();
    emit.time = 10;
    History history;
    history.apply(emit);
    // rate * lifetime, give or take those about to be born or to die.
    EXPECT_NEAR(double(history.state().gaussians.size()), 150, 2);
    for (const Gaussian &gaussian : history.state().gaussians) {
        const double age = (1 - gaussian.amplitude) * emit.lifetime;
        const dvec3 expected = emit.position + age * emit.velocity + 0.5 * age * age * emit.acceleration;
        EXPECT_NEAR(glm::distance(center(gaussian), expected), 0, 1e-9);
        EXPECT_NEAR(1 / gaussian.scale, 0.125 + age / 3 * 0.375, 1e-12);
    }
    // Nothing before the first birth; no more births after the duration; nothing when all have died.
    const auto count = [](Emit e) {
        State state;
        e.apply(state);
        return state.gaussians.size();
    };
    emit.time = 0;
    EXPECT_EQ(count(emit), 0u);
    emit.duration = 1;
    emit.time = 2.9;
    EXPECT_NEAR(double(count(emit)), 50, 1);
    emit.time = 4.1;
    EXPECT_EQ(count(emit), 0u);
    emit.rate = 0;
    EXPECT_EQ(count(emit), 0u);
}

// The particles of one time are those of an earlier time, further on: nothing depends on how time was stepped through.
TEST(MediaEmit, ParticlesKeepTheirIdentity)
{
    Emit emit = steam();
    emit.spread = 1;
    emit.radius = 0.2;
    emit.acceleration = dvec3(0.0);
    emit.amplitude = {1, 1};
    emit.lifetime = 1000;
    State early, late;
    emit.time = 2;
    emit.apply(early);
    emit.time = 5;
    emit.apply(late);
    ASSERT_NEAR(double(early.gaussians.size()), 100, 1);
    ASSERT_NEAR(double(late.gaussians.size()), 250, 1);
    for (size_t i = 0; i < early.gaussians.size(); ++i) {
        const dvec3 speed = (center(late.gaussians[i]) - center(early.gaussians[i])) / 3.0;
        EXPECT_LT(glm::distance(speed, emit.velocity), 1);
        EXPECT_NE(speed, emit.velocity);
    }
}

TEST(MediaAirbrush, StaysBeforeSurfaces)
{
    const Airbrush brush = airbrush();
    State state;
    brush.apply(state);
    ASSERT_EQ(state.gaussians.size(), 240u);
    size_t bounced = 0, beside = 0;
    for (const Gaussian &gaussian : state.gaussians) {
        const auto place = brush.lens.project(center(gaussian));
        if (!place || !(place->pixel.x >= 0 && place->pixel.x < 64 && place->pixel.y >= 0 && place->pixel.y < 48))
            continue;
        const float depth = brush.depth->depth[size_t(place->pixel.y) * 64 + size_t(place->pixel.x)];
        ASSERT_LE(place->depth, depth);
        bounced += place->depth < 3;
        beside += place->depth > 3;
    }
    EXPECT_GT(bounced, 20u);
    EXPECT_GT(beside, 20u);
    // Without surfaces the same particles fly through where the block is.
    Airbrush free = brush;
    free.depth = nullptr;
    State through;
    free.apply(through);
    size_t inside = 0;
    for (const Gaussian &gaussian : through.gaussians) {
        const auto place = brush.lens.project(center(gaussian));
        inside += place && place->depth > 3.1 && std::abs(place->pixel.x - 32) < 7 && std::abs(place->pixel.y - 28) < 11;
    }
    EXPECT_GT(inside, 10u);
}

TEST(MediaAirbrush, ReflectsAtTheWall)
{
    Airbrush brush = airbrush();
    auto wall = std::make_shared<DepthMap>(*brush.depth);
    std::fill(wall->depth.begin(), wall->depth.end(), 8.0f);
    brush.depth = wall;
    brush.position = {0.5, 0, -6};
    brush.velocity = {0.6, 0.3, -6};
    brush.spread = brush.drag = brush.diffusion = 0;
    brush.rate = 1;
    brush.duration = 1;
    State state;
    brush.apply(state);
    ASSERT_EQ(state.gaussians.size(), 1u);
    // Born at a random time within the first second, so it has flown for the rest of it; a step of which is lost in the
    // bounce.
    const double age = (state.gaussians[0].center[0] - 0.5) / 0.6;
    ASSERT_GT(age, 0.35);
    const double bounced = -8 + (6 * age - 2);
    EXPECT_NEAR(state.gaussians[0].center[2], bounced, 0.2);
    EXPECT_NEAR(state.gaussians[0].center[1], 0.3 * age, 0.01);
}

TEST(MediaAirbrush, DiffusesAsAsked)
{
    Airbrush brush;
    brush.seed = 4;
    brush.spread = 0;
    brush.diffusion = 0.3;
    brush.rate = 10;
    brush.duration = 100;
    brush.drag = 0;
    State state;
    // A particle of age t has a variance of 2 D t along each axis.
    brush.apply(state);
    double ratio = 0;
    for (size_t i = 0; i < state.gaussians.size(); ++i) {
        const double age = 100 - (double(i) + 0.5) / 10;
        ratio += glm::dot(center(state.gaussians[i]), center(state.gaussians[i])) / (3 * 2 * 0.3 * age) / 1000;
    }
    // The deviation of this estimate is .026.
    EXPECT_NEAR(ratio, 1, 0.1);
}

TEST(MediaAirbrush, LongerDurationCarriesOn)
{
    Airbrush brush = airbrush();
    brush.velocity = {0.1, 0, 0};
    brush.spread = 0;
    brush.diffusion = 0;
    brush.drag = 0;
    brush.duration = 1;
    brush.depth = nullptr;
    State one, two;
    brush.apply(one);
    brush.duration = 2;
    brush.apply(two);
    // A second more, in whole steps.
    for (size_t i = 0; i < one.gaussians.size(); ++i)
        EXPECT_NEAR(two.gaussians[i].center[0] - one.gaussians[i].center[0], 0.1, 1e-9);
}

}  // namespace
}  // namespace brume::media
