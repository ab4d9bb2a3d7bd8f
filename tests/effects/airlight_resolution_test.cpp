// Reduced resolution (Fogshop sec. 5.4) against every pixel's own airlight.
#include <gtest/gtest.h>

#include "lit_scene.h"

using namespace fog;

TEST(AirlightResolution, ErrorIsSmallAndNothingBleedsOverEdges)
{
    const int width = 90, height = 60;
    const Frame frame = lit_frame(width, height);
    for (const auto &[name, scene, tiers] : lit_scenes()) {
        auto airlight = [&](const char *resolution) {
            Json s = scene;
            s["effects"]["airlight"]["resolution"] = resolution;
            return run(cpu(), s.dump(), frame.color, frame.depth, Options{{}, {"airlight"}}).airlight;
        };
        const Picture full = airlight("full");
        double mean = 0;
        for (float v : full.data)
            mean += v / double(full.data.size());
        for (auto [resolution, bound, edge_bound] : {std::tuple("half", 0.03, 0.1), {"quarter", 0.2, 0.35}}) {
            const Picture reduced = airlight(resolution);
            // Beside an edge: a neighbour at another distance. There what is not this surface's would show.
            double error = 0, edge_error = 0, step = 0;
            int edges = 0;
            for (int y = 0; y < height; ++y)
                for (int x = 1; x + 1 < width; ++x) {
                    const float d = frame.depth.at(x, y)[0];
                    bool edge = false;
                    for (int side : {-1, 1}) {
                        const float other = frame.depth.at(x + side, y)[0];
                        if (std::max(d, other) > 2 * std::min(d, other)) {
                            edge = true;
                            step += std::abs(full.at(x + side, y)[1] - full.at(x, y)[1]);
                        }
                    }
                    const double e = std::abs(reduced.at(x, y)[1] - full.at(x, y)[1]);
                    error += e / (double(width - 2) * height);
                    edge_error += edge ? e : 0;
                    edges += edge;
                }
            printf("%s at %s resolution: mean error %.2g of the mean; at edges %.2g of their step\n", name, resolution,
                   error / mean, edge_error / step);
            EXPECT_LT(error / mean, bound) << name << " " << resolution;
            EXPECT_LT(edge_error / step, edge_bound) << name << " " << resolution;
            EXPECT_GT(edges, 80);
            EXPECT_NE(reduced.data, full.data) << name << " " << resolution;
        }
    }
}

// Images of which no side is a multiple of the reduction, and smaller than it.
TEST(AirlightResolution, EverySizeIsFilled)
{
    for (auto [width, height] : {std::pair(1, 1), {3, 2}, {5, 7}, {2, 33}, {13, 1}})
        for (const char *resolution : {"half", "quarter"}) {
            Json scene = lit_scenes()[0].scene;
            scene["effects"]["airlight"]["resolution"] = resolution;
            Frame frame = lit_frame(width, height);
            std::fill(frame.depth.data.begin(), frame.depth.data.end(), 12.0f);
            const Picture got = run(cpu(), scene.dump(), frame.color, frame.depth, Options{{}, {"airlight"}}).airlight;
            for (float v : got.data)
                ASSERT_GT(v, 0) << width << "x" << height << " " << resolution;
        }
}
