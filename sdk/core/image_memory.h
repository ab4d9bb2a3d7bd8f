#pragma once
#include "core/pixels.h"

namespace brume {

inline bool same_memory(const brume_image &a, const brume_image &b)
{
    if (a.kind != b.kind)
        return false;
    if (a.kind == BRUME_IMAGE_GL_TEXTURE)
        return a.gl_texture == b.gl_texture;
    HostPixels pa(a), pb(b);
    return pa.begin() < pb.end() && pb.begin() < pa.end();
}

inline bool same_layout(const brume_image &a, const brume_image &b)
{
    HostPixels pa(a), pb(b);
    return pa.data == pb.data && pa.pixel == pb.pixel && pa.channels == pb.channels && pa.pixel_stride == pb.pixel_stride &&
           pa.row_stride == pb.row_stride;
}

}  // namespace brume
