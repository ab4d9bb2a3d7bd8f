#include "bench/run_setting.hpp"

#include <algorithm>

#include "support/error.hpp"

namespace brume::tool {
namespace {

/// What a scene file says of the effect would make another setting of it.
void reset(const Context &context, Scene &scene, const std::string &effect)
{
    for (const brume_parameter_info &parameter : context.parameters(effect))
        check_request(context, scene.set(effect, parameter.name, parameter.default_number), effect);
}

Plan plan_of(const Context &context, const SceneText &text, const Setting *setting, const Sample &sample,
             const std::string &output)
{
    Scene scene = make_scene(context, text);
    // The setting is what is measured, not what the scene's quality would choose.
    check_request(context, scene.remove_quality(), text.name);
    if (setting) {
        reset(context, scene, setting->effect);
        for (const auto &[name, value] : setting->parameters)
            check_request(context, scene.set(setting->effect, name, value), setting->effect);
    }
    const auto &weights = sample.weights;
    check_request(context, scene.set_luminance_weights(weights[0], weights[1], weights[2]), sample.name);
    brume_format format = sample.format;
    const std::vector<std::string> roles = roles_of(sample.inputs);
    const std::vector<brume_layer> given = input_layers(roles);
    format.inputs = given.data();
    format.input_count = std::uint32_t(given.size());
    const brume_layer wanted = brume::layer(output.c_str());
    if (!output.empty()) {
        format.outputs = &wanted;
        format.output_count = 1;
    }
    Plan plan(scene, format);
    check_request(context, plan.status(), "");
    return plan;
}

}  // namespace

SettingRun::SettingRun(const Context &context, const SceneText &text, const Setting *setting, const Sample &sample,
                       std::string output)
    : sample_(sample), effect_(setting ? setting->effect : ""), output_(std::move(output)),
      plan_(plan_of(context, text, setting, sample, output_)), pixels_(sample.color.size()),
      extra_(output_.empty() ? 0 : 3 * sample.depth.size())
{
}

double SettingRun::execute()
{
    const int w = sample_.width(), h = sample_.height();
    const auto channels = std::uint32_t(sample_.channels);
    const brume_image color = brume::image(sample_.color.data(), w, h, channels);
    const brume_image depth = brume::image(sample_.depth.data(), w, h, 1);
    const brume_image out = brume::image(pixels_.data(), w, h, channels), other = brume::image(extra_.data(), w, h, 3);
    const brume_layer extra = brume::layer(output_.c_str(), &other);
    brume_frame frame = BRUME_FRAME_INIT;
    frame.color = &color;
    frame.depth = &depth;
    frame.output = &out;
    const GivenLayers inputs(sample_.inputs);
    inputs.give_to(frame);
    frame.camera = &sample_.camera;
    frame.frame = sample_.frame;
    if (!output_.empty()) {
        frame.outputs = &extra;
        frame.output_count = 1;
    }
    check_request(plan_.context(), plan_.execute(frame), sample_.name);
    double ms = 0;
    for (const brume_plan_entry &entry : plan_.entries())
        // The library's own passes, such as those for Gaussians, are under its own name.
        if (entry.runs && (entry.effect == effect_ || entry.effect == std::string("brume")))
            ms += entry.measured_ms;
    return ms;
}

bool SettingRun::runs(const std::string &effect) const
{
    const std::vector<brume_plan_entry> entries = plan_.entries();
    return std::any_of(entries.begin(), entries.end(),
                       [&](const brume_plan_entry &entry) { return entry.runs && entry.effect == effect; });
}

std::uint64_t SettingRun::bytes() const
{
    return plan_.info().image_bytes + (pixels_.size() + extra_.size()) * sizeof(float);
}

}  // namespace brume::tool
