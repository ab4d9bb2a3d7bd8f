#pragma once
#include <algorithm>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <new>

#include "base/recycling_allocator.h"

namespace brume {

// Plans used in turn, or a resized window that snaps back, find their images again within this many frames.
constexpr uint64_t idle_frames = 8;

// A backend's images that nobody holds, for the next taker of the same kind. They are freed after some frames without one,
// and at once beyond as many bytes as were ever in use together: sizes which never come back do not pile up.
// Image has `bytes` and `idle_since`.
template <class Image> class IdleImages {
public:
    // The last one given back that matches, or none.
    template <class Matches> std::unique_ptr<Image> take(Matches matches)
    {
        std::lock_guard lock(mutex_);
        const auto found = std::find_if(idle_.begin(), idle_.end(), [&](const auto &image) { return matches(*image); });
        if (found == idle_.end())
            return nullptr;
        std::unique_ptr<Image> image = std::move(*found);
        idle_.erase(found);
        idle_bytes_ -= image->bytes;
        count(image->bytes);
        return image;
    }

    // A new one comes into use.
    void add(const Image &image)
    {
        std::lock_guard lock(mutex_);
        count(image.bytes);
    }

    void put_back(std::unique_ptr<Image> image) noexcept
    {
        std::lock_guard lock(mutex_);
        const uint64_t bytes = image->bytes;
        used_ -= bytes;
        if (closed_)
            return;
        image->idle_since = frame_;
        try {
            idle_.push_front(std::move(image));
        } catch (const std::bad_alloc &) {
            return;
        }
        idle_bytes_ += bytes;
        drop_last_while([&](const Image &) { return idle_bytes_ > most_used_; });
    }

    // A frame has ended, or a plan begins.
    void age()
    {
        std::lock_guard lock(mutex_);
        ++frame_;
        drop_last_while([&](const Image &image) { return image.idle_since + idle_frames < frame_; });
    }

    // Frees all and forgets what was in use before.
    void trim()
    {
        std::lock_guard lock(mutex_);
        drop_last_while([](const Image &) { return true; });
        most_used_ = used_;
    }

    // The same, and keeps nothing more.
    void close()
    {
        trim();
        std::lock_guard lock(mutex_);
        closed_ = true;
    }

    // Of all images, in use or idle.
    uint64_t bytes() const
    {
        std::lock_guard lock(mutex_);
        return used_ + idle_bytes_;
    }

private:
    void count(uint64_t bytes)
    {
        used_ += bytes;
        most_used_ = std::max(most_used_, used_);
    }

    template <class Condition> void drop_last_while(Condition condition)
    {
        while (!idle_.empty() && condition(*idle_.back())) {
            idle_bytes_ -= idle_.back()->bytes;
            idle_.pop_back();
        }
    }

    mutable std::mutex mutex_;
    std::list<std::unique_ptr<Image>, RecyclingAllocator<std::unique_ptr<Image>>> idle_;  // given back last first
    uint64_t used_ = 0, most_used_ = 0, idle_bytes_ = 0;
    uint64_t frame_ = 0;
    bool closed_ = false;
};

}  // namespace brume
