#include "support/pending_file.hpp"

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstring>
#include <ctime>
#include <fstream>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "support/error.hpp"

namespace brume::tool {
namespace {

// A signal handler may not allocate or lock, so the names it needs lie in fixed memory.
struct Slot {
    std::atomic<bool> taken{false}, live{false};
    char path[PATH_MAX];
};
std::array<Slot, 256> slots;

int take_slot(const std::string &path)
{
    if (path.size() >= PATH_MAX)
        return -1;
    for (std::size_t i = 0; i < slots.size(); ++i) {
        if (slots[i].taken.exchange(true))
            continue;
        std::memcpy(slots[i].path, path.c_str(), path.size() + 1);
        slots[i].live.store(true);
        return int(i);
    }
    return -1;
}

void release_slot(int slot)
{
    if (slot < 0)
        return;
    slots[std::size_t(slot)].live.store(false);
    slots[std::size_t(slot)].taken.store(false);
}

// Between a file's making and its name's entry in a slot no signal may end the process: the file would stay. The thread
// itself takes no signal meanwhile, and remove_pending_files() waits for the others.
std::atomic<int> makers{0};
std::atomic<bool> ending{false};

class Making {
public:
    Making()
    {
        sigset_t signals;
        sigemptyset(&signals);
        sigaddset(&signals, SIGINT);
        sigaddset(&signals, SIGTERM);
        ::pthread_sigmask(SIG_BLOCK, &signals, &before_);
        ++makers;
        if (ending.load()) {
            --makers;
            for (;;)
                ::pause();
        }
    }
    ~Making()
    {
        --makers;
        ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    }
    Making(const Making &) = delete;
    Making &operator=(const Making &) = delete;

private:
    sigset_t before_;
};

}  // namespace

std::filesystem::path place_of(const std::filesystem::path &output, std::string &why_not)
{
    namespace fs = std::filesystem;
    constexpr int kMostLinks = 40;  // as many as Linux follows
    fs::path place = output;
    std::error_code error;
    for (int i = 0; fs::is_symlink(fs::symlink_status(place, error)); ++i) {
        if (i == kMostLinks) {
            why_not = "is a loop of links";
            return place;
        }
        place = place.parent_path() / fs::read_symlink(place, error);
    }
    const fs::file_status status = fs::status(place, error);
    if (!place.has_filename() || fs::is_directory(status))
        why_not = "is a folder";
    else if (status.type() == fs::file_type::none || status.type() == fs::file_type::unknown)
        why_not = "cannot be looked at: " + error.message();
    else if (fs::exists(status) && !fs::is_regular_file(status))
        why_not = "is a device or a pipe";
    return place;
}

PendingFile::PendingFile(std::filesystem::path final_path)
{
    static std::atomic<unsigned> serial{0};
    std::string why_not;
    final_ = place_of(final_path, why_not);
    if (!why_not.empty())
        throw FrameError(fmt::format("{}: {} (expected a file's name)", final_path.string(), why_not));
    const Making making;
    // Names of other machines, and of processes that were killed, may be the same: in containers process numbers are.
    int descriptor = -1;
    for (int tries = 0; descriptor < 0 && (tries == 0 || (errno == EEXIST && tries < 10000)); ++tries) {
        // Not made of the final name, which may be as long as a name can be.
        const std::string name = fmt::format(".brume-{}-{}.partial", ::getpid(), serial++);
        temporary_ = final_.parent_path() / name;
        descriptor = ::open(temporary_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    }
    if (descriptor < 0)
        throw FrameError(fmt::format("{}: cannot be written: {}", final_.string(), std::strerror(errno)));
    ::close(descriptor);
    slot_ = take_slot(temporary_.string());
}

PendingFile::~PendingFile()
{
    if (!committed_)
        ::unlink(temporary_.c_str());
    release_slot(slot_);
}

void PendingFile::commit()
{
    if (::rename(temporary_.c_str(), final_.c_str()) != 0)
        throw FrameError(fmt::format("{}: cannot be put in place: {}", final_.string(), std::strerror(errno)));
    committed_ = true;
}

void write_text_file(const std::filesystem::path &path, const std::string &text)
{
    PendingFile pending(path);
    if (!(std::ofstream(pending.path(), std::ios::binary) << text).flush())
        throw FrameError(fmt::format("{}: cannot be written", path.string()));
    pending.commit();
}

void remove_pending_files()
{
    ending.store(true);
    const timespec moment{0, 1000000};
    for (int i = 0; i < 1000 && makers.load() > 0; ++i)
        ::nanosleep(&moment, nullptr);
    for (const Slot &slot : slots)
        if (slot.live.load())
            ::unlink(slot.path);
}

}  // namespace brume::tool
