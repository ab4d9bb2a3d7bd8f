#include "scene/scene_numbers.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "base/json_node.h"
#include "scene/scene_check.h"
#include "base/scene_ranges.h"

namespace brume {
namespace {

constexpr double degree = 0.017453292519943295;

Number read_keys(const JsonNode &keys, const Range &range)
{
    const std::string what = "[frame, value] pairs, one at least";
    const size_t count = keys.array_size(what);
    if (count == 0)
        keys.expected(what);
    Number number;
    number.keys.clear();
    for (size_t i = 0; i < count; ++i) {
        const JsonNode key = keys.item(i);
        key.check_array_size(2, "a [frame, value] pair");
        const double frame = read_constant(key.item(0), ranges::frame);
        if (i > 0 && frame <= number.keys.back().first)
            key.item(0).expected(fmt::format("a frame after {}: keys ascend", number.keys.back().first));
        number.keys.emplace_back(frame, read_constant(key.item(1), range));
    }
    return number;
}

bool always_zero(const Number &number)
{
    return std::all_of(number.keys.begin(), number.keys.end(), [](const auto &key) { return key.second == 0.0; });
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

Number read_number(const JsonNode &node, const Range &range)
{
    if (node.value().as<double>())
        return read_constant(node, range);
    if (!node.value().as<JsonValue::Object>())
        node.expected(range.describe() + ", or {\"keys\": [[frame, value], ...]}");
    node.allow_only({"keys"});
    return read_keys(node.get("keys"), range);
}

Number3 read_vector(const JsonNode &node, const Range &range)
{
    node.check_array_size(3, "an array of 3 numbers");
    return {read_number(node.item(0), range), read_number(node.item(1), range), read_number(node.item(2), range)};
}

Number3 read_direction(const JsonNode &node)
{
    const Number3 direction = read_vector(node, ranges::any);
    if (std::all_of(direction.begin(), direction.end(), always_zero))
        node.fail("(0, 0, 0); expected a vector that is not zero");
    return direction;
}

Number3 read_rgb(const JsonNode &node, const Range &range)
{
    if (node.value().as<JsonValue::Array>())
        return read_vector(node, range);
    if (!node.value().as<double>() && !node.value().as<JsonValue::Object>())
        node.expected(range.describe() + ", [r, g, b], or {\"keys\": [[frame, value], ...]}");
    const Number grey = read_number(node, range);
    return {grey, grey, grey};
}

std::array<Number, 16> read_matrix(const JsonNode &node)
{
    const std::string what = "4 rows of 4 numbers";
    std::array<Number, 16> matrix;
    std::set<double> frames;
    node.check_array_size(4, what);
    for (size_t row = 0; row < 4; ++row) {
        node.item(row).check_array_size(4, what);
        for (size_t column = 0; column < 4; ++column) {
            const Number &element = matrix[4 * row + column] = read_number(node.item(row).item(column), ranges::any);
            for (const auto &key : element.keys)
                frames.insert(key.first);
        }
    }
    for (double frame : frames) {
        std::array<double, 16> values;
        std::transform(matrix.begin(), matrix.end(), values.begin(), [&](const Number &n) { return n.at(frame); });
        if (const std::string defect = rigid_defect(values); !defect.empty())
            node.fail(fmt::format("{}{}; expected a rigid motion: orthonormal columns, determinant 1, last row 0 0 0 1",
                                  defect, frames.size() > 1 ? fmt::format(" at frame {}", frame) : ""));
    }
    return matrix;
}

Number in_radians(Number degrees)
{
    for (auto &key : degrees.keys)
        key.second *= degree;
    return degrees;
}

}  // namespace brume
