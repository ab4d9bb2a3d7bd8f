#pragma once
// Fogging small images through the C ABI, as tests want it.
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
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
};

struct Options {
    std::function<void(brume_format &)> format;  // further settings
    uint32_t outputs = 0;
    double frame = 0;
    uint32_t lights = 0;  // as many first ones give their own airlight
    const brume_camera *camera = nullptr;
    uint32_t origin = BRUME_ORIGIN_TOP_LEFT;
};

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
        format.outputs = options.outputs;
        if (options.lights)
            format.outputs |= BRUME_OUTPUT_LIGHT_AIRLIGHT;
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
        Picture *const pictures[] = {&result.transmittance, &result.optical_depth, &result.scattered,
                                     &result.blur_radius,   &result.airlight,      &result.airlight_error};
        std::vector<std::pair<brume_extra_output, Picture *>> wanted;
        auto want = [&](uint32_t output, uint32_t light, Picture *picture) {
            brume_extra_output extra = BRUME_EXTRA_OUTPUT_INIT;
            extra.output = output;
            extra.light = light;
            *picture = Picture(color.width, color.height, output == BRUME_OUTPUT_BLUR_RADIUS ? 1 : 3);
            wanted.emplace_back(extra, picture);
        };
        for (uint32_t k = 0; k < std::size(pictures); ++k)
            if (options.outputs & (1u << k))
                want(1u << k, 0, pictures[k]);
        result.light_airlight.resize(options.lights);
        for (uint32_t l = 0; l < options.lights; ++l)
            want(BRUME_OUTPUT_LIGHT_AIRLIGHT, l, &result.light_airlight[l]);
        std::vector<brume_image> images;
        for (auto &[extra, picture] : wanted)
            images.push_back(image(*picture, options));
        std::vector<brume_extra_output> extras;
        for (auto &[extra, picture] : wanted) {
            extra.image = &images[extras.size()];
            extras.push_back(extra);
        }
        frame.extra = extras.data();
        frame.extra_count = uint32_t(extras.size());
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
