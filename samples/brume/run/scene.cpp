#include "run/scene.hpp"

#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "environment/environment.hpp"
#include "support/error.hpp"

namespace brume::tool {

SceneText read_scene(const std::string &path, const std::vector<std::string> &set)
{
    std::ifstream in(path, std::ios::binary);
    if (!in)
        throw RequestError(fmt::format("{}: scene file cannot be opened for reading", path));
    return {{std::istreambuf_iterator<char>(in), {}}, path, set};
}

SceneHandle make_scene(brume_context context, const SceneText &text)
{
    brume_scene scene = nullptr;
    check_request(context,
                  brume_scene_create_from_text(context, text.text.data(), text.text.size(), text.name.c_str(), &scene), "");
    SceneHandle handle(scene);
    for (const std::string &set : text.set) {
        const auto equals = set.find('=');
        const auto dot = set.rfind('.', equals);
        if (equals == std::string::npos || dot == std::string::npos || dot == 0 || dot + 1 == equals)
            throw RequestError(fmt::format("--set '{}': expected EFFECT.PARAM=VALUE", set));
        const std::string effect = set.substr(0, dot), parameter = set.substr(dot + 1, equals - dot - 1),
                          value = set.substr(equals + 1);
        check_request(context, brume_scene_set_text(scene, effect.c_str(), parameter.c_str(), value.c_str()),
                      "--set " + set);
    }
    resolve_environment(context, scene);
    return handle;
}

}  // namespace brume::tool
