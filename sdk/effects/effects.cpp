#include "effects/effects.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include "base/error.h"
#include "base/names.h"
#include "effects/plugin_loader.h"
#include "base/text.h"

namespace brume {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> plugin_files(const std::string &directory, const Log &log)
{
    std::vector<std::string> files;
    if (!fs::path(directory).is_absolute()) {
        log(BRUME_LOG_WARNING, fmt::format("plugin directory {}: expected an absolute path", in_quotes(directory)));
        return files;
    }
    std::error_code error;
    for (fs::directory_iterator it(directory, error), end; !error && it != end; it.increment(error))
        if (it->path().extension() == ".so")
            files.push_back(it->path().string());
    if (error)
        log(BRUME_LOG_WARNING, fmt::format("plugin directory {}: {}", in_quotes(directory), error.message()));
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace

void EffectRegistry::load(const std::vector<std::string> &directories, const Log &log)
{
    for (const std::string &directory : directories) {
        directories_.push_back(directory);
        for (const std::string &file : plugin_files(directory, log)) {
            Effect effect = load_plugin(file);
            const auto earlier = std::find_if(effects_.begin(), effects_.end(), [&](const Effect &other) {
                return effect.refusal.empty() && other.refusal.empty() && other.name == effect.name;
            });
            if (earlier != effects_.end())
                effect = refused_plugin(
                    file, fmt::format("the effect {} is there already, from {}", in_quotes(effect.name), earlier->file));
            if (effect.refusal.empty())
                log(BRUME_LOG_DEBUG, fmt::format("effect {} from {}", in_quotes(effect.name), file));
            else
                log(BRUME_LOG_WARNING, fmt::format("plugin {} refused: {}", file, effect.refusal));
            effects_.push_back(std::move(effect));
        }
    }
}

void EffectRegistry::expect_one(uint32_t wanted, const char *part, const char *renders) const
{
    std::string refused;
    for (const Effect &effect : effects_) {
        if (effect.refusal.empty() && effect.wanted == wanted)
            return;
        if (!effect.refusal.empty())
            refused += fmt::format("; {} was refused: {}", effect.file, effect.refusal);
    }
    std::string searched;
    for (const std::string &directory : directories_)
        searched +=
            (searched.empty() ? "" : ", ") + (directory.empty() ? "lib/brume/ of a library of unknown path" : directory);
    throw Error(BRUME_ERROR_NOT_FOUND, fmt::format("{}: no effect that renders {} was found; searched {}{}", part, renders,
                                                   searched.empty() ? "nowhere" : searched, refused));
}

const Effect &EffectRegistry::find(const std::string &name) const
{
    std::vector<std::string> names;
    for (const Effect &effect : effects_) {
        if (!effect.refusal.empty())
            continue;
        if (effect.name == name)
            return effect;
        names.push_back(effect.name);
    }
    for (const Effect &effect : effects_)
        if (!effect.refusal.empty() && fs::path(effect.file).stem() == name)
            throw Error(BRUME_ERROR_NOT_FOUND, fmt::format("no effect {}: the plugin {} was refused: {}", in_quotes(name),
                                                           effect.file, effect.refusal));
    throw Error(BRUME_ERROR_NOT_FOUND, fmt::format("no effect {}{}", in_quotes(name), did_you_mean(name, names)));
}

}  // namespace brume
