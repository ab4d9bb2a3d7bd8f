#include <algorithm>
#include <cstring>

#include <brume/brume_media.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "gaussians/gaussian_formats.h"
#include "base/json_node.h"
#include "media/base64.h"
#include "media/history.h"
#include "base/text.h"

// A line for each operation, in the order in which they were done; "undo" lines last for what is undone at the moment. A
// picture's depth has a line of its own, {"depth": NUMBER, ...}, before the first operation that needs it.
namespace brume::media {
namespace {

constexpr size_t longest_line = size_t(512) << 20;
constexpr uint32_t largest_picture = 65536;
constexpr double version = 1;

using Depths = std::vector<std::shared_ptr<const DepthMap>>;

// ---- writing

std::string number(double value)
{
    const std::string text = fmt::format("{}", value);
    return text == "-0" ? "-0.0" : text;  // JSON readers take "-0" for an integer
}

std::string array(const double *values, int count)
{
    std::string text = "[";
    for (int i = 0; i < count; ++i) {
        if (i > 0)
            text += ',';
        text += number(values[i]);
    }
    return text + ']';
}

std::string quoted(const std::string &text)
{
    return nlohmann::json(text).dump();
}

// Journals have had this spelling since before the ABI had the other.
const char *key_of(const char *field)
{
    return std::string_view(field) == "color" ? "colour" : field;
}

struct Writer {
    const Depths &depths;
    std::string text;

    void key(const char *field) { text += fmt::format(",\"{}\":", key_of(field)); }

    void operator()(const char *field, uint32_t value)
    {
        key(field);
        text += fmt::format("{}", value);
    }
    void operator()(const char *field, double value, const Range &)
    {
        key(field);
        text += number(value);
    }
    void operator()(const char *field, const dvec3 &value, const Range &)
    {
        key(field);
        text += array(&value.x, 3);
    }
    template <size_t n> void operator()(const char *field, const std::array<double, n> &value, const Range &)
    {
        key(field);
        text += array(value.data(), int(n));
    }
    void operator()(const char *field, const std::vector<dvec3> &value, const Range &)
    {
        key(field);
        char separator = '[';
        for (const dvec3 &point : value) {
            text += separator;
            text += array(&point.x, 3);
            separator = ',';
        }
        text += ']';
    }
    void operator()(const char *field, const std::vector<Gaussian> &value)
    {
        key(field);
        text += quoted(gaussian_csv(value));
    }
    void operator()(const char *field, const Lens &lens)
    {
        key(field);
        text += fmt::format("{{\"center\":{},\"tangent_scale\":{},\"right\":{},\"up\":{},\"back\":{},\"eye\":{}}}",
                            array(&lens.center.x, 2), array(&lens.tangent_scale.x, 2), array(&lens.axes[0].x, 3),
                            array(&lens.axes[1].x, 3), array(&lens.axes[2].x, 3), array(&lens.eye.x, 3));
    }
    void operator()(const char *field, const std::shared_ptr<const DepthMap> &depth)
    {
        for (size_t i = 0; i < depths.size(); ++i)
            if (depth == depths[i]) {
                key(field);
                text += fmt::format("{}", i + 1);
            }
    }
};

std::string depth_line(const DepthMap &map, size_t index)
{
    const std::string_view bytes(reinterpret_cast<const char *>(map.depth.data()), map.depth.size() * sizeof(float));
    return fmt::format("{{\"depth\":{},\"width\":{},\"height\":{},\"data\":\"{}\"}}\n", index, map.width, map.height,
                       base64_of(bytes));
}

// ---- reading

double read_number(const JsonNode &node, const Range &range)
{
    const double value = node.number(range.describe());
    if (!range.contains(value))
        node.expected(range.describe());
    return value;
}

uint32_t read_integer(const JsonNode &node, uint32_t largest)
{
    const std::string what = fmt::format("an integer from 0 to {}", largest);
    const double value = node.number(what);
    if (!(value >= 0 && value <= largest && value == double(uint32_t(value))))
        node.expected(what);
    return uint32_t(value);
}

void read_numbers(const JsonNode &node, double *values, int count, const Range &range)
{
    node.check_array_size(size_t(count), fmt::format("an array of {} numbers", count));
    for (int i = 0; i < count; ++i)
        values[i] = read_number(node.item(size_t(i)), range);
}

struct Reader {
    const JsonNode &node;
    const Depths &depths;
    std::vector<std::string> known{"op"};

    JsonNode get(const char *field)
    {
        known.emplace_back(key_of(field));
        return node.get(key_of(field));
    }

    void operator()(const char *field, uint32_t &value) { value = read_integer(get(field), UINT32_MAX); }
    void operator()(const char *field, double &value, const Range &range) { value = read_number(get(field), range); }
    void operator()(const char *field, dvec3 &value, const Range &range) { read_numbers(get(field), &value.x, 3, range); }
    template <size_t n> void operator()(const char *field, std::array<double, n> &value, const Range &range)
    {
        read_numbers(get(field), value.data(), int(n), range);
    }
    void operator()(const char *field, std::vector<dvec3> &value, const Range &range)
    {
        const JsonNode points = get(field);
        const std::string what = fmt::format("an array of 1 to {} points", BRUME_MEDIA_MAX_STROKE_POINTS);
        const size_t count = points.array_size(what);
        if (count < 1 || count > BRUME_MEDIA_MAX_STROKE_POINTS)
            points.expected(what);
        value.resize(count);
        for (size_t i = 0; i < count; ++i)
            read_numbers(points.item(i), &value[i].x, 3, range);
    }
    void operator()(const char *field, std::vector<Gaussian> &value)
    {
        const JsonNode csv = get(field);
        value = parse_gaussian_csv(csv.string("text of a CSV file of Gaussians"), field);
    }
    void operator()(const char *field, Lens &lens)
    {
        const JsonNode parts = get(field);
        parts.allow_only({"center", "tangent_scale", "right", "up", "back", "eye"});
        read_numbers(parts.get("center"), &lens.center.x, 2, ranges::any);
        read_numbers(parts.get("tangent_scale"), &lens.tangent_scale.x, 2, ranges::any);
        const char *const axes[] = {"right", "up", "back"};
        for (size_t i = 0; i < 3; ++i)
            read_numbers(parts.get(axes[i]), &lens.axes[i].x, 3, ranges::any);
        read_numbers(parts.get("eye"), &lens.eye.x, 3, ranges::any);
    }
    void operator()(const char *field, std::shared_ptr<const DepthMap> &depth)
    {
        known.emplace_back(field);
        const auto index = node.find(field);
        if (!index)
            return;
        const uint32_t number = read_integer(*index, UINT32_MAX);
        if (number < 1 || number > depths.size())
            index->expected("the number of a depth line above");
        depth = depths[number - 1];
    }
};

template <size_t index = 0> Operation read_operation(const JsonNode &node, const std::string &name, const Depths &depths)
{
    if constexpr (index == std::variant_size_v<Operation>) {
        std::string names;
        [&]<size_t... i>(std::index_sequence<i...>)
        {
            ((names += std::string(std::variant_alternative_t<i, Operation>::name) + ", "), ...);
        }
        (std::make_index_sequence<index>());
        node.get("op").expected("one of " + names + "undo, redo");
    } else {
        using Known = std::variant_alternative_t<index, Operation>;
        if (name != Known::name)
            return read_operation<index + 1>(node, name, depths);
        Known operation;
        Reader reader{node, depths};
        Known::fields(operation, reader);
        node.allow_only(reader.known);
        return operation;
    }
}

std::shared_ptr<const DepthMap> read_depth(const JsonNode &node)
{
    node.allow_only({"depth", "width", "height", "data"});
    auto map = std::make_shared<DepthMap>();
    map->width = read_integer(node.get("width"), largest_picture);
    map->height = read_integer(node.get("height"), largest_picture);
    const JsonNode data = node.get("data");
    const size_t samples = size_t(map->width) * map->height;
    const std::string what = fmt::format("base64 of {} floats", samples);
    const auto bytes = bytes_of_base64(data.string(what));
    if (!bytes || bytes->size() != samples * sizeof(float))
        data.expected(what);
    map->depth.resize(samples);
    std::memcpy(map->depth.data(), bytes->data(), bytes->size());
    for (const float depth : map->depth)
        if (!(depth >= 0))
            data.fail(fmt::format("a depth of {}; expected 0 or more", depth));
    return map;
}

void replay_line(History &history, Depths &depths, const JsonNode &node)
{
    if (const auto number = node.find("depth"); number && !node.find("op")) {
        if (read_integer(*number, UINT32_MAX) != depths.size() + 1)
            number->expected(fmt::format("{}: depth lines are numbered in order", depths.size() + 1));
        depths.push_back(read_depth(node));
        return;
    }
    const std::string name = node.get("op").string("an operation's name");
    if (name == "undo" || name == "redo")
        node.allow_only({"op"});
    if (name == "undo")
        history.undo();
    else if (name == "redo")
        history.redo();
    else
        history.apply(read_operation(node, name, depths));
}

void read_header(const JsonNode &node)
{
    node.allow_only({"brume_journal"});
    const JsonNode number = node.get("brume_journal");
    if (number.number("1, the version of this format") != version)
        number.expected("1, the version of this format");
}

}  // namespace

std::string journal_of(const History &history)
{
    Depths depths;
    std::string text = fmt::format("{{\"brume_journal\":{}}}\n", version);
    for (size_t i = 0; i < history.size(); ++i) {
        if (const auto *airbrush = std::get_if<Airbrush>(&history.operation(i));
            airbrush && airbrush->depth && std::find(depths.begin(), depths.end(), airbrush->depth) == depths.end()) {
            depths.push_back(airbrush->depth);
            text += depth_line(*airbrush->depth, depths.size());
        }
        std::visit(
            [&](const auto &known) {
                Writer writer{depths, {}};
                known.fields(known, writer);
                text += fmt::format("{{\"op\":\"{}\"{}}}\n", known.name, writer.text);
            },
            history.operation(i));
    }
    for (size_t i = 0; i < history.redo_count(); ++i)
        text += "{\"op\":\"undo\"}\n";
    return text;
}

void replay(History &history, std::string_view text, const std::string &name)
{
    History result = history;
    Depths depths;
    uint32_t line = 0;
    bool header = false;
    while (!text.empty()) {
        const size_t end = std::min(text.find('\n'), text.size());
        const std::string content(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        ++line;
        if (content.find_first_not_of(" \t\r") == std::string::npos)
            continue;
        const JsonValue value = parse_json(content, name, {line, 1}, longest_line);
        const JsonNode node(value, name);
        try {
            if (header)
                replay_line(result, depths, node);
            else
                read_header(node);
        } catch (const Error &error) {
            // What JsonNode says has its place already.
            if (error.status() == BRUME_ERROR_SCENE && std::string_view(error.what()).starts_with(name))
                throw;
            throw Error(BRUME_ERROR_SCENE, fmt::format("{}:{}: {}", name, line, error.what()));
        }
        header = true;
    }
    if (!header)
        throw Error(BRUME_ERROR_SCENE, name + ": empty; expected a line {\"brume_journal\": 1}");
    history = std::move(result);
}

}  // namespace brume::media
