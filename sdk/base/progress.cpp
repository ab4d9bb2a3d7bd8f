#include "base/progress.h"

#include <algorithm>

#include "base/error.h"

namespace brume {
namespace {

constexpr std::chrono::milliseconds between_reports(20);

}  // namespace

void Progress::begin()
{
    from_ = last_ = 0;
    to_ = 1;
    cancelled_ = false;
    ask(0);
    throw_if_cancelled();
}

void Progress::end()
{
    ask(1);
    throw_if_cancelled();
}

bool Progress::report(double fraction)
{
    if (callback_ && !cancelled_ && Clock::now() - asked_ >= between_reports)
        ask(from_ + (to_ - from_) * fraction);
    return !cancelled_;
}

void Progress::throw_if_cancelled() const
{
    if (cancelled_)
        throw Error(BRUME_ERROR_CANCELLED, "cancelled by the progress callback");
}

void Progress::enter_part(double from, double to)
{
    from_ = from;
    to_ = to;
}

void Progress::ask(double fraction)
{
    if (!callback_)
        return;
    last_ = std::max(last_, std::min(fraction, 1.0));
    cancelled_ = callback_(user_, last_) != 0;
    asked_ = Clock::now();
}

}  // namespace brume
