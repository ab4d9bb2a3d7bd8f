#include <algorithm>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "image/narrow.hpp"
#include "image/resolve.hpp"
#include "support/error.hpp"

namespace brume::tool {
namespace {

struct Candidate {
    ColorChoice choice;
    bool deep = false;
    bool short_names = false;  ///< R, G, B rather than red, green, blue
};

struct Triple {
    std::array<const char *, 3> rgb;
    const char *alpha;
};

constexpr Triple kTriples[] = {{{"R", "G", "B"}, "A"}, {{"r", "g", "b"}, "a"}, {{"red", "green", "blue"}, "alpha"}};

std::vector<Candidate> candidates_in(const PartInfo &part)
{
    using Group = std::pair<std::string, std::string>;  // layer, view
    std::map<Group, std::map<std::string, const ChannelInfo *>> groups;
    for (const ChannelInfo &c : part.channels)
        groups[{c.layer, c.view}][c.base] = &c;

    std::vector<Candidate> found;
    for (const auto &[group, bases] : groups) {
        const auto full_size = [&](const char *base) {
            const auto at = bases.find(base);
            return at != bases.end() && at->second->sampling == kFullSize && at->second->type != SampleType::kUint;
        };
        Candidate candidate;
        candidate.deep = part.deep;
        ColorChoice &choice = candidate.choice;
        choice.part = part.index;
        std::tie(choice.layer, choice.view) = group;
        for (const Triple &triple : kTriples) {
            if (!full_size(triple.rgb[0]) || !full_size(triple.rgb[1]) || !full_size(triple.rgb[2]))
                continue;
            for (int i = 0; i < 3; ++i)
                choice.rgb[i] = bases.at(triple.rgb[i])->name;
            if (full_size(triple.alpha))
                choice.alpha = bases.at(triple.alpha)->name;
            candidate.short_names = triple.rgb[0] == kTriples[0].rgb[0];
            break;
        }
        // Y beside RY and BY is half of a luminance/chroma image, not a grey one; in a layer of its own it may be anything.
        if (choice.rgb[0].empty() && choice.layer.empty() && full_size("Y") && !bases.contains("RY") &&
            !bases.contains("X")) {
            choice.rgb.fill(bases.at("Y")->name);
            if (full_size("A"))
                choice.alpha = bases.at("A")->name;
            choice.luminance = true;
        }
        if (!choice.rgb[0].empty())
            found.push_back(std::move(candidate));
    }
    return found;
}

bool is_beauty_name(const std::string &name)
{
    const std::string last = lower(name.substr(name.rfind('.') + 1));
    return last == "combined" || last == "beauty" || last == "rgba" || last == "rgb";
}

bool part_is(const PartInfo &part, const std::string &wanted)
{
    return part.name == wanted || std::to_string(part.index) == wanted;
}

std::string list(const ImageFile &file, const std::vector<Candidate> &candidates)
{
    std::string text;
    for (const Candidate &c : candidates)
        text += fmt::format("{}{}{}", text.empty() ? "" : "; ", c.choice.label(),
                            file.parts().size() > 1 ? " in " + file.parts()[c.choice.part].label() : "");
    return text.empty() ? "none" : text;
}

/// What stands in the way of taking the picture for a colour, where its channels' names say that it is one.
std::string why_none(const ImageFile &file)
{
    for (const PartInfo &part : file.parts())
        for (const ChannelInfo &c : part.channels) {
            if (c.base == "RY" || c.base == "BY")
                return fmt::format("; luminance and chroma ({}) are not read: convert it to R, G, B", c.name);
            const std::string base = lower(c.base);
            if (base != "r" && base != "g" && base != "b" && base != "y" && base != "red" && base != "green" &&
                base != "blue")
                continue;
            if (c.sampling != kFullSize)
                return fmt::format("; '{}' is subsampled {} x {}", c.name, c.sampling.x, c.sampling.y);
            if (c.type == SampleType::kUint)
                return fmt::format("; '{}' is of type uint", c.name);
        }
    return "";
}

std::string all_channels(const ImageFile &file)
{
    constexpr std::size_t kShown = 24;
    std::vector<std::string> names;
    for (const PartInfo &part : file.parts())
        for (const ChannelInfo &c : part.channels)
            names.push_back(c.name);
    const std::size_t total = names.size();
    names.resize(std::min(total, kShown));
    return fmt::format("{}{}", fmt::join(names, ", "), total > kShown ? fmt::format(" and {} more", total - kShown) : "");
}

}  // namespace

std::string ColorChoice::label() const
{
    const std::string in_view = view.empty() ? "" : fmt::format(" (view {})", view);
    if (luminance)
        return rgb[0] + in_view;
    return fmt::format("{},{},{}{}{}", rgb[0], rgb[1], rgb[2], alpha.empty() ? "" : "," + alpha, in_view);
}

std::vector<std::string> other_views(const ImageFile &file, const ColorChoice &color)
{
    std::vector<std::string> views;
    for (const PartInfo &part : file.parts())
        for (const Candidate &c : candidates_in(part))
            if (c.choice.layer == color.layer && !c.choice.view.empty() && !color.view.empty() &&
                c.choice.view != color.view && std::find(views.begin(), views.end(), c.choice.view) == views.end())
                views.push_back(c.choice.view);
    return views;
}

ColorChoice resolve_color(const ImageFile &file, const LayerRequest &request)
{
    std::vector<Candidate> candidates;
    for (const PartInfo &part : file.parts())
        for (auto &c : candidates_in(part))
            candidates.push_back(std::move(c));
    const std::vector<Candidate> all = candidates;
    const auto fail = [&](const std::string &what) {
        throw RequestError(
            fmt::format("{}: {}; colour layers in the file: {}", file.path().string(), what, list(file, all)));
    };
    const auto part_of = [&](const Candidate &c) -> const PartInfo & { return file.parts()[c.choice.part]; };

    if (candidates.empty())
        throw RequestError(fmt::format(
            "{}: no colour: expected half or float channels R, G, B (or Y) at full resolution; the file has {}{}",
            file.path().string(), all_channels(file), why_none(file)));
    if (!request.part.empty() && !narrow(candidates, [&](const auto &c) { return part_is(part_of(c), request.part); }))
        fail(fmt::format("--part '{}' has no colour layer", request.part));
    if (!request.view.empty() && !narrow(candidates, [&](const auto &c) { return c.choice.view == request.view; }))
        fail(fmt::format("--view '{}' has no colour layer", request.view));
    std::string reason = "the only colour layer";
    if (!request.color.empty()) {
        const auto matches = [&](const Candidate &c) {
            const std::string &red = c.choice.rgb[0];
            const std::string prefix = red.substr(0, red.rfind('.') == std::string::npos ? 0 : red.rfind('.'));
            return c.choice.layer == request.color || prefix == request.color || part_of(c).name == request.color;
        };
        if (!narrow(candidates, matches))
            fail(fmt::format("--color '{}' is not a colour layer", request.color));
        reason = "as asked by --color";
    } else if (candidates.size() > 1 && narrow(candidates, [](const auto &c) { return c.choice.layer.empty(); })) {
        reason = "root layer";
    }
    if (candidates.size() > 1 && narrow(candidates, [&](const auto &c) { return c.choice.view == file.default_view(); }) &&
        !file.default_view().empty())
        reason += ", default view";
    if (candidates.size() > 1)
        narrow(candidates, [](const auto &c) { return !c.choice.luminance; });
    if (candidates.size() > 1)
        narrow(candidates, [](const auto &c) { return c.short_names; });
    if (candidates.size() > 1) {
        const auto beauty = [&](const Candidate &c) {
            const std::string &part = part_of(c).name;
            return is_beauty_name(c.choice.layer) ||
                   (c.choice.layer.empty() && is_beauty_name(part.substr(0, part.find('.'))));
        };
        if (narrow(candidates, beauty))
            reason = "the layer named as the combined picture";
    }
    if (candidates.size() > 1)
        fail("several layers could be the colour; choose with --color, --part or --view");
    if (candidates.front().deep)
        throw RequestError(fmt::format("{}: {}: colour '{}' is deep data (expected flat scan lines or tiles)",
                                       file.path().string(), part_of(candidates.front()).label(),
                                       candidates.front().choice.label()));
    candidates.front().choice.reason = reason;
    return candidates.front().choice;
}

}  // namespace brume::tool
