#include "base/json_text.h"

#include <algorithm>
#include <set>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/text.h"

namespace brume {
namespace {

constexpr size_t deepest_nesting = 64;

using Json = nlohmann::json;

// Follows the parser, whose events carry no positions, token by token through the same text.
class Cursor {
public:
    Cursor(std::string_view text, TextPosition begin) : text_(text), position_(begin)
    {
        if (text_.substr(0, 3) == "\xef\xbb\xbf")
            offset_ = 3;
    }

    TextPosition next_token()
    {
        skip(" \t\r\n,:", true);
        const TextPosition start = position_;
        if (text_[offset_] == '"') {
            advance();
            while (text_[offset_] != '"') {
                if (text_[offset_] == '\\')
                    advance();
                advance();
            }
            advance();
        } else if (std::string_view("[]{}").find(text_[offset_]) != std::string_view::npos) {
            advance();
        } else {
            skip(" \t\r\n,:[]{}", false);
        }
        return start;
    }

    TextPosition at(size_t offset)
    {
        while (offset_ < std::min(offset, text_.size()))
            advance();
        return position_;
    }

private:
    void skip(std::string_view characters, bool among)
    {
        while (offset_ < text_.size() && (characters.find(text_[offset_]) != std::string_view::npos) == among)
            advance();
    }

    void advance()
    {
        const char byte = text_[offset_++];
        if (byte == '\n')
            position_ = {position_.line + 1, 1};
        else if (offset_ == text_.size() || (uint8_t(text_[offset_]) & 0xc0) != 0x80)
            ++position_.column;
    }

    std::string_view text_;
    size_t offset_ = 0;
    TextPosition position_;
};

// nlohmann's message without its position, which counts bytes, and without the text read, which may be long.
std::string syntax_error(const std::string &message)
{
    constexpr size_t longest_expectation = 80;
    const size_t begin = message.find("syntax error"), read = message.find("; last read: '");
    const size_t expected = message.rfind("'; expected ");
    if (begin == std::string::npos)
        return "syntax error";
    std::string cause = message.substr(begin, read == std::string::npos ? read : read - begin);
    if (read != std::string::npos && expected != std::string::npos && message.size() - expected < longest_expectation)
        cause += message.substr(expected + 1);
    return valid_utf8(cause) ? cause : "syntax error";
}

class TreeBuilder : public nlohmann::json_sax<Json> {
public:
    TreeBuilder(std::string_view text, const std::string &name, TextPosition begin) : cursor_(text, begin), name_(name) {}

    JsonValue root;

    bool null() override { return add(nullptr); }
    bool boolean(bool value) override { return add(value); }
    bool number_integer(number_integer_t value) override { return add(double(value)); }
    bool number_unsigned(number_unsigned_t value) override { return add(double(value)); }
    bool number_float(number_float_t value, const string_t &) override { return add(double(value)); }
    bool string(string_t &value) override { return add(std::move(value)); }
    bool binary(binary_t &) override { return false; }
    bool start_object(size_t) override { return open(JsonValue::Object()); }
    bool end_object() override { return close(); }
    bool start_array(size_t) override { return open(JsonValue::Array()); }
    bool end_array() override { return close(); }

    bool key(string_t &key) override
    {
        const TextPosition position = cursor_.next_token();
        if (!open_.back().keys.insert(key).second)
            fail(position, fmt::format("duplicate key {}", in_quotes(key)));
        std::get<JsonValue::Object>(open_.back().value->content).push_back({std::move(key), position, {}});
        return true;
    }

    bool parse_error(size_t offset, const std::string &, const Json::exception &exception) override
    {
        constexpr int number_overflow = 406;
        const std::string cause =
            exception.id == number_overflow ? "a number beyond the range of a double" : syntax_error(exception.what());
        fail(cursor_.at(offset == 0 ? 0 : offset - 1), cause);
    }

private:
    struct Open {
        JsonValue *value;
        std::set<std::string> keys;
    };

    [[noreturn]] void fail(TextPosition position, const std::string &message) const
    {
        throw Error(BRUME_ERROR_SCENE, fmt::format("{}:{}:{}: {}", name_, position.line, position.column, message));
    }

    template <class T> bool add(T &&content)
    {
        *slot() = {cursor_.next_token(), std::forward<T>(content)};
        return true;
    }

    template <class T> bool open(T &&empty)
    {
        JsonValue *value = slot();
        *value = {cursor_.next_token(), std::forward<T>(empty)};
        if (open_.size() == deepest_nesting)
            fail(value->position, fmt::format("nested deeper than {} levels", deepest_nesting));
        open_.push_back({value, {}});
        return true;
    }

    bool close()
    {
        cursor_.next_token();
        open_.pop_back();
        return true;
    }

    // Where the next value goes. A parent grows only when its earlier children are complete: open_'s pointers hold.
    JsonValue *slot()
    {
        if (open_.empty())
            return &root;
        JsonValue &parent = *open_.back().value;
        if (auto *object = std::get_if<JsonValue::Object>(&parent.content))
            return &object->back().value;
        return &std::get<JsonValue::Array>(parent.content).emplace_back();
    }

    Cursor cursor_;
    const std::string &name_;
    std::vector<Open> open_;
};

}  // namespace

std::string JsonValue::describe() const
{
    struct {
        std::string operator()(std::nullptr_t) const { return "null"; }
        std::string operator()(bool value) const { return value ? "true" : "false"; }
        std::string operator()(double value) const { return fmt::format("{}", value); }
        std::string operator()(const std::string &value) const { return in_quotes(value); }
        std::string operator()(const Array &value) const { return fmt::format("an array of {}", value.size()); }
        std::string operator()(const Object &) const { return "an object"; }
    } describer;
    return std::visit(describer, content);
}

JsonValue parse_json(const std::string &text, const std::string &name, TextPosition begin, size_t largest)
{
    if (text.size() > largest)
        throw Error(BRUME_ERROR_SCENE, fmt::format("{}: {} bytes; expected at most {}", name, text.size(), largest));
    // The parser takes a NUL for the end and would not see what follows.
    if (const size_t nul = text.find('\0'); nul != std::string::npos) {
        const TextPosition position = Cursor(text, begin).at(nul);
        throw Error(BRUME_ERROR_SCENE,
                    fmt::format("{}:{}:{}: NUL byte; expected JSON text", name, position.line, position.column));
    }
    TreeBuilder builder(text, name, begin);
    Json::sax_parse(text, &builder);
    return std::move(builder.root);
}

}  // namespace brume
