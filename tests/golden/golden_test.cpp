// A frame of the demo sequence, quartered, through kernels and media: the same pixels tomorrow.
// `./run goldens` renews the images; look at what changed before committing them.
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "exr.h"

using namespace fog;

namespace {

bool renewing = false;

struct Golden {
    const char *name;
    const char *medium;
    const char *parameters;  // of airlight where there are lights, else of multiscatter
    const char *lights = nullptr;
    const char *effects = nullptr;  // in place of these, all with their parameters
};

#define LANTERN(place) "{\"type\":\"point\",\"position\":" place ",\"intensity\":[180,120,66],\"radius\":0.13}"
const char *const lanterns = LANTERN("[-4.5,9.5,3.74]") "," LANTERN("[4.5,17.5,3.74]");
// clang-format off
const char *const lantern_and_spot = LANTERN("[-4.5,9.5,3.74]") ","
    "{\"type\":\"spot\",\"position\":[3,12,5],\"direction\":[-0.4,0,-1],\"intensity\":[200,240,300],\"angle\":45,"
    "\"penumbra\":0.3}";
#define BLOB(center, rest) "{\"type\":\"gaussian\",\"center\":" center "," rest "}"
#define BANK                                                                                                              \
    "\"density\":[{\"type\":\"constant\",\"value\":0.02}," BLOB("[-2,10,1]", "\"scale\":0.7,\"amplitude\":0.5") ","         \
    BLOB("[0,12,0.5]", "\"scale\":0.5,\"amplitude\":0.3,\"colour\":[1,0.8,0.6]") ","                                      \
    BLOB("[2,14,1]", "\"scale\":0.6,\"amplitude\":0.6") "]"
// clang-format on

const Golden goldens[] = {
    {"demo", nullptr, nullptr},
    {"paper", "\"scattering\":[0.03,0.03,0.032],\"g\":0.8", "\"kernel\":\"paper\""},
    {"paper_tilted_exponential",
     "\"scattering\":0.06,\"absorption\":[0.002,0.001,0],\"g\":0.6,\"density\":[{\"type\":\"exponential\",\"value\":1,"
     "\"falloff\":0.15,\"direction\":[0.1,0,1]}]",
     "\"kernel\":\"paper\""},
    {"paper_bilinear_2x2", "\"scattering\":0.05,\"g\":0.8",
     "\"kernel\":\"paper\",\"kernel_size\":\"2x2\",\"fetch\":\"linear_bilinear\""},
    {"paper_cubic_6x6", "\"scattering\":0.05,\"g\":0.8",
     "\"kernel\":\"paper\",\"kernel_size\":\"6x6\",\"fetch\":\"cubic_bicubic\""},
    {"paper_separation", "\"scattering\":0.05,\"g\":0.8",
     "\"kernel\":\"paper\",\"separation\":true,\"separation_luminance\":4,\"separation_density\":60"},
    {"paper_furnace", "\"visibility\":80,\"g\":0.8", "\"kernel\":\"paper\",\"masking\":false,\"density_blurring\":false"},
    {"paper_emission", "\"scattering\":0.02,\"absorption\":0.01,\"emission\":[0.004,0.005,0.008],\"droplet_diameter\":12",
     "\"kernel\":\"paper\""},
    {"calibrated", "\"scattering\":[0.03,0.03,0.032],\"g\":0.8", ""},
    {"calibrated_exponential",
     "\"scattering\":0.06,\"absorption\":[0.002,0.001,0],\"g\":0.3,\"density\":[{\"type\":\"exponential\",\"value\":1,"
     "\"falloff\":0.15,\"direction\":[0.1,0,1]}]",
     ""},
    {"reference", "\"scattering\":0.02,\"absorption\":0.01,\"g\":0.9", "\"kernel\":\"paper_reference\""},
    {"airlight_nodes", "\"scattering\":[0.3,0.3,0.31],\"droplet_diameter\":12," BANK,
     "\"tier\":\"nodes\",\"max_error\":0.001", lantern_and_spot},
    {"airlight_nodes_half", "\"scattering\":[0.3,0.3,0.31],\"g\":0.5," BANK, "\"tier\":\"nodes\",\"resolution\":\"half\"",
     lanterns},
    {"airlight_maps", "\"scattering\":[0.3,0.3,0.31],\"g\":0.5," BANK, "\"tier\":\"maps\",\"max_error\":0.001",
     lantern_and_spot},
    {"airlight_fogshop", "\"scattering\":[0.3,0.3,0.31]," BANK, "\"tier\":\"fogshop\"", lanterns},
    {"every_effect_reduced", "\"scattering\":[0.3,0.3,0.31],\"absorption\":[0.03,0.01,0],\"g\":0.6," BANK, nullptr,
     lantern_and_spot,
     "\"surface\":{},\"multiscatter\":{\"resolution\":\"quarter\",\"lobes\":\"third\"},"
     "\"airlight\":{\"tier\":\"nodes\",\"resolution\":\"half\"}"},
    {"calibrated_half", "\"scattering\":[0.03,0.03,0.032],\"g\":0.8", "\"resolution\":\"half\""},
    {"airlight_sun", "\"scattering\":[0.03,0.03,0.032],\"absorption\":0.01", "\"tier\":\"sun\"", lanterns},
};

struct Input {
    Picture color{160, 90, 4, 1}, depth{160, 90, 1};
};

// Colour is averaged, depth is not.
const Input &input()
{
    static const Input quartered = [] {
        std::string file = std::string(BRUME_FRAMES_DIR) + "/street.0001.exr";
        Picture color = read_exr(file, {"R", "G", "B", "A"}), depth = read_exr(file, {"Z"});
        Input in;
        for (int y = 0; y < 90; ++y)
            for (int x = 0; x < 160; ++x) {
                for (int c = 0; c < 4; ++c) {
                    float sum = 0;
                    for (int j = 0; j < 4; ++j)
                        for (int i = 0; i < 4; ++i)
                            sum += color.at(4 * x + i, 4 * y + j)[c];
                    in.color.at(x, y)[c] = sum / 16;
                }
                in.depth.at(x, y)[0] = depth.at(4 * x + 1, 4 * y + 1)[0];
            }
        return in;
    }();
    return quartered;
}

// The demo's scene where the golden has no medium of its own.
std::string text_of(const Golden &golden)
{
    // A camera 1.7 m up that looks along +y in a world whose z is up.
    const std::string camera = "{\"vertical_fov\":36,\"camera_to_world\":[[1,0,0,0],[0,0,-1,0],[0,1,0,1.7],[0,0,0,1]]}";
    if (!golden.medium) {
        nlohmann::json scene = nlohmann::json::parse(std::ifstream(std::string(BRUME_FRAMES_DIR) + "/street.json"));
        scene["camera"] = nlohmann::json::parse(camera);
        return scene.dump();
    }
    return "{\"brume\":1,\"camera\":" + camera + ",\"medium\":{" + golden.medium + "}," +
           (golden.lights ? std::string("\"lights\":[") + golden.lights + "]," : "") + "\"effects\":{" +
           (golden.effects
                ? golden.effects
                : std::string(golden.lights ? "\"airlight\":{" : "\"multiscatter\":{") + golden.parameters + "}") +
           "}}";
}

class GoldenTest : public testing::TestWithParam<Golden> {
protected:
    void hold(const Picture &output, const char *backend, double bound)
    {
        std::string name = GetParam().name, golden = std::string(BRUME_GOLDEN_DIR) + "/" + name + ".exr";
        const std::vector<std::string> rgb{"R", "G", "B"};
        Picture actual(output.width, output.height, 3);
        for (int i = 0; i < output.width * output.height; ++i)
            std::copy_n(output.data.data() + 4 * i, 3, actual.data.data() + 3 * i);
        if (renewing) {
            write_exr(golden, actual, rgb);
            printf("renewed %s\n", golden.c_str());
            return;
        }
        Worst worst = compare(actual, read_exr(golden, rgb), 1e-2);
        if (worst.error <= bound)
            return;
        std::filesystem::create_directories(BRUME_FAILURES_DIR);
        std::string base = std::string(BRUME_FAILURES_DIR) + "/" + name + "." + backend;
        write_exr(base + ".exr", actual, rgb);
        std::string command =
            std::string(BRUME_TOOL) + " compare " + base + ".exr " + golden + " -d " + base + ".difference.png";
        int drawn = std::system(command.c_str());
        ADD_FAILURE() << name << " on " << backend << ": " << worst.describe() << "; allowed " << bound << "\n  golden "
                      << golden << "\n  now " << base << ".exr\n  difference "
                      << (drawn == 0 ? base + ".difference.png" : "could not be drawn");
    }
};

}  // namespace

TEST_P(GoldenTest, Cpu)
{
    // Not bit for bit: another C library's exp and log2 may round otherwise.
    hold(run(cpu(), text_of(GetParam()), input().color, input().depth).output, "cpu", 2e-5);
}

#ifdef BRUME_GL
TEST_P(GoldenTest, Gl)
{
    if (renewing || std::strcmp(GetParam().name, "reference") == 0)
        GTEST_SKIP() << "the CPU is the truth, and the only one with the reference";
    if (!gl())
        throw std::runtime_error("no GL backend");
    hold(run(*gl(), text_of(GetParam()), input().color, input().depth).output, "gl", 1e-2);
}
#endif

INSTANTIATE_TEST_SUITE_P(Street, GoldenTest, testing::ValuesIn(goldens), [](auto &info) { return info.param.name; });

int main(int argc, char **argv)
{
    testing::InitGoogleTest(&argc, argv);
    renewing = argc > 1 && std::strcmp(argv[1], "--renew") == 0;
    return RUN_ALL_TESTS();
}
