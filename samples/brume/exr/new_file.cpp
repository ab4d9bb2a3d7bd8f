#include "exr/new_file.hpp"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>

#include "exr/metadata.hpp"
#include "exr/output_stream.hpp"
#include "exr/planes.hpp"

namespace brume::tool {

std::uint64_t write_new_exr(const std::filesystem::path &output, const NewPicture &picture)
{
    Imf::Header header(exr_window(picture.display), exr_window(picture.data), float(picture.pixel_aspect));
    put_metadata(header, picture.metadata);
    if (const auto &c = picture.chromaticities)
        Imf::addChromaticities(header, exr_chromaticities(*c));
    const std::size_t count = std::size_t(picture.data.width()) * std::size_t(picture.data.height());
    std::atomic<std::uint64_t> clamped{0};
    std::vector<Plane> planes;
    Imf::FrameBuffer buffer;
    for (const NewChannel &c : picture.channels) {
        ChannelInfo info;
        info.name = c.name;
        info.type = c.type;
        header.channels().insert(c.name, Imf::Channel(exr_type(c.type)));
        planes.push_back(plane_of_floats(info, largest_finite(c.type), c.values, count, c.stride, clamped));
    }
    for (const Plane &plane : planes)
        buffer.insert(plane.channel.name, slice_of(plane, picture.data));
    write_whole(output, [&](OutputStream &stream) {
        Imf::OutputFile file(stream, header);
        file.setFrameBuffer(buffer);
        file.writePixels(picture.data.height());
    });
    return clamped;
}

}  // namespace brume::tool
