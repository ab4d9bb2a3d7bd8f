#include "effects/plugin_lock.h"

#include <map>

namespace brume {

std::unique_lock<std::mutex> hold_if_unsafe(const brume_effect *table)
{
    static std::mutex guard;
    static std::map<const brume_effect *, std::mutex> mutexes;
    if (table->thread_safety != BRUME_THREADS_UNSAFE)
        return {};
    std::lock_guard lock(guard);
    return std::unique_lock(mutexes[table]);
}

}  // namespace brume
