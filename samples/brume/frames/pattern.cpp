#include "frames/pattern.hpp"

#include <algorithm>
#include <charconv>
#include <cctype>

#include <fmt/format.h>

#include "frames/range.hpp"
#include "support/error.hpp"

namespace brume::tool {
namespace {

struct Placeholder {
    std::size_t at, length;
    int width;
};

std::optional<Placeholder> find_placeholder(const std::string &text)
{
    const auto run = [&](std::size_t from, char c) {
        std::size_t to = from;
        while (to < text.size() && text[to] == c)
            ++to;
        return to - from;
    };
    std::optional<Placeholder> found;
    for (std::size_t i = 0; i < text.size();) {
        Placeholder here{i, 0, 0};
        if (text[i] == '%') {
            std::size_t j = i + 1;
            while (j < text.size() && std::isdigit((unsigned char)text[j]) && j - i < 4)
                ++j;
            if (j < text.size() && text[j] == 'd') {
                if (j > i + 1)
                    std::from_chars(text.data() + i + 1, text.data() + j, here.width);
                here.length = j + 1 - i;
            }
        } else if (text[i] == '#' || text[i] == '@') {
            here.length = run(i, text[i]);
            here.width = text[i] == '#' && here.length == 1 ? 4 : int(here.length);
        }
        if (here.length == 0) {
            ++i;
            continue;
        }
        if (found)
            throw RequestError(fmt::format("'{}': more than one frame number in the name (expected at most one)", text));
        found = here;
        i += here.length;
    }
    return found;
}

}  // namespace

FilePattern::FilePattern(std::string text) : text_(std::move(text))
{
    const std::size_t slash = text_.rfind('/');
    const std::size_t name = slash == std::string::npos ? 0 : slash + 1;
    if (find_placeholder(text_.substr(0, name)))
        throw RequestError(fmt::format("'{}': a frame number in a folder's name (expected in the file's name only)", text_));
    // A file that is really called so is meant literally.
    if (std::error_code none; std::filesystem::exists(text_, none))
        return;
    if (const auto found = find_placeholder(text_.substr(name))) {
        before_ = text_.substr(0, name + found->at);
        after_ = text_.substr(name + found->at + found->length);
        width_ = found->width;
    }
}

std::filesystem::path FilePattern::at(int frame) const
{
    if (!is_sequence())
        return text_;
    return fmt::format("{}{:0{}}{}", before_, frame, width_, after_);
}

std::optional<int> FilePattern::frame_of(const std::string &file_name) const
{
    const std::string before = std::filesystem::path(before_).filename().string();
    if (file_name.size() <= before.size() + after_.size() || !file_name.starts_with(before) || !file_name.ends_with(after_))
        return std::nullopt;
    const char *from = file_name.data() + before.size();
    const char *to = file_name.data() + file_name.size() - after_.size();
    int frame = 0;
    const auto [end, error] = std::from_chars(from, to, frame);
    // Only the name that this frame would be given counts: %04d is neither 7 nor 00007.
    if (error != std::errc() || end != to || at(frame).filename() != file_name)
        return std::nullopt;
    return frame;
}

std::vector<int> FilePattern::existing() const
{
    std::vector<int> frames;
    std::filesystem::path folder = std::filesystem::path(before_).parent_path();
    if (folder.empty())
        folder = ".";
    std::error_code error;
    for (const auto &entry : std::filesystem::directory_iterator(folder, error))
        if (const auto frame = frame_of(entry.path().filename().string()))
            frames.push_back(*frame);
    if (error)
        throw RequestError(fmt::format("{}: cannot be listed: {}", folder.string(), error.message()));
    std::sort(frames.begin(), frames.end());
    return frames;
}

std::vector<FrameFile> list_frames(const FilePattern &input, const FilePattern &output, const std::string &range)
{
    if (!input.is_sequence()) {
        if (!range.empty())
            throw RequestError(
                fmt::format("--frames given, but '{}' has no frame number such as %04d or ####", input.text()));
        if (!std::filesystem::exists(input.text()))
            throw RequestError(fmt::format("{}: no such file", input.text()));
        const int frame = frame_in_name(input.text());
        return {{frame, input.text(), output.at(frame)}};
    }
    const std::vector<int> frames = range.empty() ? input.existing() : parse_frames(range);
    const bool any = std::any_of(frames.begin(), frames.end(), [&](int f) { return std::filesystem::exists(input.at(f)); });
    if (!any)
        throw RequestError(
            fmt::format("{}: no file matches{}", input.text(), range.empty() ? "" : " for --frames " + range));
    if (frames.size() > 1 && !output.is_sequence())
        throw RequestError(
            fmt::format("output '{}' has no frame number such as %04d for {} frames", output.text(), frames.size()));
    std::vector<FrameFile> files;
    for (const int frame : frames)
        files.push_back({frame, input.at(frame), output.at(frame)});
    return files;
}

int frame_in_name(const std::filesystem::path &file)
{
    const std::string name = file.stem().string();
    std::size_t to = name.size();
    while (to > 0 && !std::isdigit((unsigned char)name[to - 1]))
        --to;
    std::size_t from = to;
    while (from > 0 && std::isdigit((unsigned char)name[from - 1]) && to - from < 9)
        --from;
    int frame = 0;
    std::from_chars(name.data() + from, name.data() + to, frame);
    return frame;
}

}  // namespace brume::tool
