#include "run/inputs.hpp"

#include <algorithm>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "frames/pattern.hpp"
#include "image/formats.hpp"
#include "run/layers.hpp"
#include "support/error.hpp"
#include "support/nearest.hpp"

namespace brume::tool {
namespace {

void add_once(std::vector<std::string> &roles, const std::string &role)
{
    if (std::find(roles.begin(), roles.end(), role) == roles.end())
        roles.push_back(role);
}

/// Where its pixels would not be the picture's.
void check_display(const ImageFile &file, const ColorChoice &color, const OpenInput &input)
{
    if (!input.file)
        return;
    const Window &display = file.part(color.part).display_window;
    const Window &other = input.file->part(input.choice.part).display_window;
    const auto text = [](const Window &w) {
        return fmt::format("{} x {} at ({}, {})", w.width(), w.height(), w.min.x, w.min.y);
    };
    if (other != display)
        throw RequestError(fmt::format("{}: --input {}: '{}' has the display window {}; expected {}, as {} has",
                                       input.file->path().string(), input.choice.role, input.choice.label(), text(other),
                                       text(display), file.path().string()));
}

OpenInput open_shadow(const ShadowFile &shadow, int frame, const ReadLimits &limits)
{
    const auto end = std::min(end_of_file_name(shadow.file), shadow.file.size());
    const FilePattern pattern(shadow.file.substr(0, end));
    const std::filesystem::path path = pattern.existing_at(frame);
    if (std::error_code error; !std::filesystem::exists(path, error))
        throw RequestError(fmt::format("lights[{}].shadow.file: {}: {}", shadow.light, path.string(),
                                       error ? error.message() : "no such file"));
    ImageFile file(path, limits);
    InputChoice choice = resolve_shadow(file, end < shadow.file.size() ? shadow.file.substr(end + 1) : "", shadow.light);
    return {std::move(choice), std::move(file)};
}

}  // namespace

InputRequest parse_input(const std::string &text)
{
    const auto equals = text.find('=');
    InputRequest request{text.substr(0, equals), "", equals == std::string::npos ? "" : text.substr(equals + 1)};
    if (const auto end = end_of_file_name(request.layer); end < request.layer.size()) {
        request.file = request.layer.substr(0, end);
        request.layer = request.layer.substr(end + 1);
    }
    if (request.role.empty() || request.layer.empty())
        throw RequestError(fmt::format("--input '{}': expected ROLE=LAYER or ROLE=FILE:LAYER", text));
    return request;
}

void add_input_option(CLI::App &command, std::vector<std::string> &inputs)
{
    command
        .add_option("--input", inputs,
                    "Give a layer to what reads the role, see `brume effects`; ROLE=FILE:LAYER from a file of its own; may "
                    "be repeated")
        ->type_name("ROLE=LAYER")
        ->allow_extra_args(false);
}

std::vector<InputRequest> parse_inputs(const Context &context, const std::vector<std::string> &texts)
{
    std::vector<std::string> roles;
    for (const brume_layer_info &layer : all_layers(context, BRUME_LAYER_INPUT))
        if (!(layer.flags & BRUME_LAYER_OF_LIGHT))
            roles.push_back(layer.name);
    std::vector<InputRequest> requests;
    for (const std::string &text : texts) {
        InputRequest request = parse_input(text);
        if (std::find(roles.begin(), roles.end(), request.role) == roles.end())
            throw RequestError(fmt::format("--input '{}': nothing reads a layer '{}'; nearest is '{}'; expected some of {}",
                                           text, request.role, nearest(request.role, roles), fmt::join(roles, ", ")));
        if (std::any_of(requests.begin(), requests.end(), [&](const InputRequest &r) { return r.role == request.role; }))
            throw RequestError(fmt::format("--input '{}': {} is given twice", text, request.role));
        requests.push_back(std::move(request));
    }
    return requests;
}

std::vector<std::string> known_roles(const Context &context)
{
    std::vector<std::string> roles;
    for (const brume_layer_info &layer : all_layers(context, BRUME_LAYER_INPUT))
        if (!(layer.flags & BRUME_LAYER_OF_LIGHT) && has_known_names(layer.name))
            roles.push_back(layer.name);
    return roles;
}

std::vector<OpenInput> open_inputs(const ImageFile &file, const ColorChoice &color, int frame,
                                   const std::vector<InputRequest> &asked, const std::vector<std::string> &known,
                                   const std::vector<LightGroup> &groups, const std::vector<ShadowFile> &shadows,
                                   const ReadLimits &limits)
{
    std::vector<OpenInput> inputs;
    for (const InputRequest &request : asked) {
        if (request.file.empty()) {
            inputs.push_back({resolve_input(file, request.role, request.layer, &color), std::nullopt});
            continue;
        }
        const FilePattern pattern(request.file);
        if (std::error_code error; !pattern.is_sequence() && !std::filesystem::exists(request.file, error))
            throw RequestError(
                fmt::format("--input {}={}: {}", request.role, request.file, error ? error.message() : "no such file"));
        ImageFile own(pattern.existing_at(frame), limits);
        InputChoice choice = resolve_input(own, request.role, request.layer, nullptr);
        inputs.push_back({std::move(choice), std::move(own)});
        check_display(file, color, inputs.back());
    }
    for (const std::string &role : known)
        if (std::none_of(asked.begin(), asked.end(), [&](const InputRequest &r) { return r.role == role; }))
            if (auto choice = find_known_input(file, role, color))
                inputs.push_back({std::move(*choice), std::nullopt});
    for (const LightGroup &group : groups) {
        InputChoice choice = resolve_group(file, group.layer, group.light, color);
        inputs.push_back({std::move(choice), std::nullopt});
    }
    for (const ShadowFile &shadow : shadows)
        inputs.push_back(open_shadow(shadow, frame, limits));
    return inputs;
}

std::vector<std::string> roles_of(const std::vector<OpenInput> &inputs)
{
    std::vector<std::string> roles;
    for (const OpenInput &input : inputs)
        add_once(roles, input.choice.role);
    return roles;
}

std::vector<std::string> roles_of(const std::vector<InputLayer> &inputs)
{
    std::vector<std::string> roles;
    for (const InputLayer &input : inputs)
        add_once(roles, input.role);
    return roles;
}

std::vector<brume_layer> input_layers(const std::vector<std::string> &roles)
{
    std::vector<brume_layer> layers;
    for (const std::string &role : roles)
        layers.push_back(brume::layer(role.c_str()));
    return layers;
}

GivenLayers::GivenLayers(const std::vector<InputLayer> &inputs)
{
    images_.reserve(inputs.size());
    for (const InputLayer &input : inputs) {
        images_.push_back(brume::image(input.pixels->data(), input.width, input.height, std::uint32_t(input.channels)));
        layers_.push_back(brume::layer(input.role.c_str(), &images_.back(), input.light));
    }
}

void GivenLayers::give_to(brume_frame &frame) const
{
    frame.inputs = layers_.data();
    frame.input_count = std::uint32_t(layers_.size());
}

std::string name_of(const OpenInput &input)
{
    return input.choice.role + (input.choice.light ? fmt::format("{}", *input.choice.light) : "");
}

std::string description(const OpenInput &input)
{
    return fmt::format("{}{}: {}", input.file ? input.file->path().string() + ":" : "", input.choice.label(),
                       input.choice.reason);
}

}  // namespace brume::tool
