#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "image/types.hpp"

namespace brume::tool {

/// A file format, known by the end of a file's name and by nothing else: contents choose no reader.
struct Format {
    const char *name;               ///< as OpenImageIO has it
    bool has_alpha;                 ///< pictures with alpha can be written
    std::vector<SampleType> types;  ///< that can be written, the one for radiance first

    bool has(SampleType type) const;
};

/// Null where the name ends in none that is known.
const Format *format_of(const std::filesystem::path &file);
bool is_exr(const Format &format);

/// "exr, png, ..."
std::string known_endings();

/// Where the file's name ends in a text such as "depth.png:Y" or "depth.png": npos where no such ending is in it.
std::size_t end_of_file_name(const std::string &text);

/// What a picture that is stored as `stored` is written as: `asked`, or what loses least. Throws RequestError, which names
/// `output`, where the format has no such type.
SampleType type_to_write(const std::string &output, SampleType stored, const std::string &asked);

}  // namespace brume::tool
