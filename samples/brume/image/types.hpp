#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <ImathVec.h>

namespace brume::tool {

struct Point {
    int x = 0, y = 0;
    bool operator==(const Point &) const = default;
};

/// Pixels from `min` to `max`, both among them.
struct Window {
    Point min, max;

    int width() const { return max.x - min.x + 1; }
    int height() const { return max.y - min.y + 1; }
    bool contains(const Point &p) const { return p.x >= min.x && p.x <= max.x && p.y >= min.y && p.y <= max.y; }
    bool operator==(const Window &) const = default;
};

/// How a channel is stored.
enum class SampleType { kHalf, kFloat, kUint, kUint8, kUint16 };

const char *name_of(SampleType type);
std::size_t bytes_of(SampleType type);
/// Integers that are a share of the largest, as in PNG; kUint is a number that identifies something.
inline bool is_normalized(SampleType type)
{
    return type == SampleType::kUint8 || type == SampleType::kUint16;
}

/// CIE x, y.
struct Chromaticities {
    Imath::V2f red, green, blue, white;
};

/// A channel's full name taken apart: "character.left.R" with a view "left" is layer "character", base "R".
struct ChannelInfo {
    std::string name, layer, view, base;
    SampleType type = SampleType::kHalf;
    Point sampling{1, 1};
    bool lossy = false;  ///< it loses something as it is compressed here
};
constexpr Point kFullSize{1, 1};

struct PartInfo {
    int index = 0;
    std::string name, view;
    Window data_window, display_window;
    double pixel_aspect = 1;
    bool deep = false, tiled = false;
    std::vector<ChannelInfo> channels;
    /// Attributes: one number, or 16 of a matrix row by row; none where the attribute is neither.
    std::map<std::string, std::vector<double>> attributes;
    std::optional<Chromaticities> chromaticities;

    int width() const { return data_window.width(); }
    int height() const { return data_window.height(); }
    const ChannelInfo *find(const std::string &channel_name) const;
    /// "part 2 (depth_left)", or nothing where the file has one nameless part.
    std::string label() const;
};

}  // namespace brume::tool
