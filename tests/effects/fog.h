#pragma once
// Fogging small images through the C ABI, as tests want it.
#include <cmath>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <brume/brume.h>

namespace fog {

struct Picture {
    int width = 0, height = 0, channels = 4;
    std::vector<float> data;

    Picture() = default;
    Picture(int w, int h, int c, float value = 0)
        : width(w), height(h), channels(c), data(size_t(w) * size_t(h) * size_t(c), value)
    {
    }
    float *at(int x, int y) { return data.data() + (size_t(y) * size_t(width) + size_t(x)) * size_t(channels); }
    const float *at(int x, int y) const { return const_cast<Picture *>(this)->at(x, y); }
};

inline brume_image describe(const Picture &picture)
{
    brume_image image = BRUME_IMAGE_INIT;
    image.width = picture.width;
    image.height = picture.height;
    image.channels = uint32_t(picture.channels);
    image.data = const_cast<float *>(picture.data.data());
    return image;
}

class Failure : public std::runtime_error {
public:
    Failure(brume_status s, const std::string &message) : std::runtime_error(message), status(s) {}
    brume_status status;
};

class Context {
public:
    explicit Context(uint32_t backend, uint32_t threads = 0)
    {
        brume_context_desc desc = BRUME_CONTEXT_DESC_INIT;
        desc.backend = backend;
        desc.threads = threads;
        check(brume_context_create(&desc, &handle_), nullptr);
    }
    ~Context() { brume_context_destroy(handle_); }
    Context(const Context &) = delete;
    operator brume_context() const { return handle_; }

    static void check(brume_status status, brume_context context)
    {
        if (status == BRUME_OK)
            return;
        char text[1024];
        brume_message(context, text, sizeof text);
        throw Failure(status, text);
    }

private:
    brume_context handle_ = nullptr;
};

// Backends to test: CPU always, GL where a context can be made (Mesa's software GL counts here).
inline Context &cpu()
{
    static Context context(BRUME_BACKEND_CPU);
    return context;
}

// What tests of every backend are instantiated with.
#ifdef BRUME_GL
inline constexpr const char *backend_names[] = {"cpu", "gl"};
#else
inline constexpr const char *backend_names[] = {"cpu"};
#endif

inline Context *gl()
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

struct Result {
    Picture output, transmittance, optical_depth, scattered, blur_radius, airlight, airlight_error;
    std::vector<Picture> light_airlight;

    Picture &layer(const std::string &name)
    {
        const std::pair<const char *, Picture *> all[] = {
            {"transmittance", &transmittance}, {"optical_depth", &optical_depth}, {"scattered", &scattered},
            {"blur_radius", &blur_radius},     {"airlight", &airlight},           {"airlight_error", &airlight_error}};
        for (auto &[known, picture] : all)
            if (name == known)
                return *picture;
        throw std::logic_error("fog.h knows no output layer " + name);
    }
};

using Names = std::vector<std::string>;

inline Names joined(Names a, const Names &b)
{
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

struct Options {
    std::function<void(brume_format &)> format;  // further settings
    Names outputs = {};                          // layers
    double frame = 0;
    uint32_t lights = 0;  // as many first ones give their own airlight
    const brume_camera *camera = nullptr;
    uint32_t origin = BRUME_ORIGIN_TOP_LEFT;
    std::map<std::string, Picture> inputs = {};  // layers by name
};

inline brume_layer layer(const char *name, const brume_image *image = nullptr, uint32_t light = 0)
{
    brume_layer layer = BRUME_LAYER_INIT;
    layer.name = name;
    layer.image = image;
    layer.light = light;
    return layer;
}

// A scene's plan for images of one size.
class Plan {
public:
    Plan(brume_context context, const std::string &scene_text, int width, int height, const Options &options = {},
         const std::function<void(brume_scene)> &further = {})
        : context_(context)
    {
        brume_scene scene = nullptr;
        check(brume_scene_create_from_text(context, scene_text.data(), scene_text.size(), "test.json", &scene));
        std::unique_ptr<brume_scene_t, decltype(&brume_scene_destroy)> guard(scene, brume_scene_destroy);
        if (further)
            further(scene);
        brume_format format = BRUME_FORMAT_INIT;
        format.width = width;
        format.height = height;
        std::vector<brume_layer> inputs, outputs;
        for (auto &[name, picture] : options.inputs)
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
        check(brume_plan_create(scene, &format, &plan_));
    }
    ~Plan() { brume_plan_destroy(plan_); }
    Plan(const Plan &) = delete;
    operator brume_plan() const { return plan_; }

    Result execute(const Picture &color, const Picture &depth, const Options &options = {}) const
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
        check(brume_plan_execute(plan_, &frame));
        return result;
    }

private:
    static brume_image image(const Picture &picture, const Options &options)
    {
        brume_image image = describe(picture);
        image.origin = options.origin;
        return image;
    }
    void check(brume_status status) const { Context::check(status, context_); }

    brume_context context_;
    brume_plan plan_ = nullptr;
};

inline Result run(brume_context context, const std::string &scene_text, const Picture &color, const Picture &depth,
                  const Options &options = {})
{
    return Plan(context, scene_text, color.width, color.height, options).execute(color, depth, options);
}

// Scene text with a camera of 50 degrees, this medium and these parameters of multiscatter.
inline std::string scene(const std::string &medium, const std::string &parameters = "")
{
    return "{\"brume\":1,\"camera\":{\"vertical_fov\":50,\"camera_to_world\":[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]},"
           "\"medium\":{" +
           medium + "},\"effects\":{\"multiscatter\":{" + parameters + "}}}";
}

// Furthest relative deviation |a - b| / max(|b|, floor) and where; unequal classes (NaN, +-Inf) count as infinite.
struct Worst {
    double error = 0;
    int x = 0, y = 0, channel = 0;
    double a = 0, b = 0;

    std::string describe() const
    {
        char text[200];
        snprintf(text, sizeof text, "worst %.3g at pixel (%d, %d) channel %d: %.9g, expected %.9g", error, x, y, channel, a,
                 b);
        return text;
    }
};

inline Worst compare(const Picture &a, const Picture &b, double floor)
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
