#pragma once
#include <chrono>

#include <brume/brume.h>

namespace brume {

// The caller's progress callback for the API call that runs. Only that call's thread may report.
class Progress {
public:
    Progress() = default;
    Progress(brume_progress_callback callback, void *user) : callback_(callback), user_(user) {}

    bool wanted() const { return callback_ != nullptr; }

    // Brackets a call; both throw Error(BRUME_ERROR_CANCELLED).
    void begin();
    void end();

    // Of the part that runs, from 0 to 1. Seldom enough to cost nothing. Returns false once the caller has cancelled.
    bool report(double fraction);
    bool cancelled() const { return cancelled_; }
    void throw_if_cancelled() const;

    // What is reported from here on is of this part of the call.
    void enter_part(double from, double to);

private:
    void ask(double fraction);

    using Clock = std::chrono::steady_clock;
    brume_progress_callback callback_ = nullptr;
    void *user_ = nullptr;
    double from_ = 0, to_ = 1, last_ = 0;
    Clock::time_point asked_{};
    bool cancelled_ = false;
};

// A pass whose part of a call the caller is told of.
struct Watch {
    Progress &progress;
    double from, to;
};

}  // namespace brume
