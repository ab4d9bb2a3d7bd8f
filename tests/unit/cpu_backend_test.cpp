#include "plan/backend.h"

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <thread>

#include <gtest/gtest.h>

namespace brume {
namespace {

#if defined(__x86_64__) && defined(__GNUC__)
// Whether the upper halves of wide registers are in use, after which whatever knows no AVX is slow; XGETBV of component 1
// tells.
bool wide_registers_rest()
{
    uint32_t in_use = 0, high = 0;
    asm volatile("xgetbv" : "=a"(in_use), "=d"(high) : "c"(1));
    return !(in_use & 4);
}

bool can_tell()
{
    uint32_t tells = 0, b = 0, c = 1, d = 0;
    asm("cpuid" : "=a"(tells), "=b"(b), "+c"(c), "=d"(d) : "a"(13));
    return __builtin_cpu_supports("avx") && (tells & 4);
}

brume_status leaves_them_in_use(const brume_plugin_rows *, int32_t, int32_t)
{
    asm volatile("vcmpps $15, %%ymm15, %%ymm15, %%ymm15" ::: "xmm15");
    return wide_registers_rest() ? BRUME_ERROR_INTERNAL : BRUME_OK;
}

// What rows leave behind does not slow down the host.
TEST(CpuBackend, LeavesWideRegistersAtRest)
{
    if (!can_tell())
        GTEST_SKIP() << "this processor does not tell";
    const std::unique_ptr<Backend> backend = make_cpu_backend(1);
    brume_pass_desc desc{};
    desc.struct_size = sizeof desc;
    desc.name = "wide";
    desc.rows = leaves_them_in_use;
    desc.grain = 1;
    backend->invoke([&] {
        const std::shared_ptr<Pass> pass = backend->create_pass(desc, layout_of(desc));
        ASSERT_EQ(backend->run(*pass, nullptr, nullptr, 4, 4, brume_plugin_scene{}, nullptr, nullptr), BRUME_OK);
        EXPECT_TRUE(wide_registers_rest());
    });
}
#endif

#ifdef __SANITIZE_THREAD__
struct Race {
    const std::thread::id caller = std::this_thread::get_id();
    std::atomic<int> stage = 0;
    alignas(64) int written = 0;  // by itself: of each few bytes the sanitizer remembers few accesses
};

// A block of the caller's writes, and one of another thread's that begins when that has ended: one after the other in time,
// yet in no order that anything but luck gives them.
brume_status races(const brume_plugin_rows *call, int32_t, int32_t)
{
    constexpr auto relaxed = std::memory_order_relaxed;
    Race &race = *static_cast<Race *>(call->user);
    const bool is_caller = std::this_thread::get_id() == race.caller;
    const int stage = race.stage.load(relaxed);
    if (stage == 3)
        return BRUME_OK;
    if (is_caller ? stage == 0 : stage == 2)
        race.written = stage;
    if (is_caller ? stage < 2 : stage == 2)
        race.stage.store(stage + 1, relaxed);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return BRUME_OK;
}

// Whether this build's sanitizer would tell of rows that race.
TEST(CpuBackendDeathTest, ARaceOfTwoBlocksIsReported)
{
    if (make_cpu_backend(2)->threads() < 2)
        GTEST_SKIP() << "there is one processor";
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const auto run = [] {
        const std::unique_ptr<Backend> backend = make_cpu_backend(2);
        brume_pass_desc desc{};
        desc.struct_size = sizeof desc;
        desc.name = "race";
        desc.rows = races;
        desc.grain = 1;
        Race race;
        const std::shared_ptr<Pass> pass = backend->create_pass(desc, layout_of(desc));
        backend->run(*pass, nullptr, nullptr, 4, 5000, brume_plugin_scene{}, &race, nullptr);
        std::exit(race.stage == 3 ? 0 : 3);
    };
    constexpr int reported = 66;
    EXPECT_EXIT(run(), testing::ExitedWithCode(reported), "data race(.|\n)*races");
}
#endif

}  // namespace
}  // namespace brume
