#pragma once

#include <chrono>
#include <cstddef>
#include <set>
#include <string>

namespace brume::tool {

/// A bar that redraws itself on a terminal, one line a frame elsewhere; on stderr. One thread at a time.
class Progress {
public:
    Progress(std::size_t total, bool quiet);
    ~Progress();

    void done(const std::string &frame, double seconds);
    /// Shown even when quiet.
    void note(const std::string &text);
    /// Leaves the bar as it is and goes on below it.
    void end();

private:
    void draw();
    void erase();

    std::size_t total_, finished_ = 0;
    bool quiet_, terminal_, drawn_ = false;
    std::chrono::steady_clock::time_point start_;
};

/// Counts in warnings differ from frame to frame: one line for each kind is enough.
class WarningKinds {
public:
    bool is_new(std::string warning);

private:
    std::set<std::string> seen_;
};

/// "3:07" or "1:02:09".
std::string clock_text(double seconds);

}  // namespace brume::tool
