// The threads that take the place of TBB's in the bundle.
#include <atomic>
#include <stdexcept>

#include <gtest/gtest.h>

#include "hosts/openfx/threads/oneapi/tbb/threads.h"

namespace {

using namespace oneapi;

TEST(OpenFXThreads, EachIndexOnce)
{
    for (int threads : {1, 2, 7}) {
        tbb::task_arena arena(threads);
        for (int count : {0, 1, 2, 1000}) {
            std::vector<std::atomic<int>> met(size_t(count) + 3);
            arena.execute([&] { tbb::parallel_for(3, count + 3, [&](int i) { ++met[size_t(i)]; }); });
            for (int i = 0; i < count; ++i)
                EXPECT_EQ(met[size_t(i) + 3], 1) << i << " of " << count << ", " << threads << " threads";
            std::atomic<int> rows = 0;
            arena.execute([&] {
                tbb::parallel_for(tbb::blocked_range<int>(0, count, 16), [&](const tbb::blocked_range<int> &range) {
                    EXPECT_LE(range.end() - range.begin(), 16);
                    rows += range.end() - range.begin();
                });
            });
            EXPECT_EQ(rows, count);
        }
    }
}

TEST(OpenFXThreads, AllAreUsed)
{
    tbb::task_arena arena(3);
    std::atomic<int> there = 0;
    arena.execute([&] {
        tbb::parallel_for(0, 3, [&](int) {
            ++there;
            while (there < 3)
                std::this_thread::yield();
        });
    });
    EXPECT_EQ(there, 3);
}

TEST(OpenFXThreads, WhatIsThrownArrivesAndEndsTheLoop)
{
    tbb::task_arena arena(4);
    for (int round = 0; round < 20; ++round)
        EXPECT_THROW(arena.execute([&] {
            tbb::parallel_for(0, 100, [](int i) {
                if (i == 17)
                    throw std::runtime_error("17");
            });
        }),
                     std::runtime_error);
    std::atomic<int> met = 0;
    arena.execute([&] { tbb::parallel_for(0, 100, [&](int) { ++met; }); });
    EXPECT_EQ(met, 100);
}

}  // namespace
