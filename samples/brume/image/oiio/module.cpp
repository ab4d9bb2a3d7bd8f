#include <OpenImageIO/imageio.h>

#include "image/oiio/picture.hpp"

namespace brume::tool {
namespace {

class Library : public ImageLibrary {
public:
    std::unique_ptr<PictureSource> open(const std::filesystem::path &file, const std::string &format,
                                        const ReadLimits &limits) const override
    {
        return open_picture(file, format, limits);
    }
    std::vector<std::string> write(const std::filesystem::path &file, const std::string &final_name,
                                   const std::string &format, const Raster &raster) const override
    {
        return write_picture(file, final_name, format, raster);
    }
    std::vector<float> shrunk(const float *pixels, int channels, int width, int height, int to_width,
                              int to_height) const override
    {
        return shrink_picture(pixels, channels, width, height, to_width, to_height);
    }
    Display sheet(const std::vector<Display> &cells, const std::vector<std::string> &labels) const override
    {
        return draw_sheet(cells, labels);
    }
    void set_threads(int threads) const override { OIIO::attribute("threads", threads); }
};

}  // namespace

extern "C" __attribute__((visibility("default"))) const ImageLibrary *brume_image_library(const char *version)
{
    static const Library library;
    return std::string_view(version) == kImageModuleVersion ? &library : nullptr;
}

}  // namespace brume::tool
