// Noise that shifts view rays at Gaussians (Fogshop sec. 5.5).
#include <gtest/gtest.h>

#include "fog.h"
#include "maths.hpp"

namespace f64 = brume::maths_double;

namespace {

// A camera at x = `shift`, turned by `yaw` about +y; a Gaussian before it, and this noise.
std::string noisy(const std::string &noise, double shift = 0, double yaw = 0)
{
    char camera[300];
    snprintf(camera, sizeof camera, "[[%.17g,0,%.17g,%.17g],[0,1,0,0],[%.17g,0,%.17g,0],[0,0,0,1]]", std::cos(yaw),
             std::sin(yaw), shift, -std::sin(yaw), std::cos(yaw));
    return std::string("{\"brume\":1,\"camera\":{\"vertical_fov\":50,\"camera_to_world\":") + camera +
           "},\"medium\":{\"scattering\":0.5,\"density\":[{\"type\":\"gaussian\",\"center\":[0,0,-6],\"scale\":0.7}]" +
           (noise.empty() ? "" : ",\"noise\":" + noise) + "},\"effects\":{\"multiscatter\":{}}}";
}

fog::Picture depths(brume_context context, const std::string &scene, double frame = 0)
{
    const fog::Picture color(33, 33, 4), depth(33, 33, 1, 20.0f);
    return fog::run(context, scene, color, depth, {nullptr, {"optical_depth"}, frame}).optical_depth;
}

double largest_difference(const fog::Picture &a, const fog::Picture &b)
{
    double most = 0;
    for (size_t i = 0; i < a.data.size(); ++i)
        most = std::max(most, double(std::abs(a.data[i] - b.data[i])));
    return most;
}

const std::string strong = "{\"strength\":0.7,\"scale\":0.4,\"seed\":5}";

}  // namespace

TEST(Noise, NoStrengthIsNoNoiseBitForBit)
{
    EXPECT_EQ(depths(fog::cpu(), noisy("")).data, depths(fog::cpu(), noisy("{\"strength\":0,\"seed\":9}")).data);
}

TEST(Noise, ChangesWithSeedAndOffsetAndKeepsItsMean)
{
    const fog::Picture smooth = depths(fog::cpu(), noisy("")), rough = depths(fog::cpu(), noisy(strong));
    EXPECT_GT(largest_difference(smooth, rough), 0.1);
    EXPECT_GT(largest_difference(rough, depths(fog::cpu(), noisy("{\"strength\":0.7,\"scale\":0.4,\"seed\":6}"))), 0.1);
    const std::string moving = "{\"strength\":0.7,\"scale\":0.4,\"seed\":5,\"offset\":[0,{\"keys\":[[0,0],[10,1]]},0]}";
    EXPECT_EQ(rough.data, depths(fog::cpu(), noisy(moving), 0).data);
    EXPECT_GT(largest_difference(rough, depths(fog::cpu(), noisy(moving), 5)), 0.1);
    double means[2] = {0, 0};
    for (size_t i = 0; i < smooth.data.size(); ++i) {
        means[0] += smooth.data[i];
        means[1] += rough.data[i];
    }
    EXPECT_NEAR(means[1] / means[0], 1, 0.2) << "noise moves fog about, and neither adds nor takes much";
}

// The same ray of the world through the middle of two pictures: the camera turns, the noise stays.
TEST(Noise, StaysWhereItIsInTheWorld)
{
    const double pixel = std::atan(std::tan(25 * 3.14159265358979 / 180) * 2 / 33);
    const fog::Picture straight = depths(fog::cpu(), noisy(strong));
    const fog::Picture turned = depths(fog::cpu(), noisy(strong, 0, -pixel));
    // One pixel to the right of the middle, seen straight on by the second camera.
    EXPECT_NEAR(turned.at(16, 16)[0] / straight.at(17, 16)[0], 1, 1e-4);
    const fog::Picture unmoved =
        depths(fog::cpu(), noisy("{\"strength\":0.7,\"scale\":0.4,\"seed\":5,\"offset\":[102.4,0,0]}"));
    EXPECT_LT(largest_difference(straight, unmoved), 1e-3) << "it repeats after 256 lattice points";
}

#ifdef BRUME_GL
TEST(Noise, GpuAsCpu)
{
    if (!fog::gl())
        GTEST_SKIP() << "no GL here";
    const fog::Worst worst = fog::compare(depths(*fog::gl(), noisy(strong)), depths(fog::cpu(), noisy(strong)), 1e-3);
    EXPECT_LT(worst.error, 2e-4) << worst.describe();
}
#endif

TEST(Noise, IsContinuousAndWithinItsBounds)
{
    double steepest = 0;
    f64::vec3 before = f64::noise_at(f64::vec3(-3, 0.3, 251.5), 1);
    for (double x = -3; x < 3; x += 1e-3) {
        const f64::vec3 n = f64::noise_at(f64::vec3(x, 0.3, 254.5 + x), 1);
        for (int c = 0; c < 3; ++c) {
            EXPECT_LE(std::abs(n[c]), 1.0);
            steepest = std::max(steepest, std::abs(n[c] - before[c]));
        }
        before = n;
    }
    EXPECT_LT(steepest, 2e-2) << "per thousandth of a lattice step, of which two";
    EXPECT_EQ(f64::noise_at(f64::vec3(1.25, 2.5, 3.75), 7), f64::noise_at(f64::vec3(257.25, 2.5, 3.75), 7));
}
