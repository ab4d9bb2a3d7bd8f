#include "exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>

namespace fog {

Picture read_exr(const std::string &file, const std::vector<std::string> &channels)
{
    Imf::InputFile in(file.c_str());
    Imath::Box2i window = in.header().dataWindow();
    Picture p(window.max.x - window.min.x + 1, window.max.y - window.min.y + 1, int(channels.size()));
    Imf::FrameBuffer buffer;
    size_t pixel = sizeof(float) * channels.size();
    for (size_t c = 0; c < channels.size(); ++c)
        buffer.insert(channels[c], Imf::Slice::Make(Imf::FLOAT, p.data.data() + c, window, pixel, pixel * size_t(p.width), 1,
                                                    1, channels[c] == "A" ? 1.0 : 0.0));
    in.setFrameBuffer(buffer);
    in.readPixels(window.min.y, window.max.y);
    return p;
}

void write_exr(const std::string &file, const Picture &p, const std::vector<std::string> &channels)
{
    Imf::Header header(p.width, p.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer buffer;
    size_t pixel = sizeof(float) * size_t(p.channels);
    for (size_t c = 0; c < channels.size(); ++c) {
        header.channels().insert(channels[c], Imf::Channel(Imf::FLOAT));
        buffer.insert(channels[c], Imf::Slice(Imf::FLOAT, reinterpret_cast<char *>(const_cast<float *>(p.data.data() + c)),
                                              pixel, pixel * size_t(p.width)));
    }
    Imf::OutputFile out(file.c_str(), header);
    out.setFrameBuffer(buffer);
    out.writePixels(p.height);
}

}  // namespace fog
