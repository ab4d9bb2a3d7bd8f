#pragma once

#include <filesystem>
#include <future>
#include <map>
#include <mutex>
#include <string>

#include "image/frame.hpp"

namespace brume::tool {

/// The lights' shadow maps, one of each: read anew only where its file is another one than the frame before had, or has been
/// written since. Frames share the pixels. Members may be called from several threads.
class ShadowFiles {
public:
    InputLayer read(const ImageFile &file, const InputChoice &choice);

private:
    struct Key {
        std::filesystem::path path;
        std::filesystem::file_time_type written;
        std::uintmax_t size = 0;
        int part = 0;
        std::string channel;

        bool operator==(const Key &) const = default;
    };
    struct Kept {
        Key key;
        std::shared_future<InputLayer> layer;
    };
    std::mutex mutex_;
    std::map<std::uint32_t, Kept> kept_;
};

}  // namespace brume::tool
