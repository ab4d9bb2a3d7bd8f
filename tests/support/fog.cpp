#include "fog.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <memory>
#include <string_view>
#include <utility>

namespace fog {
namespace {

brume_image image(const Picture &picture, const Options &options)
{
    brume_image image = describe(picture);
    image.origin = options.origin;
    return image;
}

}  // namespace

brume_image describe(const Picture &picture)
{
    brume_image image = BRUME_IMAGE_INIT;
    image.width = picture.width;
    image.height = picture.height;
    image.channels = uint32_t(picture.channels);
    image.data = const_cast<float *>(picture.data.data());
    return image;
}

Context::Context(uint32_t backend, uint32_t threads)
{
    brume_context_desc desc = BRUME_CONTEXT_DESC_INIT;
    desc.backend = backend;
    desc.threads = threads;
    check(brume_context_create(&desc, &handle_), nullptr);
}

void Context::check(brume_status status, brume_context context)
{
    if (status == BRUME_OK)
        return;
    char text[1024];
    brume_message(context, text, sizeof text);
    throw Failure(status, text);
}

Context &cpu()
{
    static Context context(BRUME_BACKEND_CPU);
    return context;
}

Context *gl()
{
    static std::unique_ptr<Context> context = [] {
        try {
            return std::make_unique<Context>(BRUME_BACKEND_GL);
        } catch (const Failure &failure) {
            fprintf(stderr, "no GL backend here: %s\n", failure.what());
            return std::unique_ptr<Context>();
        }
    }();
    return context.get();
}

Picture &Result::layer(const std::string &name)
{
    const std::pair<const char *, Picture *> all[] = {
        {"transmittance", &transmittance}, {"optical_depth", &optical_depth}, {"scattered", &scattered},
        {"blur_radius", &blur_radius},     {"airlight", &airlight},           {"airlight_error", &airlight_error}};
    for (auto &[known, picture] : all)
        if (name == known)
            return *picture;
    throw std::logic_error("no output layer " + name + " in fog::Result");
}

Names joined(Names a, const Names &b)
{
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

brume_layer layer(const char *name, const brume_image *image, uint32_t light)
{
    brume_layer layer = BRUME_LAYER_INIT;
    layer.name = name;
    layer.image = image;
    layer.light = light;
    return layer;
}

Plan::Plan(brume_context context, const std::string &scene_text, int width, int height, const Options &options,
           const std::function<void(brume_scene)> &further)
    : context_(context)
{
    brume_scene scene = nullptr;
    Context::check(brume_scene_create_from_text(context, scene_text.data(), scene_text.size(), "test.json", &scene),
                   context);
    std::unique_ptr<brume_scene_t, decltype(&brume_scene_destroy)> guard(scene, brume_scene_destroy);
    if (further)
        further(scene);
    brume_format format = BRUME_FORMAT_INIT;
    format.width = width;
    format.height = height;
    std::vector<brume_layer> inputs, outputs;
    for (auto &[name, picture] : options.inputs)
        inputs.push_back(layer(name.c_str()));
    for (auto &[name, pictures] : options.inputs_of_lights)
        inputs.push_back(layer(name.c_str()));
    for (const std::string &name : options.outputs)
        outputs.push_back(layer(name.c_str()));
    if (options.lights)
        outputs.push_back(layer("light_airlight"));
    format.inputs = inputs.data();
    format.input_count = uint32_t(inputs.size());
    format.outputs = outputs.data();
    format.output_count = uint32_t(outputs.size());
    if (options.format)
        options.format(format);
    Context::check(brume_plan_create(scene, &format, &plan_), context);
}

Result Plan::execute(const Picture &color, const Picture &depth, const Options &options) const
{
    Result result;
    result.output = Picture(color.width, color.height, color.channels);
    brume_image c = image(color, options), d = image(depth, options), o = image(result.output, options);
    brume_frame frame = BRUME_FRAME_INIT;
    frame.color = &c;
    frame.depth = &d;
    frame.output = &o;
    frame.frame = options.frame;
    frame.camera = options.camera;
    std::deque<brume_image> images;
    std::vector<brume_layer> inputs, outputs;
    for (auto &[name, picture] : options.inputs)
        inputs.push_back(layer(name.c_str(), &images.emplace_back(image(picture, options))));
    for (auto &[name, pictures] : options.inputs_of_lights)
        for (size_t l = 0; l < pictures.size(); ++l)
            inputs.push_back(layer(name.c_str(), &images.emplace_back(image(pictures[l], options)), uint32_t(l)));
    auto want = [&](const char *name, uint32_t light, Picture &picture) {
        picture = Picture(color.width, color.height, std::string_view(name) == "blur_radius" ? 1 : 3);
        outputs.push_back(layer(name, &images.emplace_back(image(picture, options)), light));
    };
    for (const std::string &name : options.outputs)
        want(name.c_str(), 0, result.layer(name));
    result.light_airlight.resize(options.lights);
    for (uint32_t l = 0; l < options.lights; ++l)
        want("light_airlight", l, result.light_airlight[l]);
    frame.inputs = inputs.data();
    frame.input_count = uint32_t(inputs.size());
    frame.outputs = outputs.data();
    frame.output_count = uint32_t(outputs.size());
    Context::check(brume_plan_execute(plan_, &frame), context_);
    return result;
}

Result run(brume_context context, const std::string &scene_text, const Picture &color, const Picture &depth,
           const Options &options)
{
    return Plan(context, scene_text, color.width, color.height, options).execute(color, depth, options);
}

std::string scene(const std::string &medium, const std::string &parameters)
{
    return "{\"brume\":1,\"camera\":{\"vertical_fov\":50,\"camera_to_world\":[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]},"
           "\"medium\":{" +
           medium + "},\"effects\":{\"multiscatter\":{" + parameters + "}}}";
}

std::string Worst::describe() const
{
    char text[200];
    snprintf(text, sizeof text, "worst %.3g at pixel (%d, %d) channel %d: %.9g, expected %.9g", error, x, y, channel, a, b);
    return text;
}

Worst compare(const Picture &a, const Picture &b, double floor)
{
    Worst worst;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x)
            for (int c = 0; c < a.channels; ++c) {
                double va = a.at(x, y)[c], vb = b.at(x, y)[c];
                bool same_class = std::isnan(va)                                       ? std::isnan(vb)
                                  : std::isinf(va) || std::isinf(vb) || std::isnan(vb) ? va == vb
                                                                                       : true;
                double error = !same_class         ? INFINITY
                               : std::isfinite(va) ? std::abs(va - vb) / std::max(std::abs(vb), floor)
                                                   : 0;
                if (error > worst.error)
                    worst = {error, x, y, c, va, vb};
            }
    return worst;
}

}  // namespace fog
