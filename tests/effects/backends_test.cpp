// GPU against CPU.
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "fog.h"

using namespace fog;

namespace {

struct Frame {
    Picture color, depth;
};

Frame random_frame(int width, int height, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> u(0, 1);
    Frame f{Picture(width, height, 4), Picture(width, height, 1)};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            for (int c = 0; c < 3; ++c)
                f.color.at(x, y)[c] = u(random) < 0.01f ? 200 * u(random) : 0.5f * u(random);
            f.color.at(x, y)[3] = u(random);
            f.depth.at(x, y)[0] = y < height / 3 ? INFINITY : 3 + 40 * float((x / 17 + y / 11) % 4);
        }
    return f;
}

const char *media[] = {
    "\"scattering\":[0.02,0.03,0.05],\"absorption\":[0.01,0,0.002],\"g\":0.8",
    ("\"scattering\":0.08,\"g\":0.5,\"density\":[{\"type\":\"exponential\",\"value\":1,\"falloff\":0.25,\"direction\":[0.1,"
     "1,"
     "0.2]}]"),
    "\"scattering\":0.001,\"g\":-0.3,\"emission\":[0.01,0.02,0.03]",
};

#ifdef BRUME_GL
Context &gpu()
{
    if (!gl())
        throw std::runtime_error("no GL backend");
    return *gl();
}
#endif

}  // namespace

#ifdef BRUME_GL
TEST(GpuAgainstCpu, PointwisePassesWithinTwoParts)
{
    // T, tau and W are pointwise; their floor is where the quantity has become invisible.
    for (auto [w, h] : {std::pair(1, 1), {97, 61}, {1, 300}})
        for (const char *medium : media) {
            Frame f = random_frame(w, h, 1);
            Options all{{}, {"transmittance", "optical_depth", "blur_radius"}, 0};
            auto a = run(gpu(), scene(medium), f.color, f.depth, all), b = run(cpu(), scene(medium), f.color, f.depth, all);
            // Beyond tau = 100 the transmittance is zero; there the rounding of a large exponent is all that differs.
            for (Picture *p : {&a.optical_depth, &b.optical_depth})
                for (float &v : p->data)
                    v = std::min(v, 100.0f);
            Worst t = compare(a.transmittance, b.transmittance, 1e-2), tau = compare(a.optical_depth, b.optical_depth, 1e-6),
                  blur = compare(a.blur_radius, b.blur_radius, 1e-3);
            EXPECT_LT(t.error, 2e-5) << medium << " transmittance " << t.describe();
            EXPECT_LT(tau.error, 2e-5) << medium << " optical depth " << tau.describe();
            EXPECT_LT(blur.error, 2e-5) << medium << " blur radius " << blur.describe();
        }
}

TEST(GpuAgainstCpu, WholeFilterWithinItsBound)
{
    // GPUs give the fraction of a bilinear fetch 8 bits: up to 1/512 of the difference between neighbouring texels. Mesa's
    // software GL interpolates in full precision, but its log2 (which picks the level) is good to 1e-5 only. The frames
    // hold lights 800 times as bright as what is around them; the floor is a tenth of the mean radiance.
    char device[256] = "";
    brume_context_info info = BRUME_CONTEXT_INFO_INIT;
    brume_context_get_info(gpu(), &info);
    snprintf(device, sizeof device, "%s", info.device);
    double bound = std::string(device).find("llvmpipe") != std::string::npos ? 2e-3 : 1e-2;
    double worst = 0;
    for (auto [w, h] : {std::pair(160, 90), {61, 37}, {3, 5}})
        for (const char *medium : media)
            for (const char *parameters :
                 {"", "\"kernel_size\":\"2x2\",\"fetch\":\"linear_bilinear\"",
                  "\"kernel_size\":\"6x6\",\"fetch\":\"cubic_bicubic\"", "\"masking\":false,\"density_blurring\":false",
                  "\"separation\":true", "\"levels\":3"}) {
                Frame f = random_frame(w, h, 2);
                const std::string all = std::string("\"kernel\":\"paper\"") + (*parameters ? "," : "") + parameters;
                auto a = run(gpu(), scene(medium, all), f.color, f.depth),
                     b = run(cpu(), scene(medium, all), f.color, f.depth);
                Worst found = compare(a.output, b.output, 0.05);
                worst = std::max(worst, found.error);
                EXPECT_LT(found.error, bound)
                    << w << "x" << h << " " << medium << " " << parameters << " " << found.describe();
            }
    printf("whole filter, %s against CPU: worst %.2g (bound %.2g)\n", device, worst, bound);
}
#endif

// Every effect and kernel by itself, with what makes it gather from neighbours.
TEST(Threads, AnyNumberGivesTheSameBits)
{
    const Frame f = random_frame(123, 77, 3);
    const std::string lights =
        ",\"lights\":[{\"type\":\"point\",\"position\":[1,2,-9],\"intensity\":[90,60,30],\"radius\":0.1},"
        "{\"type\":\"point\",\"position\":[-3,1,-20],\"intensity\":200}]";
    const std::pair<const char *, std::string> effects[] = {
        {"calibrated", "\"multiscatter\":{\"kernel\":\"calibrated\"}"},
        {"calibrated, reduced",
         "\"multiscatter\":{\"kernel\":\"calibrated\",\"resolution\":\"quarter\",\"lobes\":\"third\"}"},
        {"paper", "\"multiscatter\":{\"kernel\":\"paper\",\"kernel_size\":\"6x6\",\"fetch\":\"cubic_bicubic\"}"},
        {"paper, separated", "\"multiscatter\":{\"kernel\":\"paper\",\"separation\":true}"},
        {"airlight", "\"airlight\":{\"orders\":\"all\"}"},
        {"airlight, reduced", "\"airlight\":{\"resolution\":\"half\"}"},
        {"surface", "\"surface\":{}"}};
    const Context one(BRUME_BACKEND_CPU, 1), two(BRUME_BACKEND_CPU, 2), seven(BRUME_BACKEND_CPU, 7);
    std::set<std::vector<float>> pictures{f.color.data};
    for (const auto &[name, effect] : effects) {
        std::string text = scene(media[0]);
        text.replace(text.find(",\"effects\""), std::string::npos, lights + ",\"effects\":{" + effect + "}}");
        const Picture alone = run(one, text, f.color, f.depth).output;
        EXPECT_TRUE(pictures.insert(alone.data).second) << name << " changes nothing, or as another does";
        for (const Context *many : {&two, &seven, &seven})
            EXPECT_EQ(run(*many, text, f.color, f.depth).output.data, alone.data) << name;
    }
}

#ifdef BRUME_GL
TEST(GpuAgainstItself, GivesTheSameBits)
{
    Frame f = random_frame(123, 77, 3);
    EXPECT_EQ(run(gpu(), scene(media[1]), f.color, f.depth).output.data,
              run(gpu(), scene(media[1]), f.color, f.depth).output.data);
}
#endif
