#include "exr/new_file.hpp"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>

#include "exr/output_stream.hpp"
#include "exr/planes.hpp"
#include "support/error.hpp"
#include "support/pending_file.hpp"

namespace brume::tool {

std::uint64_t write_new_exr(const std::filesystem::path &output, const NewPicture &picture)
{
    Imf::Header header(exr_window(picture.display), exr_window(picture.data), float(picture.pixel_aspect));
    for (const auto &[name, text] : picture.texts)
        header.insert(name, Imf::StringAttribute(text));
    if (const auto &c = picture.chromaticities)
        Imf::addChromaticities(header, {c->red, c->green, c->blue, c->white});
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
    PendingFile pending(output);
    OutputStream stream(pending.path().string(), output.string());
    try {
        Imf::OutputFile file(stream, header);
        file.setFrameBuffer(buffer);
        file.writePixels(picture.data.height());
    } catch (const FrameError &) {
        throw;
    } catch (const std::exception &e) {
        throw FrameError(fmt::format("{}: writing: {}", output.string(), e.what()));
    }
    stream.close();
    pending.commit();
    return clamped;
}

}  // namespace brume::tool
