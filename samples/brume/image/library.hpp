#pragma once

#include <filesystem>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "image/file.hpp"

namespace brume::tool {

/// Rows from the top, channels interleaved.
struct Raster {
    int width = 0, height = 0;
    std::vector<std::string> channels;
    SampleType type = SampleType::kUint8;
    const void *pixels = nullptr;
    std::string color_space = {};  ///< said in the file where the format can; empty: nothing is
    bool straight_alpha = false;
    double pixel_aspect = 1;
    int bits = 0;  ///< of an integer's that the file is to have; 0: all
    Metadata metadata = {};
};

/// As a screen shows it: RGB of eight bits, rows from the top.
struct Display {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb;
};

/// What OpenImageIO does for the tool. It lies in a module of its own, `brume-image`: with what it depends on it takes
/// longer to load than a small picture takes to be fogged, so it is loaded when the first picture is met that is no OpenEXR
/// file, or is to be shown.
class ImageLibrary {
public:
    virtual ~ImageLibrary() = default;

    /// Throws FrameError that names the file.
    virtual std::unique_ptr<PictureSource> open(const std::filesystem::path &file, const std::string &format,
                                                const ReadLimits &limits) const = 0;
    /// Into `file`; errors name `final_name`. Returns the names of metadata that the format does not keep.
    virtual std::vector<std::string> write(const std::filesystem::path &file, const std::string &final_name,
                                           const std::string &format, const Raster &raster) const = 0;
    /// RGB, each pixel the mean of those that it covers and that are finite.
    virtual std::vector<float> shrunk(const float *pixels, int channels, int width, int height, int to_width,
                                      int to_height) const = 0;
    /// Columns of two cells, one over the other, with a label each or none.
    virtual Display sheet(const std::vector<Display> &cells, const std::vector<std::string> &labels) const = 0;
    virtual void set_threads(int threads) const = 0;
};

/// Loads the module once. Throws RequestError where it is not installed.
const ImageLibrary &image_library();

/// For both libraries, whenever the module is loaded.
void set_image_threads(int threads);

/// What the module exports: its ImageLibrary, if this text is the same in both.
constexpr const char *kImageModuleEntry = "brume_image_library";
constexpr const char *kImageModuleVersion = "brume-image 2 " __VERSION__;

}  // namespace brume::tool
