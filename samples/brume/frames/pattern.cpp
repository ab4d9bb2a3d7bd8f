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
            const auto in_word = [&](std::size_t at) { return at < text.size() && std::isalnum((unsigned char)text[at]); };
            if (text[i] == '@' && here.length == 1 && i > 0 && in_word(i - 1) && in_word(i + 1))
                here.length = 0;
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
    // A file that is really called so is meant literally.
    if (std::error_code none; std::filesystem::exists(text_, none))
        return;
    for (const char *view : {"%V", "%v"})
        if (text_.find(view, name) != std::string::npos)
            throw RequestError(fmt::format(
                "'{}': {} stands for a view's name (expected --view, which puts it there, and a run for each view)", text_,
                view));
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

std::filesystem::path FilePattern::sign_first(int frame) const
{
    return frame < 0 ? fmt::format("{}-{:0{}}{}", before_, -(long long)frame, width_, after_) : at(frame).string();
}

std::filesystem::path FilePattern::existing_at(int frame) const
{
    if (!is_sequence())
        return text_;
    std::error_code none;
    const auto other = sign_first(frame);
    return !std::filesystem::exists(at(frame), none) && std::filesystem::exists(other, none) ? other : at(frame);
}

std::filesystem::path FilePattern::at(int frame, const FilePattern &other, const std::filesystem::path &like) const
{
    return is_sequence() && frame < 0 && like != other.at(frame) ? sign_first(frame) : at(frame);
}

std::optional<FilePattern::Number> FilePattern::number_in(const std::string &file_name) const
{
    const std::string before = std::filesystem::path(before_).filename().string();
    if (file_name.size() <= before.size() + after_.size() || !file_name.starts_with(before) || !file_name.ends_with(after_))
        return std::nullopt;
    const char *from = file_name.data() + before.size();
    const char *to = file_name.data() + file_name.size() - after_.size();
    Number number;
    const auto [end, error] = std::from_chars(from, to, number.frame);
    if (error != std::errc() || end != to)
        return std::nullopt;
    // Only the names that this frame would be given count: %04d is neither 7 nor 00007.
    number.fits = at(number.frame).filename() == file_name || sign_first(number.frame).filename() == file_name;
    return number;
}

FilePattern::Listing FilePattern::listing() const
{
    Listing listing;
    std::filesystem::path folder = std::filesystem::path(before_).parent_path();
    if (folder.empty())
        folder = ".";
    std::error_code error;
    for (std::filesystem::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        const std::string name = at->path().filename().string();
        if (const auto number = number_in(name); number && number->fits)
            listing.frames.push_back(number->frame);
        else if (number)
            listing.near_misses.push_back(name);
    }
    if (error)
        throw RequestError(fmt::format("{}: cannot be listed: {}", folder.string(), error.message()));
    std::sort(listing.frames.begin(), listing.frames.end());
    listing.frames.erase(std::unique(listing.frames.begin(), listing.frames.end()), listing.frames.end());
    std::sort(listing.near_misses.begin(), listing.near_misses.end());
    return listing;
}

std::vector<std::string> sequence_notes(const FilePattern &input)
{
    static constexpr std::size_t kShown = 8;
    const auto shown = [](const std::vector<std::string> &items) {
        const std::vector<std::string> first(items.begin(), items.begin() + std::ptrdiff_t(std::min(items.size(), kShown)));
        return fmt::format("{}{}", fmt::join(first, ", "), items.size() > kShown ? ", ..." : "");
    };
    std::vector<std::string> notes;
    if (!input.is_sequence())
        return notes;
    const FilePattern::Listing listing = input.listing();
    std::vector<std::string> gaps;
    for (std::size_t i = 1; i < listing.frames.size(); ++i) {
        const long long from = (long long)listing.frames[i - 1] + 1, to = (long long)listing.frames[i] - 1;
        if (from <= to)
            gaps.push_back(from == to ? std::to_string(from) : fmt::format("{} to {}", from, to));
    }
    if (!gaps.empty())
        notes.push_back(fmt::format("{}: no files for the frames {}", input.text(), shown(gaps)));
    if (!listing.near_misses.empty())
        notes.push_back(
            fmt::format("{}: left out for their number of digits: {}", input.text(), shown(listing.near_misses)));
    return notes;
}

std::vector<FrameFile> list_frames(const FilePattern &input, const FilePattern &output, const std::string &range)
{
    if (!input.is_sequence()) {
        if (!range.empty())
            throw RequestError(
                fmt::format("--frames given, but '{}' has no frame number such as %04d or ####", input.text()));
        std::error_code error;
        if (!std::filesystem::exists(input.text(), error))
            throw RequestError(fmt::format("{}: {}", input.text(), error ? error.message() : "no such file"));
        const int frame = frame_in_name(input.text());
        return {{frame, input.text(), output.at(frame)}};
    }
    const std::vector<int> frames = range.empty() ? input.existing() : parse_frames(range);
    std::error_code error;
    const bool any = std::any_of(frames.begin(), frames.end(),
                                 [&](int f) { return std::filesystem::exists(input.existing_at(f), error); });
    if (!any && error)
        throw RequestError(fmt::format("{}: {}", input.text(), error.message()));
    if (!any)
        throw RequestError(
            fmt::format("{}: no file matches{}", input.text(), range.empty() ? "" : " for --frames " + range));
    if (frames.size() > 1 && !output.is_sequence())
        throw RequestError(
            fmt::format("output '{}' has no frame number such as %04d for {} frames", output.text(), frames.size()));
    std::vector<FrameFile> files;
    for (const int frame : frames) {
        const std::filesystem::path file = input.existing_at(frame);
        files.push_back({frame, file, output.at(frame, input, file)});
    }
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
    // A minus after a separator is a sign; in "shot-005" it is the separator.
    const bool signed_number =
        from > 0 && name[from - 1] == '-' && (from == 1 || name[from - 2] == '.' || name[from - 2] == '_');
    return signed_number ? -frame : frame;
}

}  // namespace brume::tool
