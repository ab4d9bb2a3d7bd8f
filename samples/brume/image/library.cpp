#include "image/library.hpp"

#include <atomic>
#include <mutex>

#include <dlfcn.h>
#include <fmt/format.h>

#include "exr/file.hpp"
#include "support/error.hpp"

namespace brume::tool {
namespace {

using Entry = const ImageLibrary *(*)(const char *version);

std::atomic<int> threads{1};
std::atomic<const ImageLibrary *> loaded{nullptr};

const ImageLibrary *load()
{
    // By its name alone: the loader looks where the tool's own libraries are.
    void *module = ::dlopen("brume-image.so", RTLD_NOW | RTLD_LOCAL);
    if (!module)
        throw RequestError(fmt::format("only OpenEXR files can be read and written without brume-image: {}", ::dlerror()));
    const auto entry = reinterpret_cast<Entry>(::dlsym(module, kImageModuleEntry));
    const ImageLibrary *library = entry ? entry(kImageModuleVersion) : nullptr;
    if (!library)
        throw RequestError("brume-image.so is of another version than the tool");
    library->set_threads(threads);
    loaded = library;
    return library;
}

}  // namespace

const ImageLibrary &image_library()
{
    static std::mutex mutex;
    const std::lock_guard lock(mutex);
    return loaded ? *loaded : *load();
}

void set_image_threads(int count)
{
    threads = count;
    set_exr_threads(count);
    if (const ImageLibrary *library = loaded)
        library->set_threads(count);
}

}  // namespace brume::tool
