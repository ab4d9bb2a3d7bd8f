#pragma once
#include <mutex>

#include <brume/brume_plugin.h>

namespace brume {

// Held around each call of a plugin that is not thread-safe; nothing for others. Contexts are independent, so such a plugin
// may be reached from two of them at once.
std::unique_lock<std::mutex> hold_if_unsafe(const brume_effect *table);

}  // namespace brume
