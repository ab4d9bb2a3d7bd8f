#pragma once

#include <atomic>
#include <cstddef>
#include <limits>

#include <ImathFun.h>
#include <ImfFrameBuffer.h>

#include "exr/file.hpp"

namespace brume::tool {

/// Samples handed to one task: enough that a task costs more than its dispatch.
constexpr std::size_t kGrain = 1 << 15;

/// Sampled coordinates are the multiples of the sampling rate inside the window.
inline int samples(int sampling, int from, int to)
{
    return Imath::divp(to, sampling) - Imath::divp(from - 1, sampling);
}

inline std::size_t plane_bytes(const ChannelInfo &c, const Window &window)
{
    return bytes_of(c.type) * std::size_t(samples(c.sampling.x, window.min.x, window.max.x)) *
           std::size_t(samples(c.sampling.y, window.min.y, window.max.y));
}

inline Imf::Slice slice_of(const Plane &plane, const Window &window)
{
    const ChannelInfo &c = plane.channel;
    const std::size_t row = plane.sample_bytes * std::size_t(samples(c.sampling.x, window.min.x, window.max.x));
    return Imf::Slice::Make(exr_type(c.type), plane.bytes.get(), exr_window(window), plane.sample_bytes, row, c.sampling.x,
                            c.sampling.y);
}

constexpr float kHalfMax = 65504.0f;

inline float largest_finite(SampleType type)
{
    return type == SampleType::kHalf ? kHalfMax : std::numeric_limits<float>::max();
}

/// Of values `stride` floats apart; those beyond `largest` become that, and are counted.
Plane plane_of_floats(const ChannelInfo &channel, float largest, const float *in, std::size_t count, std::size_t stride,
                      std::atomic<std::uint64_t> &clamped);

}  // namespace brume::tool
