#pragma once
// Effects that read a layer of each light, through the C ABI.
#include "lit_scene.h"

namespace fog {

// layers: by name, in world axes; groups: light_group of each light, if any.
inline Picture relit(brume_context context, const Json &scene_json, const Picture &color, const Picture &depth,
                     const std::map<std::string, Picture> &layers = {}, const std::vector<Picture> &groups = {})
{
    Options options;
    options.inputs = layers;
    if (!groups.empty())
        options.inputs_of_lights["light_group"] = groups;
    return run(context, scene_json.dump(), color, depth, options).output;
}

}  // namespace fog
