// Tier `nodes` where many Gaussians lie along a ray, in cells, against the same ray in parts, which is what max_error .0005
// takes.
#include <gtest/gtest.h>

#include "clouds.h"

namespace {

using namespace fog;

std::vector<NamedScene> dense_clouds()
{
    auto denser = [](Json density, double factor) {
        for (Json &g : density)
            g["amplitude"] = factor * g["amplitude"].get<double>();
        return density;
    };
    const Json facing{{"type", "spot"},         {"position", {0.3, 0.2, -13}},
                      {"direction", {0, 0, 1}}, {"angle", 40},
                      {"penumbra", 0.3},        {"intensity", 60}};
    return {{"absorption of some colours",
             scene_of(cloud(50, 3), lamps(3), {{"scattering", {0.8, 0.6, 0.4}}, {"absorption", {0, 1, 4}}}),
             {}},
            {"optical depth 30", scene_of(denser(cloud(50, 5), 20), lamps(3)), {}},
            {"optical depth 100", scene_of(denser(cloud(50, 9), 70), lamps(3)), {}},
            {"a spot that faces the camera",
             scene_of(cloud(50, 6), Json::array({facing}), {{"scattering", {0.5, 0.7, 1}}, {"g", 0.7}}),
             {}},
            {"few that are dense",
             scene_of(denser(cloud(20, 8), 6), lamps(2), {{"scattering", {1, 0.5, 0.2}}, {"absorption", {0.1, 0.1, 1}}}),
             {}}};
}

TEST(AirlightCells, ComeToWhatPartsHave)
{
    const Frame frame = lit_frame(36, 24);
    int bounded = 0, all = 0;
    for (const NamedScene &s : dense_clouds()) {
        const Json nodes = with(s.scene, "tier", "nodes");
        const Picture exact = airlight_of(cpu(), with(nodes, "max_error", 0.0005), frame);
        for (double max_error : {0.05, 0.01, 0.002}) {
            const Result r = run(cpu(), with(nodes, "max_error", max_error).dump(), frame.color, frame.depth,
                                 Options{{}, {"airlight", "airlight_error"}});
            const Errors e = errors(r.airlight, exact);
            report((std::string(s.name) + ", max_error " + std::to_string(max_error)).c_str(), e);
            EXPECT_LT(e.p95, 0.3 * max_error) << s.name;
            int here = 0;
            double mean = 0;
            for (float v : exact.data)
                mean += double(v) / double(exact.data.size());
            for (size_t i = 0; i < exact.data.size(); ++i)
                here += std::abs(double(r.airlight.data[i]) - double(exact.data[i])) <=
                        double(r.airlight_error.data[i]) + 1e-5 * std::max(double(exact.data[i]), 0.01 * mean);
            printf("  bounded in %.1f %%\n", 100.0 * here / double(exact.data.size()));
            bounded += here;
            all += int(exact.data.size());
        }
    }
    printf("bounded in %.1f %%\n", 100.0 * bounded / all);
    EXPECT_GE(double(bounded) / all, 0.95);
}

}  // namespace
