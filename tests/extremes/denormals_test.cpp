// Denormal inputs, and callers whose thread flushes denormals to zero, rounds otherwise or traps.
#include <cfenv>

#include <gtest/gtest.h>

#include "columns.h"

#ifdef __SSE2__
#include <pmmintrin.h>
#include <xmmintrin.h>
#endif

using namespace extremes;
using fog::Frame;
using fog::Picture;
using fog::Result;

namespace {

Frame denormal_frame()
{
    Frame frame = fog::lit_frame(40, 64);
    const float values[] = {1e-45f, 1e-42f, 1e-40f, 1.1e-38f, -1e-40f, 1e-37f};
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 40; ++x) {
            if ((x + y) % 3 == 0)
                std::fill_n(frame.color.at(x, y), 3, values[(x + 5 * y) % 6]);
            if ((x + y) % 5 == 0)
                frame.depth.at(x, y)[0] = std::abs(values[(x + y) % 6]);
        }
    return frame;
}

std::vector<Condition> denormal_media()
{
    Condition ordinary{"denormals", "in the image", ordinary_medium(), ordinary_lights()};
    std::vector<Condition> all{ordinary};
    ordinary.medium["density"] = {fog::constant(1)};
    all.push_back(ordinary);
    for (double tiny : {1e-45, 1e-40, 1e-38}) {
        Condition c = ordinary;
        c.name = "in the medium";
        c.medium["scattering"] = {tiny, 0.05, 1e-3};
        c.medium["absorption"] = {0, tiny, 1e-3};
        c.medium["density"] = {fog::constant(tiny), fog::gaussian({0.5, 0.2, -4}, 0.8, tiny)};
        c.lights[0]["intensity"] = {tiny, 1, 1e30};
        all.push_back(c);
    }
    return all;
}

// Results with a mode set before the context exists, and so before any worker has a mode.
std::vector<Result> results(const Frame &frame, const std::function<void()> &set_mode)
{
    fog::Context context(BRUME_BACKEND_CPU, 2);
    std::vector<Result> all;
    for (const Condition &c : denormal_media())
        for (const Column &column : columns())
            if (column.takes(c) && !(column.filters() && column.cpu_only)) {
                const std::string scene = column.scene(c);
                const fog::Options options = options_of(column);
                std::fenv_t before;
                std::fegetenv(&before);
                set_mode();
                try {
                    all.push_back(fog::run(context, scene, frame.color, frame.depth, options));
                } catch (...) {
                    std::fesetenv(&before);
                    throw;
                }
                std::fesetenv(&before);
            }
    return all;
}

void expect_same(const std::vector<Result> &a, const std::vector<Result> &b)
{
    ASSERT_EQ(a.size(), b.size());
    for (size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].output.data, b[i].output.data) << i;
        EXPECT_EQ(a[i].transmittance.data, b[i].transmittance.data) << i;
        EXPECT_EQ(a[i].airlight.data, b[i].airlight.data) << i;
    }
}

}  // namespace

TEST(Denormals, GiveFiniteResults)
{
    for (const Result &r : results(denormal_frame(), [] {}))
        for (const Picture *p :
             {&r.output, &r.transmittance, &r.optical_depth, &r.airlight, &r.airlight_error, &r.scattered})
            for (float v : p->data)
                ASSERT_TRUE(std::isfinite(v)) << v;
}

// Bit for bit, which is less than the 1e-37 that flushing may cost.
TEST(Denormals, ResultsDoNotDependOnTheCallersMode)
{
    const Frame frame = denormal_frame();
    const std::vector<Result> expected = results(frame, [] {});
#ifdef __SSE2__
    expect_same(results(frame,
                        [] {
                            _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
                            _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
                        }),
                expected);
#endif
    for (int rounding : {FE_UPWARD, FE_TOWARDZERO})
        expect_same(results(frame, [=] { std::fesetround(rounding); }), expected);
}

TEST(Denormals, TheCallersModeIsAsItWas)
{
    const Frame frame = fog::lit_frame(4, 3);
    const Condition c{"", "", ordinary_medium(), ordinary_lights()};
    std::fenv_t before;
    std::fegetenv(&before);
    std::fesetround(FE_DOWNWARD);
#ifdef __SSE2__
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
#endif
    const Result r = fog::run(fog::cpu(), column("calibrated and nodes").scene(c), frame.color, frame.depth);
    const int rounding = std::fegetround();
#ifdef __SSE2__
    const unsigned flush = _MM_GET_FLUSH_ZERO_MODE();
#endif
    std::fesetenv(&before);
    EXPECT_EQ(rounding, FE_DOWNWARD);
#ifdef __SSE2__
    EXPECT_EQ(flush, unsigned(_MM_FLUSH_ZERO_ON));
#endif
}

#ifdef BRUME_GL
// Software GL computes on the same processor; GPUs are free to flush.
TEST(Denormals, GlAgreesWithTheCpu)
{
    const Frame frame = denormal_frame();
    for (const Condition &c : denormal_media())
        for (const char *name : {"calibrated", "nodes"}) {
            const Column &column = extremes::column(name);
            const fog::Options options = options_of(column);
            const Picture a = fog::run(fog::backend("gl"), column.scene(c), frame.color, frame.depth, options).output,
                          b = fog::run(fog::cpu(), column.scene(c), frame.color, frame.depth, options).output;
            for (size_t i = 0; i < a.data.size(); ++i)
                ASSERT_NEAR(a.data[i], b.data[i], 1e-37 + 2e-3 * (0.05 + std::abs(b.data[i])))
                    << name << " " << c.name << " " << i;
        }
}
#endif
