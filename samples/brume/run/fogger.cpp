#include "run/fogger.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "run/calibration.hpp"
#include "run/provenance.hpp"
#include "run/scene.hpp"
#include "support/error.hpp"

namespace brume::tool {
namespace {

/// A plan holds its images; a sequence with a moving data window meets a new format with every frame.
constexpr std::size_t kMostPlans = 4;

/// As brume_quality.detail.
double detail_of(const ImageFile &file, const ColorChoice &color)
{
    const PartInfo &part = file.parts()[color.part];
    Picture picture{0, 0, part.width(), part.height(), {}};
    picture.rgb.resize(std::size_t(picture.width) * std::size_t(picture.height) * 3);
    const std::set<std::string> channels(color.rgb.begin(), color.rgb.end());  // of a grey picture one
    const auto stored = file.source().read(color.part, {channels.begin(), channels.end()});
    for (std::size_t c = 0; c < 3; ++c)
        stored->to_floats(color.rgb[c], picture.rgb.data() + c, 3);
    return std::sqrt(measure(box_blurred(picture, 4), picture).relative_mse);
}

bool reads_layer(const Context &context, const char *effect, const std::string &role)
{
    for (const brume_layer_info &layer : context.layers(effect))
        if (layer.flags & BRUME_LAYER_INPUT && role == layer.name)
            return true;
    return false;
}

std::string missing_camera(std::uint32_t missing, const char *reason, const std::vector<std::string> &notes)
{
    const char *what = missing == BRUME_CAMERA_POSE            ? "camera pose"
                       : missing == BRUME_CAMERA_FIELD_OF_VIEW ? "field of view"
                                                               : "camera";
    return fmt::format("no {} in options, scene file or metadata, and it matters: {}{}{}", what, reason,
                       notes.empty() ? "" : "; ", fmt::join(notes, "; "));
}

}  // namespace

void FogOptions::add_scene_to(CLI::App &command)
{
    command.add_option("SCENE", scene, "Scene file (JSON; `brume schema` prints its schema)")->required();
    command.add_option("--backend", backend, "auto (GL where a GPU is found), gl or cpu")
        ->capture_default_str()
        ->type_name("{auto,gl,cpu}");
    add_plugins_option(command, plugins);
    command.add_option("--set", set, "Set an effect's parameter, see `brume effects`; may be repeated")
        ->type_name("EFFECT.PARAM=VALUE")
        ->allow_extra_args(false);
    picture.add_to(command);
}

void FogOptions::add_to(CLI::App &command)
{
    add_scene_to(command);
    auto *chosen = command.add_option("--quality", preset, "draft, standard, final or reference; before the scene file's")
                       ->check(CLI::IsMember({"draft", "standard", "final", "reference"}))
                       ->type_name("PRESET");
    auto *error =
        command.add_option("--max-error", max_error, "Quality: largest error against the references (root of relMSE)")
            ->check(CLI::Range(1e-6, 10.0))
            ->excludes(chosen);
    command.add_option("--budget-ms", budget_ms, "Quality: largest time of a frame, see `brume calibrate`")
        ->check(CLI::Range(1e-6, 1e9))
        ->excludes(chosen)
        ->excludes(error);
    command
        .add_option("--layers", layers, "Also write these as brume.NAME: layers that an effect fills, see `brume effects`")
        ->delimiter(',')
        ->type_name("NAME,...")
        ->allow_extra_args(false);
    add_input_option(command, inputs);
    command.add_flag("--element", element,
                     "The picture goes over a plate in the same fog: the medium's own light counts as far as alpha covers");
}

Fogger::Fogger(const FogOptions &options) : Fogger(options, read_scene(options.scene, options.set)) {}

Fogger::Fogger(const FogOptions &options, const SceneText &text)
    : options_(options), context_(create_context(options.backend, options.plugins)), scene_(make_scene(context_, text))
{
    options.picture.depth_kind();
    options.picture.sky();
    outputs_ = parse_layers(context_, options.layers);
    output_layers_ = format_layers(outputs_);
    inputs_ = parse_inputs(context_, options.inputs);
    load_calibration(context_);
    take_scene(text);
}

void Fogger::change_scene(const std::string &text)
{
    plans_.clear();
    const SceneText changed{text, options_.scene, options_.set};
    scene_ = make_scene(context_, changed);
    take_scene(changed);
}

void Fogger::take_scene(const SceneText &text)
{
    provenance_ = provenance_of(text, options_, context_.info().backend);
    ask_for_quality();
    scene_camera_ = CameraBlock::of_scene(text.text, options_.scene);
    scene_info_ = scene_.info();
    shadows_.clear();
    for (std::uint32_t light = 0; light < scene_info_.light_count; ++light)
        if (std::string name = scene_.light_shadow_file(light); !name.empty())
            shadows_.push_back({light, std::move(name)});
    for (const LayerOutput &output : outputs_)
        if (output.of_light && output.light >= scene_info_.light_count)
            throw RequestError(fmt::format("--layers '{}': {} has {} lights; expected the number of one, from 0",
                                           output.name, options_.scene, scene_info_.light_count));
}

void Fogger::ask_for_quality()
{
    if (options_.preset.empty() && options_.max_error == 0 && options_.budget_ms == 0)
        return;
    brume_quality quality = scene_.quality();
    quality.max_error = options_.max_error;
    quality.budget_ms = options_.budget_ms;
    quality.preset = options_.preset == "draft"      ? BRUME_PRESET_DRAFT
                     : options_.preset == "standard" ? BRUME_PRESET_STANDARD
                     : options_.preset == "final"    ? BRUME_PRESET_FINAL
                     : options_.preset.empty()       ? BRUME_PRESET_NONE
                                                     : BRUME_PRESET_REFERENCE;
    check_request(context_, scene_.set_quality(quality), "quality");
}

void Fogger::expect(const ImageFile &file, const ColorChoice &color, const ImageFile &depth_file, const DepthChoice &depth,
                    const std::vector<OpenInput> &inputs, int number)
{
    brume_quality quality = scene_.quality();
    if ((quality.preset == BRUME_PRESET_NONE && quality.max_error == 0 && quality.budget_ms == 0) ||
        (quality.transmittance > 0 && quality.detail > 0))
        return;
    const PartInfo &part = depth_file.parts()[depth.part];
    Shot shot = shot_of(file, color, number);
    shot.format = format_of(part.data_window, depth_file.part(depth.part).display_window, options_.picture);
    brume_layer wanted = brume::layer("transmittance");
    shot.format.outputs = &wanted;
    shot.format.output_count = 1;
    const std::vector<std::string> roles = roles_of(inputs);
    const std::vector<brume_layer> given = input_layers(roles);
    shot.format.inputs = given.data();
    shot.format.input_count = std::uint32_t(given.size());
    brume_quality draft = BRUME_QUALITY_INIT;
    draft.preset = BRUME_PRESET_DRAFT;
    check_request(context_, scene_.set_quality(draft), "quality");
    Plan plan(scene_, shot.format);
    check_request(context_, scene_.set_quality(quality), "quality");
    // What does not work here fails where the scene is planned as it is, with the reason.
    if (!plan)
        return;
    const brume_plan_info info = plan.info();
    if (info.does_nothing || (info.camera_needs & ~shot.camera.given))
        return;
    std::vector<float> distances = read_depth(depth_file, depth);
    options_.picture.depth_kind().convert(distances);
    std::vector<float> color_rgb(distances.size() * 3), transmittance(distances.size() * 3);
    const int width = part.width(), height = part.height();
    const brume_image c = brume::image(color_rgb.data(), width, height, 3),
                      d = brume::image(distances.data(), width, height, 1),
                      t = brume::image(transmittance.data(), width, height, 3);
    wanted.image = &t;
    brume_frame call = BRUME_FRAME_INIT;
    call.color = &c;
    call.depth = &d;
    call.output = &c;
    call.outputs = &wanted;
    call.output_count = 1;
    std::vector<InputLayer> layers;
    for (const OpenInput &input : inputs)
        layers.push_back(read_pixels(input, file, part, nullptr));
    const GivenLayers images(layers);
    images.give_to(call);
    call.camera = &shot.camera;
    check_request(context_, plan.execute(call), file.path().string());
    double sum = 0;
    for (const float value : transmittance)
        sum += double(value);
    if (quality.transmittance == 0)
        quality.transmittance = std::clamp(sum / double(transmittance.size()), 1e-6, 1.0);
    if (quality.detail == 0)
        quality.detail = std::clamp(detail_of(file, color), 1e-6, 1e6);
    check_request(context_, scene_.set_quality(quality), "quality");
}

Shot Fogger::shot_of(const ImageFile &file, const ColorChoice &color, int number) const
{
    Shot shot = tool::shot_of(file, color, options_.picture, scene_camera_, number);
    shot.format.outputs = output_layers_.data();
    shot.format.output_count = std::uint32_t(output_layers_.size());
    return shot;
}

void Fogger::learn_roles(const ImageFile &file, const ColorChoice &color, int number)
{
    std::vector<std::string> roles = tool::known_roles(context_);
    const std::vector<LightGroup> groups = scene_groups();
    if (!groups.empty())
        roles.push_back(kLightGroup);
    if (roles.empty())
        return;
    // A scene that names shadow maps is planned with them only.
    if (!shadows_.empty())
        roles.push_back(kShadow);
    // Which effects run is the library's to say, so it is asked with all of the roles.
    Shot shot = shot_of(file, color, number);
    const std::vector<brume_layer> given = input_layers(roles);
    shot.format.inputs = given.data();
    shot.format.input_count = std::uint32_t(given.size());
    const Plan plan(scene_, shot.format);
    // What does not work here fails where the scene is planned as it is.
    if (!plan)
        return;
    known_roles_.clear();
    groups_.clear();
    const std::vector<brume_plan_entry> entries = plan.entries();
    for (const std::string &role : roles)
        for (const brume_plan_entry &entry : entries)
            if (entry.runs && reads_layer(context_, entry.effect, role)) {
                if (role == kLightGroup)
                    groups_ = groups;
                else if (role != kShadow)
                    known_roles_.push_back(role);
                break;
            }
}

std::vector<LightGroup> Fogger::scene_groups() const
{
    std::vector<LightGroup> groups;
    for (std::uint32_t light = 0; light < scene_info_.light_count; ++light)
        if (std::string name = scene_.light_group(light); !name.empty())
            groups.push_back({light, std::move(name)});
    return groups;
}

std::vector<OpenInput> Fogger::open_inputs(const ImageFile &file, const ColorChoice &color, int number,
                                           const ReadLimits &limits) const
{
    return tool::open_inputs(file, color, number, inputs_, known_roles_, groups_, shadows_, limits);
}

InputLayer Fogger::read_pixels(const OpenInput &input, const ImageFile &picture, const PartInfo &onto,
                               const StoredPixels *stored) const
{
    const ImageFile &file = input.file ? *input.file : picture;
    return input.choice.role == kShadow ? shadow_files_.read(file, input.choice)
                                        : read_input(file, input.choice, onto, stored);
}

Plan &Fogger::plan_for(const ImageFile &file, const ColorChoice &color, const LuminanceWeights &weights,
                       const std::vector<std::string> &roles, int number)
{
    Shot shot = shot_of(file, color, number);
    if (options_.element && color.alpha.empty())
        throw RequestError(fmt::format("{}: --element: colour '{}' has no alpha", file.path().string(), color.label()));
    const std::vector<brume_layer> given = input_layers(roles);
    shot.format.inputs = given.data();
    shot.format.input_count = std::uint32_t(given.size());
    const std::vector<double> picture{double(shot.format.width),
                                      double(shot.format.height),
                                      double(shot.format.display_x),
                                      double(shot.format.display_y),
                                      double(shot.format.display_width),
                                      double(shot.format.display_height),
                                      weights[0],
                                      weights[1],
                                      weights[2]};
    const std::pair key{picture, roles};
    auto at = plans_.find(key);
    if (at == plans_.end()) {
        check_request(context_, scene_.set_luminance_weights(weights[0], weights[1], weights[2]), file.path().string());
        if (plans_.size() >= kMostPlans)
            plans_.clear();
        Plan plan(scene_, shot.format);
        check_request(context_, plan.status(), file.path().string());
        at = plans_.emplace(key, std::move(plan)).first;
    }
    const brume_plan_info info = at->second.info();
    if (const std::uint32_t missing = info.camera_needs & ~shot.camera.given)
        throw RequestError(
            fmt::format("{}: {}", file.path().string(), missing_camera(missing, info.camera_reason, shot.camera_notes)));
    return at->second;
}

/// The fog is linear in the picture, so what it makes of a black one is the medium's own light. Where the picture covers
/// nothing the plate has that light already.
void Fogger::take_uncovered_light(Plan &plan, brume_frame call, Frame &frame) const
{
    std::vector<float> black(frame.pixels.size());
    for (std::size_t i = 3; i < black.size(); i += 4)
        black[i] = frame.pixels[i];
    const brume_image image = brume::image(black.data(), frame.width, frame.height, std::uint32_t(frame.channels));
    call.color = call.output = &image;
    call.outputs = nullptr;
    call.output_count = 0;
    check_request(context_, plan.execute(call), frame.file.path().string());
    for (std::size_t i = 0; i + 3 < black.size(); i += 4)
        if (const float uncovered = 1 - std::clamp(frame.pixels[i + 3], 0.0f, 1.0f); uncovered > 0)
            for (std::size_t c = 0; c < 3; ++c)
                frame.pixels[i + c] -= uncovered * black[i + c];
}

FogReport Fogger::fog(Frame &frame, int number, const LuminanceWeights &weights, std::vector<AddedLayer> &layers)
try {
    Plan &plan = plan_for(frame.file, frame.color, weights, roles_of(frame.inputs), number);
    const Shot shot = shot_of(frame.file, frame.color, number);
    const brume_image color = brume::image(frame.pixels.data(), frame.width, frame.height, std::uint32_t(frame.channels));
    const brume_image depth = brume::image(frame.depth.data(), frame.width, frame.height, 1);

    std::vector<brume_image> images;
    std::vector<brume_layer> wanted;
    images.reserve(outputs_.size());
    layers.clear();
    layers.reserve(outputs_.size());
    for (const LayerOutput &output : outputs_) {
        layers.push_back({output.name, output.channels, output.type, {}});
        layers.back().pixels.resize(std::size_t(frame.width) * std::size_t(frame.height) * std::size_t(output.channels));
        images.push_back(
            brume::image(layers.back().pixels.data(), frame.width, frame.height, std::uint32_t(output.channels)));
        wanted.push_back(brume::layer(output.layer.c_str(), &images.back(), output.light));
    }

    brume_frame call = BRUME_FRAME_INIT;
    call.color = &color;
    call.depth = &depth;
    call.output = &color;
    call.outputs = wanted.data();
    call.output_count = std::uint32_t(wanted.size());
    const GivenLayers inputs(frame.inputs);
    inputs.give_to(call);
    call.camera = &shot.camera;
    call.frame = number;
    check_request(context_, plan.execute(call), frame.file.path().string());
    if (options_.element)
        take_uncovered_light(plan, call, frame);

    FogReport report;
    report.camera = shot.camera_source;
    const brume_plan_info info = plan.info();
    report.nothing_to_do = info.does_nothing != 0;
    if (info.camera_needs)
        report.warnings = shot.camera_notes;
    for (const brume_plan_entry &entry : plan.entries())
        if (entry.runs)
            report.passes.push_back({entry.effect, entry.name, entry.measured_ms});
    return report;
} catch (const RequestError &e) {
    // Once frames are being done, what is wrong is wrong with this frame.
    throw FrameError(e.what());
}

}  // namespace brume::tool
