// What passes do, by kind.
#pragma once
#include <cstdint>
#include <string>

#include <brume/brume_plugin.h>

namespace airlight {

// See brume_plugin_entry.
struct Work {
    double operations = 0, alike = 0, turns = 0;
};

constexpr Work operator+(const Work &a, const Work &b)
{
    return {a.operations + b.operations, a.alike + b.alike, a.turns + b.turns};
}

constexpr Work operator*(double times, const Work &work)
{
    return {times * work.operations, times * work.alike, times * work.turns};
}

inline brume_plugin_entry running(const char *name, const std::string &reason, double bytes, const Work &work)
{
    return {sizeof(brume_plugin_entry),
            1u,
            name,
            reason.c_str(),
            uint64_t(bytes),
            uint64_t(work.operations),
            uint64_t(work.alike),
            uint64_t(work.turns)};
}

}  // namespace airlight
