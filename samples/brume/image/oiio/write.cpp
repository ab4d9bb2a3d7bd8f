#include <algorithm>
#include <fstream>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "image/oiio/picture.hpp"
#include "support/error.hpp"

namespace brume::tool {
namespace {

OIIO::TypeDesc oiio_type(SampleType type)
{
    return type == SampleType::kUint8    ? OIIO::TypeDesc::UINT8
           : type == SampleType::kUint16 ? OIIO::TypeDesc::UINT16
           : type == SampleType::kHalf   ? OIIO::TypeDesc::HALF
                                         : OIIO::TypeDesc::FLOAT;
}

void write_bytes(const std::filesystem::path &file, const std::string &final_name, const std::vector<unsigned char> &bytes)
{
    std::ofstream stream(file, std::ios::binary);
    stream.write(reinterpret_cast<const char *>(bytes.data()), std::streamsize(bytes.size()));
    stream.close();
    if (!stream)
        throw FrameError(fmt::format("{}: cannot be written: the disk takes no more", final_name));
}

/// The header has the name under which the file was written, which is a temporary one that differs from run to run.
void rename_in_dpx(const std::filesystem::path &file, const std::filesystem::path &final_name)
{
    constexpr std::size_t kAt = 36, kLength = 100;
    std::string name = final_name.filename().string();
    name.resize(kLength - 1);
    name.push_back('\0');
    std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekp(kAt);
    if (!stream.write(name.data(), kLength).flush())
        throw FrameError(fmt::format("{}: cannot be written", final_name.string()));
}

}  // namespace

void write_picture(const std::filesystem::path &file, const std::string &final_name, const std::string &format,
                   const Raster &raster)
{
    const auto fail = [&](std::string why) {
        std::replace(why.begin(), why.end(), '\n', ' ');
        throw FrameError(fmt::format("{}: cannot be written: {}", final_name, why));
    };
    const auto output = OIIO::ImageOutput::create(format);
    if (!output)
        fail(fmt::format("this build of OpenImageIO does not write {}: {}", format, OIIO::geterror()));
    OIIO::ImageSpec spec(raster.width, raster.height, int(raster.channels.size()), oiio_type(raster.type));
    spec.channelnames = raster.channels;
    const auto alpha = std::find(raster.channels.begin(), raster.channels.end(), "A");
    spec.alpha_channel = alpha == raster.channels.end() ? -1 : int(alpha - raster.channels.begin());
    if (raster.straight_alpha)
        spec.attribute("oiio:UnassociatedAlpha", 1);
    // For sRGB's sake OpenImageIO 2.4 adds an EXIF directory to a TIFF, and the header points to that and no more to the
    // picture.
    if (!raster.color_space.empty() && format != "tiff")
        spec.attribute("oiio:ColorSpace", raster.color_space);
    if (raster.pixel_aspect != 1)
        spec.attribute("PixelAspectRatio", float(raster.pixel_aspect));
    if (format == "tiff") {
        spec.attribute("compression", "zip");
        if (raster.type == SampleType::kHalf)
            spec.attribute("tiff:half", 1);
    }
    // Or the formats' writers put today's date in, and two runs differ.
    if (format == "tiff")
        spec.attribute("DateTime", "");
    if (format == "dpx")
        spec.attribute("DateTime", "1970:01:01 00:00:00");
    if (format == "jpeg") {
        spec.attribute("compression", "jpeg:98");
        spec.attribute("jpeg:subsampling", "4:4:4");
    }
    if (format == "dpx" && raster.type == SampleType::kUint16)
        spec.attribute("oiio:BitsPerSample", 16);
    // On a full disk OpenImageIO reports success for a PNG that is cut, and ends the process for a JPEG. Coded in memory,
    // the bytes are written here.
    OIIO::Filesystem::IOVecOutput coded;
    const bool in_memory = output->supports("ioproxy") && output->set_ioproxy(&coded);
    if (!output->open(file.string(), spec))
        fail(output->geterror());
    if (!output->write_image(spec.format, raster.pixels) || !output->close())
        fail(output->geterror());
    if (in_memory)
        write_bytes(file, final_name, coded.buffer());
    if (format == "dpx")
        rename_in_dpx(file, final_name);
}

}  // namespace brume::tool
