#include "run/provenance.hpp"

#include <cstdint>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace brume::tool {
namespace {

/// FNV-1a: the same on every machine, unlike std::hash.
std::uint64_t hash_of(const std::string &text)
{
    std::uint64_t hash = 14695981039346656037u;
    for (const char c : text)
        hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
    return hash;
}

}  // namespace

std::string provenance_of(const SceneText &scene, const FogOptions &options, std::uint32_t backend)
{
    const auto document = nlohmann::json::parse(scene.text, nullptr, false);
    std::string text =
        document.is_discarded() ? scene.text : document.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
    for (const std::string &set : options.set)
        text += "\n" + set;
    text += fmt::format("\n{} {} {}", options.preset, options.max_error, options.budget_ms);
    const std::uint32_t version = brume_version();
    return fmt::format("brume {}.{}.{}; {}; scene {:016x}", version / 10000, version / 100 % 100, version % 100,
                       backend_name(backend), hash_of(text));
}

}  // namespace brume::tool
