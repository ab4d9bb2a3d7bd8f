#include "compare/comparison.hpp"

#include <algorithm>
#include <filesystem>
#include <new>

#include <fmt/format.h>

#include "exr/header_changes.hpp"
#include "image/frame.hpp"
#include "metrics/flip.hpp"
#include "support/error.hpp"

namespace brume::tool {
namespace {

struct Loaded {
    ImageFile file;
    int part;
    Picture picture;
    LuminanceWeights weights;
    std::string channels;
};

Loaded load(const std::string &path, const LayerRequest &request, const ColorManager &colors)
{
    if (!std::filesystem::exists(path))
        throw FrameError(fmt::format("{}: no such file", path));
    ImageFile file(path);
    const ColorChoice color = resolve_color(file, request);
    const LuminanceWeights weights = colors.luminance_weights(file.part(color.part));
    Frame frame = read_frame(file, color, nullptr);
    colors.file_to_working(frame);
    const Window &window = frame.part().data_window;
    Picture picture{window.min.x, window.min.y, frame.width, frame.height, {}};
    if (frame.channels == 3) {
        picture.rgb = std::move(frame.pixels);
    } else {
        picture.rgb.reserve(frame.pixels.size() / 4 * 3);
        picture.alpha.reserve(frame.pixels.size() / 4);
        for (std::size_t i = 0; i < frame.pixels.size(); i += 4) {
            const auto pixel = frame.pixels.begin() + std::ptrdiff_t(i);
            picture.rgb.insert(picture.rgb.end(), pixel, pixel + 3);
            picture.alpha.push_back(pixel[3]);
        }
    }
    std::string channels =
        color.luminance ? color.rgb[0] : fmt::format("{}, {}, {}", color.rgb[0], color.rgb[1], color.rgb[2]);
    if (!color.alpha.empty())
        channels += ", " + color.alpha;
    return {std::move(file), color.part, std::move(picture), weights, std::move(channels)};
}

std::string window_of(const Picture &p)
{
    return fmt::format("{} x {} at ({}, {})", p.width, p.height, p.x, p.y);
}

bool same_window(const Picture &a, const Picture &b)
{
    return a.x == b.x && a.y == b.y && a.width == b.width && a.height == b.height;
}

Mask load_mask(const std::string &path, const Picture &onto, const ColorManager &colors)
{
    if (path.empty())
        return {};
    const Picture picture = load(path, {}, colors).picture;
    if (!same_window(picture, onto))
        throw FrameError(
            fmt::format("--mask {}: is {}; expected {}, as what is compared", path, window_of(picture), window_of(onto)));
    Mask mask(picture.rgb.size() / 3);
    for (std::size_t i = 0; i < mask.size(); ++i)
        mask[i] = std::any_of(&picture.rgb[3 * i], &picture.rgb[3 * i] + 3, [](float v) { return v != 0; });
    if (std::none_of(mask.begin(), mask.end(), [](std::uint8_t m) { return m != 0; }))
        throw FrameError(fmt::format("--mask {}: is 0 everywhere; expected a pixel to compare", path));
    return mask;
}

void compare(Comparison &result, const CompareRequest &request, const ColorManager &colors, const UsePictures &use)
{
    Loaded a = load(result.files.a, request.layers, colors);
    result.a_is_whole = true;
    Loaded b = load(result.files.b, request.layers, colors);
    if (const std::string note = provenance_note(a.file, b.file); !note.empty())
        result.notes.push_back(note);
    if (request.header)
        result.header = header_changes(a.file, b.file);

    std::vector<std::string> mismatched;
    if (a.channels != b.channels) {
        mismatched.push_back(fmt::format("the channels differ: {} has {}, {} has {}", result.files.a, a.channels,
                                         result.files.b, b.channels));
        a.picture.alpha.clear();
        b.picture.alpha.clear();
    }
    result.same_window = same_window(a.picture, b.picture);
    if (!result.same_window) {
        const std::string windows =
            fmt::format("{} is {}, {} is {}", result.files.a, window_of(a.picture), result.files.b, window_of(b.picture));
        crop_to_common(a.picture, b.picture);
        if (a.picture.rgb.empty())
            throw FrameError(fmt::format("the data windows have no pixel in common: {}", windows));
        mismatched.push_back(fmt::format("the data windows differ: {}; figures are of the {} x {} pixels in common", windows,
                                         a.picture.width, a.picture.height));
    }
    const Mask mask = load_mask(request.mask, a.picture, colors);
    result.metrics = measure(a.picture, b.picture, b.weights, mask);
    result.verdict = judge(a.picture, b.picture, result.metrics, request.limits, mask);
    result.measured = true;
    if (request.flip)
        result.flip = hdr_flip(a.picture, b.picture);
    result.verdict.beyond.insert(result.verdict.beyond.begin(), mismatched.begin(), mismatched.end());
    use(a.picture, b.picture, result);
}

}  // namespace

void check_layers(const std::vector<PairFiles> &pairs, const CompareRequest &request)
{
    for (const PairFiles &files : pairs)
        try {
            for (const std::string &path : {files.a, files.b})
                if (std::filesystem::exists(path))
                    resolve_color(ImageFile(path), request.layers);
            return;
        } catch (const FrameError &) {
        }
}

Comparison compare_pair(const PairFiles &files, const CompareRequest &request, const ColorManager &colors,
                        const UsePictures &use)
{
    Comparison result;
    result.files = files;
    try {
        compare(result, request, colors, use);
    } catch (const std::bad_alloc &) {
        result.error = fmt::format("{}: out of memory", files.a);
    } catch (const std::exception &e) {
        result.error = e.what();
    }
    return result;
}

}  // namespace brume::tool
