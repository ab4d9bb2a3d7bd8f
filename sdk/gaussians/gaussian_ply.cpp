#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <optional>

#include <fmt/format.h>

#include "base/error.h"
#include "gaussians/gaussian_columns.h"
#include "gaussians/gaussian_formats.h"
#include "base/text.h"

static_assert(std::endian::native == std::endian::little, "PLY is read and written as the machine has its numbers");

namespace brume {
namespace {

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct Property {
    std::string name;
    Type type;
    std::optional<Type> count_type;  // of a list
};

struct Element {
    std::string name;
    uint64_t count = 0;
    std::vector<Property> properties;
};

constexpr size_t most_header_lines = 4096;

std::optional<Type> type_named(std::string_view name)
{
    constexpr std::pair<std::string_view, Type> names[] = {
        {"char", Type::int8},     {"int8", Type::int8},       {"uchar", Type::uint8},    {"uint8", Type::uint8},
        {"short", Type::int16},   {"int16", Type::int16},     {"ushort", Type::uint16},  {"uint16", Type::uint16},
        {"int", Type::int32},     {"int32", Type::int32},     {"uint", Type::uint32},    {"uint32", Type::uint32},
        {"float", Type::float32}, {"float32", Type::float32}, {"double", Type::float64}, {"float64", Type::float64}};
    for (const auto &[known, type] : names)
        if (name == known)
            return type;
    return std::nullopt;
}

// Values one after the other, from text or bytes.
class Values {
public:
    Values(std::string_view rest, bool binary, size_t line, const std::string &name)
        : rest_(rest), binary_(binary), line_(line), name_(name)
    {
    }

    double next(Type type) { return binary_ ? next_binary(type) : next_text(); }
    uint64_t remaining() const { return rest_.size(); }
    std::string place(uint64_t vertex) const
    {
        return binary_ ? fmt::format("{}: vertex {}", name_, vertex) : fmt::format("{}:{}", name_, line_);
    }

    void skip(const Element &element)
    {
        for (uint64_t i = 0; i < element.count && !element.properties.empty(); ++i)
            for (const Property &property : element.properties)
                skip(property);
    }
    void skip(const Property &property)
    {
        if (!property.count_type) {
            next(property.type);
            return;
        }
        const double count = next(*property.count_type);
        if (!(count >= 0 && count <= double(remaining())))
            fail(fmt::format("a list of {} values; expected no more than the file holds", count));
        for (uint64_t i = 0; i < uint64_t(count); ++i)
            next(property.type);
    }

private:
    [[noreturn]] void fail(const std::string &what) const
    {
        throw Error(BRUME_ERROR_SCENE, binary_ ? name_ + ": " + what : fmt::format("{}:{}: {}", name_, line_, what));
    }

    template <class T> double take()
    {
        if (rest_.size() < sizeof(T))
            fail("the file ends within its elements");
        T value;
        std::memcpy(&value, rest_.data(), sizeof value);
        rest_.remove_prefix(sizeof value);
        return double(value);
    }

    double next_binary(Type type)
    {
        switch (type) {
        case Type::int8:
            return take<int8_t>();
        case Type::uint8:
            return take<uint8_t>();
        case Type::int16:
            return take<int16_t>();
        case Type::uint16:
            return take<uint16_t>();
        case Type::int32:
            return take<int32_t>();
        case Type::uint32:
            return take<uint32_t>();
        case Type::float32:
            return take<float>();
        default:
            return take<double>();
        }
    }

    double next_text()
    {
        constexpr std::string_view blank = " \t\r\n";
        const size_t begin = std::min(rest_.find_first_not_of(blank), rest_.size());
        line_ += size_t(std::count(rest_.begin(), rest_.begin() + std::ptrdiff_t(begin), '\n'));
        rest_.remove_prefix(begin);
        const std::string_view token = rest_.substr(0, rest_.find_first_of(blank));
        if (token.empty())
            fail("the file ends within its elements");
        rest_.remove_prefix(token.size());
        double value = 0;
        const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
        if (error != std::errc() || end != token.data() + token.size())
            fail(in_quotes(token) + "; expected a number");
        return value;
    }

    std::string_view rest_;
    bool binary_;
    size_t line_;
    const std::string &name_;
};

class Header {
public:
    Header(std::string_view content, const std::string &name) : rest_(content), name_(name)
    {
        if (words() != std::vector<std::string_view>{"ply"})
            fail("not a PLY file; expected it to begin with a line \"ply\"");
        const auto format = words();
        if (format.size() != 3 || format[0] != "format" || format[2] != "1.0" ||
            (format[1] != "ascii" && format[1] != "binary_little_endian"))
            fail(in_quotes(line_text_) + "; expected \"format ascii 1.0\" or \"format binary_little_endian 1.0\"");
        binary = format[1] != "ascii";
        for (auto line = words(); line != std::vector<std::string_view>{"end_header"}; line = words())
            read(line);
    }

    bool binary = false;
    std::vector<Element> elements;
    std::string_view rest() const { return rest_; }
    size_t line() const { return line_; }

private:
    [[noreturn]] void fail(const std::string &what) const
    {
        throw Error(BRUME_ERROR_SCENE, fmt::format("{}:{}: {}", name_, line_, what));
    }

    std::vector<std::string_view> words()
    {
        const size_t end = rest_.find('\n');
        line_text_ = rest_.substr(0, std::min(end, size_t(1024)));
        if (line_text_.ends_with('\r'))
            line_text_.remove_suffix(1);
        if (end == std::string_view::npos || line_ == most_header_lines)
            fail("a header without \"end_header\"");
        rest_.remove_prefix(end + 1);
        ++line_;
        std::vector<std::string_view> found;
        constexpr std::string_view blank = " \t";
        for (size_t at = line_text_.find_first_not_of(blank); at < line_text_.size();) {
            const size_t stop = std::min(line_text_.find_first_of(blank, at), line_text_.size());
            found.push_back(line_text_.substr(at, stop - at));
            at = line_text_.find_first_not_of(blank, stop);
        }
        return found;
    }

    void read(const std::vector<std::string_view> &line)
    {
        if (line.empty() || line[0] == "comment" || line[0] == "obj_info")
            return;
        if (line[0] == "element" && line.size() == 3) {
            Element element{std::string(line[1]), 0, {}};
            const auto [end, error] = std::from_chars(line[2].data(), line[2].data() + line[2].size(), element.count);
            if (error != std::errc() || end != line[2].data() + line[2].size())
                fail(in_quotes(line_text_) + "; expected a count of 0 or more");
            elements.push_back(std::move(element));
            return;
        }
        const bool list = line.size() == 5 && line[1] == "list";
        if (line[0] == "property" && !elements.empty() && (line.size() == 3 || list)) {
            const auto type = type_named(line[list ? 3 : 1]);
            const auto count_type = list ? type_named(line[2]) : std::nullopt;
            if (type && (!list || count_type)) {
                elements.back().properties.push_back({std::string(line.back()), *type, count_type});
                return;
            }
        }
        fail(in_quotes(line_text_) + "; expected an element, a property or a comment");
    }

    std::string_view rest_, line_text_;
    size_t line_ = 0;
    const std::string &name_;
};

// What an integer colour is divided by.
double full_colour(const Property &property, const std::string &name)
{
    switch (property.type) {
    case Type::uint8:
        return 255;
    case Type::uint16:
        return 65535;
    case Type::float32:
    case Type::float64:
        return 1;
    default:
        throw Error(BRUME_ERROR_SCENE,
                    fmt::format("{}: property {}: expected uchar, ushort, float or double", name, in_quotes(property.name)));
    }
}

std::vector<Gaussian> read_vertices(const Element &element, Values &values, const std::string &name)
{
    if (element.count > BRUME_MAX_GAUSSIANS)
        throw Error(BRUME_ERROR_SCENE,
                    fmt::format("{}: {} vertices; expected {} at most", name, element.count, BRUME_MAX_GAUSSIANS));
    std::vector<std::string> names;
    for (const Property &property : element.properties)
        names.push_back(property.count_type ? "" : property.name);
    const GaussianColumns columns(std::move(names), name + ": vertex properties");
    std::vector<double> divisor(columns.count(), 1.0), row(columns.count());
    for (size_t i = 0; i < columns.count(); ++i)
        if (columns.is_colour(i))
            divisor[i] = full_colour(element.properties[i], name);

    std::vector<Gaussian> gaussians;
    // Every vertex takes a byte at least, so that a count the file cannot hold allocates nothing.
    gaussians.reserve(size_t(std::min(element.count, values.remaining())));
    for (uint64_t vertex = 0; vertex < element.count; ++vertex) {
        for (size_t i = 0; i < columns.count(); ++i)
            if (element.properties[i].count_type)
                values.skip(element.properties[i]);
            else
                row[i] = values.next(element.properties[i].type) / divisor[i];
        gaussians.push_back(columns.read(row, [&] { return values.place(vertex); }));
    }
    return gaussians;
}

}  // namespace

std::vector<Gaussian> parse_gaussian_ply(std::string_view content, const std::string &name)
{
    const Header header(content, name);
    Values values(header.rest(), header.binary, header.line() + 1, name);
    for (const Element &element : header.elements) {
        if (element.name == "vertex")
            return read_vertices(element, values, name);
        values.skip(element);
    }
    throw Error(BRUME_ERROR_SCENE, name + ": no element \"vertex\"");
}

std::string gaussian_ply(std::span<const Gaussian> gaussians)
{
    std::string content = fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\n", gaussians.size());
    for (const char *name : {"x", "y", "z", "scale", "amplitude"})
        content += fmt::format("property double {}\n", name);
    for (const char *name : {"red", "green", "blue"})
        content += fmt::format("property float {}\n", name);
    content += "end_header\n";
    auto append = [&](auto value) { content.append(reinterpret_cast<const char *>(&value), sizeof value); };
    for (const Gaussian &gaussian : gaussians) {
        for (double coordinate : gaussian.center)
            append(coordinate);
        append(gaussian.scale);
        append(gaussian.amplitude);
        for (float component : gaussian.color)
            append(component);
    }
    return content;
}

}  // namespace brume
