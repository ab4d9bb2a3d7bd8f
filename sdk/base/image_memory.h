#pragma once
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "base/pixels.h"

namespace brume {

// "960 x 540", or "960 x 540 at (64, 0) of 1920 x 1080".
inline std::string extent_text(const brume_image &image)
{
    const std::string size = fmt::format("{} x {}", image.width, image.height);
    return is_part(image)
               ? fmt::format("{} at ({}, {}) of {} x {}", size, image.x, image.y, image.whole_width, image.whole_height)
               : size;
}

// Of two images, where either is a part: " (output is 960 x 540 at ..., color 960 x 540 at ...)".
inline std::string extents_text(std::string_view name, const brume_image &a, std::string_view other, const brume_image &b)
{
    return is_part(a) || is_part(b) ? fmt::format(" ({} is {}, {} {})", name, extent_text(a), other, extent_text(b)) : "";
}

inline bool same_rectangle(const brume_image &a, const brume_image &b)
{
    return a.x == b.x && a.y == b.y && a.width == b.width && a.height == b.height;
}

inline bool rectangles_meet(const brume_image &a, const brume_image &b)
{
    return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

// Two images that are different channels of the same pixels, such as colour and depth of five floats each.
inline bool other_channels(const HostPixels &a, const HostPixels &b)
{
    const HostPixels &first = a.data < b.data ? a : b, &second = a.data < b.data ? b : a;
    const int64_t apart = second.data - first.data;
    const int64_t pixel = std::abs(a.pixel_stride), row = std::abs(a.row_stride);
    return a.interleaved() && b.interleaved() && a.pixel_stride == b.pixel_stride && a.row_stride == b.row_stride &&
           row >= pixel * a.width && apart >= int64_t(first.sample_size) * first.channels &&
           apart + int64_t(second.sample_size) * second.channels <= pixel;
}

inline bool same_layout(const HostPixels &a, const HostPixels &b)
{
    return a.data == b.data && a.pixel == b.pixel && a.channels == b.channels && a.pixel_stride == b.pixel_stride &&
           a.row_stride == b.row_stride && a.channel_stride == b.channel_stride;
}

// Whether they have a pixel in common. Parts of one whole do where their rectangles meet, though the rows of others lie
// between theirs.
inline bool same_memory(const brume_image &a, const brume_image &b)
{
    const bool texture = a.kind != BRUME_IMAGE_HOST;
    if (texture != (b.kind != BRUME_IMAGE_HOST))
        return false;
    if (texture)
        return a.gl_texture == b.gl_texture && rectangles_meet(a, b);
    const HostPixels pa(a), pb(b);
    if (pa.begin() >= pb.end() || pb.begin() >= pa.end())
        return false;
    const HostPixels wa(whole_of(a)), wb(whole_of(b));
    return !other_channels(wa, wb) && !(same_layout(wa, wb) && !rectangles_meet(a, b));
}

// Of two that have pixels in common: they are the very same image.
inline bool same_image(const brume_image &a, const brume_image &b)
{
    return a.kind == BRUME_IMAGE_HOST ? same_layout(HostPixels(a), HostPixels(b)) : same_rectangle(a, b);
}

}  // namespace brume
