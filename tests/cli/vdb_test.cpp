// `brume media fit` on OpenVDB files made here.
#include <cstring>
#include <random>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>

#include "files.hpp"

namespace brume::tests {
namespace {

using nlohmann::json;

class FitTool : public testing::Test {
protected:
    FitTool() { openvdb::initialize(); }

    void write(const openvdb::GridPtrVec &grids) { openvdb::io::File(vdb_.string()).write(grids); }
    json fit(std::vector<std::string> more = {})
    {
        std::vector<std::string> words{"media", "fit", vdb_.string(), "-o", out_.string(), "--json"};
        words.insert(words.end(), more.begin(), more.end());
        const Result result = brume(words);
        EXPECT_EQ(result.status, 0) << result.err;
        return json::parse(result.out);
    }
    json info() { return json::parse(brume({"media", "info", out_.string(), "--json"}).out); }
    void refused(const std::string &part)
    {
        const Result result = brume({"media", "fit", vdb_.string(), "-o", out_.string()});
        EXPECT_EQ(result.status, 2);
        EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
    }
    /// A Gaussian of radius 1.5 in the world around (3, -2, 1), its density 4, in voxels of 0.25.
    openvdb::FloatGrid::Ptr puff() const
    {
        auto grid = openvdb::FloatGrid::create();
        grid->setName("density");
        auto transform = openvdb::math::Transform::createLinearTransform(0.25);
        transform->postTranslate({3, -2, 1});
        grid->setTransform(transform);
        for (int z = -18; z <= 18; ++z)
            for (int y = -18; y <= 18; ++y)
                for (int x = -18; x <= 18; ++x)
                    grid->tree().setValue({x, y, z}, 4 * std::exp(-(x * x + y * y + z * z) / 36.0f));
        return grid;
    }

    Folder folder_;
    const fs::path vdb_ = folder_ / "smoke.vdb", out_ = folder_ / "smoke.csv";
};

TEST_F(FitTool, FindsAGaussianInTheWorld)
{
    write({puff()});
    const json said = fit({"--count", "1", "--unit", "2"});
    EXPECT_EQ(said["gaussians"], 1);
    EXPECT_LT(said["residual"].get<double>(), 0.01);
    const json found = info();
    EXPECT_NEAR(found["centers"][0][0].get<double>(), 3, 0.01);
    EXPECT_NEAR(found["centers"][1][0].get<double>(), -2, 0.01);
    EXPECT_NEAR(found["centers"][2][0].get<double>(), 1, 0.01);
    EXPECT_NEAR(found["radius"][0].get<double>(), 1.5, 0.01);
    EXPECT_NEAR(found["amplitude"][0].get<double>(), 2, 0.02);
}

TEST_F(FitTool, FillsLevelSets)
{
    write({openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(2.0f, {1, 0, 0}, 0.2f)});
    const json said = fit({"--count", "150", "--grid", ""});
    EXPECT_LT(said["residual"].get<double>(), 0.25);
    EXPECT_NEAR(said["mass_error"].get<double>(), 0, 0.1);
    // The fog's edge is a narrow band of voxels inside the surface.
    EXPECT_NEAR(info()["mass"].get<double>(), 4.0 / 3 * 3.14159 * 8 * 0.75, 8);
}

// A tile of voxels that share one value, turned and too large: averaged down, its mass kept.
TEST_F(FitTool, AveragesWhatIsLarge)
{
    auto grid = openvdb::FloatGrid::create();
    grid->setName("smoke");
    auto transform = openvdb::math::Transform::createLinearTransform(0.1);
    transform->preRotate(0.3, openvdb::math::Z_AXIS);
    grid->setTransform(transform);
    grid->fill(openvdb::CoordBBox({0, 0, 0}, {191, 127, 63}), 1.0f);
    write({grid});
    const json said = fit({"--count", "5"});
    EXPECT_EQ(said["grid"], "smoke");
    EXPECT_EQ(said["averaged"], 2);
    const double mass = 19.2 * 12.8 * 6.4 * (1 + said["mass_error"].get<double>());
    EXPECT_NEAR(info()["mass"].get<double>(), mass, 1e-3 * mass);
    // The corner at the origin stays where it is, give or take the fit.
    EXPECT_GT(info()["centers"][2][0].get<double>(), -1);
    EXPECT_LT(info()["centers"][2][1].get<double>(), 7.4);
}

TEST_F(FitTool, RefusesWhatItCannotFit)
{
    refused("smoke.vdb: cannot be opened");
    write_text(vdb_, "not a grid");
    refused("smoke.vdb: ");
    write({openvdb::FloatGrid::create()});
    refused("expected a grid with active voxels");
    write({openvdb::Vec3SGrid::create()});
    refused("which grid?");
    auto odd = puff();
    odd->setTransform(openvdb::math::Transform::createLinearTransform(0.1));
    odd->transform().postScale({1, 1, 2});
    write({odd});
    refused("expected cubes");
    auto bad = puff();
    bad->tree().setValue({1, 2, 3}, std::nanf(""));
    write({bad});
    refused("at 1, 2, 3; expected finite");
    EXPECT_FALSE(fs::exists(out_));
}

TEST_F(FitTool, NamesOfMegabytesAreQuotedInPart)
{
    write({puff()});
    std::string damaged = read_text(vdb_);
    const std::string map = "UniformScaleTranslateMap";
    const size_t at = damaged.find(map);
    ASSERT_NE(at, std::string::npos);
    // The name's length stands before it.
    for (const uint32_t length : {8'000'000u, 4'000'000'000u}) {
        std::memcpy(&damaged[at - sizeof length], &length, sizeof length);
        write_text(vdb_, damaged);
        const Result result = brume({"media", "fit", vdb_.string(), "-o", out_.string(), "--count", "2"});
        EXPECT_EQ(result.status, 2);
        EXPECT_NE(result.err.find("smoke.vdb: "), std::string::npos) << result.err;
        EXPECT_LT(result.err.size(), 5000u);
    }
}

// Whatever is wrong with a file, the tool says so and lives on.
TEST_F(FitTool, DamagedFilesAreRefused)
{
    write({puff()});
    const std::string whole = read_text(vdb_);
    std::mt19937_64 random(1);
    size_t refusals = 0;
    for (int i = 0; i < 30; ++i) {
        std::string damaged = whole;
        if (i % 3 == 0)
            damaged.resize(random() % damaged.size());
        else
            damaged[random() % (i % 3 == 1 ? 3000 : damaged.size())] = char(random());
        write_text(vdb_, damaged);
        const Result result = brume({"media", "fit", vdb_.string(), "-o", out_.string(), "--count", "2"});
        ASSERT_TRUE(result.status == 0 || result.status == 2) << result.status << ' ' << result.err;
        refusals += result.status == 2;
    }
    EXPECT_GT(refusals, 10u);
}

}  // namespace
}  // namespace brume::tests
