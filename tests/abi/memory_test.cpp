// Plans that are too large for the memory, and giving memory back.
#include <cstdlib>
#include <new>

#include "support.h"

using namespace client;

namespace {
thread_local size_t largest_allocation = size_t(-1);
}

// The library's, too.
void *operator new(size_t size)
{
    if (size <= largest_allocation)
        if (void *memory = std::malloc(size ? size : 1))
            return memory;
    throw std::bad_alloc();
}
void operator delete(void *memory) noexcept
{
    std::free(memory);
}
void operator delete(void *memory, size_t) noexcept
{
    std::free(memory);
}

namespace {

class ImageMemory : public EachBackend {
protected:
    uint64_t held() const
    {
        brume_context_info info = BRUME_CONTEXT_INFO_INIT;
        EXPECT_EQ(brume_context_get_info(context.get(), &info), BRUME_OK);
        return info.host_bytes + info.device_bytes;
    }
};
INSTANTIATE_EACH_BACKEND(ImageMemory);

TEST_P(ImageMemory, TrimGivesBackWhatNoPlanHolds)
{
    EXPECT_EQ(brume_context_trim(nullptr), BRUME_ERROR_ARGUMENT);
    Scene scene = make_scene(context, foggy);
    Plan kept = make_plan(context, scene, ray_format(32, 32));
    ASSERT_EQ(brume_context_trim(context.get()), BRUME_OK);
    const uint64_t before = held();
    EXPECT_GT(before, 0u);
    make_plan(context, scene, ray_format(256, 256));
    EXPECT_GT(held(), before);
    ASSERT_EQ(brume_context_trim(context.get()), BRUME_OK);
    EXPECT_EQ(held(), before);
}

TEST(TooLargePlans, SayWhatWasWantedAndHoldNothing)
{
    Context context = make_context(BRUME_BACKEND_CPU);
    Scene scene = make_scene(context, foggy);
    const brume_format format = ray_format(2048, 1024);
    brume_plan plan = nullptr;
    largest_allocation = size_t(20) << 20;
    const brume_status status = brume_plan_create(scene.get(), &format, &plan);
    largest_allocation = size_t(-1);
    expect_status(context.get(), status, BRUME_ERROR_MEMORY, " x 4 floats, ");
    expect_status(context.get(), status, BRUME_ERROR_MEMORY, "MB: out of memory");
    expect_status(context.get(), status, BRUME_ERROR_MEMORY, "image ");
    brume_context_info info = BRUME_CONTEXT_INFO_INIT;
    ASSERT_EQ(brume_context_get_info(context.get(), &info), BRUME_OK);
    EXPECT_EQ(info.host_bytes, 0u);
}

}  // namespace
