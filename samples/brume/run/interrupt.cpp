#include "run/interrupt.hpp"

#include <atomic>
#include <csignal>

#include <unistd.h>

#include "support/error.hpp"
#include "support/pending_file.hpp"

namespace brume::tool {
namespace {

std::atomic<bool> asked{false};
static_assert(std::atomic<bool>::is_always_lock_free, "used in a signal handler");

void on_signal(int)
{
    if (!asked.exchange(true))
        return;
    remove_pending_files();
    ::_exit(kSomeFailed);
}

}  // namespace

void catch_interrupts()
{
    struct sigaction action {};
    action.sa_handler = on_signal;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART;
    ::sigaction(SIGINT, &action, nullptr);
    ::sigaction(SIGTERM, &action, nullptr);
}

bool interrupted()
{
    return asked.load();
}

}  // namespace brume::tool
