#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include <brume/brume.h>

#include "base/half.h"

namespace brume {

inline bool is_part(const brume_image &image)
{
    return image.whole_width != 0;
}

// What the image is a part of, or it itself.
inline brume_image whole_of(const brume_image &image)
{
    brume_image whole = image;
    if (is_part(image)) {
        whole.width = image.whole_width;
        whole.height = image.whole_height;
        whole.x = whole.y = whole.whole_width = whole.whole_height = 0;
    }
    return whole;
}

// The caller's host image with its strides resolved.
struct HostPixels {
    explicit HostPixels(const brume_image &image)
        : data(static_cast<unsigned char *>(image.data)), pixel(image.pixel), channels(int(image.channels)),
          sample_size(image.pixel == BRUME_PIXEL_F16 ? 2 : 4),
          channel_stride(image.plane_stride ? image.plane_stride : sample_size),
          pixel_stride(image.pixel_stride ? image.pixel_stride : int64_t(sample_size) * (image.plane_stride ? 1 : channels)),
          row_stride(image.row_stride ? image.row_stride : pixel_stride * whole_of(image).width), width(image.width),
          height(image.height)
    {
        data = at(image.x, image.y);
    }

    unsigned char *at(int x, int y, int channel = 0) const
    {
        return data + y * row_stride + x * pixel_stride + channel * channel_stride;
    }
    // First byte touched and one past the last, whatever the sign of the strides.
    const unsigned char *begin() const
    {
        return data + std::min<int64_t>(0, row_stride * (height - 1)) + std::min<int64_t>(0, pixel_stride * (width - 1)) +
               std::min<int64_t>(0, channel_stride * (channels - 1));
    }
    const unsigned char *end() const
    {
        return data + std::max<int64_t>(0, row_stride * (height - 1)) + std::max<int64_t>(0, pixel_stride * (width - 1)) +
               std::max<int64_t>(0, channel_stride * (channels - 1)) + sample_size;
    }
    // The samples of a pixel are side by side.
    bool interleaved() const { return channels == 1 || channel_stride == sample_size; }
    bool packed_float(int wanted_channels) const
    {
        return pixel == BRUME_PIXEL_F32 && channels == wanted_channels && interleaved() &&
               pixel_stride == int64_t(4) * channels && row_stride % 4 == 0 && reinterpret_cast<uintptr_t>(data) % 4 == 0;
    }

    unsigned char *data;
    uint32_t pixel;
    int channels;
    int sample_size;
    int64_t channel_stride;
    int64_t pixel_stride;
    int64_t row_stride;
    int width;
    int height;
};

constexpr float largest_half = 65504.0f;

inline float load_sample(const unsigned char *p, uint32_t pixel)
{
    if (pixel == BRUME_PIXEL_F16) {
        uint16_t half;
        std::memcpy(&half, p, 2);
        return half_to_float(half);
    }
    float value;
    std::memcpy(&value, p, 4);
    return value;
}

// Finite values stay finite: halves saturate at their largest. Returns whether this one did.
inline bool store_sample(unsigned char *p, uint32_t pixel, float value)
{
    if (pixel != BRUME_PIXEL_F16) {
        std::memcpy(p, &value, 4);
        return false;
    }
    const bool beyond = std::isfinite(value) && std::abs(value) > largest_half;
    const uint16_t half = float_to_half(beyond ? std::copysign(largest_half, value) : value);
    std::memcpy(p, &half, 2);
    return beyond;
}

// One row as RGBA: grey is spread over RGB, alpha is 1 where there is none.
inline void load_row_rgba(const HostPixels &from, int y, float *to)
{
    bool grey = from.channels <= 2;
    bool alpha = from.channels == 2 || from.channels == 4;
    for (int x = 0; x < from.width; ++x, to += 4) {
        const unsigned char *p = from.at(x, y);
        to[0] = load_sample(p, from.pixel);
        to[1] = grey ? to[0] : load_sample(p + from.channel_stride, from.pixel);
        to[2] = grey ? to[0] : load_sample(p + 2 * from.channel_stride, from.pixel);
        to[3] = alpha ? load_sample(p + (from.channels - 1) * from.channel_stride, from.pixel) : 1.0f;
    }
}

// The reverse; grey takes the first component. Returns how many values saturated.
inline int64_t store_row_rgba(const float *from, const HostPixels &to, int y)
{
    int64_t saturated = 0;
    for (int x = 0; x < to.width; ++x, from += 4) {
        unsigned char *p = to.at(x, y);
        saturated += store_sample(p, to.pixel, from[0]);
        if (to.channels == 2)
            saturated += store_sample(p + to.channel_stride, to.pixel, from[3]);
        for (int c = 1; c < to.channels && to.channels > 2; ++c)
            saturated += store_sample(p + c * to.channel_stride, to.pixel, from[c]);
    }
    return saturated;
}

// Of `from` pixels side by side, the one in which the centre of pixel x of `to` lies.
inline int32_t nearest_pixel(int32_t x, int32_t to, int32_t from)
{
    return int32_t((2 * int64_t(x) + 1) * from / (2 * int64_t(to)));
}

inline void load_row_scalar(const HostPixels &from, int y, float *to)
{
    for (int x = 0; x < from.width; ++x)
        to[x] = load_sample(from.at(x, y), from.pixel);
}

inline int64_t store_row_scalar(const float *from, const HostPixels &to, int y)
{
    int64_t saturated = 0;
    for (int x = 0; x < to.width; ++x)
        saturated += store_sample(to.at(x, y), to.pixel, from[x]);
    return saturated;
}

}  // namespace brume
