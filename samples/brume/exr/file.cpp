#include "exr/file.hpp"

#include <algorithm>
#include <new>

#include <ImfChannelList.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <fmt/format.h>

#include "support/error.hpp"

namespace brume::tool {
namespace {

std::vector<std::string> split(const std::string &name)
{
    std::vector<std::string> parts;
    std::size_t from = 0;
    for (std::size_t dot; (dot = name.find('.', from)) != std::string::npos; from = dot + 1)
        parts.push_back(name.substr(from, dot - from));
    parts.push_back(name.substr(from));
    return parts;
}

/// The standard puts the view just before the base name; some writers put it first. A view's name anywhere before the
/// base names the view, and channels without one belong to the default view.
ChannelInfo take_apart(const std::string &name, const Imf::Channel &channel, const std::vector<std::string> &views,
                       const std::string &part_view)
{
    ChannelInfo info{name, "", part_view, "", channel.type, {channel.xSampling, channel.ySampling}};
    auto components = split(name);
    info.base = components.back();
    components.pop_back();
    if (!views.empty()) {
        const auto is_view = [&](const std::string &c) { return std::find(views.begin(), views.end(), c) != views.end(); };
        const auto at = std::find_if(components.begin(), components.end(), is_view);
        if (at != components.end()) {
            info.view = *at;
            components.erase(at);
        } else if (info.view.empty()) {
            info.view = views.front();
        }
    }
    info.layer = fmt::format("{}", fmt::join(components, "."));
    return info;
}

}  // namespace

const ChannelInfo *PartInfo::find(const std::string &channel_name) const
{
    const auto at = std::find_if(channels.begin(), channels.end(), [&](const auto &c) { return c.name == channel_name; });
    return at == channels.end() ? nullptr : &*at;
}

std::string PartInfo::label() const
{
    return name.empty() ? fmt::format("part {}", index) : fmt::format("part {} ({})", index, name);
}

ExrFile::ExrFile(std::filesystem::path path, const ReadLimits &limits) : path_(std::move(path))
{
    precheck_headers(path_, limits);
    guarded("reading headers", [&] { file_ = std::make_shared<Imf::MultiPartInputFile>(path_.c_str()); });
    guarded("reading headers", [&] {
        for (int index = 0; index < file_->parts(); ++index) {
            const Imf::Header &h = file_->header(index);
            PartInfo part;
            part.index = index;
            if (h.hasName())
                part.name = h.name();
            if (h.hasView())
                part.view = h.view();
            part.data_window = h.dataWindow();
            part.compression = h.compression();
            const std::string type = h.hasType() ? h.type() : "";
            part.deep = Imf::isDeepData(type);
            part.tiled = Imf::isTiled(type) || (type.empty() && h.hasTileDescription());
            const std::vector<std::string> views = Imf::hasMultiView(h) ? Imf::multiView(h) : Imf::StringVector{};
            if (default_view_.empty())
                default_view_ = !views.empty() ? views.front() : part.view;
            for (auto c = h.channels().begin(); c != h.channels().end(); ++c)
                part.channels.push_back(take_apart(c.name(), c.channel(), views, part.view));
            parts_.push_back(std::move(part));
        }
    });
}

void ExrFile::rethrow(const std::string &doing, const std::exception &e) const
{
    if (dynamic_cast<const FrameError *>(&e))
        throw;
    if (dynamic_cast<const std::bad_alloc *>(&e))
        throw FrameError(fmt::format("{}: out of memory while {}", path_.string(), doing));
    // OpenEXR's messages name the file once more, over several lines.
    std::string what = e.what();
    for (const std::string named = " \"" + path_.string() + "\""; what.find(named) != std::string::npos;)
        what.erase(what.find(named), named.size());
    std::replace(what.begin(), what.end(), '\n', ' ');
    throw FrameError(fmt::format("{}: {}: {}", path_.string(), doing, what));
}

}  // namespace brume::tool
