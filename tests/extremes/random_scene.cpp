#include "random_scene.h"

#include <cmath>

namespace extremes {

std::vector<ParameterKind> parameters_of(brume_context context)
{
    std::vector<ParameterKind> all;
    for (uint32_t e = 0; e < brume_effect_count(context); ++e) {
        brume_effect_info effect = BRUME_EFFECT_INFO_INIT;
        brume_effect_get_info(context, e, &effect);
        for (uint32_t i = 0; i < effect.parameter_count; ++i) {
            brume_parameter_info p = BRUME_PARAMETER_INFO_INIT;
            brume_parameter_get_info(context, effect.name, i, &p);
            ParameterKind kind{effect.name, p.name, p.type, p.minimum, p.maximum, {}};
            for (std::string rest = p.choices; !rest.empty();) {
                const size_t bar = rest.find('|');
                kind.choices.push_back(rest.substr(0, bar));
                rest = bar == std::string::npos ? "" : rest.substr(bar + 1);
            }
            all.push_back(kind);
        }
    }
    return all;
}

RandomScenes::RandomScenes(uint64_t seed, std::vector<ParameterKind> parameters)
    : random_(seed), parameters_(std::move(parameters))
{
}

double RandomScenes::magnitude(double low, double high)
{
    return chance(0.1) ? 0.0 : std::pow(10, uniform(low, high));
}

RandomScenes::Json RandomScenes::nonsense()
{
    const Json all[] = {nullptr, true,   "1", Json::array(), Json::object(), -1,    1e31, 1e300,
                        1e-320,  -1e-40, 0.5, "constant",    {1, 2},         {{1}}, -0.0, 181};
    return all[below(std::size(all))];
}

RandomScenes::Json RandomScenes::value(double low, double high)
{
    if (chance(faults_))
        return nonsense();
    if (chance(0.1))
        return chance(0.5) ? low : high;
    if (low < 0)
        return (chance(0.5) ? 1 : -1) * std::min(magnitude(-30, std::log10(high)), high);
    if (high <= 200)
        return uniform(low, high);
    return std::clamp(chance(0.7) ? magnitude(-4, 2) : magnitude(-30, 30), low, high);
}

RandomScenes::Json RandomScenes::keyed(double low, double high)
{
    if (!chance(0.05))
        return value(low, high);
    Json keys = Json::array();
    for (double frame = uniform(-5, 1); keys.size() < 3; frame += uniform(0.1, 4))
        keys.push_back({frame, value(low, high)});
    return {{"keys", keys}};
}

RandomScenes::Json RandomScenes::rgb(double low, double high)
{
    return chance(0.5) ? keyed(low, high) : Json{keyed(low, high), keyed(low, high), keyed(low, high)};
}

RandomScenes::Json RandomScenes::vector(double extent)
{
    Json v = Json::array();
    while (v.size() < (chance(0.3 * faults_) ? 2u : 3u))
        v.push_back(chance(0.9) ? Json(uniform(-extent, extent)) : keyed(-1e30, 1e30));
    return v;
}

RandomScenes::Json RandomScenes::direction()
{
    return chance(0.3) ? Json{0, chance(0.5) ? 1 : -1, 0} : vector(1);
}

// A turn about y, sometimes far from the origin.
RandomScenes::Json RandomScenes::pose()
{
    const double a = uniform(0, 7), far = chance(0.1) ? 1e6 : 1;
    Json m = {{std::cos(a), 0, std::sin(a), far}, {0, 1, 0, -far}, {-std::sin(a), 0, std::cos(a), far}, {0, 0, 0, 1}};
    if (chance(faults_))
        m[below(4)][below(4)] = value(-1e30, 1e30);
    return m;
}

RandomScenes::Json RandomScenes::medium()
{
    Json m = Json::object();
    if (chance(0.9))
        m["scattering"] = rgb(0, 1e30);
    else
        m["visibility"] = keyed(1e-30, 1e30);
    if (chance(0.5))
        m["absorption"] = rgb(0, 1e30);
    if (chance(0.2))
        m["emission"] = rgb(0, 1e30);
    if (chance(0.5))
        m["g"] = keyed(-1, 1);
    else if (chance(0.2))
        m["droplet_diameter"] = keyed(5, 50);
    if (chance(0.7)) {
        Json density = Json::array();
        for (size_t i = below(4); density.size() <= i;) {
            switch (below(3)) {
            case 0:
                density.push_back({{"type", "constant"}, {"value", keyed(0, 1e30)}});
                break;
            case 1:
                density.push_back({{"type", "exponential"}, {"falloff", keyed(0, 1e30)}, {"direction", direction()}});
                if (chance(0.5))
                    density.back()["origin"] = vector(20);
                break;
            default:
                density.push_back({{"type", "gaussian"}, {"center", vector(20)}, {"scale", keyed(1e-30, 1e30)}});
                if (chance(0.8))
                    density.back()["amplitude"] = keyed(0, 1e30);
                if (chance(0.2))
                    density.back()["colour"] = rgb(0, 1);
            }
        }
        m["density"] = density;
    }
    if (chance(0.1))
        m["noise"] = {{"strength", keyed(0, 10)}, {"scale", keyed(1e-6, 1e9)}, {"seed", below(70000)}};
    return m;
}

RandomScenes::Json RandomScenes::light()
{
    switch (below(3)) {
    case 0:
        return {{"type", "point"}, {"position", vector(20)}, {"intensity", rgb(0, 1e30)}, {"radius", keyed(0, 1e30)}};
    case 1:
        return {{"type", "spot"},         {"position", vector(20)}, {"direction", direction()}, {"intensity", rgb(0, 1e30)},
                {"angle", keyed(0, 180)}, {"penumbra", keyed(0, 1)}};
    default:
        return {
            {"type", "directional"}, {"direction", direction()}, {"intensity", rgb(0, 1e30)}, {"distance", keyed(0, 1e30)}};
    }
}

RandomScenes::Json RandomScenes::effects()
{
    Json all = Json::object();
    for (const ParameterKind &p : parameters_) {
        if (!chance(all.contains(p.effect) ? 0.3 : 0.1))
            continue;
        Json &to = all[p.effect][chance(0.3 * faults_) ? p.name + "s" : p.name];
        if (chance(faults_))
            to = nonsense();
        else if (p.type == BRUME_PARAMETER_BOOLEAN)
            to = chance(0.5);
        else if (p.type == BRUME_PARAMETER_CHOICE)
            to = p.choices[below(p.choices.size())];
        else if (p.type == BRUME_PARAMETER_INTEGER)
            to = std::floor(uniform(p.minimum, p.maximum + 1));
        else
            to = value(p.minimum, p.maximum);
    }
    return all;
}

RandomScenes::Json RandomScenes::scene(double faults)
{
    faults_ = faults;
    Json s{{"brume", 1}};
    if (chance(0.1))
        s["metres_per_unit"] = value(1e-30, 1e30);
    s["camera"] = {{chance(0.9) ? "vertical_fov" : "horizontal_fov", keyed(1e-3, 179)}, {"camera_to_world", pose()}};
    if (chance(0.1))
        s["camera"]["pixel_aspect"] = value(1e-3, 1e3);
    if (chance(0.97))
        s["medium"] = medium();
    if (chance(0.6)) {
        s["lights"] = Json::array();
        for (size_t i = below(4); i > 0; --i)
            s["lights"].push_back(light());
    }
    if (chance(0.1)) {
        s["environment"]["sh"] = Json::array();
        for (size_t i = chance(0.5) ? 1 : 9; i > 0; --i)
            s["environment"]["sh"].push_back({value(-1e30, 1e30), value(-1e30, 1e30), value(-1e30, 1e30)});
    }
    if (chance(0.7))
        s["effects"] = effects();
    if (chance(faults))
        s["fog"] = 1;
    return s;
}

std::string RandomScenes::mutated(std::string text)
{
    static const std::string fragments[] = {"{",
                                            "}",
                                            "[",
                                            "]",
                                            ",",
                                            ":",
                                            "\"",
                                            "\\",
                                            "null",
                                            "true",
                                            "-",
                                            "1e308",
                                            "1e-320",
                                            "0.1",
                                            "\"keys\":",
                                            "[[1,2]]",
                                            "\n",
                                            "\xff",
                                            "\xc3\xa9",
                                            "\\ud800",
                                            "\\u00e9",
                                            "//",
                                            "\"density\":",
                                            "\t",
                                            "\r\n",
                                            "[[[[[",
                                            "\"medium\":",
                                            "{}",
                                            "99999999999999999999",
                                            "\xed\xa0\x80",
                                            "NaN"};
    for (size_t edits = 1 + below(4); edits > 0 && !text.empty(); --edits) {
        const size_t at = below(text.size() + 1);
        const size_t length = below(1 + std::min<size_t>(text.size() - at, 12));
        switch (below(6)) {
        case 0:
            text.replace(at, length, 1, char(below(256)));
            break;
        case 1:
            text.erase(at, length);
            break;
        case 2:
            text.insert(at, text.substr(at, length));
            break;
        case 3:
            text.insert(below(text.size() + 1), text.substr(at, length));
            break;
        case 4:
            text.replace(at, below(2) ? length : 0, fragments[below(std::size(fragments))]);
            break;
        default:
            text.resize(below(8) ? text.size() : at);
        }
    }
    return text;
}

}  // namespace extremes
