// Quality on the command line: what is chosen, and what is measured for it.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "files.hpp"

namespace brume::tests {
namespace {

using nlohmann::json;

class Quality : public testing::Test {
protected:
    Quality()
    {
        write_text(fog_, kFog);
        write_exr(in_, {{rgbz()}});
    }
    Result plan(std::vector<std::string> more) const
    {
        std::vector<std::string> words{"plan", fog_.string(), in_.string(), "--backend", "cpu", "--vfov", "50", "--json"};
        words.insert(words.end(), more.begin(), more.end());
        return brume(words);
    }

    Folder folder_;
    const fs::path fog_ = folder_ / "fog.json", in_ = folder_ / "in.exr";
};

TEST_F(Quality, IsAskedOnTheCommandLineOrInTheScene)
{
    const json none = json::parse(plan({}).out), loose = json::parse(plan({"--max-error", "5"}).out),
               tight = json::parse(plan({"--max-error", "1e-5"}).out);
    EXPECT_EQ(none["quality"], "");
    EXPECT_NE(loose["quality"].get<std::string>().find("max_error 5: multiscatter resolution quarter"), std::string::npos)
        << loose["quality"];
    EXPECT_NE(tight["quality"].get<std::string>().find("nothing but the references"), std::string::npos) << tight["quality"];
    EXPECT_LT(tight["predicted_error"].get<double>(), loose["predicted_error"].get<double>());

    std::string text = kFog;
    text.insert(text.rfind('}'), ",\"quality\":{\"max_error\":5}");
    write_text(fog_, text);
    const json in_scene = json::parse(plan({}).out);
    EXPECT_EQ(in_scene["quality"], loose["quality"]) << "the tool measures the frame for either";
    EXPECT_EQ(json::parse(plan({"--max-error", "1e-5"}).out)["quality"], tight["quality"])
        << "the line goes before the file";

    EXPECT_EQ(plan({"--quality", "fine"}).status, 2);
    EXPECT_EQ(plan({"--quality", "draft", "--max-error", "1"}).status, 2);
    EXPECT_EQ(plan({"--max-error", "0"}).status, 2);
    // The reference runs, and differs from a draft.
    for (const char *preset : {"draft", "reference"})
        ASSERT_EQ(brume({"run", fog_.string(), in_.string(), "-o", (folder_ / (std::string(preset) + ".exr")).string(),
                         "--backend", "cpu", "--vfov", "50", "--quality", preset})
                      .status,
                  0);
    EXPECT_NE(read_plane(folder_ / "draft.exr", "R"), read_plane(folder_ / "reference.exr", "R"));
}

TEST_F(Quality, CalibrationIsKeptWhereItIsTold)
{
    const fs::path file = folder_ / "kept" / "rates.json";
    const Result done = brume({"calibrate", "--backend", "cpu", "-o", file.string()});
    ASSERT_EQ(done.status, 0) << done.err;
    const json rates = json::parse(read_text(file));
    EXPECT_EQ(rates["device"], "CPU");
    EXPECT_GT(rates["passes"]["multiscatter/compose"]["ms_per_operation"].get<double>(), 0);
    EXPECT_EQ(brume({"calibrate", "--backend", "cpu", "-o", "/proc/none/rates.json"}).status, 2);
}

}  // namespace
}  // namespace brume::tests
