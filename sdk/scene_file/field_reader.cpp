#include "scene_file/field_reader.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "scene/scene_check.h"

namespace brume {
namespace {

Number read_keys(const JsonNode &keys, const Range &range, double unit)
{
    const std::string what = "[frame, value] pairs, one at least";
    const size_t count = keys.array_size(what);
    if (count == 0)
        keys.expected(what);
    std::vector<Number::Key> read;
    for (size_t i = 0; i < count; ++i) {
        const JsonNode key = keys.item(i);
        key.check_array_size(2, "a [frame, value] pair");
        const double frame = read_constant(key.item(0), ranges::frame);
        if (i > 0 && frame <= read.back().first)
            key.item(0).expected(fmt::format("a frame after {}: keys ascend", read.back().first));
        read.emplace_back(frame, read_constant(key.item(1), range) * unit);
    }
    return Number(std::move(read));
}

bool always_zero(const Number &number)
{
    return std::all_of(number.keys().begin(), number.keys().end(), [](const auto &key) { return key.second == 0.0; });
}

}  // namespace

double read_constant(const JsonNode &node, const Range &range)
{
    const std::string what = range.describe();
    const double value = node.number(what);
    if (!range.contains(value))
        node.expected(what);
    return value;
}

namespace {

Number read_number(const JsonNode &node, const Range &range, double unit = 1.0)
{
    if (node.value().as<double>())
        return read_constant(node, range) * unit;
    if (!node.value().as<JsonValue::Object>())
        node.expected(range.describe() + ", or {\"keys\": [[frame, value], ...]}");
    node.allow_only({"keys"});
    return read_keys(node.get("keys"), range, unit);
}

}  // namespace

void FieldReader::operator()(uint32_t &to) const
{
    const double value = read_constant(node, range);
    if (value != std::floor(value))
        node.expected("a whole " + range.describe());
    to = uint32_t(value);
}

void FieldReader::operator()(Number &to) const
{
    to = read_number(node, range, traits & degrees ? degree : 1.0);
}

void FieldReader::operator()(std::array<Number, 2> &to) const
{
    node.check_array_size(2, "an array of 2 numbers");
    to = {read_number(node.item(0), range), read_number(node.item(1), range)};
}

void FieldReader::operator()(Number3 &to) const
{
    if (traits & color && !node.value().as<JsonValue::Array>()) {
        if (!node.value().as<double>() && !node.value().as<JsonValue::Object>())
            node.expected(range.describe() + ", [r, g, b], or {\"keys\": [[frame, value], ...]}");
        to.fill(read_number(node, range));
        return;
    }
    node.check_array_size(3, "an array of 3 numbers");
    to = {read_number(node.item(0), range), read_number(node.item(1), range), read_number(node.item(2), range)};
    if (traits & direction && std::all_of(to.begin(), to.end(), always_zero))
        node.fail("(0, 0, 0); expected a vector that is not zero");
}

// A rigid motion.
void FieldReader::operator()(Matrix &to) const
{
    const std::string what = "4 rows of 4 numbers";
    std::set<double> frames;
    node.check_array_size(4, what);
    for (size_t row = 0; row < 4; ++row) {
        node.item(row).check_array_size(4, what);
        for (size_t column = 0; column < 4; ++column) {
            const Number &element = to[4 * row + column] = read_number(node.item(row).item(column), range);
            for (const auto &key : element.keys())
                frames.insert(key.first);
        }
    }
    for (double frame : frames) {
        std::array<double, 16> values;
        std::transform(to.begin(), to.end(), values.begin(), [&](const Number &n) { return n.at(frame); });
        if (const std::string defect = rigid_defect(values); !defect.empty())
            node.fail(fmt::format("{}{}; expected a rigid motion: orthonormal columns, determinant 1, last row 0 0 0 1",
                                  defect, frames.size() > 1 ? fmt::format(" at frame {}", frame) : ""));
    }
}

void FieldReader::operator()(std::optional<Matrix> &to) const
{
    (*this)(to.emplace());
}

}  // namespace brume
