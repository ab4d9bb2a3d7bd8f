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
    Picture output, transmittance, optical_depth, scattered, blur_radius;
};

struct Options {
    std::function<void(brume_format &)> format;  // further settings
    uint32_t outputs = 0;
    double frame = 0;
};

inline Result run(brume_context context, const std::string &scene_text, const Picture &color, const Picture &depth,
                  const Options &options = {})
{
    brume_scene scene = nullptr;
    Context::check(brume_scene_create_from_text(context, scene_text.data(), scene_text.size(), "test.json", &scene),
                   context);
    std::unique_ptr<brume_scene_t, decltype(&brume_scene_destroy)> scene_guard(scene, brume_scene_destroy);
    brume_format format = BRUME_FORMAT_INIT;
    format.width = color.width;
    format.height = color.height;
    format.outputs = options.outputs;
    if (options.format)
        options.format(format);
    brume_plan plan = nullptr;
    Context::check(brume_plan_create(scene, &format, &plan), context);
    std::unique_ptr<brume_plan_t, decltype(&brume_plan_destroy)> plan_guard(plan, brume_plan_destroy);

    Result result;
    result.output = Picture(color.width, color.height, color.channels);
    brume_image c = describe(color), d = describe(depth), o = describe(result.output);
    brume_frame frame = BRUME_FRAME_INIT;
    frame.color = &c;
    frame.depth = &d;
    frame.output = &o;
    frame.frame = options.frame;
    std::vector<brume_extra_output> extras;
    std::vector<brume_image> images(4);
    Picture *pictures[] = {&result.transmittance, &result.optical_depth, &result.scattered, &result.blur_radius};
    for (uint32_t k = 0; k < 4; ++k)
        if (options.outputs & (1u << k)) {
            *pictures[k] = Picture(color.width, color.height, k == 3 ? 1 : 3);
            images[k] = describe(*pictures[k]);
            brume_extra_output extra = BRUME_EXTRA_OUTPUT_INIT;
            extra.output = 1u << k;
            extra.image = &images[k];
            extras.push_back(extra);
        }
    frame.extra = extras.data();
    frame.extra_count = uint32_t(extras.size());
    Context::check(brume_plan_execute(plan, &frame), context);
    return result;
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
