// Frames in the host's textures.
#include <new>

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "channel_texture.h"
#include "effect.h"
#include "gl_functions.h"
#include "instance.h"

namespace openfx {

using namespace ofx;

// In the context that was current when it was made.
class GlFog {
public:
    explicit GlFog(EffectHandle effect) : fog(BRUME_BACKEND_GL, Instance::is_aborted, effect) {}

    Fog fog;
    ChannelTexture channel;
};

namespace {

// A texture of a clip, held until destroyed. Its first row is the bottom one.
class ClipTexture {
public:
    ClipTexture(const Clip &clip, Time time) : properties_(nullptr)
    {
        const Status status = suites.gl->clip_load_texture(clip.handle(), time, pixels::floating, nullptr, &texture_);
        if (status == out_of_memory)
            throw std::bad_alloc();
        if (status != ok || !texture_)
            throw Refusal(fmt::format("{}: the host has no texture of it at this time", clip.name()));
        properties_ = texture_;
        try {
            read(clip.name());
        } catch (...) {
            suites.gl->clip_free_texture(texture_);
            throw;
        }
    }
    ~ClipTexture() { suites.gl->clip_free_texture(texture_); }
    ClipTexture(const ClipTexture &) = delete;
    ClipTexture &operator=(const ClipTexture &) = delete;

    const RectI &bounds() const { return bounds_; }
    int channels() const { return channels_; }
    double pixel_aspect() const { return properties_.number(property::pixel_aspect, 1); }
    brume_image image() const
    {
        brume_image image = BRUME_IMAGE_INIT;
        image.kind = BRUME_IMAGE_GL_TEXTURE;
        image.origin = BRUME_ORIGIN_BOTTOM_LEFT;
        image.gl_texture = name_;
        image.width = bounds_.x2 - bounds_.x1;
        image.height = bounds_.y2 - bounds_.y1;
        return image;
    }

private:
    void read(const char *clip)
    {
        const std::string depth = properties_.text(property::depth), components = properties_.text(property::components);
        if (depth != pixels::floating)
            throw Refusal(fmt::format("{}: texture of {}; expected {}", clip, depth, pixels::floating));
        channels_ = components == pixels::rgba ? 4 : components == pixels::rgb ? 3 : components == pixels::alpha ? 1 : 0;
        if (channels_ == 0)
            throw Refusal(fmt::format("{}: components {}; expected RGBA, RGB or Alpha", clip, components));
        const int target = properties_.integer(property::texture_target, 0);
        if (target != GL_TEXTURE_2D)
            throw Refusal(fmt::format("{}: texture target {:#x}; expected GL_TEXTURE_2D", clip, target));
        name_ = uint32_t(properties_.integer(property::texture, 0));
        bounds_ = properties_.rectangle(property::bounds);
    }

    PropertySet texture_ = nullptr;
    Properties properties_;
    RectI bounds_{};
    int channels_ = 0;
    uint32_t name_ = 0;
};

GlFog &fog_of(Instance &instance)
{
    if (!instance.gl) {
        if (!load_gl())
            throw Refusal("The host: no library of OpenGL is loaded that has all that Brume calls");
        instance.gl = std::make_shared<GlFog>(instance.effect);
    }
    return *instance.gl;
}

void fog(Instance &instance, Properties in)
{
    const Time time = in.number(property::time, 0);
    const Settings settings = read_settings(instance.effect, time);
    GlFog &gl = fog_of(instance);
    const Clip depth_clip(instance.effect, instance.filter ? clip::source : clip::depth);
    if (!depth_clip.connected())
        throw Refusal("Depth: not connected");
    const ClipTexture source(Clip(instance.effect, clip::source), time), output(Clip(instance.effect, clip::output), time);
    std::optional<ClipTexture> other;
    if (!instance.filter)
        other.emplace(depth_clip, time);
    const ClipTexture &depth = other ? *other : source;
    const RectI &bounds = source.bounds();
    if (source.channels() != 4 || output.channels() != 4)
        throw Refusal("Textures without alpha; expected RGBA");
    if (output.bounds() != bounds || depth.bounds() != bounds || in.rectangle(property::render_window) != bounds)
        throw Refusal("Textures of different regions, or a window of them; expected all of the same");
    const int channel = depth.channels() == 1 ? 0 : settings.depth_channel;
    if (channel >= depth.channels())
        throw Refusal("Depth channel: the texture has none of this number");

    gl.fog.prepare(settings, frame_of(instance.effect, in, bounds, source.pixel_aspect()));
    brume_image distance = depth.image();
    distance.channels = 1;
    distance.gl_texture = gl.channel.copy(distance.gl_texture, channel, distance.width, distance.height);
    gl.fog.run(source.image(), distance, output.image(), time);
}

}  // namespace

Status fog_textures(Instance &instance, Properties in)
try {
    if (!suites.gl)
        return gl_render_failed;
    fog(instance, in);
    return ok;
} catch (const LibraryError &error) {
    if (error.status == BRUME_ERROR_CANCELLED)
        throw;
    return error.status == BRUME_ERROR_MEMORY ? gl_out_of_memory : gl_render_failed;
} catch (const Refusal &) {
    return gl_render_failed;
}

Status attach_gl(EffectHandle effect)
try {
    Instance &instance = instance_of(effect);
    const std::lock_guard lock(instance.mutex);
    instance.gl.reset();
    fog_of(instance);
    return ok;
} catch (const std::runtime_error &) {
    return failed;  // the host then renders on the CPU
}

Status detach_gl(EffectHandle effect)
{
    Instance &instance = instance_of(effect);
    const std::lock_guard lock(instance.mutex);
    instance.gl.reset();
    return ok;
}

}  // namespace openfx
