#include <cstdlib>

#include <gtest/gtest.h>

#include "files.hpp"
#include "png_files.hpp"

// OpenImageIO brings thirty libraries, which take longer to load than a small picture takes to be fogged.

namespace brume::tests {
namespace {

class ImageLibraryLoading : public testing::Test {
protected:
    ~ImageLibraryLoading() override { set_debugging(nullptr); }
    static void set_debugging(const char *file)
    {
        if (file) {
            ::setenv("LD_DEBUG", "files", 1);
            ::setenv("LD_DEBUG_OUTPUT", file, 1);
        } else {
            ::unsetenv("LD_DEBUG");
            ::unsetenv("LD_DEBUG_OUTPUT");
        }
    }
    /// Whether the dynamic loader met OpenImageIO.
    bool loads_it(const std::vector<std::string> &words)
    {
        const Folder said;
        set_debugging((said / "ld").c_str());
        const Result r = brume(words);
        set_debugging(nullptr);
        EXPECT_EQ(r.status, 0) << r.err;
        bool met = false, any = false;
        for (const auto &entry : fs::directory_iterator(said.path())) {
            const std::string text = read_text(entry.path());
            any |= text.find("libOpenEXR") != text.npos;
            met |= text.find("libOpenImageIO.so") != text.npos;
        }
        EXPECT_TRUE(any) << "the loader said nothing";
        return met;
    }
    Folder folder_;
};

TEST_F(ImageLibraryLoading, WaitsForThePictureThatNeedsIt)
{
    const std::string scene = (folder_ / "fog.json").string(), exr = (folder_ / "a.exr").string(),
                      png = (folder_ / "a.png").string(), out = (folder_ / "o.exr").string();
    write_text(scene, kClear);
    write_exr(exr, {{rgbz()}});
    write_png(png, 3, std::vector<std::uint8_t>(3 * kWidth * kHeight, 100));
    EXPECT_FALSE(loads_it({"--version"}));
    EXPECT_FALSE(loads_it({"effects"}));
    EXPECT_FALSE(loads_it({"schema"}));
    EXPECT_FALSE(loads_it({"media", "--help"}));
    EXPECT_FALSE(loads_it({"info", exr}));
    EXPECT_FALSE(loads_it({"run", scene, exr, "-o", out, "--backend", "cpu"}));
    EXPECT_FALSE(loads_it({"compare", exr, exr}));
    EXPECT_TRUE(loads_it({"info", png}));
    EXPECT_TRUE(loads_it({"run", scene, exr, "-o", out, "--backend", "cpu", "--preview", (folder_ / "p.png").string()}));
}

TEST(Dependencies, TheLibraryAndTheToolNeedNeitherOpenImageIONorOpenVdb)
{
    for (const std::string file : {BRUME_LIBRARY, BRUME_TOOL}) {
        const Folder folder;
        ASSERT_EQ(std::system(("ldd '" + file + "' >'" + (folder / "needed").string() + "'").c_str()), 0);
        const std::string needed = read_text(folder / "needed");
        EXPECT_NE(needed.find("libtbb"), std::string::npos) << needed;
        EXPECT_EQ(needed.find("OpenImageIO"), std::string::npos) << file;
        EXPECT_EQ(needed.find("libopenvdb"), std::string::npos) << file;
    }
}

TEST(Dependencies, OpenExrIsKnownToItsOwnFolderAlone)
{
    std::size_t files = 0;
    for (const auto &entry : fs::recursive_directory_iterator(fs::path(BRUME_SOURCES) / "samples/brume")) {
        if (!entry.is_regular_file())
            continue;
        const std::string text = read_text(entry.path()), where = entry.path().string();
        ++files;
        if (where.find("samples/brume/exr/") == where.npos) {
            EXPECT_EQ(text.find("Imf::"), text.npos) << where;
            EXPECT_EQ(text.find("#include <Imf"), text.npos) << where;
        }
        if (where.find("samples/brume/image/oiio/") == where.npos) {
            EXPECT_EQ(text.find("OIIO::"), text.npos) << where;
            EXPECT_EQ(text.find("#include <OpenImageIO"), text.npos) << where;
        }
    }
    EXPECT_GT(files, 100u);
}

}  // namespace
}  // namespace brume::tests
