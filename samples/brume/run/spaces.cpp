#include "run/spaces.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "image/formats.hpp"
#include "image/resolve.hpp"
#include "support/error.hpp"

namespace brume::tool {
namespace {

bool is_rewrite(const std::filesystem::path &file)
{
    const Format *format = format_of(file);
    return !format || is_exr(*format);
}

}  // namespace

ColorRequest spaces_of(const ColorRequest &asked, const std::vector<FrameFile> &files, const std::string &output,
                       const std::string &output_type, const LayerRequest &layers, const ReadLimits &limits)
{
    if (output_type.empty() && is_rewrite(output) &&
        std::all_of(files.begin(), files.end(), [](const FrameFile &f) { return is_rewrite(f.input); }))
        return asked;
    for (const FrameFile &f : files)
        try {
            const ImageFile file(f.input, limits);
            const ColorChoice color = resolve_color(file, layers);
            const SampleType stored = color.type_in(file);
            const SampleType written = type_to_write(output, stored, output_type);
            if (!output_type.empty() && is_rewrite(output) && is_rewrite(f.input))
                throw RequestError(fmt::format("--output-type {}: channels of an EXR file keep their types", output_type));
            ColorRequest spaces = asked;
            if (spaces.input_space.empty()) {
                const auto &said = file.source().color_space;
                if (!said)
                    throw RequestError(
                        fmt::format("{}: pixels are {} of an unknown colour space: {}; expected --input-space, such as sRGB",
                                    f.input.string(), name_of(stored), file.source().color_note));
                spaces.input_space = *said;
            }
            if (!spaces.output_space.empty())
                return spaces;
            if (is_normalized(written) && !is_normalized(stored) && asked.input_space.empty())
                throw RequestError(fmt::format("-o {}: {} holds 0 to 1, and {} is scene-linear radiance without a bound; "
                                               "expected --output-space, such as sRGB, or a format of floats",
                                               output, name_of(written), f.input.string()));
            if (!is_normalized(written) && is_normalized(stored))
                spaces.output_space = OCIO_NAMESPACE::ROLE_SCENE_LINEAR;
            return spaces;
        } catch (const FrameError &) {
            // The run reports it.
        }
    return asked;
}

void check_space(const ImageFile &file, const ColorRequest &asked, const ColorRequest &used)
{
    if (!asked.input_space.empty() || file.source().color_space == used.input_space)
        return;
    const auto shown = [](const std::optional<std::string> &space) {
        return !space ? "of an unknown space" : space->empty() ? "scene-linear" : *space;
    };
    throw FrameError(fmt::format("{}: pixels are {} (expected {}, as those of the first picture; --input-space says it of "
                                 "all)",
                                 file.path().string(), shown(file.source().color_space), shown(used.input_space)));
}

}  // namespace brume::tool
