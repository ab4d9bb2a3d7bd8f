#include "support/memory.hpp"

#include <algorithm>

#include <sys/resource.h>
#include <unistd.h>

namespace brume::tool {

std::uint64_t memory_of_machine()
{
    std::uint64_t bytes = std::uint64_t(::sysconf(_SC_PHYS_PAGES)) * std::uint64_t(::sysconf(_SC_PAGESIZE));
    rlimit limit{};
    if (::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
        bytes = std::min<std::uint64_t>(bytes, limit.rlim_cur);
    return bytes;
}

}  // namespace brume::tool
