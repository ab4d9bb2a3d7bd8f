#include "plan/backend.h"

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

}  // namespace
}  // namespace brume
