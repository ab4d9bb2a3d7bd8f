#pragma once
#include <algorithm>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "scene_file/field_reader.h"

namespace brume {

// Blocks of a scene file. Files that they name are relative to `folder`, the scene file's own.
Medium read_medium(const JsonNode &node, const std::filesystem::path &folder);
std::vector<Light> read_lights(const JsonNode &node, const std::filesystem::path &folder);
Environment read_environment(const JsonNode &node, const std::filesystem::path &folder);

template <class T> void allow_fields(const JsonNode &node, Fields<T> fields, uint32_t these)
{
    std::vector<std::string> keys;
    for (const Field<T> &field : fields)
        if (field.is(these) && std::find(keys.begin(), keys.end(), field.key) == keys.end())
            keys.push_back(field.key);
    node.allow_only(keys);
    for (const Field<T> &field : fields)
        if (field.instead_of)
            node.refuse_both(field.instead_of, field.key);
}

inline constexpr auto nothing_more = [](std::string_view, const JsonNode &) {};

// An object of this kind; what the table has no member for goes to own(key, node).
template <class T, class Own>
void read_fields(const JsonNode &node, const std::filesystem::path &folder, Fields<T> fields, uint32_t kind, T &to, Own own)
{
    allow_fields<T>(node, fields, kind);
    for (const Field<T> &field : fields) {
        const auto value = !field.is(kind)     ? std::nullopt
                           : field.has(needed) ? std::optional(node.get(field.key))
                                               : node.find(field.key);
        if (!value)
            continue;
        std::visit(
            [&](auto member) {
                if constexpr (std::is_same_v<decltype(member), std::monostate>)
                    own(std::string_view(field.key), *value);
                else
                    FieldReader{*value, folder, field.range, field.traits}(to.*member);
            },
            field.member);
    }
}

}  // namespace brume
