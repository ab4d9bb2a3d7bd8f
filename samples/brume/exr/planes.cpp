#include "exr/planes.hpp"

#include <algorithm>
#include <cmath>

#include <half.h>
#include <oneapi/tbb/parallel_for.h>

namespace brume::tool {

Plane plane_of_floats(const ChannelInfo &channel, float largest, const float *in, std::size_t count, std::size_t stride,
                      std::atomic<std::uint64_t> &clamped)
{
    Plane plane{channel, std::make_unique_for_overwrite<char[]>(count * bytes_of(channel.type)), bytes_of(channel.type)};
    oneapi::tbb::parallel_for(std::size_t(0), (count + kGrain - 1) / kGrain, [&](std::size_t block) {
        const std::size_t from = block * kGrain, to = std::min(count, from + kGrain);
        std::uint64_t over = 0;
        const auto fill = [&](auto *out) {
            for (std::size_t i = from; i < to; ++i) {
                const float value = in[i * stride];
                const bool too_large = std::isfinite(value) && std::abs(value) > largest;
                over += too_large;
                out[i] = too_large ? std::copysign(largest, value) : value;
            }
        };
        if (channel.type == SampleType::kFloat)
            fill(reinterpret_cast<float *>(plane.bytes.get()));
        else
            fill(reinterpret_cast<half *>(plane.bytes.get()));
        clamped += over;
    });
    return plane;
}

}  // namespace brume::tool
