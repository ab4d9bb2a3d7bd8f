#include "base/json_node.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "base/names.h"
#include "base/text.h"

namespace brume {

void JsonNode::fail_at(TextPosition position, const std::string &message) const
{
    throw Error(BRUME_ERROR_SCENE, fmt::format("{}:{}:{}: {}", *file_, position.line, position.column, message));
}

void JsonNode::fail(const std::string &message) const
{
    fail_at(value_->position, path_.empty() ? message : fmt::format("{}: {}", path_, message));
}

void JsonNode::expected(const std::string &what) const
{
    fail(fmt::format("{}; expected {}", value_->describe(), what));
}

const JsonValue::Object &JsonNode::object() const
{
    if (const auto *object = value_->as<JsonValue::Object>())
        return *object;
    expected("an object");
}

double JsonNode::number(const std::string &what) const
{
    if (const auto *number = value_->as<double>())
        return *number;
    expected(what);
}

const std::string &JsonNode::string(const std::string &what) const
{
    if (const auto *string = value_->as<std::string>())
        return *string;
    expected(what);
}

bool JsonNode::boolean() const
{
    if (const auto *boolean = value_->as<bool>())
        return *boolean;
    expected("true or false");
}

size_t JsonNode::array_size(const std::string &what) const
{
    if (const auto *array = value_->as<JsonValue::Array>())
        return array->size();
    expected(what);
}

void JsonNode::check_array_size(size_t size, const std::string &what) const
{
    if (array_size(what) != size)
        expected(what);
}

JsonNode JsonNode::item(size_t index) const
{
    return JsonNode((*value_->as<JsonValue::Array>())[index], *file_, fmt::format("{}[{}]", path_, index));
}

JsonNode JsonNode::member(const JsonMember &member) const
{
    return JsonNode(member.value, *file_, path_.empty() ? member.key : fmt::format("{}.{}", path_, member.key));
}

void JsonNode::fail_key(const JsonMember &member, const std::string &message) const
{
    fail_at(member.position, message);
}

void JsonNode::allow_only(const std::vector<std::string> &keys) const
{
    for (const JsonMember &member : object()) {
        if (std::find(keys.begin(), keys.end(), member.key) != keys.end())
            continue;
        fail_at(member.position, fmt::format("unknown key {}{}", in_quotes(member.key), did_you_mean(member.key, keys)));
    }
}

std::optional<JsonNode> JsonNode::find(std::string_view key) const
{
    for (const JsonMember &candidate : object())
        if (candidate.key == key)
            return member(candidate);
    return std::nullopt;
}

JsonNode JsonNode::get(std::string_view key) const
{
    if (const auto node = find(key))
        return *node;
    fail(fmt::format("has no {}; expected one", in_quotes(key)));
}

void JsonNode::refuse_both(std::string_view one, std::string_view other) const
{
    const JsonMember *first = nullptr;
    for (const JsonMember &member : object()) {
        if (member.key != one && member.key != other)
            continue;
        if (first)
            fail_key(member, fmt::format("{} beside {}; expected one of them: they say the same thing",
                                         in_quotes(member.key), in_quotes(first->key)));
        first = &member;
    }
}

}  // namespace brume
