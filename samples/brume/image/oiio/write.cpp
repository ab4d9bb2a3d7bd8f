#include <algorithm>
#include <fstream>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "image/oiio/metadata.hpp"
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

bool has_exif(const OIIO::ImageSpec &spec)
{
    return std::any_of(spec.extra_attribs.begin(), spec.extra_attribs.end(), [](const OIIO::ParamValue &value) {
        return value.name().string().starts_with("Exif:") || value.name() == "ExposureTime" || value.name() == "FNumber";
    });
}

std::vector<std::string> metadata_lost(const std::filesystem::path &file, const std::string &format,
                                       const Metadata &metadata)
{
    OIIO::ImageSpec written;
    const auto input = OIIO::ImageInput::create(format);
    if (metadata.empty() || !input || !input->open(file.string(), written))
        return {};
    return lost_from(written, metadata);
}

}  // namespace

std::vector<std::string> write_picture(const std::filesystem::path &file, const std::string &final_name,
                                       const std::string &format, const Raster &raster)
{
    const auto fail = [&](std::string why) {
        std::replace(why.begin(), why.end(), '\n', ' ');
        throw FrameError(fmt::format("{}: cannot be written: {}", final_name, why));
    };
    auto output = OIIO::ImageOutput::create(format);
    if (!output)
        fail(fmt::format("this build of OpenImageIO does not write {}: {}", format, OIIO::geterror()));
    OIIO::ImageSpec spec(raster.width, raster.height, int(raster.channels.size()), oiio_type(raster.type));
    spec.channelnames = raster.channels;
    const auto alpha = std::find(raster.channels.begin(), raster.channels.end(), "A");
    spec.alpha_channel = alpha == raster.channels.end() ? -1 : int(alpha - raster.channels.begin());
    // Or the formats' writers put today's date in, and two runs differ.
    if (format == "tiff")
        spec.attribute("DateTime", "");
    if (format == "dpx")
        spec.attribute("DateTime", "1970:01:01 00:00:00");
    put_metadata(spec, format, raster.metadata, raster.pixel_aspect);
    if (raster.straight_alpha)
        spec.attribute("oiio:UnassociatedAlpha", 1);
    // For sRGB's sake OpenImageIO 2.4 adds an EXIF directory to a TIFF.
    if (!raster.color_space.empty() && format != "tiff")
        spec.attribute("oiio:ColorSpace", raster.color_space);
    if (format == "tiff") {
        spec.attribute("compression", "zip");
        if (raster.type == SampleType::kHalf)
            spec.attribute("tiff:half", 1);
    }
    if (format == "jpeg") {
        spec.attribute("compression", "jpeg:98");
        spec.attribute("jpeg:subsampling", "4:4:4");
    }
    if (format == "dpx" && raster.type == SampleType::kUint16)
        spec.attribute("oiio:BitsPerSample", raster.bits ? raster.bits : 16);
    // On a full disk OpenImageIO reports success for a PNG that is cut, and ends the process for a JPEG. Coded in memory,
    // the bytes are written here. But of a TIFF with an EXIF directory the header would point to that, and no more to the
    // picture.
    OIIO::Filesystem::IOVecOutput coded;
    const bool in_memory = !(format == "tiff" && has_exif(spec)) && output->supports("ioproxy");
    const auto open = [&] { return (!in_memory || output->set_ioproxy(&coded)) && output->open(file.string(), spec); };
    if (!open()) {
        // Of a profile that is not for such pixels.
        std::string why = output->geterror();
        output = OIIO::ImageOutput::create(format);
        coded.buffer().clear();
        coded.seek(0);
        if (!spec.find_attribute("ICCProfile") || (spec.erase_attribute("ICCProfile"), !open()))
            fail(why);
    }
    if (!output->write_image(spec.format, raster.pixels) || !output->close())
        fail(output->geterror());
    if (in_memory)
        write_bytes(file, final_name, coded.buffer());
    if (format == "dpx")
        rename_in_dpx(file, final_name);
    return metadata_lost(file, format, raster.metadata);
}

}  // namespace brume::tool
