#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "image/narrow.hpp"
#include "image/resolve.hpp"
#include "support/error.hpp"

namespace brume::tool {
namespace {

struct Candidate {
    const PartInfo *part;
    const ChannelInfo *channel;
};

std::string last_component(const std::string &layer)
{
    return layer.substr(layer.rfind('.') + 1);
}

/// A Z beside an X or a Y is the third axis of a normal, a position or a motion vector; but a root Y is luminance.
bool is_axis(const PartInfo &part, const ChannelInfo &z)
{
    return std::any_of(part.channels.begin(), part.channels.end(), [&](const ChannelInfo &c) {
        const std::string base = lower(c.base);
        return c.layer == z.layer && c.view == z.view && (base == "x" || (base == "y" && !c.layer.empty()));
    });
}

bool part_named_depth(const std::string &name)
{
    std::string component;
    for (const char c : lower(name) + ".") {
        if (c != '.' && c != '_' && c != '-') {
            component += c;
        } else {
            if (component == "depth" || component == "zdepth")
                return true;
            component.clear();
        }
    }
    return false;
}

bool is_root_z(const PartInfo &part, const ChannelInfo &c)
{
    return c.layer.empty() && c.base == "Z" && !is_axis(part, c);
}

bool has_known_name(const PartInfo &part, const ChannelInfo &c)
{
    const std::string layer = lower(last_component(c.layer));
    const std::string base = lower(c.base);
    if (base == "z" && is_axis(part, c))
        return false;
    if (layer == "depth" && (base == "z" || base == "v"))
        return true;
    if (layer.ends_with("worlddepth") && base == "r")
        return true;
    if (layer == "vrayzdepth" || base == "vrayzdepth")
        return layer.empty() || base == "z" || base == "r" || base == "y";
    if (c.layer.empty() && (c.base == "Pz" || base == "depth"))
        return true;
    if (!part_named_depth(part.name))
        return false;
    return part.channels.size() == 1 || base == "z" || base == "r" || base == "v";
}

/// What a person might mean: offered in errors, never chosen.
bool is_conceivable(const PartInfo &part, const ChannelInfo &c)
{
    const std::string name = lower(c.name);
    return (lower(c.base) == "z" && !is_axis(part, c)) || name.find("depth") != std::string::npos || has_known_name(part, c);
}

bool is_usable(const PartInfo &part, const ChannelInfo &c)
{
    return !part.deep && c.sampling == kFullSize;
}

template <class Wanted> std::vector<Candidate> gather(const ImageFile &file, Wanted wanted)
{
    std::vector<Candidate> found;
    for (const PartInfo &part : file.parts())
        for (const ChannelInfo &c : part.channels)
            if (wanted(part, c))
                found.push_back({&part, &c});
    return found;
}

std::string list(const std::vector<Candidate> &candidates, bool several_parts)
{
    std::set<std::string> lines;
    for (const auto &[part, c] : candidates)
        lines.insert(fmt::format("{}{}{}{}", c->name, several_parts ? " in " + part->label() : "",
                                 c->view.empty() ? "" : fmt::format(" (view {})", c->view), part->deep ? " (deep)" : ""));
    return lines.empty() ? "none" : fmt::format("{}", fmt::join(lines, "; "));
}

std::vector<Candidate> by_request(const ImageFile &file, const std::string &wanted)
{
    auto found = gather(file, [&](const PartInfo &part, const ChannelInfo &c) {
        return c.name == wanted || (!part.name.empty() && part.name + "." + c.name == wanted);
    });
    if (!found.empty())
        return found;
    // A layer's or a part's name will do where it holds one channel, or one that is called Z.
    found =
        gather(file, [&](const PartInfo &part, const ChannelInfo &c) { return c.layer == wanted || part.name == wanted; });
    if (found.size() > 1)
        narrow(found, [](const Candidate &c) { return c.channel->base == "Z"; });
    return found;
}

}  // namespace

std::optional<DepthChoice> find_depth(const ImageFile &file, const LayerRequest &request, const ColorChoice *color,
                                      std::string *why_not)
{
    const bool several_parts = file.parts().size() > 1;
    const auto refuse = [&](const std::string &what) -> std::optional<DepthChoice> {
        const auto conceivable = gather(file, is_conceivable);
        if (why_not)
            *why_not = fmt::format("{}: {}; candidates: {}", file.path().string(), what, list(conceivable, several_parts));
        return std::nullopt;
    };

    std::vector<Candidate> found;
    std::string reason;
    const bool asked = !request.depth.empty();
    if (asked) {
        found = by_request(file, request.depth);
        reason = "as asked by --depth";
        if (found.empty())
            return refuse(fmt::format("--depth '{}' is not a channel", request.depth));
    } else {
        const auto flat = [](auto wanted) {
            return [wanted](const PartInfo &p, const ChannelInfo &c) { return is_usable(p, c) && wanted(p, c); };
        };
        reason = "root Z";
        found = gather(file, flat(is_root_z));
        const auto same_view = [&](const Candidate &c) {
            return !color || c.channel->view.empty() || color->view.empty() || c.channel->view == color->view;
        };
        const bool root_of_this_view = narrow(found, same_view);
        if (!root_of_this_view) {
            auto known = gather(file, flat(has_known_name));
            reason = "known name";
            if (narrow(known, same_view)) {
                found = known;
            } else if (!found.empty() || !known.empty()) {
                return refuse(fmt::format("no depth in the colour's view '{}'", color->view));
            }
        }
        // A file that was named as depth's own and has one channel.
        if (found.empty() && !color && file.parts().size() == 1 && file.part(0).channels.size() == 1) {
            found = gather(file, [](const PartInfo &p, const ChannelInfo &c) { return is_usable(p, c); });
            reason = "its only channel";
        }
        if (found.empty())
            for (const auto &[part, channel] : gather(file, [](const PartInfo &p, const ChannelInfo &c) {
                     return !p.deep && c.sampling != kFullSize && (is_root_z(p, c) || has_known_name(p, c));
                 }))
                return refuse(fmt::format("depth '{}' is subsampled {} x {} (expected full resolution)", channel->name,
                                          channel->sampling.x, channel->sampling.y));
        if (found.empty())
            return refuse("no depth: expected Z, depth.Z or another known name (see docs/depth), or --depth NAME");
    }
    if (found.size() > 1 && color) {
        narrow(found, [&](const Candidate &c) { return c.channel->view == color->view; });
        if (found.size() > 1)
            narrow(found, [&](const Candidate &c) { return c.part->index == color->part; });
    }
    if (found.size() > 1 && !asked)
        narrow(found, [](const Candidate &c) { return c.channel->base == "Z" || c.part->channels.size() == 1; });
    if (found.size() > 1)
        return refuse(fmt::format("{} channels could be the depth ({}); choose with --depth", found.size(),
                                  list(found, several_parts)));

    const auto &[part, channel] = found.front();
    if (part->deep)
        return refuse(
            fmt::format("depth '{}' in {} is deep data (expected flat scan lines or tiles)", channel->name, part->label()));
    if (channel->sampling != kFullSize)
        return refuse(fmt::format("depth '{}' is subsampled {} x {} (expected full resolution)", channel->name,
                                  channel->sampling.x, channel->sampling.y));
    return DepthChoice{part->index, channel->name, reason};
}

DepthChoice resolve_depth(const ImageFile &file, const LayerRequest &request, const ColorChoice *color)
{
    std::string why_not;
    auto choice = find_depth(file, request, color, &why_not);
    if (!choice)
        throw RequestError(why_not);
    return *choice;
}

}  // namespace brume::tool
