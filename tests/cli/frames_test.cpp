#include <gtest/gtest.h>

#include "files.hpp"
#include "frames/pattern.hpp"
#include "frames/range.hpp"
#include "support/error.hpp"

namespace brume::tests {
namespace {

using namespace brume::tool;
using Frames = std::vector<int>;

TEST(Range, FollowsOiiotoolsSyntax)
{
    EXPECT_EQ(parse_frames("200"), Frames({200}));
    EXPECT_EQ(parse_frames("1-4"), Frames({1, 2, 3, 4}));
    EXPECT_EQ(parse_frames("1-10x3,20"), Frames({1, 4, 7, 10, 20}));
    EXPECT_EQ(parse_frames("1-6y2"), Frames({2, 4, 6}));
    EXPECT_EQ(parse_frames("5-1x-2"), Frames({5, 3, 1}));
    EXPECT_EQ(parse_frames("3-1"), Frames({3, 2, 1}));
    EXPECT_EQ(parse_frames("-2-1"), Frames({-2, -1, 0, 1}));
    EXPECT_EQ(parse_frames("-5--3"), Frames({-5, -4, -3}));
    EXPECT_EQ(parse_frames("1-3,2,3-4"), Frames({1, 2, 3, 4})) << "repeats are dropped";
}

TEST(Range, RefusesWhatItCannotRead)
{
    for (const char *text : {"", "a", "1-", "1-3x0", "1-3x-1", "3-1x2", "1,,2", "1-2 ", "1-999999999", "99999999999"})
        EXPECT_THROW(parse_frames(text), RequestError) << text;
}

TEST(Pattern, NamesFiles)
{
    EXPECT_EQ(FilePattern("a.%04d.exr").at(7), "a.0007.exr");
    EXPECT_EQ(FilePattern("a.%d.exr").at(7), "a.7.exr");
    EXPECT_EQ(FilePattern("a.####.exr").at(12345), "a.12345.exr");
    EXPECT_EQ(FilePattern("a.###.exr").at(7), "a.007.exr");
    EXPECT_EQ(FilePattern("a.#.exr").at(7), "a.0007.exr") << "a lone # is four digits, as in oiiotool";
    EXPECT_EQ(FilePattern("a@@.exr").at(7), "a07.exr");
    EXPECT_EQ(FilePattern("a.%04d.exr").at(-5), "a.-005.exr");
    EXPECT_FALSE(FilePattern("100%.exr").is_sequence());
    EXPECT_THROW(FilePattern("a##.%04d.exr"), RequestError);
    EXPECT_EQ(FilePattern("shot##/@a%d/a.#.exr").at(7), "shot##/@a%d/a.0007.exr") << "folders are meant literally";
    EXPECT_FALSE(FilePattern("plate@2x.exr").is_sequence());
    EXPECT_EQ(FilePattern("plate@2x.@.exr").at(7), "plate@2x.7.exr");
    EXPECT_THROW(FilePattern("shot.%V.####.exr"), RequestError);
}

TEST(Pattern, FindsWhatExists)
{
    const Folder folder;
    for (const char *name :
         {"a.0001.exr", "a.0003.exr", "a.12345.exr", "a.7.exr", "a.00004.exr", "a.-002.exr", "b.0001.exr", "a.0001.exr.bak"})
        write_text(folder / name, "");
    EXPECT_EQ(FilePattern((folder / "a.%04d.exr").string()).existing(), Frames({-2, 1, 3, 12345}));
    EXPECT_EQ(FilePattern((folder / "a.%d.exr").string()).existing(), Frames({7, 12345}));
}

TEST(Pattern, PairsInputsWithOutputs)
{
    const Folder folder;
    for (const char *name : {"a.0001.exr", "a.0002.exr"})
        write_text(folder / name, "");
    const FilePattern input((folder / "a.%04d.exr").string());
    const auto files = list_frames(input, FilePattern((folder / "out.##.exr").string()), "2-3");
    ASSERT_EQ(files.size(), 2u) << "a frame asked for by number is listed although it is missing";
    EXPECT_EQ(files[1].output, folder / "out.03.exr");
    EXPECT_THROW(list_frames(input, FilePattern("out.exr"), ""), RequestError) << "two frames, one file";
    EXPECT_THROW(list_frames(input, input, "7-9"), RequestError) << "none exists";
    EXPECT_THROW(list_frames(FilePattern((folder / "a.0001.exr").string()), FilePattern("o.exr"), "1"), RequestError);
    EXPECT_EQ(frame_in_name("shot12.v2.0042.exr"), 42);
    EXPECT_EQ(frame_in_name("shot.exr"), 0);
    EXPECT_EQ(frame_in_name("shot.-0042.exr"), -42);
    EXPECT_EQ(frame_in_name("-7.exr"), -7);
    EXPECT_EQ(frame_in_name("shot-0042.exr"), 42) << "the minus is a separator";
}

}  // namespace
}  // namespace brume::tests
