#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "media/operations.h"

namespace brume::media {

// A medium being made: what is there, and the operations that made it. A value: copies share states.
class History {
public:
    const State &state() const { return *state_; }

    // Each throws Error(BRUME_ERROR_ARGUMENT) and changes nothing where it cannot be done.
    void apply(Operation operation);
    void undo();
    void redo();

    size_t undo_count() const { return done_; }
    size_t redo_count() const { return steps_.size() - done_; }

    // The operations, those that were undone last.
    size_t size() const { return steps_.size(); }
    const Operation &operation(size_t index) const { return *steps_[index].operation; }

private:
    struct Step {
        std::shared_ptr<const Operation> operation;
        std::shared_ptr<const State> after;  // null where it was forgotten and is made again when needed
    };

    std::shared_ptr<const State> state_after(size_t steps) const;
    void forget();

    std::vector<Step> steps_;
    size_t done_ = 0;
    std::shared_ptr<const State> state_ = std::make_shared<State>();
};

// The history as text, and back; see brume_media.h. Replaying throws Error(BRUME_ERROR_SCENE) as "name:line: ...".
std::string journal_of(const History &history);
void replay(History &history, std::string_view text, const std::string &name);

}  // namespace brume::media
