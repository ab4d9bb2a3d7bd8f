#include "allocations.h"

#include <algorithm>
#include <cstdlib>
#include <new>

namespace allocations {
std::atomic<size_t> count = 0;
thread_local size_t largest_granted = size_t(-1);
}  // namespace allocations

namespace {

void *granted(size_t size, void *(*allocate)(size_t alignment, size_t size), size_t alignment)
{
    ++allocations::count;
    if (size <= allocations::largest_granted)
        if (void *memory = allocate(alignment, std::max<size_t>(size, 1)))
            return memory;
    throw std::bad_alloc();
}

}  // namespace

void *operator new(size_t size)
{
    return granted(
        size, [](size_t, size_t bytes) { return std::malloc(bytes); }, 0);
}
void *operator new(size_t size, std::align_val_t alignment)
{
    return granted(
        size, [](size_t to, size_t bytes) { return std::aligned_alloc(to, (bytes + to - 1) / to * to); }, size_t(alignment));
}
void operator delete(void *memory) noexcept
{
    std::free(memory);
}
void operator delete(void *memory, size_t) noexcept
{
    std::free(memory);
}
void operator delete(void *memory, std::align_val_t) noexcept
{
    std::free(memory);
}
void operator delete(void *memory, size_t, std::align_val_t) noexcept
{
    std::free(memory);
}
