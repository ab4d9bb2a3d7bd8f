#include "settings.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <initializer_list>
#include <iterator>

#include <fmt/format.h>

namespace openfx {

using namespace ofx;

const char *const channel_names[4] = {"Red", "Green", "Blue", "Alpha"};

namespace {

constexpr const char *fog = "fog", *depth = "depth", *camera = "camera";

struct Number {
    const char *group, *name, *label, *hint;
    double Settings::*field;
    double initial, least, most, display_most;
};

const Number numbers[] = {
    {fog, "visibility", "Visibility", "Distance [m] at which contrast has fallen to 2 %: extinction is 3.912 / visibility",
     &Settings::visibility, 150, 1e-3, 1e9, 5000},
    {fog, "anisotropy", "Anisotropy", "Mean cosine of what is scattered; fog has about 0.8", &Settings::g, .8, -1, 1, 1},
    {fog, "heightFalloff", "Height falloff",
     "The fog thins with height above the ground by this exponent [1/m]; 0: it does not", &Settings::falloff, 0, 0, 1e6, 1},
    {depth, "near", "Near", "Distance at depth 0, of normalized and device depth, in depth's unit", &Settings::near_distance,
     .1, 0, 1e9, 10},
    {depth, "far", "Far",
     "Distance at depth 1, of normalized and device depth, in depth's unit; smaller than near where depth is reversed",
     &Settings::far_distance, 1000, 0, 1e9, 10000},
    {depth, "depthScale", "Metres per unit", "Length of depth's unit [m]: 0.01 where depth is in centimetres",
     &Settings::metres, 1, 1e-9, 1e9, 10},
    {depth, "skyDistance", "Sky distance", "Where the sky is, in depth's unit, if it is at a distance",
     &Settings::sky_distance, 500, 0, 1e9, 5000},
    {camera, "verticalFov", "Vertical field of view", "Of the project's height [degrees]", &Settings::vertical_fov, 50, .01,
     179.9, 120},
    {camera, "cameraHeight", "Camera height",
     "Above the ground [m], where fog that falls off with height has its visibility", &Settings::camera_height, 1.7, -1e6,
     1e6, 100},
    {camera, "cameraTilt", "Camera tilt", "Upwards [degrees]", &Settings::camera_tilt, 0, -90, 90, 90},
};

struct Color {
    const char *name, *label, *hint;
    double (Settings::*field)[3];
    double initial;
};

const Color colors[] = {
    {"scattering", "Scatters", "Share of the extinction that scatters light", &Settings::scattering, 1},
    {"absorption", "Absorbs", "Share of the extinction that absorbs light", &Settings::absorption, 0},
};

struct Choice {
    const char *group, *name, *label, *hint;
    int Settings::*field;
    int initial;
    std::initializer_list<const char *> options;  // in the order of the C ABI's constants
};

const Choice choices[] = {
    {fog,
     "quality",
     "Quality",
     "What the picture may differ by from the reference",
     &Settings::quality,
     BRUME_PRESET_NONE,
     {"As the scene says", "Draft", "Standard", "Final", "Reference"}},
    {depth,
     "depthChannel",
     "Depth channel",
     "Where RGB or RGBA holds depth",
     &Settings::depth_channel,
     0,
     {channel_names[0], channel_names[1], channel_names[2], channel_names[3]}},
    {depth,
     "depthKind",
     "Depth kind",
     "Along the optical axis, along the pixel's ray, 1 / planar, 0 to 1 evenly, or a depth buffer's",
     &Settings::depth_kind,
     BRUME_DEPTH_PLANAR,
     {"Planar", "Ray", "Inverse", "Normalized", "Device"}},
    {depth,
     "sky",
     "Sky",
     "What lies where depth is infinite, 0 or less: behind all of the fog, without fog, or at a distance",
     &Settings::sky,
     BRUME_SKY_FOG,
     {"In fog", "Without fog", "At a distance"}},
};

constexpr const char *scene_file_name = "sceneFile";

Properties define(ParameterSet parameters, const char *type, const char *name, const char *label)
{
    PropertySet set = nullptr;
    if (suites.parameters->define(parameters, type, name, &set) != ok)
        throw Refusal(fmt::format("{}: the host takes no parameter of type {}", name, type));
    const Properties properties = set;
    properties.set(property::label, label);
    return properties;
}

ParameterSet parameters_of(EffectHandle effect)
{
    ParameterSet parameters = nullptr;
    if (suites.effects->get_parameter_set(effect, &parameters) != ok)
        throw Refusal("The host has lost the parameters");
    return parameters;
}

ParameterHandle handle(ParameterSet parameters, const char *name)
{
    ParameterHandle parameter = nullptr;
    if (suites.parameters->get_handle(parameters, name, &parameter, nullptr) != ok)
        throw Refusal(fmt::format("{}: the host has lost this parameter", name));
    return parameter;
}

template <class... Values> void read(ParameterSet parameters, const char *name, Time time, Values *...values)
{
    if (suites.parameters->get_value_at_time(handle(parameters, name), time, values...) != ok)
        throw Refusal(fmt::format("{}: the host gives no value at time {}", name, time));
}

void check(const char *label, double value, double least, double most)
{
    if (!(value >= least && value <= most))
        throw Refusal(fmt::format("{}: {}; expected {} to {}", label, value, least, most));
}

std::string text_of(const std::string &file)
{
    std::ifstream stream(file, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (!stream)
        throw Refusal(fmt::format("Scene file: \"{}\": {}; expected a Brume scene", file, std::strerror(errno)));
    return text;
}

}  // namespace

void define_settings(ParameterSet parameters, bool filter)
{
    const std::initializer_list<const char *> groups[] = {{fog, "Fog"}, {depth, "Depth"}, {camera, "Camera"}};
    for (const auto &group : groups)
        define(parameters, type::group, group.begin()[0], group.begin()[1]);
    for (const Color &one : colors) {
        const Properties color = define(parameters, type::rgb, one.name, one.label);
        color.set(property::hint, one.hint);
        color.set(property::parent, fog);
        for (int i = 0; i < 3; ++i)
            color.set(property::initial, one.initial, i);
    }
    for (const Number &one : numbers) {
        const Properties number = define(parameters, type::number, one.name, one.label);
        number.set(property::hint, one.hint);
        number.set(property::parent, one.group);
        number.set(property::initial, one.initial);
        number.set(property::digits, 4);
        number.set(property::least, one.least);
        number.set(property::most, one.most);
        number.set(property::display_least, std::max(one.least, -one.display_most));
        number.set(property::display_most, one.display_most);
    }
    for (const Choice &one : choices) {
        const Properties choice = define(parameters, type::choice, one.name, one.label);
        choice.set(property::hint, one.hint);
        choice.set(property::parent, one.group);
        int count = 0;
        for (const char *option : one.options)
            choice.set(property::option, option, count++);
        choice.set(property::initial, filter && one.field == &Settings::depth_channel ? 3 : one.initial);
    }
    const Properties file = define(parameters, type::string, scene_file_name, "Scene file");
    file.set(property::hint, "Replaces the fog above, and the camera where it has one");
    file.set(property::parent, fog);
    file.set(property::string_mode, property::file_path);
    file.set(property::file_exists, 1);
}

std::string scene_file(EffectHandle effect, Time time)
{
    char *file = nullptr;
    read(parameters_of(effect), scene_file_name, time, &file);
    return file ? file : "";
}

Settings read_settings(EffectHandle effect, Time time)
{
    const ParameterSet parameters = parameters_of(effect);
    Settings settings{};
    for (const Number &one : numbers) {
        read(parameters, one.name, time, &(settings.*one.field));
        check(one.label, settings.*one.field, one.least, one.most);
    }
    for (const Color &one : colors) {
        double(&values)[3] = settings.*one.field;
        read(parameters, one.name, time, &values[0], &values[1], &values[2]);
        for (double value : values)
            check(one.label, value, 0, 1e6);
    }
    for (const Choice &one : choices) {
        read(parameters, one.name, time, &(settings.*one.field));
        check(one.label, settings.*one.field, 0, double(one.options.size() - 1));
    }
    settings.scene_file = scene_file(effect, time);
    if (!settings.scene_file.empty())
        settings.scene_text = text_of(settings.scene_file);
    return settings;
}

}  // namespace openfx
