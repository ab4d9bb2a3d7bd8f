#include "plan/shadow_maps.h"

#include <random>

#include <gtest/gtest.h>

namespace brume {
namespace {

TEST(Pack, PutsRectanglesSideBySide)
{
    std::mt19937 random(3);
    for (int count : {1, 2, 5, 64}) {
        std::vector<Rectangle> rectangles;
        double area = 0;
        for (int i = 0; i < count; ++i) {
            rectangles.push_back({-1, -1, 1 + int(random() % 300), 1 + int(random() % 300)});
            area += double(rectangles.back().width) * rectangles.back().height;
        }
        const Rectangle all = pack(rectangles, 16384);
        EXPECT_LE(area, double(all.width) * all.height);
        EXPECT_LE(double(all.width) * all.height, count == 1 ? area : 2.5 * area + 300 * 300);
        for (size_t i = 0; i < rectangles.size(); ++i) {
            const Rectangle &a = rectangles[i];
            EXPECT_TRUE(a.x >= 0 && a.y >= 0 && a.x + a.width <= all.width && a.y + a.height <= all.height);
            for (size_t k = 0; k < i; ++k) {
                const Rectangle &b = rectangles[k];
                EXPECT_TRUE(a.x + a.width <= b.x || b.x + b.width <= a.x || a.y + a.height <= b.y || b.y + b.height <= a.y);
            }
        }
    }
}

TEST(Pack, WidensBeforeItGivesUp)
{
    std::vector<Rectangle> high{{0, 0, 10, 90}, {0, 0, 10, 90}, {0, 0, 10, 90}, {0, 0, 10, 90}};
    const Rectangle fits = pack(high, 100);
    EXPECT_LE(fits.width, 100);
    EXPECT_LE(fits.height, 100);
    std::vector<Rectangle> many(20, Rectangle{0, 0, 60, 60});
    EXPECT_GT(pack(many, 100).height, 100);
}

}  // namespace
}  // namespace brume
