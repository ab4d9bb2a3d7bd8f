#pragma once
#include <cstddef>
#include <mutex>
#include <new>

namespace brume {

// Small blocks that come and go with every frame (control blocks of images, nodes of lists): the last ones given back are
// kept, so that frames allocate nothing once warm.
template <size_t size, size_t alignment> class RecycledBlocks {
public:
    static void *take() noexcept
    {
        std::lock_guard lock(mutex_);
        return count_ > 0 ? blocks_[--count_] : nullptr;
    }
    static bool keep(void *block) noexcept
    {
        std::lock_guard lock(mutex_);
        if (count_ == most)
            return false;
        blocks_[count_++] = block;
        return true;
    }

private:
    static constexpr size_t most = 64;
    static inline std::mutex mutex_;
    static inline void *blocks_[most];
    static inline size_t count_ = 0;
};

template <class T> struct RecyclingAllocator {
    using value_type = T;
    using Blocks = RecycledBlocks<sizeof(T), alignof(T)>;
    static_assert(alignof(T) <= __STDCPP_DEFAULT_NEW_ALIGNMENT__);

    RecyclingAllocator() = default;
    template <class Other> RecyclingAllocator(const RecyclingAllocator<Other> &) {}

    T *allocate(size_t n)
    {
        if (void *block = n == 1 ? Blocks::take() : nullptr)
            return static_cast<T *>(block);
        return static_cast<T *>(::operator new(n * sizeof(T)));
    }
    void deallocate(T *block, size_t n) noexcept
    {
        if (n != 1 || !Blocks::keep(block))
            ::operator delete(block);
    }
    template <class Other> bool operator==(const RecyclingAllocator<Other> &) const { return true; }
};

}  // namespace brume
