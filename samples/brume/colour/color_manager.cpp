#include "colour/color_manager.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include "colour/builtin_config.hpp"
#include "colour/primaries.hpp"
#include "support/error.hpp"

namespace brume::tool {
namespace {

namespace ocio = OCIO_NAMESPACE;

/// Pixels handed to OCIO at a time.
constexpr std::size_t kRun = 1 << 14;

/// As configs have it.
constexpr const char *kNamesOfSrgb[] = {"sRGB", "srgb_texture", "srgb_tx", "sRGB - Texture", "Utility - sRGB - Texture"};

void apply(const ocio::ConstCPUProcessorRcPtr &processor, float *pixels, std::size_t count, int channels)
{
    if (!processor)
        return;
    oneapi::tbb::parallel_for(std::size_t(0), (count + kRun - 1) / kRun, [&](std::size_t run) {
        const std::size_t n = std::min(kRun, count - run * kRun);
        ocio::PackedImageDesc image(pixels + run * kRun * std::size_t(channels), long(n), 1, channels);
        processor->apply(image);
    });
}

LuminanceWeights normalized(LuminanceWeights w)
{
    // AP0's blue primary lies outside what can be seen, hence the negative weight.
    for (double &v : w)
        v = std::max(v, 0.0);
    const double sum = w[0] + w[1] + w[2];
    if (!(sum > 0) || !std::isfinite(sum))
        return kRec709Luminance;
    for (double &v : w)
        v /= sum;
    return w;
}

LuminanceWeights weights_of(const ocio::ConstConfigRcPtr &config)
{
    LuminanceWeights weights;
    config->getDefaultLumaCoefs(weights.data());
    if (!config->hasRole("aces_interchange"))
        return normalized(weights);
    // Configs often leave the coefficients at Rec. 709's whatever their working space is: the interchange role is surer.
    const auto to_ap0 = config->getProcessor(ocio::ROLE_SCENE_LINEAR, "aces_interchange")->getDefaultCPUProcessor();
    constexpr double kAp0Luminance[3] = {0.3439664498, 0.7281660966, -0.0721325464};
    for (std::size_t i = 0; i < 3; ++i) {
        float rgb[3] = {0, 0, 0};
        rgb[i] = 1;
        to_ap0->applyRGB(rgb);
        weights[i] = rgb[0] * kAp0Luminance[0] + rgb[1] * kAp0Luminance[1] + rgb[2] * kAp0Luminance[2];
    }
    return normalized(weights);
}

}  // namespace

ColorManager::ColorManager(const ColorRequest &request)
{
    const char *path = std::getenv("OCIO");
    source_ = path && *path ? path : "the built-in config";
    try {
        load(request);
    } catch (const ocio::Exception &e) {
        const std::string why = fmt::format("OpenColorIO, {}: {}", source_, e.what());
        if (request.display || !request.input_space.empty() || !request.output_space.empty())
            throw RequestError(why);
        warning_ = why + "; no colour space is asked for, and luminance weights are Rec. 709's";
        weights_ = kRec709Luminance;
    }
}

std::string ColorManager::name_in_config(const std::string &space) const
{
    if (space.empty() || config_->getColorSpace(space.c_str()))
        return space;
    if (space == "sRGB")
        for (const char *other : kNamesOfSrgb)
            if (config_->getColorSpace(other))
                return other;
    return "";
}

ocio::ConstCPUProcessorRcPtr ColorManager::processor(const std::string &from, const std::string &to) const
{
    const auto p = config_->getProcessor(from.c_str(), to.c_str());
    return p->isNoOp() ? nullptr : p->getDefaultCPUProcessor();
}

void ColorManager::load(const ColorRequest &request)
{
    const char *path = std::getenv("OCIO");
    config_ = path && *path ? ocio::Config::CreateFromEnv() : builtin_config();
    const auto in_config = [&](const char *option, const std::string &space) -> std::string {
        if (const std::string name = name_in_config(space); space.empty() || !name.empty())
            return name;
        std::string known;
        for (int i = 0; i < config_->getNumColorSpaces(); ++i)
            known += fmt::format("{}{}", i ? ", " : "", config_->getColorSpaceNameByIndex(i));
        throw RequestError(fmt::format("{} '{}' is not in {}; it has {}", option, space, source_, known));
    };

    const std::string working = ocio::ROLE_SCENE_LINEAR;
    const std::string asked_in = in_config("--input-space", request.input_space);
    const std::string asked_out = in_config("--output-space", request.output_space);
    const std::string input = asked_in.empty() ? working : asked_in;
    const std::string output = asked_out.empty() ? input : asked_out;
    const auto same = [&](const char *space) {
        const auto a = config_->getColorSpace(space), b = config_->getColorSpace(output.c_str());
        return a && b && a->getName() == std::string_view(b->getName());
    };
    said_of_output_ = same(ocio::ROLE_SCENE_LINEAR) ? "Linear" : "";
    for (const char *name : kNamesOfSrgb)
        if (same(name))
            said_of_output_ = "sRGB";
    if (!request.input_space.empty() || !request.output_space.empty()) {
        in_ = processor(input, working);
        out_ = processor(working, output);
        changes_space_ = !config_->getProcessor(input.c_str(), output.c_str())->isNoOp();
        has_input_space_ = !request.input_space.empty();
    }
    if (changes_space_)
        new_chromaticities_ = primaries_of(config_, output.c_str());
    if (request.display) {
        const char *display = config_->getDefaultDisplay();
        auto view = ocio::DisplayViewTransform::Create();
        view->setSrc(working.c_str());
        view->setDisplay(display);
        view->setView(config_->getDefaultView(display));
        view_ = config_->getProcessor(view)->getDefaultCPUProcessor();
    }
    weights_ = weights_of(config_);
}

void ColorManager::to_working(float *pixels, std::size_t count, int channels) const
{
    apply(in_, pixels, count, channels);
}

void ColorManager::file_to_working(Frame &frame) const
{
    const auto &said = frame.file.source().color_space;
    if (!said || said->empty())
        return;
    const std::string space = config_ ? name_in_config(*said) : "";
    if (space.empty())
        throw FrameError(
            fmt::format("{}: pixels are {}, which {} does not have", frame.file.path().string(), *said, source_));
    apply(processor(space, ocio::ROLE_SCENE_LINEAR), frame.pixels.data(), frame.pixels.size() / std::size_t(frame.channels),
          frame.channels);
}

void ColorManager::from_working(float *pixels, std::size_t count, int channels) const
{
    apply(out_, pixels, count, channels);
}

LuminanceWeights ColorManager::luminance_weights(const PartInfo &part, std::vector<std::string> *warnings) const
{
    if (has_input_space_ || !part.chromaticities)
        return weights_;
    if (const auto weights = luminance_of(*part.chromaticities))
        return normalized(*weights);
    if (warnings)
        warnings->push_back("its chromaticities are degenerate: luminance weights are the working space's");
    return weights_;
}

std::vector<std::uint8_t> ColorManager::to_display(const float *pixels, std::size_t count, int channels) const
{
    std::vector<float> rgb(3 * count);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            rgb[3 * i + c] = pixels[std::size_t(channels) * i + c];
    apply(view_, rgb.data(), count, 3);
    std::vector<std::uint8_t> out(rgb.size());
    std::transform(rgb.begin(), rgb.end(), out.begin(),
                   [](float v) { return std::uint8_t(std::isnan(v) ? 0 : std::lround(std::clamp(v, 0.0f, 1.0f) * 255)); });
    return out;
}

std::string ColorManager::description() const
{
    return source_;
}

}  // namespace brume::tool
