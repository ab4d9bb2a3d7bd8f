#pragma once
#include "base/pixels.h"

namespace brume {

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

inline bool same_memory(const brume_image &a, const brume_image &b)
{
    const bool texture = a.kind != BRUME_IMAGE_HOST;
    if (texture != (b.kind != BRUME_IMAGE_HOST))
        return false;
    if (texture)
        return a.gl_texture == b.gl_texture;
    HostPixels pa(a), pb(b);
    return pa.begin() < pb.end() && pb.begin() < pa.end() && !other_channels(pa, pb);
}

inline bool same_layout(const brume_image &a, const brume_image &b)
{
    HostPixels pa(a), pb(b);
    return pa.data == pb.data && pa.pixel == pb.pixel && pa.channels == pb.channels && pa.pixel_stride == pb.pixel_stride &&
           pa.row_stride == pb.row_stride && pa.channel_stride == pb.channel_stride;
}

}  // namespace brume
