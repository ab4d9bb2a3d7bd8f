#include "plan/context.h"

#include <atomic>
#include <filesystem>

#include <dlfcn.h>

#include "base/error.h"

namespace brume {
namespace {

// lib/brume/ beside the file this code was loaded from: neither the working directory nor the environment can put an
// effect in front of ours.
std::string find_own_plugin_directory()
{
    Dl_info info{};
    if (!dladdr(reinterpret_cast<void *>(&find_own_plugin_directory), &info) || !info.dli_fname)
        return {};
    std::error_code error;
    auto file = std::filesystem::canonical(info.dli_fname, error);
    return error ? std::string() : (file.parent_path() / "brume").string();
}

// Found while the library is loaded: the loader may know it by a path relative to the working directory of that moment.
const std::string own_plugin_directory = find_own_plugin_directory();

}  // namespace

uint64_t Context::new_id()
{
    static std::atomic<uint64_t> last = 0;
    return ++last;
}

std::shared_ptr<Context> create_context(const brume_context_desc &desc, MakeBackend make_backend)
{
    auto context = std::make_shared<Context>();
    context->log = {desc.log, desc.log_user, desc.log_level};
    context->progress = {desc.progress, desc.progress_user};
    context->backend = make_backend(desc, context->log);
    context->device = context->backend->device();
    std::vector<std::string> directories{own_plugin_directory};
    if (desc.plugin_directory) {
        if (!std::filesystem::path(desc.plugin_directory).is_absolute())
            throw Error(BRUME_ERROR_ARGUMENT,
                        "plugin_directory: \"" + std::string(desc.plugin_directory) + "\"; expected an absolute path");
        directories.emplace_back(desc.plugin_directory);
    }
    context->effects.load(directories, context->log);
    context->log(BRUME_LOG_INFO,
                 "backend " + context->device + ", " + std::to_string(context->effects.all().size()) + " effects");
    return context;
}

}  // namespace brume
