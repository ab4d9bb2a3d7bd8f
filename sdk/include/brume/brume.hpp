// Brume for C++17 and later: brume.h with handles that clean up after themselves and failures that are exceptions.
// Header-only; everything it does goes through the C ABI, whose header is the manual.
//
//   brume::Context context;
//   brume::Scene scene(context, text, "fog.json");
//   brume::Plan plan(scene, brume::format(1920, 1080));
//   plan.execute(brume::image(rgba, 1920, 1080, 4), brume::image(z, 1920, 1080, 1), brume::image(out, 1920, 1080, 4));
//
// Compiled without exceptions, or with BRUME_HPP_NO_EXCEPTIONS defined, calls return a brume_status instead. A handle that
// could not be made is false and its status() says why it could not; what answers with a value answers with the defaults
// after a failure. message() of a context has the text:
//
//   brume::Plan plan(scene, format);
//   if (!plan)
//       report(plan.status(), context.message());
//   if (brume_status status = plan.execute(frame))
//       report(status, context.message());
#ifndef BRUME_BRUME_HPP
#define BRUME_BRUME_HPP

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "brume.h"

#if !defined(BRUME_HPP_NO_EXCEPTIONS) && !defined(__cpp_exceptions)
#define BRUME_HPP_NO_EXCEPTIONS
#endif
#ifndef BRUME_HPP_NO_EXCEPTIONS
#include <stdexcept>
#endif

namespace brume {

#ifdef BRUME_HPP_NO_EXCEPTIONS
// Names of their own, so that a program may have files of either kind.
inline namespace no_exceptions {

using Result = brume_status;
#else
using Result = void;

class Error : public std::runtime_error {
public:
    Error(brume_status status, const std::string &message) : std::runtime_error(message), status_(status) {}
    brume_status status() const noexcept { return status_; }

private:
    brume_status status_;
};
#endif

namespace detail {

// Calls a function that copies text out as brume_message does. Some answer 0 on failure.
template <class Copy> std::string copied_text(Copy copy)
{
    std::string text(copy(nullptr, std::size_t(0)), '\0');
    if (text.empty())
        return text;
    copy(&text[0], text.size());
    text.pop_back();
    return text;
}

// A vector's size, which brume.h bounds far below 2^32.
template <class Value> std::uint32_t count(const std::vector<Value> &values)
{
    return std::uint32_t(std::min<std::size_t>(values.size(), UINT32_MAX));
}

inline std::string message(brume_context context)
{
    return copied_text([&](char *to, std::size_t size) { return brume_message(context, to, size); });
}

#ifdef BRUME_HPP_NO_EXCEPTIONS
inline Result check(brume_context, brume_status status)
{
    return status;
}
#else
inline Result check(brume_context context, brume_status status)
{
    if (status == BRUME_OK)
        return;
    const std::string text = message(context);
    throw Error(status, text.empty() ? brume_status_name(status) : text);
}
#endif

struct Destroy {
    void operator()(brume_scene scene) const { brume_scene_destroy(scene); }
    void operator()(brume_plan plan) const { brume_plan_destroy(plan); }
};

}  // namespace detail

// Copies share one context; it is destroyed with the last copy, scene and plan of it.
class Context {
public:
    explicit Context(const brume_context_desc &desc = brume_context_desc BRUME_CONTEXT_DESC_INIT)
    {
        brume_context context = nullptr;
        status_ = brume_context_create(&desc, &context);
        detail::check(nullptr, status_);
        handle_.reset(context, brume_context_destroy);
    }

    brume_context get() const { return handle_.get(); }
    explicit operator bool() const { return handle_ != nullptr; }
    brume_status status() const { return status_; }
    // Of the calling thread's last failure in this context, or in making it.
    std::string message() const { return detail::message(get()); }
    Result check(brume_status status) const { return detail::check(get(), status); }

    brume_context_info info() const
    {
        brume_context_info info = BRUME_CONTEXT_INFO_INIT;
        check(brume_context_get_info(get(), &info));
        return info;
    }

    // Plugins that were refused included: their `refusal` says why.
    std::vector<brume_effect_info> effects() const
    {
        std::vector<brume_effect_info> all(brume_effect_count(get()), brume_effect_info BRUME_EFFECT_INFO_INIT);
        for (std::size_t i = 0; i < all.size(); ++i)
            check(brume_effect_get_info(get(), std::uint32_t(i), &all[i]));
        return all;
    }

    std::vector<brume_parameter_info> parameters(const std::string &effect) const
    {
        std::vector<brume_parameter_info> all;
        for (const brume_effect_info &info : effects()) {
            if (info.refusal || effect != info.name)
                continue;
            all.assign(info.parameter_count, brume_parameter_info BRUME_PARAMETER_INFO_INIT);
            for (std::size_t i = 0; i < all.size(); ++i)
                check(brume_parameter_get_info(get(), effect.c_str(), std::uint32_t(i), &all[i]));
            return all;
        }
        brume_parameter_info none = BRUME_PARAMETER_INFO_INIT;
        check(brume_parameter_get_info(get(), effect.c_str(), 0, &none));
        return all;
    }

    // What an effect reads and fills; nothing of one that is not there.
    std::vector<brume_layer_info> layers(const std::string &effect) const { return layers_of(effect.c_str()); }
    // What the library reads itself, for all effects.
    std::vector<brume_layer_info> library_layers() const { return layers_of(nullptr); }

    Result trim() const { return check(brume_context_trim(get())); }
    Result calibrate() const { return check(brume_context_calibrate(get())); }
    std::string calibration() const
    {
        return detail::copied_text(
            [&](char *to, std::size_t size) { return brume_context_calibration(get(), to, size); });
    }
    Result set_calibration(std::string_view text) const
    {
        return check(brume_context_set_calibration(get(), text.data(), text.size()));
    }

    std::string scene_schema() const
    {
        return detail::copied_text(
            [&](char *to, std::size_t size) { return brume_scene_schema(get(), to, size); });
    }

private:
    std::vector<brume_layer_info> layers_of(const char *effect) const
    {
        std::vector<brume_layer_info> all(brume_layer_count(get(), effect), brume_layer_info BRUME_LAYER_INFO_INIT);
        for (std::size_t i = 0; i < all.size(); ++i)
            check(brume_layer_get_info(get(), effect, std::uint32_t(i), &all[i]));
        return all;
    }

    std::shared_ptr<brume_context_t> handle_;
    brume_status status_ = BRUME_OK;
};

class Scene {
public:
    explicit Scene(const Context &context) : context_(context)
    {
        brume_scene scene = nullptr;
        status_ = brume_scene_create(context_.get(), &scene);
        context_.check(status_);
        handle_.reset(scene);
    }

    // From scene-file text; `name` stands for the file in messages.
    Scene(const Context &context, std::string_view text, const std::string &name = "scene") : context_(context)
    {
        brume_scene scene = nullptr;
        status_ = brume_scene_create_from_text(context_.get(), text.data(), text.size(), name.c_str(), &scene);
        context_.check(status_);
        handle_.reset(scene);
    }

    brume_scene get() const { return handle_.get(); }
    explicit operator bool() const { return handle_ != nullptr; }
    brume_status status() const { return status_; }
    const Context &context() const { return context_; }

    Result set_medium(const brume_medium &medium) { return context_.check(brume_scene_set_medium(get(), &medium)); }
    // With these Gaussians instead of those that the medium points to.
    Result set_medium(brume_medium medium, const std::vector<brume_gaussian> &gaussians)
    {
        medium.gaussians = gaussians.data();
        medium.gaussian_count = detail::count(gaussians);
        return set_medium(medium);
    }
    Result remove_medium() { return context_.check(brume_scene_set_medium(get(), nullptr)); }
    Result set_lights(const std::vector<brume_light> &lights)
    {
        return context_.check(brume_scene_set_lights(get(), lights.data(), detail::count(lights)));
    }
    Result set_environment(const std::vector<std::array<double, 3>> &coefficients)
    {
        const double *first = coefficients.empty() ? nullptr : coefficients.front().data();
        return context_.check(brume_scene_set_environment(get(), first, detail::count(coefficients)));
    }
    std::string environment_file() const
    {
        return detail::copied_text(
            [&](char *to, std::size_t size) { return brume_scene_environment_file(get(), to, size); });
    }
    std::string light_shadow_file(std::uint32_t light) const
    {
        return detail::copied_text(
            [&](char *to, std::size_t size) { return brume_scene_light_shadow_file(get(), light, to, size); });
    }
    std::string light_group(std::uint32_t light) const
    {
        return detail::copied_text(
            [&](char *to, std::size_t size) { return brume_scene_light_group(get(), light, to, size); });
    }
    brume_scene_info info() const
    {
        brume_scene_info info = BRUME_SCENE_INFO_INIT;
        context_.check(brume_scene_get_info(get(), &info));
        return info;
    }
    Result set_quality(const brume_quality &quality) { return context_.check(brume_scene_set_quality(get(), &quality)); }
    // Parameters are as they are set.
    Result remove_quality() { return context_.check(brume_scene_set_quality(get(), nullptr)); }
    brume_quality quality() const
    {
        brume_quality quality = BRUME_QUALITY_INIT;
        context_.check(brume_scene_get_quality(get(), &quality));
        return quality;
    }
    Result set_camera(const brume_camera &camera) { return context_.check(brume_scene_set_camera(get(), &camera)); }
    Result set_metres_per_unit(double metres) { return context_.check(brume_scene_set_metres_per_unit(get(), metres)); }
    Result set_luminance_weights(double r, double g, double b)
    {
        const double weights[3] = {r, g, b};
        return context_.check(brume_scene_set_luminance_weights(get(), weights));
    }

    // BRUME_CAMERA_... flags.
    std::uint32_t camera_given() const
    {
        std::uint32_t given = 0;
        context_.check(brume_scene_get_camera_given(get(), &given));
        return given;
    }

    Result add_effect(const std::string &effect)
    {
        return context_.check(brume_scene_set_text(get(), effect.c_str(), nullptr, nullptr));
    }
    Result set(const std::string &effect, const std::string &parameter, const std::string &value)
    {
        return context_.check(brume_scene_set_text(get(), effect.c_str(), parameter.c_str(), value.c_str()));
    }
    Result set(const std::string &effect, const std::string &parameter, double value)
    {
        return context_.check(brume_scene_set_number(get(), effect.c_str(), parameter.c_str(), value));
    }

private:
    Context context_;
    std::unique_ptr<brume_scene_t, detail::Destroy> handle_;
    brume_status status_ = BRUME_OK;
};

class Plan {
public:
    Plan(const Scene &scene, const brume_format &format) : context_(scene.context())
    {
        brume_plan plan = nullptr;
        status_ = brume_plan_create(scene.get(), &format, &plan);
        context_.check(status_);
        handle_.reset(plan);
    }

    brume_plan get() const { return handle_.get(); }
    explicit operator bool() const { return handle_ != nullptr; }
    brume_status status() const { return status_; }
    const Context &context() const { return context_; }

    brume_plan_info info() const
    {
        brume_plan_info info = BRUME_PLAN_INFO_INIT;
        context_.check(brume_plan_get_info(get(), &info));
        return info;
    }

    std::vector<brume_plan_entry> entries() const
    {
        std::vector<brume_plan_entry> all(info().entry_count, brume_plan_entry BRUME_PLAN_ENTRY_INIT);
        for (std::size_t i = 0; i < all.size(); ++i)
            context_.check(brume_plan_get_entry(get(), std::uint32_t(i), &all[i]));
        return all;
    }

    // Another scene of the same structure, for the frames from now on.
    Result update(const Scene &scene) { return context_.check(brume_plan_update(get(), scene.get(), nullptr)); }
    Result update(const Scene &scene, const brume_format &format)
    {
        return context_.check(brume_plan_update(get(), scene.get(), &format));
    }

    Result execute(const brume_frame &frame) { return context_.check(brume_plan_execute(get(), &frame)); }
    Result execute(const brume_image &color, const brume_image &depth, const brume_image &output,
                 const brume_camera *camera = nullptr, double frame_number = 0)
    {
        brume_frame frame = BRUME_FRAME_INIT;
        frame.color = &color;
        frame.depth = &depth;
        frame.output = &output;
        frame.camera = camera;
        frame.frame = frame_number;
        return execute(frame);
    }

private:
    Context context_;
    std::unique_ptr<brume_plan_t, detail::Destroy> handle_;
    brume_status status_ = BRUME_OK;
};

inline brume_format format(std::int32_t width, std::int32_t height)
{
    brume_format format = BRUME_FORMAT_INIT;
    format.width = width;
    format.height = height;
    return format;
}

// Packed floats. The library writes through the pointer only where the image is an output.
inline brume_image image(const float *data, std::int32_t width, std::int32_t height, std::uint32_t channels)
{
    brume_image image = BRUME_IMAGE_INIT;
    image.data = const_cast<float *>(data);
    image.width = width;
    image.height = height;
    image.channels = channels;
    return image;
}

// Keeps the pointers. Without an image, as formats have layers; `light` is of the layers that lights have one each of.
inline brume_layer layer(const char *name, const brume_image *image = nullptr, std::uint32_t light = 0)
{
    brume_layer layer = BRUME_LAYER_INIT;
    layer.name = name;
    layer.image = image;
    layer.light = light;
    return layer;
}

// Packed halves, as their bits.
inline brume_image half_image(const std::uint16_t *data, std::int32_t width, std::int32_t height, std::uint32_t channels)
{
    brume_image image = BRUME_IMAGE_INIT;
    image.data = const_cast<std::uint16_t *>(data);
    image.pixel = BRUME_PIXEL_F16;
    image.width = width;
    image.height = height;
    image.channels = channels;
    return image;
}

// A GL_TEXTURE_2D of the borrowed context; its first row is the bottom one.
inline brume_image texture(std::uint32_t name, std::int32_t width, std::int32_t height, std::uint32_t channels)
{
    brume_image image = BRUME_IMAGE_INIT;
    image.kind = BRUME_IMAGE_GL_TEXTURE;
    image.origin = BRUME_ORIGIN_BOTTOM_LEFT;
    image.gl_texture = name;
    image.width = width;
    image.height = height;
    image.channels = channels;
    return image;
}

// The part of an image from column x and row y on, rows counted as they are stored.
inline brume_image part(brume_image image, std::int32_t x, std::int32_t y, std::int32_t width, std::int32_t height)
{
    if (image.whole_width == 0) {
        image.whole_width = image.width;
        image.whole_height = image.height;
    }
    image.x += x;
    image.y += y;
    image.width = width;
    image.height = height;
    return image;
}

#ifdef BRUME_HPP_NO_EXCEPTIONS
}  // namespace no_exceptions
#endif
}  // namespace brume

#endif
