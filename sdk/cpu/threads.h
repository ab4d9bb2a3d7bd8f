#pragma once
#include <cstdint>
#include <memory>

namespace brume {

/// Threads that blocks of work are dealt out to. Only this file's source knows TBB.
class Threads {
public:
    explicit Threads(uint32_t count);
    ~Threads();

    static uint32_t most();

    /// function(context, block) for blocks 0 to count - 1, in any order; what one throws is thrown here.
    void run(int count, void (*function)(void *context, int block), void *context);

private:
    struct Arena;
    std::unique_ptr<Arena> arena_;
};

}  // namespace brume
