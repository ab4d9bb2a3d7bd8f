#include "image/types.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace brume::tool {

const char *name_of(SampleType type)
{
    constexpr const char *names[] = {"half", "float", "uint", "uint8", "uint16"};
    return names[std::size_t(type)];
}

std::size_t bytes_of(SampleType type)
{
    constexpr std::size_t bytes[] = {2, 4, 4, 1, 2};
    return bytes[std::size_t(type)];
}

const ChannelInfo *PartInfo::find(const std::string &channel_name) const
{
    const auto at = std::find_if(channels.begin(), channels.end(), [&](const auto &c) { return c.name == channel_name; });
    return at == channels.end() ? nullptr : &*at;
}

std::string PartInfo::label() const
{
    return name.empty() ? fmt::format("part {}", index) : fmt::format("part {} ({})", index, name);
}

}  // namespace brume::tool
