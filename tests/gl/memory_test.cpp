// The images that backends keep for the next plan or frame, and what happens when there is no memory for one.
#include <cstdlib>
#include <new>

#include <gtest/gtest.h>

#include "plan/idle_images.h"
#include "support.h"

namespace {
thread_local size_t largest_allocation = size_t(-1);
}

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

namespace brume::test {
namespace {

class Memory : public testing::TestWithParam<bool> {
protected:
    std::unique_ptr<Backend> backend = GetParam() ? owned_backend() : make_cpu_backend(1);

    uint64_t held() const { return backend->host_bytes() + backend->device_bytes(); }

    // A plan with one image; destroyed at once.
    void plan(int32_t width, int32_t height)
    {
        backend->invoke([&] {
            auto timer = backend->create_timer();
            auto image = backend->create_image(width, height, 4, BRUME_PIXEL_F32);
        });
    }
    void frame()
    {
        backend->invoke([&] { backend->flush(); });
    }
};
INSTANTIATE_TEST_SUITE_P(Backends, Memory, testing::Bool(), [](const auto &info) { return info.param ? "Gl" : "Cpu"; });

TEST_P(Memory, PlansOfNewSizesDoNotPileUp)
{
    for (int i = 0; i < 600; ++i) {
        plan(64 + i, 16);
        ASSERT_LE(held(), uint64_t(64 + i) * 16 * 16) << "after " << i << " plans";
    }
}

TEST_P(Memory, OtherPlansMakeIdleImagesOld)
{
    plan(512, 512);
    for (uint64_t i = 0; i <= idle_frames; ++i)
        plan(8, 8);
    EXPECT_EQ(held(), 8u * 8 * 16);
}

TEST_P(Memory, FramesMakeIdleImagesOld)
{
    plan(512, 512);
    for (uint64_t i = 0; i < idle_frames; ++i)
        frame();
    EXPECT_EQ(held(), 512u * 512 * 16);
    frame();
    EXPECT_EQ(held(), 0u);
}

TEST_P(Memory, TrimKeepsOnlyWhatIsInUse)
{
    plan(512, 512);
    std::shared_ptr<Image> kept;
    backend->invoke([&] {
        kept = backend->create_image(8, 8, 1, BRUME_PIXEL_F32);
        backend->trim();
    });
    EXPECT_EQ(held(), 8u * 8 * 4);
    kept.reset();
    EXPECT_EQ(held(), 8u * 8 * 4) << "it may serve again";
    backend->invoke([&] { backend->trim(); });
    EXPECT_EQ(held(), 0u);
}

TEST_P(Memory, TooLargeImagesSayHowMuchWasWanted)
{
    if (GetParam() && gl_is_hardware(GlOptions{}))
        GTEST_SKIP() << "this device may have the memory";
    plan(64, 64);
    const Failure failure = failure_of([&] {
        backend->invoke([&] {
            largest_allocation = 1 << 20;
            backend->create_image(16384, 12288, 4, BRUME_PIXEL_F32);
        });
    });
    largest_allocation = size_t(-1);
    EXPECT_EQ(failure.status, BRUME_ERROR_MEMORY);
    EXPECT_NE(failure.message.find("16384 x 12288 x 4 floats, 3.2 GB: out of "), std::string::npos) << failure.message;
    EXPECT_EQ(held(), 0u) << "idle images are kept where memory is short";
}

}  // namespace
}  // namespace brume::test
