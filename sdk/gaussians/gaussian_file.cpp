#include "gaussians/gaussian_file.h"

#include <algorithm>
#include <filesystem>

#include "base/error.h"
#include "gaussians/gaussian_formats.h"
#include "base/text.h"
#include "base/whole_file.h"

namespace brume {
namespace {

// Room for the most Gaussians at 512 bytes each: particle caches carry columns that are passed over.
constexpr size_t largest_file = size_t(BRUME_MAX_GAUSSIANS) * 512;

enum class FileFormat { csv, ply };

FileFormat format_of(const std::string &path)
{
    std::string extension = std::filesystem::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
    if (extension == ".csv")
        return FileFormat::csv;
    if (extension == ".ply")
        return FileFormat::ply;
    throw Error(BRUME_ERROR_SCENE, path + ": extension " + in_quotes(extension) + "; expected .csv or .ply");
}

}  // namespace

std::vector<Gaussian> read_gaussians(const std::string &path)
{
    const FileFormat format = format_of(path);
    const std::string content = read_whole_file(path, largest_file);
    return format == FileFormat::csv ? parse_gaussian_csv(content, path) : parse_gaussian_ply(content, path);
}

void write_gaussians(const std::string &path, std::span<const Gaussian> gaussians)
{
    const FileFormat format = format_of(path);
    write_whole_file(path, format == FileFormat::csv ? gaussian_csv(gaussians) : gaussian_ply(gaussians));
}

}  // namespace brume
