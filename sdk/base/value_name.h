#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace brume {

// "lights[3].intensity": what a message calls a value. Made into text only where it is needed, not for each value of each
// frame.
struct ValueName {
    std::string_view list;
    int64_t index = -1;  // < 0: none
    std::string_view member{};

    ValueName(const char *name) : list(name) {}
    ValueName(std::string_view name, int64_t i, std::string_view of = {}) : list(name), index(i), member(of) {}

    ValueName of(std::string_view name) const { return {list, index, name}; }
    std::string text() const
    {
        return index < 0 ? fmt::format("{}{}", list, member) : fmt::format("{}[{}]{}", list, index, member);
    }
};

}  // namespace brume
