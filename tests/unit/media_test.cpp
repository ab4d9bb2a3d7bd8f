// Operations on media of Gaussians: what each does to the state, its history, and that journals replay to the same bits.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include <brume/brume_media.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "media/base64.h"
#include "media/history.h"
#include "media/random.h"

namespace brume::media {
namespace {

dvec3 center(const Gaussian &gaussian)
{
    return {gaussian.center[0], gaussian.center[1], gaussian.center[2]};
}

template <class Call> std::string failure(Call call, brume_status status = BRUME_ERROR_ARGUMENT)
{
    try {
        call();
    } catch (const Error &error) {
        EXPECT_EQ(error.status(), status) << error.what();
        return error.what();
    }
    return "accepted";
}

bool same_bits(const std::vector<Gaussian> &a, const std::vector<Gaussian> &b)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Gaussian &x, const Gaussian &y) {
        return std::memcmp(&x.center, &y.center, sizeof x.center) == 0 && x.scale == y.scale && x.amplitude == y.amplitude &&
               std::memcmp(&x.color, &y.color, sizeof x.color) == 0;
    });
}

void expect_same(const State &a, const State &b)
{
    EXPECT_TRUE(same_bits(a.gaussians, b.gaussians));
    EXPECT_TRUE(same_bits(a.clipboard, b.clipboard));
    EXPECT_EQ(a.selected, b.selected);
}

// A camera at the origin that looks down -z over a picture of 64 x 48; the half width of what it sees is 1 at depth 1.
Lens lens()
{
    Lens lens;
    lens.center = {32, 24};
    lens.tangent_scale = {1 / 32.0, -1 / 32.0};
    return lens;
}

// A back wall at depth 8 with a block in the middle at depth 3, and sky above.
std::shared_ptr<const DepthMap> room()
{
    auto map = std::make_shared<DepthMap>();
    map->width = 64;
    map->height = 48;
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x)
            map->depth.push_back(y < 8                                    ? std::numeric_limits<float>::infinity()
                                 : x >= 24 && x < 40 && y >= 16 && y < 40 ? 3.0f
                                                                          : 8.0f);
    return map;
}

Paint stroke(std::vector<dvec3> points)
{
    Paint paint;
    paint.seed = 5;
    paint.points = std::move(points);
    paint.scale = 2;
    paint.amplitude = 0.7;
    paint.color = {1, 0.5, 0.25};
    return paint;
}

Airbrush airbrush()
{
    Airbrush brush;
    brush.seed = 9;
    brush.position = {0, 0, -2};
    brush.velocity = {0, 0, -3};
    brush.spread = 2;
    brush.drag = 0.5;
    brush.diffusion = 0.4;
    brush.rate = 60;
    brush.duration = 4;
    brush.scale = 5;
    brush.lens = lens();
    brush.depth = room();
    return brush;
}

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

Emit steam()
{
    Emit emit;
    emit.seed = 11;
    emit.position = {1, 2, 3};
    emit.velocity = {0, 0, 2};
    emit.acceleration = {0.5, 0, -1};
    emit.rate = 50;
    emit.lifetime = 3;
    emit.scale = {8, 2};
    emit.amplitude = {1, 0};
    return emit;
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

Put grid()
{
    Put put;
    for (int y = -3; y <= 3; ++y)
        for (int x = -3; x <= 3; ++x)
            put.gaussians.push_back({{x * 1.0, y * 1.0, -4}, 1, 1, {1, 1, 1}});
    put.gaussians.push_back({{0, 0, 4}, 1, 1, {1, 1, 1}});  // behind the camera
    return put;
}

size_t selected(const History &history)
{
    return size_t(std::count(history.state().selected.begin(), history.state().selected.end(), 1));
}

TEST(MediaSelection, SelectsCopiesMovesDeletes)
{
    History history;
    history.apply(grid());
    SelectRectangle select;
    select.lens = lens();
    // At depth 4 a unit is 8 pixels: the upper right quarter, axes included.
    select.rectangle = {31, 0, 64, 25};
    history.apply(select);
    EXPECT_EQ(selected(history), 16u);
    for (size_t i = 0; i < history.state().gaussians.size(); ++i) {
        const dvec3 at = center(history.state().gaussians[i]);
        EXPECT_EQ(bool(history.state().selected[i]), at.z < 0 && at.x >= 0 && at.y >= 0);
    }
    select.mode = BRUME_MEDIA_SELECT_ADD;
    select.rectangle = {0, 0, 33, 25};
    history.apply(select);
    EXPECT_EQ(selected(history), 28u);
    select.mode = BRUME_MEDIA_SELECT_REMOVE;
    history.apply(select);
    EXPECT_EQ(selected(history), 12u);

    history.apply(Copy{});
    EXPECT_EQ(history.state().clipboard.size(), 12u);
    Move move;
    move.offset = {0, 0, -1};
    history.apply(move);
    for (size_t i = 0; i < history.state().gaussians.size(); ++i)
        EXPECT_EQ(history.state().gaussians[i].center[2] == -5, bool(history.state().selected[i]));
    Paste paste;
    paste.offset = {10, 0, 0};
    history.apply(paste);
    EXPECT_EQ(history.state().gaussians.size(), 62u);
    EXPECT_EQ(selected(history), 12u);
    for (size_t i = 50; i < 62; ++i) {
        EXPECT_TRUE(history.state().selected[i]);
        EXPECT_EQ(history.state().gaussians[i].center[2], -4);
        EXPECT_GE(history.state().gaussians[i].center[0], 10);
    }
    history.apply(Delete{});
    EXPECT_EQ(history.state().gaussians.size(), 50u);
    EXPECT_EQ(selected(history), 0u);
    history.apply(SelectAll{});
    EXPECT_EQ(selected(history), 50u);
    history.apply(SelectNone{});
    EXPECT_EQ(selected(history), 0u);
}

// One of everything, with numbers that have no short decimals.
std::vector<Operation> everything()
{
    Put put = grid();
    put.gaussians[0].center = {-0.0, 1.0 / 3, 1e-300 * 0 + std::numbers::pi};
    put.gaussians[1].color = {0.1f, 1.0f / 3, 0};
    Erase erase;
    erase.points = {{0.1, 0.2, -4}, {1.0 / 7, -2, -4}};
    erase.radius = 1.1;
    erase.strength = 0.7;
    Emit emit = steam();
    emit.spread = 1.0 / 3;
    emit.time = 4.2;
    SelectRectangle select;
    select.lens = lens();
    select.lens.tangent_scale *= 1 + 1e-15;
    select.rectangle = {10.1, 0, 64, 25};
    Paste paste;
    paste.offset = {0.1, -0.0, 3};
    Move move;
    move.offset = {1e-17, 1.0 / 3, 0};
    Airbrush again = airbrush();
    again.seed = 10;
    Airbrush free = airbrush();
    free.depth = nullptr;
    auto shared = airbrush();
    again.depth = shared.depth;
    return {put,    stroke({{0, 0, 0}, {1.0 / 3, 2, 3}, {4, 5, 6}}),
            erase,  emit,
            select, Copy{},
            paste,  move,
            shared, again,
            free,   SelectAll{},
            Copy{}, SelectNone{},
            select, Delete{}};
}

TEST(MediaHistory, UndoesAndRedoes)
{
    History history;
    std::vector<State> states{history.state()};
    for (const Operation &operation : everything()) {
        history.apply(operation);
        states.push_back(history.state());
    }
    const size_t count = states.size() - 1;
    EXPECT_EQ(history.undo_count(), count);
    EXPECT_NE(failure([&] { history.redo(); }).find("nothing to redo"), std::string::npos);
    for (size_t i = count; i-- > 0;) {
        history.undo();
        expect_same(history.state(), states[i]);
        EXPECT_EQ(history.redo_count(), count - i);
    }
    EXPECT_NE(failure([&] { history.undo(); }).find("nothing to undo"), std::string::npos);
    for (size_t i = 1; i <= count; ++i) {
        history.redo();
        expect_same(history.state(), states[i]);
    }
    // A new operation ends what could be redone.
    history.undo();
    history.undo();
    history.apply(SelectAll{});
    EXPECT_EQ(history.redo_count(), 0u);
    EXPECT_EQ(history.undo_count(), count - 1);
}

TEST(MediaHistory, ForgottenStatesComeBack)
{
    History history;
    Put put;
    put.gaussians.resize(400000);
    history.apply(put);
    Move move;
    move.offset = {0.1, 0, 0};
    history.apply(SelectAll{});
    for (int i = 0; i < 14; ++i)
        history.apply(move);
    const State last = history.state();
    for (int i = 0; i < 14; ++i)
        history.undo();
    EXPECT_EQ(history.state().gaussians[0].center[0], 0);
    EXPECT_EQ(history.state().gaussians.size(), 400000u);
    for (int i = 0; i < 14; ++i)
        history.redo();
    expect_same(history.state(), last);
}

TEST(MediaHistory, AFailureChangesNothing)
{
    History history;
    history.apply(stroke({{0, 0, 0}, {3, 0, 0}}));
    const State before = history.state();
    EXPECT_EQ(failure([&] {
                  Paint paint = stroke({{0, 0, 0}});
                  paint.scale = 0;
                  history.apply(paint);
              }),
              "paint.scale: 0; expected a number from 1e-30 to 1e+30");
    EXPECT_EQ(failure([&] {
                  Paint paint = stroke({{0, 0, 0}});
                  paint.color[2] = -0.5;
                  history.apply(paint);
              }),
              "paint.color[2]: -0.5; expected a number from 0 to 1");
    EXPECT_EQ(failure([&] { history.apply(stroke({})); }), "paint.points: 0 of them; expected 1 to 65536");
    EXPECT_NE(failure([&] {
                  history.apply(stroke({{0, 0, 0}, {NAN, 0, 0}}));
              }).find("paint.points[1][0]: nan"),
              std::string::npos);
    EXPECT_NE(failure([&] {
                  history.apply(stroke({{0, 0, 0}, {1e9, 0, 0}}));
              }).find("expected 1000000 at most"),
              std::string::npos);
    EXPECT_NE(failure([&] {
                  Emit emit = steam();
                  emit.rate = 1e9;
                  emit.time = 1e6;
                  history.apply(emit);
              }).find("emit: makes"),
              std::string::npos);
    EXPECT_NE(failure([&] {
                  Emit emit = steam();
                  emit.velocity = {1e30, 0, 0};
                  emit.time = 3;
                  history.apply(emit);
              }).find("emit.center[0]"),
              std::string::npos);
    EXPECT_NE(failure([&] {
                  Airbrush brush = airbrush();
                  brush.rate = 1e3;
                  brush.duration = 900;
                  history.apply(brush);
              }).find("steps; expected"),
              std::string::npos);
    EXPECT_NE(failure([&] {
                  Airbrush brush = airbrush();
                  brush.position = {0, 0, -3.5};
                  history.apply(brush);
              }).find("airbrush.position: 0, 0, -3.5; expected a place before"),
              std::string::npos);
    EXPECT_NE(failure([&] {
                  SelectRectangle select;
                  select.mode = 3;
                  history.apply(select);
              }).find("select_rectangle.mode: 3"),
              std::string::npos);
    EXPECT_NE(failure([&] {
                  Erase erase;
                  erase.points.resize(65536);
                  Put put;
                  put.gaussians.resize(100000);
                  History large;
                  large.apply(put);
                  large.apply(erase);
              }).find("erase.points: 65536 of them over 100000"),
              std::string::npos);
    expect_same(history.state(), before);
    EXPECT_EQ(history.undo_count(), 1u);
}

TEST(MediaJournal, ReplaysToTheSameBits)
{
    History history;
    for (const Operation &operation : everything())
        history.apply(operation);
    for (int i = 0; i < 3; ++i)
        history.undo();
    const std::string text = journal_of(history);
    // The header, the room's depth once, the operations, the undos.
    EXPECT_EQ(size_t(std::count(text.begin(), text.end(), '\n')), 1 + 1 + everything().size() + 3);
    EXPECT_NE(text.find("\"colour\":[1,0.5,0.25]"), std::string::npos) << "the key that journals of 0.1 have";
    History copy;
    replay(copy, text, "journal");
    expect_same(copy.state(), history.state());
    EXPECT_EQ(copy.redo_count(), 3u);
    EXPECT_EQ(journal_of(copy), text);
    for (int i = 0; i < 3; ++i) {
        copy.redo();
        history.redo();
        expect_same(copy.state(), history.state());
    }
    // CRLF, blank lines, and no newline at the end.
    std::string typed;
    for (const char c : text.substr(0, text.size() - 1))
        typed += c == '\n' ? std::string("\r\n \n") : std::string(1, c);
    History again;
    replay(again, typed, "journal");
    EXPECT_EQ(journal_of(again), text);
}

TEST(MediaJournal, SaysWhatIsWrongAndWhere)
{
    const std::string header = "{\"brume_journal\": 1}\n";
    const auto says = [](const std::string &text) {
        History history;
        history.apply(SelectAll{});
        const std::string message = failure([&] { replay(history, text, "fog.journal"); }, BRUME_ERROR_SCENE);
        EXPECT_EQ(history.undo_count(), 1u);
        return message;
    };
    EXPECT_EQ(says(""), "fog.journal: empty; expected a line {\"brume_journal\": 1}");
    EXPECT_NE(says("{\"brume\": 1}\n").find("fog.journal:1:2: unknown key \"brume\""), std::string::npos);
    EXPECT_NE(says("{\"brume_journal\": 2}\n").find("fog.journal:1:"), std::string::npos);
    EXPECT_NE(says(header + "paint\n").find("fog.journal:2:1: syntax error"), std::string::npos);
    EXPECT_NE(says(header + "\n[]\n").find("fog.journal:3:1: an array of 0; expected an object"), std::string::npos);
    EXPECT_NE(says(header + "{\"op\": \"smear\"}\n").find("\"smear\"; expected one of put, paint, erase"),
              std::string::npos);
    EXPECT_NE(says(header + "{\"op\": \"erase\"}\n").find("has no \"points\""), std::string::npos);
    EXPECT_NE(says(header + "{\"op\": \"move\", \"offset\": [1, 2]}\n").find("an array of 3 numbers"), std::string::npos);
    EXPECT_NE(
        says(header + "{\"op\": \"move\", \"offset\": [1, 2, 1e40]}\n").find("offset[2]: 1e+40; expected a number from"),
        std::string::npos);
    EXPECT_NE(says(header + "{\"op\": \"move\", \"offset\": [1, 2, 3], \"by\": 1}\n").find("unknown key \"by\""),
              std::string::npos);
    EXPECT_NE(
        says(header + "{\"op\": \"erase\", \"points\": [], \"radius\": 1, \"strength\": 1}\n").find("1 to 65536 points"),
        std::string::npos);
    EXPECT_NE(says(header + "{\"op\": \"put\", \"gaussians\": \"x,y,z,scale,amplitude\\n1,2,3,0,1\"}\n")
                  .find("fog.journal:2: gaussians:2: scale: 0; expected"),
              std::string::npos);
    EXPECT_NE(says(header + "{\"op\": \"redo\"}\n").find("fog.journal:2: redo: there is nothing to redo"),
              std::string::npos);
    EXPECT_NE(says(header + "{\"op\": \"undo\"}\n{\"op\": \"undo\"}\n").find("fog.journal:3: undo: there is nothing"),
              std::string::npos);
    EXPECT_NE(says(header + "{\"depth\": 2, \"width\": 1, \"height\": 1, \"data\": \"AAAAAA==\"}\n").find("expected 1"),
              std::string::npos);
    EXPECT_NE(
        says(header + "{\"depth\": 1, \"width\": 2, \"height\": 1, \"data\": \"AAAAAA==\"}\n").find("base64 of 2 floats"),
        std::string::npos);
    EXPECT_NE(says(header + "{\"depth\": 1, \"width\": 65536, \"height\": 65536, \"data\": \"\"}\n").find("base64 of"),
              std::string::npos);
}

// Damaged journals end in a message or in a state that could be saved.
TEST(MediaJournal, SurvivesDamage)
{
    History history;
    for (const Operation &operation : everything())
        if (!std::holds_alternative<Airbrush>(operation))
            history.apply(operation);
    const std::string whole = journal_of(history);
    size_t accepted = 0, refused = 0;
    for (uint64_t i = 0; i < 600; ++i) {
        Random random(2, i);
        std::string text = whole;
        for (int hits = 1 + int(random.next() * 2); hits > 0; --hits)
            text[size_t(random.next() * double(text.size()))] = "0123456789-eE.,:{}[]\"\n"[size_t(random.next() * 22)];
        History damaged;
        try {
            replay(damaged, text, "damaged");
            ++accepted;
        } catch (const Error &error) {
            EXPECT_EQ(std::string(error.what()).substr(0, 7), "damaged");
            EXPECT_EQ(damaged.undo_count(), 0u);
            ++refused;
        }
    }
    EXPECT_GT(accepted, 20u);
    EXPECT_GT(refused, 20u);
}

}  // namespace
}  // namespace brume::media
