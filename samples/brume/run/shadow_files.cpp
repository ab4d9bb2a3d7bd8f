#include "run/shadow_files.hpp"

namespace brume::tool {

InputLayer ShadowFiles::read(const ImageFile &file, const InputChoice &choice)
{
    // Asked before the pixels are read: what is written meanwhile is read with the next frame.
    std::error_code none;
    const Key key{file.path(), std::filesystem::last_write_time(file.path(), none),
                  std::filesystem::file_size(file.path(), none), choice.part, choice.channels.front()};
    const std::uint32_t light = choice.light.value_or(0);
    std::packaged_task<InputLayer()> task([&] { return read_shadow(file, choice); });
    std::shared_future<InputLayer> layer;
    bool first = false;
    {
        const std::scoped_lock lock(mutex_);
        const auto at = kept_.find(light);
        first = at == kept_.end() || at->second.key != key;
        if (first)
            kept_.insert_or_assign(light, Kept{key, task.get_future().share()});
        layer = kept_.at(light).layer;
    }
    if (first)
        task();
    try {
        return layer.get();
    } catch (...) {
        // Memory may suffice for the next frame.
        const std::scoped_lock lock(mutex_);
        if (const auto at = kept_.find(light); at != kept_.end() && at->second.key == key)
            kept_.erase(at);
        throw;
    }
}

}  // namespace brume::tool
