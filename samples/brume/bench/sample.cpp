#include "bench/sample.hpp"

#include <fmt/format.h>

#include "colour/color_manager.hpp"
#include "image/frame.hpp"
#include "run/fogger.hpp"
#include "run/sequence.hpp"
#include "support/error.hpp"

namespace brume::tool {
namespace {

std::vector<float> averaged(const std::vector<float> &pixels, int width, int height, int channels, int factor)
{
    const int w = width / factor, h = height / factor;
    std::vector<float> out(std::size_t(w) * std::size_t(h) * std::size_t(channels));
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x)
            for (int c = 0; c < channels; ++c) {
                double sum = 0;
                for (int j = 0; j < factor; ++j)
                    for (int i = 0; i < factor; ++i)
                        sum += pixels[(std::size_t(y * factor + j) * std::size_t(width) + std::size_t(x * factor + i)) *
                                          std::size_t(channels) +
                                      std::size_t(c)];
                out[(std::size_t(y) * std::size_t(w) + std::size_t(x)) * std::size_t(channels) + std::size_t(c)] =
                    float(sum / (factor * factor));
            }
    return out;
}

std::vector<float> from_middles(const std::vector<float> &pixels, int width, int height, int channels, int factor)
{
    const int w = width / factor, h = height / factor;
    std::vector<float> out;
    out.reserve(std::size_t(w) * std::size_t(h) * std::size_t(channels));
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x) {
            const auto middle =
                pixels.begin() +
                (std::ptrdiff_t(y * factor + factor / 2) * width + x * factor + factor / 2) * std::ptrdiff_t(channels);
            out.insert(out.end(), middle, middle + channels);
        }
    return out;
}

void reduce(InputLayer &input, int factor)
{
    if (input.role == kShadow)
        return;  // the light's picture, of a size of its own
    const auto reduced = input.role == kLightGroup ? averaged : from_middles;
    input.pixels = std::make_shared<const std::vector<float>>(
        reduced(*input.pixels, input.width, input.height, input.channels, factor));
    input.width /= factor;
    input.height /= factor;
}

}  // namespace

Picture picture_of(const std::vector<float> &pixels, int width, int height, int channels)
{
    Picture picture{0, 0, width, height, {}};
    picture.rgb.reserve(3 * pixels.size() / std::size_t(channels));
    for (std::size_t i = 0; i < pixels.size(); i += std::size_t(channels))
        picture.rgb.insert(picture.rgb.end(), pixels.begin() + std::ptrdiff_t(i), pixels.begin() + std::ptrdiff_t(i) + 3);
    return picture;
}

Sample load_sample(const FrameFile &file, const PictureOptions &options, const CameraBlock &scene_camera,
                   const std::string &truth, Fogger *fogger)
{
    const ColorManager colors;
    OpenFrame open = open_frame(file, options, {});
    const DepthSource depth{open.depth_file ? &*open.depth_file : nullptr, open.depth};
    const PartInfo &header = open.file.part(open.color.part);
    const Shot shot = shot_of(open.file, open.color, options, scene_camera, file.frame);
    Sample sample;
    sample.name = file.input.string();
    sample.format = shot.format;
    sample.camera = shot.camera;
    sample.frame = file.frame;
    sample.weights = colors.luminance_weights(header);
    std::vector<OpenInput> inputs;
    if (fogger) {
        fogger->learn_roles(open.file, open.color, file.frame);
        inputs = fogger->open_inputs(open.file, open.color, file.frame, {});
    }
    Frame frame = read_frame(std::move(open.file), open.color, &depth);
    for (const OpenInput &input : inputs)
        sample.inputs.push_back(fogger->read_pixels(input, frame.file, frame.part(), nullptr));
    colors.file_to_working(frame);
    sample.channels = frame.channels;
    sample.color = std::move(frame.pixels);
    sample.depth = std::move(frame.depth);
    options.depth_kind().convert(sample.depth);
    if (!truth.empty()) {
        ImageFile truth_file(truth);
        const ColorChoice color = resolve_color(truth_file, options.layers);
        Frame other = read_frame(std::move(truth_file), color, nullptr);
        colors.file_to_working(other);
        if (other.width != frame.width || other.height != frame.height)
            throw RequestError(fmt::format("--truth {}: {} x {} pixels; expected {} x {}, as {} has", truth, other.width,
                                           other.height, frame.width, frame.height, sample.name));
        sample.truth = picture_of(other.pixels, other.width, other.height, other.channels);
    }
    return sample;
}

Sample reduced(const Sample &sample, int factor)
{
    Sample out = sample;
    brume_format &f = out.format;
    f.width /= factor;
    f.height /= factor;
    f.display_x /= factor;
    f.display_y /= factor;
    f.display_width /= factor;
    f.display_height /= factor;
    out.color = averaged(sample.color, sample.width(), sample.height(), sample.channels, factor);
    out.depth = from_middles(sample.depth, sample.width(), sample.height(), 1, factor);
    for (InputLayer &input : out.inputs)
        reduce(input, factor);
    if (sample.truth)
        out.truth =
            Picture{0, 0, f.width, f.height, averaged(sample.truth->rgb, sample.width(), sample.height(), 3, factor)};
    return out;
}

}  // namespace brume::tool
