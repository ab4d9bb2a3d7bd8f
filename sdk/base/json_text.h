#pragma once
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace brume {

// Both from 1; columns count characters.
struct TextPosition {
    uint32_t line = 1;
    uint32_t column = 1;
};

struct JsonMember;

// A JSON value that knows where in its text it stands.
struct JsonValue {
    using Array = std::vector<JsonValue>;
    using Object = std::vector<JsonMember>;

    TextPosition position;
    std::variant<std::nullptr_t, bool, double, std::string, Array, Object> content;

    template <class T> const T *as() const { return std::get_if<T>(&content); }
    // As a message shows it: numbers and short strings themselves, else what it is.
    std::string describe() const;
};

struct JsonMember {
    std::string key;
    TextPosition position;
    JsonValue value;
};

// Strict JSON: no comments, no duplicate keys, numbers finite, nesting and size bounded. Throws Error(BRUME_ERROR_SCENE)
// as "name:line:column: ...", counting from where the text begins in its file.
JsonValue parse_json(const std::string &text, const std::string &name, TextPosition begin = {},
                     size_t largest = size_t(8) << 20);

}  // namespace brume
