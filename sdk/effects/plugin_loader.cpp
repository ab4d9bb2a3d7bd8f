#include "effects/plugin_loader.h"

#include <dlfcn.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <filesystem>
#include <stdexcept>

#include <fmt/format.h>

#include "base/text.h"

namespace brume {
namespace {

constexpr uint32_t largest_struct = 1024;
constexpr uint32_t most_parameters = 256;
constexpr uint32_t most_of_others = 64;  // layers, products made, products used
constexpr size_t longest_name = 63;
constexpr size_t longest_text = 4095;
constexpr double largest_integer = 9007199254740992.0;  // 2^53: beyond it a double skips integers

struct Refusal : std::runtime_error {
    using std::runtime_error::runtime_error;
};

template <class... Arguments> [[noreturn]] void refuse(fmt::format_string<Arguments...> format, Arguments &&...arguments)
{
    throw Refusal(fmt::format(format, std::forward<Arguments>(arguments)...));
}

// The plugin's struct as this library knows it: what its struct_size does not cover keeps the defaults.
template <class T> T copy_sized(const void *source, T defaults, const std::string &what)
{
    uint32_t size = 0;
    std::memcpy(&size, source, sizeof size);
    if (size < sizeof size || size > largest_struct)
        refuse("{}.struct_size: {}; expected {}", what, size, sizeof(T));
    std::memcpy(&defaults, source, std::min<size_t>(size, sizeof(T)));
    const auto *bytes = static_cast<const unsigned char *>(source);
    for (size_t i = sizeof(T); i < size; ++i)
        if (bytes[i] != 0)
            refuse("{}: uses fields that this library does not know ({} bytes; expected {})", what, size, sizeof(T));
    return defaults;
}

std::string copy_text(const char *text, const std::string &what)
{
    if (!text)
        refuse("{}: NULL; expected a string", what);
    const size_t length = strnlen(text, longest_text + 1);
    if (length > longest_text)
        refuse("{}: longer than {} bytes", what, longest_text);
    const std::string copy(text, length);
    if (!valid_utf8(copy))
        refuse("{}: {}; expected UTF-8", what, in_quotes(copy));
    if (copy.find_first_of("\r\n") != std::string::npos)
        refuse("{}: {}; expected one line", what, in_quotes(copy));
    return copy;
}

std::string copy_name(const char *text, const std::string &what)
{
    const std::string name = copy_text(text, what);
    const auto lower = [](char c) { return c >= 'a' && c <= 'z'; };
    const auto inner = [&](char c) { return lower(c) || (c >= '0' && c <= '9') || c == '_'; };
    if (name.empty() || name.size() > longest_name || !lower(name[0]) || !std::all_of(name.begin(), name.end(), inner))
        refuse("{}: {}; expected [a-z][a-z0-9_]*, at most {} bytes", what, in_quotes(name), longest_name);
    return name;
}

std::vector<std::string> split_choices(const std::string &text, const std::string &what)
{
    std::vector<std::string> choices;
    for (size_t begin = 0; begin <= text.size();) {
        const size_t end = std::min(text.find('|', begin), text.size());
        const std::string choice = text.substr(begin, end - begin);
        const bool plain = !choice.empty() && std::all_of(choice.begin(), choice.end(), [](char c) {
            return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || std::strchr("_-+.", c);
        });
        if (!plain)
            refuse("{}: {}; expected words of letters, digits and _-+. with | between them", what, in_quotes(text));
        if (std::find(choices.begin(), choices.end(), choice) != choices.end())
            refuse("{}: {}; {} is there twice", what, in_quotes(text), in_quotes(choice));
        choices.push_back(choice);
        begin = end + 1;
    }
    return choices;
}

void check_numbers(const Parameter &parameter, const std::string &what)
{
    const double numbers[] = {parameter.minimum, parameter.default_value, parameter.maximum};
    for (double number : numbers) {
        if (!std::isfinite(number))
            refuse("{}: range {} to {}, default {}; expected finite numbers", what, numbers[0], numbers[2], numbers[1]);
        const bool integral = number == std::floor(number) && std::abs(number) <= largest_integer;
        if (parameter.type != BRUME_PARAMETER_NUMBER && !integral)
            refuse("{}: range {} to {}, default {}; expected integers", what, numbers[0], numbers[2], numbers[1]);
    }
    if (!(numbers[0] <= numbers[1] && numbers[1] <= numbers[2]))
        refuse("{}: default {}; expected one in the range {} to {}", what, numbers[1], numbers[0], numbers[2]);
}

Parameter copy_parameter(const brume_parameter_info &info, const std::string &index)
{
    Parameter parameter;
    parameter.name = copy_name(info.name, index + ".name");
    const std::string what = fmt::format("parameter {}", in_quotes(parameter.name));
    parameter.help = copy_text(info.help, what + ".help");
    parameter.unit = info.unit ? copy_text(info.unit, what + ".unit") : "";
    parameter.choices_text = info.choices ? copy_text(info.choices, what + ".choices") : "";
    parameter.alias = info.alias && *info.alias ? copy_name(info.alias, what + ".alias") : "";
    parameter.type = info.type;
    parameter.default_value = info.default_number;
    switch (info.type) {
    case BRUME_PARAMETER_NUMBER:
    case BRUME_PARAMETER_INTEGER:
        parameter.minimum = info.minimum;
        parameter.maximum = info.maximum;
        break;
    case BRUME_PARAMETER_BOOLEAN:
        parameter.maximum = 1.0;
        break;
    case BRUME_PARAMETER_CHOICE:
        parameter.choices = split_choices(parameter.choices_text, what + ".choices");
        parameter.maximum = double(parameter.choices.size() - 1);
        break;
    default:
        refuse("{}.type: {}; expected a BRUME_PARAMETER_... of this library", what, info.type);
    }
    if (info.type != BRUME_PARAMETER_CHOICE && !parameter.choices_text.empty())
        refuse("{}.choices: {}; expected \"\" for a parameter that is no choice", what, in_quotes(parameter.choices_text));
    check_numbers(parameter, what);
    return parameter;
}

// The elements of a table of the effect's, each as the struct that this library knows; take(info, "table[i]").
template <class Info, class Take>
void for_infos(const Info *first, uint32_t count, uint32_t most, const char *table, const Info &defaults, Take take)
{
    if (count > most)
        refuse("{}: {} of them; expected at most {}", table, count, most);
    if (count > 0 && !first)
        refuse("{}: NULL; expected {} of them", table, count);
    const auto *entry = reinterpret_cast<const unsigned char *>(first);
    uint32_t stride = 0;
    for (uint32_t i = 0; i < count; ++i, entry += stride) {
        const std::string index = fmt::format("{}[{}]", table, i);
        const auto info = copy_sized<Info>(entry, defaults, index);
        if (i == 0)
            stride = info.struct_size;
        if (info.struct_size != stride || stride % alignof(Info) != 0)
            refuse("{}.struct_size: {}; expected {}", index, info.struct_size, sizeof(Info));
        take(info, index);
    }
}

std::vector<Parameter> copy_parameters(const brume_effect &table)
{
    std::vector<Parameter> parameters;
    for_infos(table.parameters, table.parameter_count, most_parameters, "parameters",
              brume_parameter_info BRUME_PARAMETER_INFO_INIT,
              [&](const brume_parameter_info &info, const std::string &index) {
                  Parameter parameter = copy_parameter(info, index);
                  for (const Parameter &earlier : parameters)
                      for (const std::string &name : {parameter.name, parameter.alias})
                          if (!name.empty() && (name == earlier.name || name == earlier.alias))
                              refuse("{}.name: {}; another parameter has that name", index, in_quotes(name));
                  parameters.push_back(std::move(parameter));
              });
    return parameters;
}

Layer copy_layer(const brume_layer_info &info, const std::string &index)
{
    constexpr uint32_t directions = BRUME_LAYER_INPUT | BRUME_LAYER_OUTPUT;
    Layer layer{copy_name(info.name, index + ".name"), copy_text(info.help, index + ".help"), info.flags, info.channels};
    const uint32_t direction = info.flags & directions;
    if (direction != BRUME_LAYER_INPUT && direction != BRUME_LAYER_OUTPUT)
        refuse("{}.flags: {:#x}; expected one of BRUME_LAYER_INPUT and BRUME_LAYER_OUTPUT", index, info.flags);
    if (info.flags & ~(directions | BRUME_LAYER_NEEDED | BRUME_LAYER_OF_LIGHT | BRUME_LAYER_ANY_SIZE))
        refuse("{}.flags: {:#x}; expected BRUME_LAYER_... flags of this library", index, info.flags);
    if (info.flags & BRUME_LAYER_NEEDED && direction != BRUME_LAYER_INPUT)
        refuse("{}.flags: {:#x}; expected BRUME_LAYER_NEEDED of inputs only", index, info.flags);
    if (info.flags & BRUME_LAYER_ANY_SIZE && direction != BRUME_LAYER_INPUT)
        refuse("{}.flags: {:#x}; expected BRUME_LAYER_ANY_SIZE of inputs only", index, info.flags);
    if (info.channels != 1 && info.channels != 3)
        refuse("{}.channels: {}; expected 1 or 3", index, info.channels);
    return layer;
}

std::vector<Layer> copy_layers(const brume_effect &table)
{
    std::vector<Layer> layers;
    for_infos(table.layers, table.layer_count, most_of_others, "layers", brume_layer_info BRUME_LAYER_INFO_INIT,
              [&](const brume_layer_info &info, const std::string &index) {
                  Layer layer = copy_layer(info, index);
                  for (const Layer &earlier : layers)
                      if (earlier.name == layer.name && ((earlier.flags ^ layer.flags) & BRUME_LAYER_INPUT) == 0)
                          refuse("{}.name: {}; another layer has that name", index, in_quotes(layer.name));
                  layers.push_back(std::move(layer));
              });
    return layers;
}

std::vector<std::string> copy_names(const char *const *names, uint32_t count, const char *table)
{
    if (count > most_of_others || (count > 0 && !names))
        refuse("{}: {}; expected at most {}", table, names ? fmt::format("{} of them", count) : "NULL", most_of_others);
    std::vector<std::string> copies;
    for (uint32_t i = 0; i < count; ++i) {
        copies.push_back(copy_name(names[i], fmt::format("{}[{}]", table, i)));
        if (std::find(copies.begin(), copies.end() - 1, copies.back()) != copies.end() - 1)
            refuse("{}[{}]: {} is there twice", table, i, in_quotes(copies.back()));
    }
    return copies;
}

std::vector<std::string> copy_scenes(const brume_effect &table)
{
    const uint32_t count = table.scenes ? table.scene_count : 0;
    if (count > most_of_others)
        refuse("scenes: {} of them; expected at most {}", count, most_of_others);
    for (uint32_t i = 0; i < count; ++i)
        if (!table.scenes[i])
            refuse("scenes[{}]: NULL; expected a scene file's text", i);
    return {table.scenes, table.scenes + count};
}

void copy_table(const brume_effect *source, Effect &effect)
{
    // Before all else: what lies behind it is another struct in another ABI.
    uint32_t head[2] = {};
    std::memcpy(head, source, sizeof head);
    if (head[0] >= sizeof head && head[0] <= largest_struct && head[1] != BRUME_PLUGIN_ABI)
        refuse("made for plugin ABI {}; this library knows ABI {}", head[1], BRUME_PLUGIN_ABI);
    const auto table = copy_sized<brume_effect>(source, brume_effect{}, "effect");
    if (table.abi != BRUME_PLUGIN_ABI)
        refuse("made for plugin ABI {}; this library knows ABI {}", table.abi, BRUME_PLUGIN_ABI);
    effect.name = copy_name(table.name, "effect.name");
    effect.help = copy_text(table.help, "effect.help");
    if (table.thread_safety > BRUME_THREADS_SAFE)
        refuse("effect.thread_safety: {}; expected a BRUME_THREADS_... of this library", table.thread_safety);
    if (table.wanted > BRUME_WANTED_WITH_LAYERS)
        refuse("effect.wanted: {}; expected a BRUME_WANTED_... of this library", table.wanted);
    if (!table.plan || !table.execute || !table.destroy)
        refuse("effect.{}: NULL; expected a function", !table.plan ? "plan" : !table.execute ? "execute" : "destroy");
    effect.order = table.order;
    effect.wanted = table.wanted;
    effect.parameters = copy_parameters(table);
    effect.layers = copy_layers(table);
    effect.makes = copy_names(table.makes, table.make_count, "makes");
    effect.uses = copy_names(table.uses, table.use_count, "uses");
    effect.scenes = copy_scenes(table);
    effect.table = source;
    effect.offer = table.offer;
    effect.makes_with = table.makes_with;
    effect.settle = table.settle;
    effect.uses_with = table.uses_with;
}

std::shared_ptr<void> open_library(const std::string &file)
{
    if (!std::filesystem::is_regular_file(file))
        refuse("cannot be loaded: not a regular file");
    void *library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!library)
        refuse("cannot be loaded: {}", dlerror());
    return {library, [](void *handle) { dlclose(handle); }};
}

const brume_effect *ask_for_table(void *library)
{
    const auto entry = reinterpret_cast<brume_plugin_effect_function>(dlsym(library, BRUME_PLUGIN_ENTRY));
    if (!entry)
        refuse("does not export " BRUME_PLUGIN_ENTRY);
    const brume_effect *table = nullptr;
    try {
        table = entry(BRUME_PLUGIN_ABI);
    } catch (const std::exception &exception) {
        refuse(BRUME_PLUGIN_ENTRY " threw an exception: {}", in_quotes(exception.what()));
    } catch (...) {
        refuse(BRUME_PLUGIN_ENTRY " threw something that is not a std::exception");
    }
    if (!table)
        refuse(BRUME_PLUGIN_ENTRY " returned NULL: it cannot work with plugin ABI {}", BRUME_PLUGIN_ABI);
    return table;
}

}  // namespace

Effect load_plugin(const std::string &file)
{
    // Outlives whatever of the plugin is still in use below.
    std::shared_ptr<void> library;
    try {
        library = open_library(file);
        Effect effect;
        copy_table(ask_for_table(library.get()), effect);
        effect.file = file;
        effect.library = library;
        return effect;
    } catch (const std::exception &refusal) {
        return refused_plugin(file, refusal.what());
    }
}

Effect refused_plugin(const std::string &file, const std::string &refusal)
{
    Effect effect;
    effect.name = std::filesystem::path(file).filename().string();
    effect.file = file;
    effect.refusal = refusal;
    return effect;
}

}  // namespace brume
