#include "image/resolve_input.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "image/narrow.hpp"
#include "support/error.hpp"
#include "support/nearest.hpp"

namespace brume::tool {
namespace {

/// The last component of a layer's name, in lower case. Optical depth and transmittance are not here: they take the place of
/// the scene's own medium, so only a person can want that.
struct KnownName {
    const char *role, *layer;
};
constexpr KnownName kKnownNames[] = {{"normal", "normal"},         {"normal", "n"},
                                     {"albedo", "albedo"},         {"albedo", "diffcol"},
                                     {"specular", "specular"},     {"specular", "glosscol"},
                                     {"roughness", "roughness"},   {"transfer_0", "transfer_0"},
                                     {"transfer_1", "transfer_1"}, {"transfer_2", "transfer_2"},
                                     {"transfer_3", "transfer_3"}, {"transfer_4", "transfer_4"},
                                     {"transfer_5", "transfer_5"}};

constexpr const char *kTriples[][3] = {
    {"R", "G", "B"}, {"r", "g", "b"}, {"red", "green", "blue"}, {"X", "Y", "Z"}, {"x", "y", "z"}};

struct Candidate {
    const PartInfo *part;
    std::string layer, view;
    std::vector<const ChannelInfo *> channels;
};

/// Three channels that belong together, or the one that a layer has.
std::vector<Candidate> layers_in(const ImageFile &file)
{
    std::vector<Candidate> found;
    for (const PartInfo &part : file.parts()) {
        using Group = std::pair<std::string, std::string>;  // layer, view
        std::map<Group, std::map<std::string, const ChannelInfo *>> groups;
        for (const ChannelInfo &c : part.channels)
            groups[{c.layer, c.view}][c.base] = &c;
        for (const auto &[group, bases] : groups) {
            Candidate candidate{&part, group.first, group.second, {}};
            for (const auto &triple : kTriples)
                if (candidate.channels.empty() &&
                    std::all_of(triple, triple + 3, [&](const char *base) { return bases.contains(base); }))
                    for (const char *base : triple)
                        candidate.channels.push_back(bases.at(base));
            if (candidate.channels.empty() && bases.size() == 1)
                candidate.channels.push_back(bases.begin()->second);
            if (!candidate.channels.empty())
                found.push_back(std::move(candidate));
        }
    }
    return found;
}

std::string prefix_of(const ChannelInfo &c)
{
    const auto dot = c.name.rfind('.');
    return dot == std::string::npos ? "" : c.name.substr(0, dot);
}

std::vector<Candidate> named(const ImageFile &file, const std::string &wanted, const std::vector<Candidate> &layers)
{
    std::vector<Candidate> found;
    for (const PartInfo &part : file.parts())
        for (const ChannelInfo &c : part.channels)
            if (c.name == wanted || (!part.name.empty() && part.name + "." + c.name == wanted))
                found.push_back({&part, c.layer, c.view, {&c}});
    if (!found.empty())
        return found;
    for (const Candidate &c : layers)
        if ((!c.layer.empty() && c.layer == wanted) || prefix_of(*c.channels.front()) == wanted ||
            (!c.part->name.empty() && (c.part->name == wanted || c.part->name + "." + c.layer == wanted)))
            found.push_back(c);
    return found;
}

std::string label_of(const Candidate &c)
{
    std::vector<std::string> names;
    for (const ChannelInfo *channel : c.channels)
        names.push_back(channel->name);
    return fmt::format("{}", fmt::join(names, ","));
}

std::string list(const ImageFile &file, const std::vector<Candidate> &candidates)
{
    std::vector<std::string> lines;
    for (const Candidate &c : candidates)
        lines.push_back(fmt::format("{}{}{}", label_of(c), file.parts().size() > 1 ? " in " + c.part->label() : "",
                                    c.view.empty() ? "" : fmt::format(" (view {})", c.view)));
    return lines.empty() ? "none" : fmt::format("{}", fmt::join(lines, "; "));
}

bool is_whole(const Candidate &c)
{
    return !c.part->deep && std::all_of(c.channels.begin(), c.channels.end(),
                                        [](const ChannelInfo *channel) { return channel->sampling == kFullSize; });
}

bool is_known(const Candidate &c, const std::string &role)
{
    const std::string name = lower(c.layer.empty() ? c.part->name : c.layer);
    const std::string last = name.substr(name.rfind('.') + 1);
    // A lone letter is a layer of its own, not the end of any name.
    return std::any_of(std::begin(kKnownNames), std::end(kKnownNames), [&](const KnownName &known) {
        return role == known.role && last == known.layer && (last.size() > 1 || name == last);
    });
}

void narrow_to_picture(std::vector<Candidate> &found, const ImageFile &file, const ColorChoice *color)
{
    if (found.size() > 1)
        narrow(found, [&](const Candidate &c) { return c.view == (color ? color->view : file.default_view()); });
    if (found.size() > 1 && color)
        narrow(found, [&](const Candidate &c) { return c.part->index == color->part; });
}

InputChoice choice_of(const Candidate &c, const std::string &role, const std::string &reason)
{
    InputChoice choice{role, c.part->index, {}, reason};
    for (const ChannelInfo *channel : c.channels)
        choice.channels.push_back(channel->name);
    return choice;
}

}  // namespace

std::string InputChoice::label() const
{
    return fmt::format("{}", fmt::join(channels, ","));
}

namespace {

/// asked: what names the layer, with its value.
InputChoice resolved(const ImageFile &file, const std::string &role, const std::string &wanted, const ColorChoice *color,
                     const std::string &asked, const std::string &reason)
{
    const std::vector<Candidate> layers = layers_in(file);
    std::vector<Candidate> found = named(file, wanted, layers);
    narrow_to_picture(found, file, color);
    const auto fail = [&](const std::string &what, const std::vector<Candidate> &candidates) {
        throw RequestError(fmt::format("{}: {}: {}: {}", file.path().string(), asked, what, list(file, candidates)));
    };
    if (found.empty()) {
        std::vector<std::string> names;
        for (const Candidate &c : layers)
            names.push_back(c.layer.empty() ? c.channels.front()->name : c.layer);
        const std::string near = nearest(wanted, names);
        fail(fmt::format("no such layer or channel{}; layers in the file",
                         near.empty() ? "" : fmt::format(", nearest is '{}'", near)),
             layers);
    }
    if (found.size() > 1)
        fail(fmt::format("{} layers could be it, expected the name of a channel or PART.LAYER", found.size()), found);
    const Candidate &c = found.front();
    if (c.part->deep)
        fail("deep data (expected flat scan lines or tiles)", found);
    if (!is_whole(c))
        fail("subsampled (expected full resolution)", found);
    return choice_of(c, role, reason);
}

}  // namespace

InputChoice resolve_input(const ImageFile &file, const std::string &role, const std::string &wanted,
                          const ColorChoice *color)
{
    return resolved(file, role, wanted, color, fmt::format("--input {}={}", role, wanted), "as asked by --input");
}

InputChoice resolve_group(const ImageFile &file, const std::string &wanted, std::uint32_t light, const ColorChoice &color)
{
    const std::string asked = fmt::format("lights[{}].group", light);
    InputChoice choice =
        resolved(file, "light_group", wanted, &color, fmt::format("{} \"{}\"", asked, wanted), "the scene's " + asked);
    choice.light = light;
    return choice;
}

InputChoice resolve_shadow(const ImageFile &file, const std::string &wanted, std::uint32_t light)
{
    const std::string asked = fmt::format("lights[{}].shadow.file", light);
    InputChoice choice{"shadow", 0, {}, "", light};
    if (!wanted.empty()) {
        choice = resolved(file, "shadow", wanted, nullptr, fmt::format("{} \":{}\"", asked, wanted), "the scene's " + asked);
        choice.light = light;
    } else if (const auto depth = find_depth(file, {}, nullptr, nullptr)) {
        choice.part = depth->part;
        choice.channels = {depth->channel};
        choice.reason = "the scene's " + asked;
    } else {
        throw RequestError(fmt::format("{}: {}: no depth by a known name, or several; expected FILE:LAYER with one of {}",
                                       file.path().string(), asked, list(file, layers_in(file))));
    }
    const PartInfo &part = file.part(choice.part);
    if (choice.channels.size() != 1)
        throw RequestError(fmt::format("{}: {}: '{}' has {} channels; expected one, of distances", file.path().string(),
                                       asked, choice.label(), choice.channels.size()));
    if (const SampleType type = part.find(choice.channels.front())->type;
        type != SampleType::kHalf && type != SampleType::kFloat)
        throw RequestError(fmt::format("{}: {}: '{}' is {}; expected half or float, of distances in scene units",
                                       file.path().string(), asked, choice.label(), name_of(type)));
    if (std::abs(part.pixel_aspect - 1) > 1e-3)
        throw RequestError(fmt::format("{}: {}: a pixel aspect of {}; expected square pixels", file.path().string(), asked,
                                       part.pixel_aspect));
    return choice;
}

bool has_known_names(const std::string &role)
{
    return std::any_of(std::begin(kKnownNames), std::end(kKnownNames),
                       [&](const KnownName &known) { return role == known.role; });
}

std::optional<InputChoice> find_known_input(const ImageFile &file, const std::string &role, const ColorChoice &color)
{
    std::vector<Candidate> found = layers_in(file);
    std::erase_if(found, [&](const Candidate &c) { return !is_whole(c) || !is_known(c, role); });
    // Those of another view belong to another picture.
    std::erase_if(found, [&](const Candidate &c) { return !c.view.empty() && c.view != color.view; });
    narrow_to_picture(found, file, &color);
    if (found.empty())
        return std::nullopt;
    if (found.size() > 1)
        throw RequestError(fmt::format("{}: {} layers could be the input {}, choose with --input {}=LAYER: {}",
                                       file.path().string(), found.size(), role, role, list(file, found)));
    return choice_of(found.front(), role, "known name");
}

}  // namespace brume::tool
