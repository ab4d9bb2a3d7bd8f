// What kinds of work take by a backend's nominal rates.
#include <gtest/gtest.h>

#include "plan/backend.h"
#include "plan/rates.h"

namespace brume {
namespace {

TEST(Rates, OfKindsOfWorkAddUp)
{
    const auto cpu = make_cpu_backend(1);
    EXPECT_EQ(nanoseconds(*cpu, {1000, 0, 0}), 1000) << "the unit";
    EXPECT_EQ(nanoseconds(*cpu, {0, 1000, 0}), 250) << "side by side";
    EXPECT_EQ(nanoseconds(*cpu, {0, 0, 1000}), 1500);
    EXPECT_EQ(nanoseconds(*cpu, {1000, 1000, 1000}), 2750);
    EXPECT_EQ(nanoseconds(*cpu, {}), 0);
    const auto many = make_cpu_backend(0);
    EXPECT_EQ(nanoseconds(*many, {1000, 1000, 1000}), 2750) << "of one thread";
}

}  // namespace
}  // namespace brume
