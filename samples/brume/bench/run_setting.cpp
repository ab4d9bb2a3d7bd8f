#include "bench/run_setting.hpp"

#include "support/error.hpp"

namespace brume::tool {
namespace {

/// What a scene file says of the effect would make another setting of it.
void reset(brume_context context, brume_scene scene, const std::string &effect)
{
    for (const brume_parameter_info &parameter : parameters_of(context, effect))
        check_request(context, brume_scene_set_number(scene, effect.c_str(), parameter.name, parameter.default_number),
                      effect);
}

template <class Visit> void for_entries(brume_context context, brume_plan plan, const Visit &visit)
{
    brume_plan_info info = BRUME_PLAN_INFO_INIT;
    check_request(context, brume_plan_get_info(plan, &info), "plan");
    for (std::uint32_t i = 0; i < info.entry_count; ++i) {
        brume_plan_entry entry = BRUME_PLAN_ENTRY_INIT;
        check_request(context, brume_plan_get_entry(plan, i, &entry), "plan");
        if (entry.runs)
            visit(entry);
    }
}

}  // namespace

SettingRun::SettingRun(brume_context context, const SceneText &text, const Setting *setting, const Sample &sample,
                       std::string output)
    : context_(context), sample_(sample), effect_(setting ? setting->effect : ""), output_(std::move(output))
{
    const SceneHandle scene = make_scene(context, text);
    // The setting is what is measured, not what the scene's quality would choose.
    check_request(context, brume_scene_set_quality(scene.get(), nullptr), text.name);
    if (setting) {
        reset(context, scene.get(), effect_);
        for (const auto &[name, value] : setting->parameters)
            check_request(context, brume_scene_set_text(scene.get(), effect_.c_str(), name.c_str(), value.c_str()), effect_);
    }
    check_request(context, brume_scene_set_luminance_weights(scene.get(), sample.weights.data()), sample.name);
    brume_format format = sample.format;
    const brume_layer wanted = layer_named(output_.c_str(), nullptr);
    if (!output_.empty()) {
        format.outputs = &wanted;
        format.output_count = 1;
    }
    brume_plan plan = nullptr;
    check_request(context, brume_plan_create(scene.get(), &format, &plan), "");
    plan_.reset(plan);
    pixels_.resize(sample.color.size());
    if (!output_.empty())
        extra_.resize(3 * sample.depth.size());
}

double SettingRun::execute()
{
    const int w = sample_.width(), h = sample_.height();
    // Inputs are only read.
    const brume_image color = host_image(const_cast<float *>(sample_.color.data()), w, h, sample_.channels);
    const brume_image depth = host_image(const_cast<float *>(sample_.depth.data()), w, h, 1);
    const brume_image out = host_image(pixels_.data(), w, h, sample_.channels), other = host_image(extra_.data(), w, h, 3);
    const brume_layer extra = layer_named(output_.c_str(), &other);
    brume_frame frame = BRUME_FRAME_INIT;
    frame.color = &color;
    frame.depth = &depth;
    frame.output = &out;
    frame.camera = &sample_.camera;
    frame.frame = sample_.frame;
    if (!output_.empty()) {
        frame.outputs = &extra;
        frame.output_count = 1;
    }
    check_request(context_, brume_plan_execute(plan_.get(), &frame), sample_.name);
    double ms = 0;
    for_entries(context_, plan_.get(), [&](const brume_plan_entry &entry) {
        // The library's own passes, such as those for Gaussians, are under its own name.
        if (entry.effect == effect_ || entry.effect == std::string("brume"))
            ms += entry.measured_ms;
    });
    return ms;
}

bool SettingRun::runs(const std::string &effect) const
{
    bool found = false;
    for_entries(context_, plan_.get(), [&](const brume_plan_entry &entry) { found |= entry.effect == effect; });
    return found;
}

std::uint64_t SettingRun::bytes() const
{
    brume_plan_info info = BRUME_PLAN_INFO_INIT;
    check_request(context_, brume_plan_get_info(plan_.get(), &info), "plan");
    return info.image_bytes + (pixels_.size() + extra_.size()) * sizeof(float);
}

}  // namespace brume::tool
