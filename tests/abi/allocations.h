#pragma once
#include <atomic>
#include <cstddef>

// What operator new is asked for in this program, by the library too, aligned or not. Linking allocations.cpp replaces it.
namespace allocations {

extern std::atomic<size_t> count;            // on all threads
extern thread_local size_t largest_granted;  // larger ones throw std::bad_alloc

}  // namespace allocations
