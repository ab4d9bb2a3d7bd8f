#include "base/memory_limit.h"

#include <sys/resource.h>
#include <sys/sysinfo.h>

#include <algorithm>
#include <fstream>
#include <string>

namespace brume {
namespace {

// Of the group and those it is within (cgroup v2).
uint64_t limit_of_groups()
{
    uint64_t least = UINT64_MAX;
    std::ifstream groups("/proc/self/cgroup");
    for (std::string line; std::getline(groups, line);) {
        if (line.rfind("0::/", 0) != 0)
            continue;
        for (std::string path = line.substr(3); !path.empty(); path.resize(path.rfind('/'))) {
            std::ifstream file("/sys/fs/cgroup" + path + "/memory.max");
            if (uint64_t most; file >> most)  // else "max", or no such group in this view
                least = std::min(least, most);
        }
    }
    return least;
}

}  // namespace

uint64_t memory_limit()
{
    uint64_t least = limit_of_groups();
    struct sysinfo machine {};
    if (sysinfo(&machine) == 0)
        least = std::min(least, (uint64_t(machine.totalram) + machine.totalswap) * machine.mem_unit);
    rlimit addresses{};
    if (getrlimit(RLIMIT_AS, &addresses) == 0 && addresses.rlim_cur != RLIM_INFINITY)
        least = std::min(least, uint64_t(addresses.rlim_cur));
    return least;
}

}  // namespace brume
