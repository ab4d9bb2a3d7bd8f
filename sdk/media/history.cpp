#include "media/history.h"

#include "base/error.h"

namespace brume::media {
namespace {

// Of all states that are kept beside the one at hand.
constexpr size_t most_kept_gaussians = size_t(4) << 20;

State applied(State state, const Operation &operation)
{
    std::visit([&](const auto &known) { known.apply(state); }, operation);
    return state;
}

size_t size_of(const State &state)
{
    return state.gaussians.size() + state.clipboard.size();
}

}  // namespace

void History::apply(Operation operation)
{
    check(operation);
    auto after = std::make_shared<const State>(applied(*state_, operation));
    Step step{std::make_shared<const Operation>(std::move(operation)), after};
    steps_.reserve(done_ + 1);
    steps_.resize(done_);
    steps_.push_back(std::move(step));
    ++done_;
    state_ = std::move(after);
    forget();
}

void History::undo()
{
    if (done_ == 0)
        throw Error(BRUME_ERROR_ARGUMENT, "undo: there is nothing to undo");
    state_ = state_after(done_ - 1);
    --done_;
}

void History::redo()
{
    if (redo_count() == 0)
        throw Error(BRUME_ERROR_ARGUMENT, "redo: there is nothing to redo");
    state_ = state_after(done_ + 1);
    ++done_;
}

// An operation gives the same state whenever it is applied, so that states need not be kept.
std::shared_ptr<const State> History::state_after(size_t steps) const
{
    size_t from = steps;
    while (from > 0 && !steps_[from - 1].after)
        --from;
    auto state = from > 0 ? steps_[from - 1].after : std::make_shared<const State>();
    for (; from < steps; ++from)
        state = std::make_shared<const State>(applied(*state, *steps_[from].operation));
    return state;
}

// The oldest first: it is the last steps that are undone.
void History::forget()
{
    size_t kept = 0;
    for (size_t i = steps_.size(); i-- > 0;) {
        if (!steps_[i].after)
            continue;
        kept += size_of(*steps_[i].after);
        if (kept > most_kept_gaussians)
            steps_[i].after.reset();
    }
}

}  // namespace brume::media
