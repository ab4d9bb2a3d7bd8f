#pragma once
// Fogging small images through the C ABI, as tests want it.
#include <functional>
#include <map>
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

brume_image describe(const Picture &picture);

class Failure : public std::runtime_error {
public:
    Failure(brume_status s, const std::string &message) : std::runtime_error(message), status(s) {}
    brume_status status;
};

class Context {
public:
    explicit Context(uint32_t backend, uint32_t threads = 0);
    ~Context() { brume_context_destroy(handle_); }
    Context(const Context &) = delete;
    operator brume_context() const { return handle_; }

    // Throws Failure with the library's message.
    static void check(brume_status status, brume_context context);

private:
    brume_context handle_ = nullptr;
};

// Backends to test: CPU always, GL where a context can be made (Mesa's software GL counts here).
Context &cpu();

// What tests of every backend are instantiated with.
#ifdef BRUME_GL
inline constexpr const char *backend_names[] = {"cpu", "gl"};
#else
inline constexpr const char *backend_names[] = {"cpu"};
#endif

Context *gl();

struct Result {
    Picture output, transmittance, optical_depth, scattered, blur_radius, airlight, airlight_error;
    std::vector<Picture> light_airlight;

    Picture &layer(const std::string &name);
};

using Names = std::vector<std::string>;

Names joined(Names a, const Names &b);

struct Options {
    std::function<void(brume_format &)> format;  // further settings
    Names outputs = {};                          // layers
    double frame = 0;
    uint32_t lights = 0;  // as many first ones give their own airlight
    const brume_camera *camera = nullptr;
    uint32_t origin = BRUME_ORIGIN_TOP_LEFT;
    std::map<std::string, Picture> inputs = {};                         // layers by name
    std::map<std::string, std::vector<Picture>> inputs_of_lights = {};  // those of the first lights
};

brume_layer layer(const char *name, const brume_image *image = nullptr, uint32_t light = 0);

// A scene's plan for images of one size.
class Plan {
public:
    Plan(brume_context context, const std::string &scene_text, int width, int height, const Options &options = {},
         const std::function<void(brume_scene)> &further = {});
    ~Plan() { brume_plan_destroy(plan_); }
    Plan(const Plan &) = delete;
    operator brume_plan() const { return plan_; }

    Result execute(const Picture &color, const Picture &depth, const Options &options = {}) const;

private:
    brume_context context_;
    brume_plan plan_ = nullptr;
};

Result run(brume_context context, const std::string &scene_text, const Picture &color, const Picture &depth,
           const Options &options = {});

// Scene text with a camera of 50 degrees, this medium and these parameters of multiscatter.
std::string scene(const std::string &medium, const std::string &parameters = "");

// Furthest relative deviation |a - b| / max(|b|, floor) and where; unequal classes (NaN, +-Inf) count as infinite.
struct Worst {
    double error = 0;
    int x = 0, y = 0, channel = 0;
    double a = 0, b = 0;

    std::string describe() const;
};

Worst compare(const Picture &a, const Picture &b, double floor);

}  // namespace fog
