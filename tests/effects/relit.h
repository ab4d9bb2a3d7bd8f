#pragma once
// Effects that read a layer of each light, through the C ABI.
#include <deque>

#include "lit_scene.h"

namespace fog {

// layers: by name, in world axes; groups: light_group of each light, if any.
inline Picture relit(brume_context context, const Json &scene_json, const Picture &color, const Picture &depth,
                     const std::map<std::string, Picture> &layers = {}, const std::vector<Picture> &groups = {})
{
    const std::string text = scene_json.dump();
    brume_scene scene = nullptr;
    Context::check(brume_scene_create_from_text(context, text.data(), text.size(), "test.json", &scene), context);
    std::unique_ptr<brume_scene_t, decltype(&brume_scene_destroy)> scene_guard(scene, brume_scene_destroy);
    std::deque<brume_image> images;
    std::vector<brume_layer> named, given;
    for (auto &[name, picture] : layers) {
        named.push_back(layer(name.c_str()));
        given.push_back(layer(name.c_str(), &images.emplace_back(describe(picture))));
    }
    if (!groups.empty())
        named.push_back(layer("light_group"));
    for (size_t l = 0; l < groups.size(); ++l)
        given.push_back(layer("light_group", &images.emplace_back(describe(groups[l])), uint32_t(l)));
    brume_format format = BRUME_FORMAT_INIT;
    format.width = color.width;
    format.height = color.height;
    format.inputs = named.data();
    format.input_count = uint32_t(named.size());
    brume_plan plan = nullptr;
    Context::check(brume_plan_create(scene, &format, &plan), context);
    std::unique_ptr<brume_plan_t, decltype(&brume_plan_destroy)> plan_guard(plan, brume_plan_destroy);
    Picture output(color.width, color.height, color.channels);
    brume_image c = describe(color), d = describe(depth), o = describe(output);
    brume_frame frame = BRUME_FRAME_INIT;
    frame.color = &c;
    frame.depth = &d;
    frame.output = &o;
    frame.inputs = given.data();
    frame.input_count = uint32_t(given.size());
    Context::check(brume_plan_execute(plan, &frame), context);
    return output;
}

}  // namespace fog
