#include "compare/pairs.hpp"

#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "frames/pattern.hpp"
#include "frames/range.hpp"
#include "support/error.hpp"

namespace brume::tool {
namespace {

namespace fs = std::filesystem;

void add_files_below(const fs::path &folder, std::set<std::string> &names)
{
    std::error_code error;
    for (auto at = fs::recursive_directory_iterator(folder, error); !error && at != fs::end(at); at.increment(error))
        if (at->path().extension() == ".exr" && !at->is_directory())
            names.insert(at->path().lexically_relative(folder).string());
    if (error)
        throw RequestError(fmt::format("{}: cannot be listed: {}", folder.string(), error.message()));
}

std::vector<PairFiles> pairs_of_folders(const fs::path &a, const fs::path &b)
{
    std::set<std::string> names;
    add_files_below(a, names);
    if (fs::exists(b))
        add_files_below(b, names);
    if (names.empty())
        throw RequestError(fmt::format("{} and {}: no .exr file in either folder", a.string(), b.string()));
    std::vector<PairFiles> pairs;
    for (const std::string &name : names)
        pairs.push_back({name, (a / name).string(), (b / name).string()});
    return pairs;
}

std::vector<PairFiles> pairs_of_patterns(const FilePattern &a, const FilePattern &b, const std::string &range)
{
    std::set<int> frames;
    if (!range.empty()) {
        const auto asked = parse_frames(range);
        frames.insert(asked.begin(), asked.end());
    } else {
        const auto of_a = a.existing(), of_b = b.existing();
        frames.insert(of_a.begin(), of_a.end());
        frames.insert(of_b.begin(), of_b.end());
    }
    if (frames.empty())
        throw RequestError(fmt::format("{} and {}: no file matches either", a.text(), b.text()));
    std::vector<PairFiles> pairs;
    for (const int frame : frames)
        pairs.push_back({a.at(frame).filename().string(), a.at(frame).string(), b.at(frame).string(), frame});
    return pairs;
}

}  // namespace

std::vector<PairFiles> list_pairs(const std::string &a, const std::string &b, const std::string &frames, bool may_make_b)
{
    const auto kind_of = [](const std::string &path, const FilePattern &pattern) {
        return fs::is_directory(path) ? "a folder" : pattern.is_sequence() ? "a pattern" : "a file";
    };
    const FilePattern pattern_a(a), pattern_b(b);
    const std::string kind = kind_of(a, pattern_a), other = kind_of(b, pattern_b);
    const bool makes_folder = kind == "a folder" && may_make_b && !fs::exists(b);
    if (kind != other && !makes_folder)
        throw RequestError(
            fmt::format("{} is {} and {} is {}: expected two files, two patterns or two folders", a, kind, b, other));
    if (!frames.empty() && kind != "a pattern")
        throw RequestError(fmt::format("--frames given, but '{}' has no frame number such as %04d or ####", a));
    if (kind == "a folder")
        return pairs_of_folders(a, b);
    if (kind == "a pattern")
        return pairs_of_patterns(pattern_a, pattern_b, frames);
    for (const std::string &file : may_make_b ? std::vector{a} : std::vector{a, b})
        if (!fs::exists(file))
            throw RequestError(fmt::format("{}: no such file", file));
    return {{fs::path(a).filename().string(), a, b}};
}

}  // namespace brume::tool
