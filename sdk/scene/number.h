#pragma once
#include <algorithm>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace brume {

// A number that may change over the frames: linear between keys, constant outside them. Without more keys than one it holds
// no memory: engines bring thousands with each frame. Copies share their keys.
class Number {
public:
    using Key = std::pair<double, double>;  // (frame, value)

    Number(double value = 0.0) : first_(0.0, value) {}
    // Of ascending frames, one key at least.
    explicit Number(std::vector<Key> keys) : first_(keys.front())
    {
        if (keys.size() > 1)
            keys_ = std::make_shared<const std::vector<Key>>(std::move(keys));
    }

    bool animated() const { return keys_ != nullptr; }
    double at(double frame) const { return keys_ ? between_keys(frame) : first_.second; }
    std::span<const Key> keys() const { return keys_ ? std::span<const Key>(*keys_) : std::span(&first_, 1); }

private:
    double between_keys(double frame) const;

    Key first_;
    std::shared_ptr<const std::vector<Key>> keys_;  // where there are more than the first
};

// Of the values, whatever their frames where there is but one.
inline bool operator==(const Number &a, const Number &b)
{
    if (a.animated() != b.animated())
        return false;
    return a.animated() ? std::equal(a.keys().begin(), a.keys().end(), b.keys().begin(), b.keys().end())
                        : a.at(0) == b.at(0);
}

}  // namespace brume
