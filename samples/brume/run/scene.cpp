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

Scene make_scene(const Context &context, const SceneText &text)
{
    Scene scene(context, text.text, text.name);
    check_request(context, scene.status(), "");
    for (const std::string &set : text.set) {
        const auto equals = set.find('=');
        const auto dot = set.rfind('.', equals);
        if (equals == std::string::npos || dot == std::string::npos || dot == 0 || dot + 1 == equals)
            throw RequestError(fmt::format("--set '{}': expected EFFECT.PARAM=VALUE", set));
        const std::string effect = set.substr(0, dot), parameter = set.substr(dot + 1, equals - dot - 1),
                          value = set.substr(equals + 1);
        check_request(context, scene.set(effect, parameter, value), "--set " + set);
    }
    resolve_environment(context, scene);
    return scene;
}

}  // namespace brume::tool
