#include "support/isolated.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <new>

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "support/error.hpp"
#include "support/memory.hpp"

namespace brume::tool {
namespace {

enum ChildStatus { kReturned = 0, kThrew = 1, kOutOfMemory = 2 };

// Damaged files put megabytes into names, which messages quote.
constexpr std::size_t kMostMessage = 4096;

std::uint64_t most_bytes_of(std::uint64_t wanted)
{
    return std::min(wanted, memory_of_machine() / 2);
}

[[noreturn]] void run_child(int pipe, std::uint64_t most_bytes, const std::function<std::string()> &work)
{
    // What is killed leaves nothing that runs on.
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    const rlimit memory{most_bytes_of(most_bytes), most_bytes_of(most_bytes)};
    ::setrlimit(RLIMIT_AS, &memory);
    const rlimit no_core{0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core);
    std::string text;
    int status = kReturned;
    try {
        text = work();
    } catch (const std::bad_alloc &) {
        status = kOutOfMemory;
    } catch (const std::exception &e) {
        status = kThrew;
        text.assign(e.what(), ::strnlen(e.what(), kMostMessage));
    }
    for (std::size_t at = 0; at < text.size();) {
        const ssize_t written = ::write(pipe, text.data() + at, text.size() - at);
        if (written < 0 && errno != EINTR)
            ::_exit(kThrew);
        at += written > 0 ? std::size_t(written) : 0;
    }
    ::_exit(status);
}

}  // namespace

std::string isolated(const std::string &doing, std::uint64_t most_bytes, const std::function<std::string()> &work)
{
    const auto fail = [&](const std::string &why) { throw RequestError(doing + ": " + why); };
    int ends[2];
    if (::pipe(ends) != 0)
        fail(std::strerror(errno));
    const pid_t child = ::fork();
    if (child < 0)
        fail(std::strerror(errno));
    if (child == 0) {
        ::close(ends[0]);
        run_child(ends[1], most_bytes, work);
    }
    ::close(ends[1]);
    std::string text;
    char buffer[1 << 16];
    for (ssize_t got; (got = ::read(ends[0], buffer, sizeof buffer)) != 0;)
        if (got > 0)
            text.append(buffer, std::size_t(got));
        else if (errno != EINTR)
            break;
    ::close(ends[0]);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (WIFSIGNALED(status))
        fail(fmt::format("the library that reads it crashed ({}): the file is damaged", ::strsignal(WTERMSIG(status))));
    if (WEXITSTATUS(status) == kOutOfMemory)
        fail(fmt::format("asks for more than {} MiB of memory: the file is damaged, or too large for this machine",
                         most_bytes_of(most_bytes) >> 20));
    if (WEXITSTATUS(status) != kReturned)
        throw RequestError(text.empty() ? doing + ": failed" : text);
    return text;
}

}  // namespace brume::tool
