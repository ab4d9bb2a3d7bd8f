#include "run/checks.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <sys/stat.h>

#include "support/error.hpp"

namespace brume::tool {
namespace {

using FileId = std::pair<dev_t, ino_t>;

std::optional<FileId> id_of(const std::filesystem::path &file)
{
    struct stat status {};
    std::error_code error;
    // "new/../a.exr" is nothing until the folder `new` has been made, and a.exr from then on.
    if (::stat(file.c_str(), &status) != 0 && ::stat(std::filesystem::weakly_canonical(file, error).c_str(), &status) != 0)
        return std::nullopt;
    return FileId{status.st_dev, status.st_ino};
}

}  // namespace

void check_outputs(const SequenceOptions &options, const std::vector<FrameFile> &files)
{
    std::vector<std::filesystem::path> outputs;
    for (const FrameFile &f : files)
        outputs.push_back(f.output);
    if (!options.stats.empty())
        outputs.push_back(options.stats);
    if (!options.preview.empty()) {
        const FilePattern preview(options.preview);
        for (const FrameFile &f : files) {
            outputs.push_back(preview.at(f.frame));
            if (!preview.is_sequence())
                break;
        }
    }
    std::set<std::filesystem::path> seen;
    for (const auto &output : outputs) {
        if (!seen.insert(std::filesystem::absolute(output).lexically_normal()).second)
            throw RequestError(fmt::format("{}: two outputs would be written there", output.string()));
        if (std::filesystem::is_directory(output))
            throw RequestError(fmt::format("{}: is a folder (expected a file's name)", output.string()));
    }

    std::vector<std::filesystem::path> read{options.fog.scene};
    if (!options.fog.picture.camera_file.empty())
        read.push_back(options.fog.picture.camera_file);
    for (const FrameFile &f : files) {
        read.push_back(f.input);
        if (const std::string depth = options.fog.picture.depth_file(); !depth.empty())
            read.push_back(FilePattern(depth).at(f.frame));
    }
    // By identity, so that links of either kind are seen for what they are.
    std::map<FileId, std::filesystem::path> inputs;
    for (const auto &file : read)
        if (const auto id = id_of(file))
            inputs.emplace(*id, file);
    for (const auto &output : outputs)
        if (const auto id = id_of(output); id && inputs.contains(*id))
            throw RequestError(fmt::format("{}: would overwrite the input {} (expected another place)", output.string(),
                                           inputs[*id].string()));
}

}  // namespace brume::tool
