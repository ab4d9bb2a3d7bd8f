#include "cpu/threads.h"

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace brume {

struct Threads::Arena : oneapi::tbb::task_arena {
    using task_arena::task_arena;
};

Threads::Threads(uint32_t count) : arena_(std::make_unique<Arena>(int(count))) {}

Threads::~Threads() = default;

// An arena of more than the process may use would only make TBB warn.
uint32_t Threads::most()
{
    return uint32_t(oneapi::tbb::info::default_concurrency());
}

void Threads::run(int count, void (*function)(void *context, int block), void *context)
{
    arena_->execute([&] { oneapi::tbb::parallel_for(0, count, [&](int block) { function(context, block); }); });
}

}  // namespace brume
