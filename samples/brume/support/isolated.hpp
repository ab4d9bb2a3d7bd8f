#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace brume::tool {

/// Does the work in a process of its own, for libraries that damaged files can crash or make allocate without bound, and
/// returns what it returns. Its RequestError comes through; where the process dies, throws a RequestError that says `doing`
/// and how. It has `most_bytes` of addresses, or half of the machine's memory where that is less. To be called before any
/// thread is started.
std::string isolated(const std::string &doing, std::uint64_t most_bytes, const std::function<std::string()> &work);

}  // namespace brume::tool
