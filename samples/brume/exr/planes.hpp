#pragma once

#include <cstddef>

#include <ImathFun.h>
#include <ImfFrameBuffer.h>

#include "exr/frame.hpp"

namespace brume::tool {

/// Samples handed to one task: enough that a task costs more than its dispatch.
constexpr std::size_t kGrain = 1 << 15;

inline std::size_t pixel_bytes(Imf::PixelType type)
{
    return type == Imf::HALF ? 2 : 4;
}

/// Sampled coordinates are the multiples of the sampling rate inside the window.
inline int samples(int sampling, int from, int to)
{
    return Imath::divp(to, sampling) - Imath::divp(from - 1, sampling);
}

inline std::size_t plane_bytes(const ChannelInfo &c, const Imath::Box2i &window)
{
    return pixel_bytes(c.type) * std::size_t(samples(c.sampling.x, window.min.x, window.max.x)) *
           std::size_t(samples(c.sampling.y, window.min.y, window.max.y));
}

inline Imf::Slice slice_of(const Plane &plane, const Imath::Box2i &window)
{
    const ChannelInfo &c = plane.channel;
    const std::size_t row = plane.sample_bytes * std::size_t(samples(c.sampling.x, window.min.x, window.max.x));
    return Imf::Slice::Make(c.type, plane.bytes.get(), window, plane.sample_bytes, row, c.sampling.x, c.sampling.y);
}

}  // namespace brume::tool
