#include "run/progress.hpp"

#include <cctype>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

#include "support/text.hpp"

namespace brume::tool {

std::string clock_text(double seconds)
{
    const long s = std::lround(seconds);
    return s >= 3600 ? fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60)
                     : fmt::format("{}:{:02}", s / 60, s % 60);
}

bool WarningKinds::is_new(std::string warning)
{
    std::erase_if(warning, [](unsigned char c) { return std::isdigit(c); });
    return seen_.insert(std::move(warning)).second;
}

Progress::Progress(std::size_t total, bool quiet)
    : total_(total), quiet_(quiet), terminal_(::isatty(STDERR_FILENO)), start_(std::chrono::steady_clock::now())
{
}

Progress::~Progress()
{
    end();
}

void Progress::end()
{
    if (drawn_)
        std::fputc('\n', stderr);
    drawn_ = false;
}

void Progress::done(const std::string &frame, double seconds)
{
    ++finished_;
    if (quiet_)
        return;
    if (terminal_)
        draw();
    else
        fmt::print(stderr, "[{}/{}] {} {:.2f} s\n", finished_, total_, frame, seconds);
}

void Progress::note(const std::string &text)
{
    erase();
    fmt::print(stderr, "brume: {}\n", printable(text));
    if (drawn_)
        draw();
}

void Progress::erase()
{
    if (drawn_)
        std::fputs("\r\033[K", stderr);
}

void Progress::draw()
{
    constexpr std::size_t kCells = 30;
    const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    const double rate = elapsed > 0 ? double(finished_) / elapsed : 0;
    const std::size_t filled = total_ ? kCells * finished_ / total_ : kCells;
    const std::string left = rate > 0 ? clock_text(double(total_ - finished_) / rate) : "?";
    fmt::print(stderr, "\r\033[K[{}{}] {}/{}  {:.2f} frames/s  {} left", std::string(filled, '#'),
               std::string(kCells - filled, '.'), finished_, total_, rate, left);
    std::fflush(stderr);
    drawn_ = true;
}

}  // namespace brume::tool
