#include "run/checks.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <unistd.h>

#include "image/formats.hpp"
#include "image/narrow.hpp"
#include "run/inputs.hpp"
#include "run/scene.hpp"
#include "support/error.hpp"
#include "support/pending_file.hpp"

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

/// What FILE:LAYER has before the colon.
std::string name_alone(const std::string &file)
{
    return file.substr(0, end_of_file_name(file));
}

/// Every file that a scene names, of whatever kind.
void collect_files(const nlohmann::json &node, const std::filesystem::path &folder, std::vector<FilePattern> &files)
{
    for (const auto &[key, value] : node.items())
        if (key == "file" && value.is_string())
            files.emplace_back((folder / name_alone(value.get<std::string>())).string());
        else if (value.is_structured())
            collect_files(value, folder, files);
}

void check_ending(const char *option, const std::string &file, const std::string &ending)
{
    const std::string name = lower(std::filesystem::path(file).filename().string());
    if (!name.ends_with(ending) || name == ending)
        throw RequestError(fmt::format("{} {}: expected a name that ends in {}", option, file, ending));
}

}  // namespace

void check_outputs(const SequenceOptions &options, const std::vector<FrameFile> &files)
{
    std::vector<std::filesystem::path> outputs;
    for (const FrameFile &f : files)
        outputs.push_back(f.output);
    if (!options.stats.empty() && !is_stream(options.stats))
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
        std::string why_not;
        const std::filesystem::path place = place_of(output, why_not);
        if (!why_not.empty())
            throw RequestError(fmt::format("{}: {} (expected a file's name)", output.string(), why_not));
        std::error_code error;
        const std::filesystem::path real = std::filesystem::weakly_canonical(place, error);
        if (!seen.insert(error ? std::filesystem::absolute(place).lexically_normal() : real).second)
            throw RequestError(fmt::format("{}: two outputs would be written there", output.string()));
    }
    const Format *format = format_of(options.output);
    if (!format)
        throw RequestError(fmt::format("-o {}: expected a name that ends in one of {}", options.output, known_endings()));
    if (!options.fog.layers.empty() && !is_exr(*format))
        throw RequestError(
            fmt::format("-o {}: --layers go into an EXR file; expected a name that ends in .exr", options.output));
    if (!options.preview.empty())
        check_ending("--preview", options.preview, ".png");

    std::vector<std::filesystem::path> read{options.fog.scene};
    const nlohmann::json scene = nlohmann::json::parse(read_scene(options.fog.scene, {}).text, nullptr, false);
    std::vector<FilePattern> patterns;
    if (scene.is_structured())
        collect_files(scene, std::filesystem::path(options.fog.scene).parent_path(), patterns);
    if (const std::string &camera = options.fog.picture.camera_file; !camera.empty())
        patterns.emplace_back(camera);
    if (const std::string depth = options.fog.picture.depth_file(); !depth.empty())
        patterns.emplace_back(depth);
    for (const std::string &input : options.fog.inputs)
        if (const std::string file = parse_input(input).file; !file.empty())
            patterns.emplace_back(file);
    if (const char *config = std::getenv("OCIO"); config && *config)
        read.push_back(config);
    for (const FrameFile &f : files) {
        read.push_back(f.input);
        for (const FilePattern &pattern : patterns)
            read.push_back(pattern.existing_at(f.frame));
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

void make_folder_of(const std::filesystem::path &output)
{
    const std::filesystem::path folder = output.parent_path();
    std::error_code error;
    if (!folder.empty() && !std::filesystem::create_directories(folder, error) && error)
        throw RequestError(fmt::format("{}: the output's folder cannot be made: {}", folder.string(), error.message()));
    if (::access(folder.empty() ? "." : folder.c_str(), W_OK | X_OK) != 0)
        throw RequestError(
            fmt::format("{}: the output's folder cannot be written to: {}", folder.string(), std::strerror(errno)));
}

}  // namespace brume::tool
