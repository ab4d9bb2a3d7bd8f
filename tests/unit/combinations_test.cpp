#include "plan/combinations.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

using namespace brume;

namespace {

std::vector<std::vector<Option>> random_effects(unsigned seed, int count, int offers)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0, 1);
    std::vector<std::vector<Option>> effects(static_cast<size_t>(count));
    for (auto &options : effects)
        for (int i = 0; i < offers; ++i) {
            const double error = std::round(100 * share(random)) / 100, operations = std::round((1 - error) * 20) + 1;
            options.push_back({{{}, error}, operations, operations * (0.5 + share(random))});
        }
    return effects;
}

std::vector<Combination> every(const std::vector<std::vector<Option>> &effects)
{
    std::vector<Combination> all{{}};
    for (const auto &options : effects) {
        std::vector<Combination> next;
        for (const Combination &c : all)
            for (const Option &o : options) {
                Combination &n = next.emplace_back(c);
                n.error = std::hypot(c.error, o.offer.error);
                n.operations += o.operations;
                n.ms += o.ms;
            }
        all = std::move(next);
    }
    return all;
}

}  // namespace

TEST(Combinations, FrontHoldsTheBestOfEveryLimit)
{
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const auto effects = random_effects(seed, 4, 6);
        std::vector<Combination> front{{}};
        for (const auto &options : effects)
            front = with_each(front, options);
        const std::vector<Combination> all = every(effects);
        EXPECT_LT(front.size(), all.size() / 4);
        for (const Combination &limit : all) {
            double least = INFINITY, least_found = INFINITY, nearest = INFINITY, nearest_found = INFINITY;
            for (const Combination &c : all) {
                least = c.error <= limit.error ? std::min(least, c.operations) : least;
                nearest = c.ms <= limit.ms ? std::min(nearest, c.error) : nearest;
            }
            for (const Combination &c : front) {
                least_found = c.error <= limit.error ? std::min(least_found, c.operations) : least_found;
                nearest_found = c.ms <= limit.ms ? std::min(nearest_found, c.error) : nearest_found;
            }
            ASSERT_EQ(least_found, least) << "error up to " << limit.error;
            ASSERT_EQ(nearest_found, nearest) << "milliseconds up to " << limit.ms;
        }
    }
}

TEST(Combinations, OfManyEffectsStayFew)
{
    // Every combination would be 8^10.
    std::vector<Combination> front{{}};
    const auto effects = random_effects(9, 10, 8);
    for (const auto &options : effects) {
        front = with_each(front, options);
        ASSERT_LT(front.size(), 20000u);
    }
    ASSERT_EQ(front.front().options.size(), 10u);
}

TEST(Combinations, OfEqualsTheFirstStays)
{
    const std::vector<Option> options{{{{1}, 0.5}, 3, 2}, {{{2}, 0.5}, 3, 2}};
    const auto front = with_each({{}}, options);
    ASSERT_EQ(front.size(), 1u);
    EXPECT_EQ(front[0].options[0], &options[0]);
}
