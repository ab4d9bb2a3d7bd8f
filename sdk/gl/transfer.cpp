#include "gl/transfer.h"

#include <algorithm>
#include <cstring>
#include <vector>

#include "base/pixels.h"

namespace brume::gl {
namespace {

// Rows that are repacked at a time: enough to amortise a transfer, little enough to stay in the caches.
constexpr int64_t band_bytes = int64_t(4) << 20;
// glGetTextureSubImage takes the size of its destination as an int.
constexpr int64_t largest_read = int64_t(1) << 30;

template <class Sample> constexpr Sample one = sizeof(Sample) == 2 ? Sample(0x3c00) : Sample(0x3f800000);

template <class Sample> Sample load(const unsigned char *p)
{
    Sample sample;
    std::memcpy(&sample, p, sizeof sample);
    return sample;
}

template <class Sample> void store(unsigned char *p, Sample sample)
{
    std::memcpy(p, &sample, sizeof sample);
}

template <class Sample> void load_row(const HostPixels &from, int y, int channels, Sample *to)
{
    const int64_t next = from.channel_stride;
    const bool color = from.channels >= 3;
    const bool alpha = from.channels == 2 || from.channels == 4;
    for (int x = 0; x < from.width; ++x, to += channels) {
        const unsigned char *p = from.at(x, y);
        to[0] = load<Sample>(p);
        if (channels == 1)
            continue;
        to[1] = color ? load<Sample>(p + next) : to[0];
        to[2] = color ? load<Sample>(p + 2 * next) : to[0];
        to[3] = alpha ? load<Sample>(p + (from.channels - 1) * next) : one<Sample>;
    }
}

template <class Sample> void store_row(const Sample *from, int channels, const HostPixels &to, int y)
{
    const int64_t next = to.channel_stride;
    const bool color = to.channels >= 3 && channels == 4;
    const bool alpha = to.channels == 2 || to.channels == 4;
    for (int x = 0; x < to.width; ++x, from += channels) {
        unsigned char *p = to.at(x, y);
        store(p, from[0]);
        if (to.channels >= 3) {
            store(p + next, color ? from[1] : from[0]);
            store(p + 2 * next, color ? from[2] : from[0]);
        }
        if (alpha)
            store(p + (to.channels - 1) * next, channels == 4 ? from[3] : one<Sample>);
    }
}

struct Layout {
    Layout(const HostPixels &host, const GlImage &image)
        : format(image.channels == 1 ? GL_RED : GL_RGBA), type(host.pixel == BRUME_PIXEL_F16 ? GL_HALF_FLOAT : GL_FLOAT),
          pixel_bytes(int64_t(host.sample_size) * image.channels)
    {
    }

    // What pixel-store parameters can express: whole pixels side by side and rows that are whole pixels apart.
    bool describes(const HostPixels &host, const GlImage &image) const
    {
        return host.channels == image.channels && host.interleaved() && host.pixel_stride == pixel_bytes &&
               host.row_stride >= host.width * pixel_bytes && host.row_stride % pixel_bytes == 0 &&
               host.row_stride / pixel_bytes <= INT32_MAX &&
               reinterpret_cast<uintptr_t>(host.data) % uintptr_t(host.sample_size) == 0;
    }

    GLenum format, type;
    int64_t pixel_bytes;
};

template <class Function> void for_bands(int32_t height, int64_t row_bytes, int64_t bytes, Function function)
{
    const auto rows = int32_t(std::clamp<int64_t>(bytes / row_bytes, 1, height));
    for (int32_t y = 0; y < height; y += rows)
        function(y, std::min(rows, height - y));
}

template <class Sample> void upload_bands(const HostPixels &host, const GlImage &to, const Layout &layout)
{
    std::vector<Sample> band;
    for_bands(host.height, host.width * layout.pixel_bytes, band_bytes, [&](int32_t first, int32_t rows) {
        const size_t row = size_t(host.width) * size_t(to.channels);
        band.resize(row * size_t(rows));
        for (int32_t y = 0; y < rows; ++y)
            load_row(host, first + y, to.channels, band.data() + row * size_t(y));
        glTextureSubImage2D(to.texture, 0, 0, first, host.width, rows, layout.format, layout.type, band.data());
    });
}

template <class Sample> void download_bands(const GlImage &from, const HostPixels &host, const Layout &layout)
{
    std::vector<Sample> band;
    for_bands(host.height, host.width * layout.pixel_bytes, band_bytes, [&](int32_t first, int32_t rows) {
        const size_t row = size_t(host.width) * size_t(from.channels);
        band.resize(row * size_t(rows));
        glGetTextureSubImage(from.texture, 0, 0, first, 0, host.width, rows, 1, layout.format, layout.type,
                             GLsizei(band.size() * sizeof(Sample)), band.data());
        for (int32_t y = 0; y < rows; ++y)
            store_row(band.data() + row * size_t(y), from.channels, host, first + y);
    });
}

}  // namespace

void upload(const brume_image &from, const GlImage &to, StateGuard &guard)
{
    const HostPixels host(from);
    const Layout layout(host, to);
    guard.unpack();
    if (layout.describes(host, to)) {
        glPixelStorei(GL_UNPACK_ROW_LENGTH, GLint(host.row_stride / layout.pixel_bytes));
        glTextureSubImage2D(to.texture, 0, 0, 0, host.width, host.height, layout.format, layout.type, host.data);
        glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    } else if (host.pixel == BRUME_PIXEL_F16) {
        upload_bands<uint16_t>(host, to, layout);
    } else {
        upload_bands<uint32_t>(host, to, layout);
    }
}

void download(const GlImage &from, const brume_image &to, StateGuard &guard)
{
    const HostPixels host(to);
    const Layout layout(host, from);
    guard.pack();
    if (layout.describes(host, from)) {
        glPixelStorei(GL_PACK_ROW_LENGTH, GLint(host.row_stride / layout.pixel_bytes));
        for_bands(host.height, host.row_stride, largest_read, [&](int32_t first, int32_t rows) {
            glGetTextureSubImage(from.texture, 0, 0, first, 0, host.width, rows, 1, layout.format, layout.type,
                                 GLsizei(rows * host.row_stride), host.at(0, first));
        });
        glPixelStorei(GL_PACK_ROW_LENGTH, 0);
    } else if (host.pixel == BRUME_PIXEL_F16) {
        download_bands<uint16_t>(from, host, layout);
    } else {
        download_bands<uint32_t>(from, host, layout);
    }
}

}  // namespace brume::gl
