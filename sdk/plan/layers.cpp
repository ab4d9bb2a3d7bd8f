#include "plan/layers.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "base/image_memory.h"
#include "base/names.h"
#include "base/text.h"

namespace brume {
namespace {

constexpr uint32_t directions = BRUME_LAYER_INPUT | BRUME_LAYER_OUTPUT;

const char *list_of(uint32_t direction)
{
    return direction == BRUME_LAYER_INPUT ? "inputs" : "outputs";
}

template <class Function> void for_tables(const EffectRegistry &effects, Function function)
{
    function("the library", host_layers());
    for (const Effect &effect : effects.all())
        if (effect.refusal.empty())
            function(effect.name.c_str(), effect.layers);
}

}  // namespace

const std::vector<Layer> &host_layers()
{
    static const std::vector<Layer> layers = {
        {"optical_depth", "optical depth along the ray, RGB or grey: takes the place of the scene's density",
         BRUME_LAYER_INPUT, 3},
        {"transmittance", "transmittance along the ray, RGB or grey: takes the place of the scene's density",
         BRUME_LAYER_INPUT, 3}};
    return layers;
}

void FrameLayers::plan(const Format &format, const EffectRegistry &effects)
{
    layers_.clear();
    auto add = [&](const std::vector<Format::LayerName> &names, uint32_t direction) {
        for (size_t i = 0; i < names.size(); ++i) {
            FormatLayer layer{names[i], 0, 0};
            std::string first;
            std::vector<std::string> known;
            for_tables(effects, [&](const char *owner, const std::vector<Layer> &table) {
                for (const Layer &of : table) {
                    if (!(of.flags & direction))
                        continue;
                    known.push_back(of.name);
                    if (of.name != names[i].name)
                        continue;
                    const uint32_t flags = of.flags & (directions | BRUME_LAYER_OF_LIGHT | BRUME_LAYER_ANY_SIZE);
                    if (layer.flags && (layer.flags != flags || layer.channels != of.channels))
                        throw Error(BRUME_ERROR_PLUGIN,
                                    fmt::format("layer {}: {} and {} do not mean the same by it", of.name, first, owner));
                    layer.flags = flags;
                    layer.channels = of.channels;
                    first = owner;
                }
            });
            if (!layer.flags)
                throw Error(BRUME_ERROR_UNSUPPORTED,
                            fmt::format("format.{}[{}]: no effect {} a layer {}{}", list_of(direction), i,
                                        direction == BRUME_LAYER_INPUT ? "reads" : "fills", in_quotes(names[i].name),
                                        did_you_mean(names[i].name, known)));
            layers_.push_back(std::move(layer));
        }
    };
    add(format.input_layers, BRUME_LAYER_INPUT);
    add(format.output_layers, BRUME_LAYER_OUTPUT);
    if (has_input("optical_depth") && has_input("transmittance"))
        throw Error(BRUME_ERROR_ARGUMENT, "format.inputs: optical_depth and transmittance; expected one of the two");
    images_.resize(layers_.size());
}

int FrameLayers::index_of(std::string_view name, uint32_t direction) const
{
    for (size_t i = 0; i < layers_.size(); ++i)
        if ((layers_[i].flags & direction) && layers_[i].name.name == name)
            return int(i);
    return -1;
}

const FormatLayer *FrameLayers::find(std::string_view name, uint32_t direction) const
{
    const int at = index_of(name, direction);
    return at < 0 ? nullptr : &layers_[size_t(at)];
}

std::vector<int> FrameLayers::places(const std::vector<Layer> &table) const
{
    std::vector<int> places;
    for (const Layer &layer : table)
        places.push_back(index_of(layer.name, layer.flags & directions));
    return places;
}

std::vector<uint32_t> FrameLayers::given(const std::vector<Layer> &table) const
{
    std::vector<uint32_t> given;
    for (int place : places(table))
        given.push_back(place >= 0 ? 1 : 0);
    return given;
}

void FrameLayers::check(const brume_frame &frame, size_t lights) const
{
    const std::pair<const brume_layer *, uint32_t> lists[] = {{frame.inputs, frame.input_count},
                                                              {frame.outputs, frame.output_count}};
    for (int list = 0; list < 2; ++list) {
        const uint32_t direction = list == 0 ? BRUME_LAYER_INPUT : BRUME_LAYER_OUTPUT;
        const auto [given, count] = lists[list];
        for (uint32_t i = 0; i < count; ++i) {
            const brume_layer &layer = given[i];
            auto refuse = [&](const std::string &problem) {
                throw Error(BRUME_ERROR_ARGUMENT,
                            fmt::format("{}[{}] ({}): {}", list_of(direction), i, layer.name, problem));
            };
            const FormatLayer *planned = find(layer.name, direction);
            if (!planned)
                refuse(fmt::format("expected a layer of the plan's format.{}", list_of(direction)));
            if (layer.kind != planned->name.kind)
                refuse(fmt::format("kind {}; the plan was made for {}", layer.kind, planned->name.kind));
            const bool of_light = planned->flags & BRUME_LAYER_OF_LIGHT;
            if (layer.light >= (of_light ? lights : 1))
                refuse(fmt::format("light {}; expected {}", layer.light,
                                   of_light ? fmt::format("an index below {}", lights) : "0"));
            for (uint32_t k = 0; k < i; ++k)
                if (layer.light == given[k].light && std::string_view(layer.name) == given[k].name)
                    refuse("given twice");
            if (list == 0)
                continue;
            const bool scalar = planned->channels == 1;
            if (layer.image->channels < (scalar ? 1u : 3u) || layer.image->channels > (scalar ? 1u : 4u))
                refuse(fmt::format("{} channels; expected {}", layer.image->channels, scalar ? "1" : "3 or 4"));
            auto expect_apart = [&](const brume_image &other, const char *name) {
                if (same_memory(*layer.image, other))
                    refuse(fmt::format("shares memory with {}{}", name, extents_text("it", *layer.image, name, other)));
            };
            expect_apart(*frame.color, "color");
            expect_apart(*frame.output, "output");
            if (frame.depth)
                expect_apart(*frame.depth, "depth");
            for (uint32_t k = 0; k < i; ++k)
                expect_apart(*given[k].image, given[k].name);
            for (uint32_t k = 0; k < frame.input_count; ++k)
                expect_apart(*frame.inputs[k].image, frame.inputs[k].name);
        }
        for (uint32_t i = 0; list == 0 && i < count; ++i)
            if (same_memory(*given[i].image, *frame.output))
                throw Error(BRUME_ERROR_ARGUMENT,
                            fmt::format("inputs[{}] ({}): shares memory with output{}", i, given[i].name,
                                        extents_text("it", *given[i].image, "output", *frame.output)));
    }
    for (const FormatLayer &planned : layers_) {
        if (!(planned.flags & BRUME_LAYER_INPUT) || planned.flags & BRUME_LAYER_OF_LIGHT)
            continue;
        const auto of_name = [&](const brume_layer &layer) { return planned.name.name == layer.name; };
        if (std::none_of(frame.inputs, frame.inputs + frame.input_count, of_name))
            throw Error(BRUME_ERROR_ARGUMENT, "inputs: the layer " + planned.name.name + " of the plan's format is missing");
    }
}

void FrameLayers::put(int at, const brume_layer &layer, std::shared_ptr<Image> image, size_t lights)
{
    Images &to = images_[size_t(at)];
    if (layers_[size_t(at)].flags & BRUME_LAYER_OF_LIGHT) {
        if (!to.there)
            to.of_lights.assign(lights, nullptr);
        to.of_lights[layer.light] = image.get();
    } else {
        to.image = image;
    }
    to.there = true;
    held_.push_back(std::move(image));
}

void FrameLayers::begin(const brume_frame &frame, size_t lights, Backend &backend)
{
    release();
    for (uint32_t i = 0; i < frame.input_count; ++i) {
        const int at = index_of(frame.inputs[i].name, BRUME_LAYER_INPUT);
        put(at, frame.inputs[i], backend.import(*frame.inputs[i].image, layers_[size_t(at)].channels == 1 ? 1 : 4), lights);
    }
    for (uint32_t i = 0; i < frame.output_count; ++i) {
        const int at = index_of(frame.outputs[i].name, BRUME_LAYER_OUTPUT);
        // Effects hold only their output to the limit of halves, so halves of these are not written directly.
        const bool direct = backend.pixel(*frame.outputs[i].image) == BRUME_PIXEL_F32;
        put(at, frame.outputs[i],
            backend.begin_output(*frame.outputs[i].image, layers_[size_t(at)].channels == 1 ? 1 : 4, direct), lights);
    }
}

int64_t FrameLayers::finish(const brume_frame &frame, Backend &backend)
{
    int64_t clamped = 0;
    for (uint32_t i = 0; i < frame.output_count; ++i) {
        const int64_t more = backend.finish_output(*frame.outputs[i].image, *held_[frame.input_count + i]);
        clamped = clamped == not_counted || more == not_counted ? not_counted : clamped + more;
    }
    return clamped;
}

uint64_t FrameLayers::bytes() const
{
    uint64_t sum = 0;
    for (const auto &image : held_)
        sum += image->bytes;
    return sum;
}

void FrameLayers::release()
{
    for (Images &images : images_) {
        images.image.reset();
        images.there = false;
    }
    held_.clear();
}

void FrameLayers::see(const std::vector<int> &places, std::vector<brume_plugin_layer> &out) const
{
    out.clear();
    for (int place : places) {
        brume_plugin_layer seen{};
        if (place >= 0 && images_[size_t(place)].there) {
            const Images &images = images_[size_t(place)];
            seen.image = images.image.get();
            seen.of_lights = layers_[size_t(place)].flags & BRUME_LAYER_OF_LIGHT ? images.of_lights.data() : nullptr;
        }
        if (place >= 0)
            seen.kind = layers_[size_t(place)].name.kind;
        out.push_back(seen);
    }
}

brume_plugin_image FrameLayers::input(std::string_view name) const
{
    const int at = index_of(name, BRUME_LAYER_INPUT);
    return at < 0 ? nullptr : images_[size_t(at)].image.get();
}

const brume_plugin_image *FrameLayers::inputs_of_lights(std::string_view name) const
{
    const int at = index_of(name, BRUME_LAYER_INPUT);
    return at < 0 || !images_[size_t(at)].there ? nullptr : images_[size_t(at)].of_lights.data();
}

}  // namespace brume
