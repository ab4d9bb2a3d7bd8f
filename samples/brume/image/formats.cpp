#include "image/formats.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "image/narrow.hpp"
#include "support/error.hpp"

namespace brume::tool {
namespace {

using enum SampleType;

struct Ending {
    const char *text;
    Format format;
};

const std::vector<Ending> &endings()
{
    static const std::vector<Ending> all{{".exr", {"openexr", true, {kHalf, kFloat}}},
                                         {".png", {"png", true, {kUint8, kUint16}}},
                                         {".tif", {"tiff", true, {kFloat, kHalf, kUint16, kUint8}}},
                                         {".tiff", {"tiff", true, {kFloat, kHalf, kUint16, kUint8}}},
                                         {".jpg", {"jpeg", false, {kUint8}}},
                                         {".jpeg", {"jpeg", false, {kUint8}}},
                                         {".dpx", {"dpx", false, {kUint16, kUint8}}},
                                         {".hdr", {"hdr", false, {kFloat}}},
                                         {".pfm", {"pfm", false, {kFloat}}},
                                         {".npy", {"npy", true, {kFloat}}}};
    return all;
}

}  // namespace

bool Format::has(SampleType type) const
{
    return std::find(types.begin(), types.end(), type) != types.end();
}

const Format *format_of(const std::filesystem::path &file)
{
    const std::string name = lower(file.filename().string());
    for (const Ending &ending : endings())
        if (name.ends_with(ending.text) && name != ending.text)
            return &ending.format;
    return nullptr;
}

bool is_exr(const Format &format)
{
    return std::string_view(format.name) == "openexr";
}

std::string known_endings()
{
    std::string list;
    for (const Ending &ending : endings())
        list += fmt::format("{}{}", list.empty() ? "" : ", ", ending.text);
    return list;
}

std::size_t end_of_file_name(const std::string &text)
{
    const std::string low = lower(text);
    std::size_t end = std::string::npos;
    for (const Ending &ending : endings()) {
        const std::string_view name(ending.text);
        if (const auto at = low.find(std::string(name) + ":"); at != std::string::npos)
            end = std::min(end, at + name.size());
    }
    return end != std::string::npos ? end : format_of(text) ? text.size() : end;
}

SampleType type_to_write(const std::string &output, SampleType stored, const std::string &asked)
{
    const Format *format = format_of(output);
    if (!format)
        throw RequestError(fmt::format("{}: expected a name that ends in one of {}", output, known_endings()));
    if (asked.empty())
        return format->has(stored) ? stored : format->types.front();
    std::string names;
    for (const SampleType type : format->types) {
        if (asked == name_of(type))
            return type;
        names += fmt::format("{}{}", names.empty() ? "" : ", ", name_of(type));
    }
    throw RequestError(fmt::format("--output-type {}: {} cannot have it; expected {}", asked, output, names));
}

}  // namespace brume::tool
