#pragma once
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/json_text.h"

namespace brume {

// A value of a JSON file with its path ("medium.density[1].value"), for reading it and complaining about it. All
// failures are Error(BRUME_ERROR_SCENE) as "file:line:column: ...".
class JsonNode {
public:
    JsonNode(const JsonValue &root, const std::string &file) : value_(&root), file_(&file) {}

    const JsonValue &value() const { return *value_; }
    const std::string &path() const { return path_; }

    [[noreturn]] void fail(const std::string &message) const;
    // "path: value; expected ..."
    [[noreturn]] void expected(const std::string &what) const;

    // These fail where the value is not of that type.
    const JsonValue::Object &object() const;
    double number(const std::string &what) const;
    const std::string &string(const std::string &what) const;
    bool boolean() const;
    size_t array_size(const std::string &what) const;
    void check_array_size(size_t size, const std::string &what) const;

    JsonNode item(size_t index) const;
    JsonNode member(const JsonMember &member) const;
    [[noreturn]] void fail_key(const JsonMember &member, const std::string &message) const;

    void allow_only(const std::vector<std::string> &keys) const;
    std::optional<JsonNode> find(std::string_view key) const;
    JsonNode get(std::string_view key) const;
    // Two ways to say one thing.
    void refuse_both(std::string_view one, std::string_view other) const;

private:
    JsonNode(const JsonValue &value, const std::string &file, std::string path)
        : value_(&value), file_(&file), path_(std::move(path))
    {
    }
    [[noreturn]] void fail_at(TextPosition position, const std::string &message) const;

    const JsonValue *value_;
    const std::string *file_;
    std::string path_;
};

}  // namespace brume
