#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "effect.h"
#include "instance.h"

namespace openfx {

using namespace ofx;

Instance &instance_of(EffectHandle effect)
{
    auto *instance = static_cast<Instance *>(properties_of(effect).pointer(property::instance_data));
    if (!instance)
        throw Refusal("The host has lost the instance's data");
    return *instance;
}

// The scale that the host renders at, and where the project lies in pixels of that scale.
Frame frame_of(EffectHandle effect, Properties in, const RectI &bounds, double pixel_aspect)
{
    const PointD scale = in.point(property::render_scale, {1, 1});
    if (!(scale.x > 0 && scale.y > 0 && pixel_aspect > 0))
        throw Refusal(fmt::format("The host: render scale {} x {}, pixel aspect {}; expected more than 0", scale.x, scale.y,
                                  pixel_aspect));
    const int width = bounds.x2 - bounds.x1, height = bounds.y2 - bounds.y1;
    Frame frame{width, height, 0, 0, width, height, pixel_aspect * scale.y / scale.x};
    const PointD size = properties_of(effect).point(property::project_size, {0, 0}),
                 offset = properties_of(effect).point(property::project_offset, {0, 0});
    if (size.x > 0 && size.y > 0) {
        const auto x = [&](double canonical) { return int(std::lround(canonical * scale.x / pixel_aspect)); };
        const auto y = [&](double canonical) { return int(std::lround(canonical * scale.y)); };
        frame.display_x = x(offset.x) - bounds.x1;
        frame.display_width = std::max(1, x(offset.x + size.x) - x(offset.x));
        frame.display_y = bounds.y2 - y(offset.y + size.y);
        frame.display_height = std::max(1, y(offset.y + size.y) - y(offset.y));
    }
    return frame;
}

namespace {

// The top row first.
brume_image packed(std::vector<float> &values, const RectI &bounds, int channels)
{
    brume_image image = BRUME_IMAGE_INIT;
    image.width = bounds.x2 - bounds.x1;
    image.height = bounds.y2 - bounds.y1;
    image.channels = uint32_t(channels);
    image.data = values.data();
    return image;
}

// Depth of the source's pixels. Beyond the depth image there is 0, as hosts crop what is black.
class Depth {
public:
    Depth(const ClipImage &from, int channel, const char *clip, const RectI &bounds)
    {
        if (from.channels() == 1)
            channel = 0;
        if (channel >= from.channels())
            throw Refusal(
                fmt::format("Depth channel: {}; {} has {} channels", channel_names[channel], clip, from.channels()));
        if (from.bounds() == bounds) {
            image_ = from.one_channel(channel);
            return;
        }
        const int width = bounds.x2 - bounds.x1;
        copy_.resize(size_t(width) * size_t(bounds.y2 - bounds.y1));
        const RectI &have = from.bounds();
        for (int y = std::max(bounds.y1, have.y1); y < std::min(bounds.y2, have.y2); ++y)
            for (int x = std::max(bounds.x1, have.x1); x < std::min(bounds.x2, have.x2); ++x)
                copy_[size_t(bounds.y2 - 1 - y) * size_t(width) + size_t(x - bounds.x1)] = from.at(x, y)[channel];
        image_ = packed(copy_, bounds, 1);
    }

    const brume_image &image() const { return image_; }

private:
    std::vector<float> copy_;
    brume_image image_;
};

// The window of the fogged source, which is packed; where there is no source, there is nothing.
void write(const ClipImage &output, const RectI &asked, const std::vector<float> &fogged, const ClipImage &source)
{
    const RectI &bounds = output.bounds(), &have = source.bounds();
    const int channels = source.channels(), common = std::min(channels, output.channels());
    for (int y = std::max(asked.y1, bounds.y1); y < std::min(asked.y2, bounds.y2); ++y)
        for (int x = std::max(asked.x1, bounds.x1); x < std::min(asked.x2, bounds.x2); ++x) {
            const bool inside = x >= have.x1 && x < have.x2 && y >= have.y1 && y < have.y2;
            std::fill_n(output.at(x, y), output.channels(), inside ? 1.f : 0.f);
            if (inside)
                std::copy_n(fogged.begin() + ((have.y2 - 1 - y) * std::ptrdiff_t(source.width()) + x - have.x1) * channels,
                            common, output.at(x, y));
        }
}

void fog_frame(Instance &instance, Properties in)
{
    const Time time = in.number(property::time, 0);
    const Settings settings = read_settings(instance.effect, time);
    const Clip source_clip(instance.effect, clip::source), depth_clip(instance.effect, clip::depth);
    if (!instance.filter && !depth_clip.connected())
        throw Refusal("Depth: not connected; expected a clip that holds the distance to what each pixel shows");
    const ClipImage source(source_clip, time), output(Clip(instance.effect, clip::output), time);
    for (const ClipImage *image : {&source, &output})
        if (image->channels() < 3)
            throw Refusal(
                fmt::format("{}: components Alpha; expected RGBA or RGB", image == &source ? clip::source : clip::output));
    std::optional<ClipImage> depth_image;
    if (!instance.filter)
        depth_image.emplace(depth_clip, time);
    const Depth depth(depth_image ? *depth_image : source, settings.depth_channel, depth_image ? clip::depth : clip::source,
                      source.bounds());
    Fog &fog = instance.get_fog();
    fog.prepare(settings, frame_of(instance.effect, in, source.bounds(), source.pixel_aspect()));

    std::vector<float> fogged(size_t(source.width()) * size_t(source.height()) * size_t(source.channels()));
    const brume_image to = packed(fogged, source.bounds(), source.channels());
    fog.run(source.all_channels(), depth.image(), to, time);
    write(output, in.rectangle(property::render_window), fogged, source);
}

}  // namespace

// Nothing that can fail is done before the first frame: hosts drop an effect from the user's project where this fails.
Status create_instance(EffectHandle effect)
{
    properties_of(effect).set(property::instance_data, new Instance(effect));
    return ok;
}

Status destroy_instance(EffectHandle effect)
{
    delete &instance_of(effect);
    properties_of(effect).set(property::instance_data, static_cast<void *>(nullptr));
    return ok;
}

Status purge_caches(EffectHandle effect)
{
    Instance &instance = instance_of(effect);
    std::unique_lock lock(instance.mutex, std::try_to_lock);
    if (lock)
        instance.fog.reset();
    return ok;
}

Status region_of_definition(EffectHandle effect, Properties in, Properties out)
{
    const Clip source(effect, clip::source);
    if (!source.connected())
        return reply_default;
    out.set(property::region_of_definition, source.region(in.number(property::time, 0)));
    return ok;
}

Status regions_of_interest(EffectHandle effect, Properties in, Properties out)
{
    for (const char *name : {clip::source, clip::depth}) {
        const Clip clip(effect, name);
        if (clip.connected())
            out.set((property::clip_region + std::string(name)).c_str(), clip.region(in.number(property::time, 0)));
    }
    return ok;
}

Status clip_preferences(EffectHandle effect, Properties out)
{
    // Scene files may have keys.
    out.set(property::frame_varying, scene_file(effect, 0).empty() ? 0 : 1);
    return ok;
}

Status is_identity(EffectHandle effect, Properties in, Properties out)
try {
    Instance &instance = instance_of(effect);
    const std::unique_lock lock(instance.mutex, std::try_to_lock);
    if (!lock)
        return reply_default;
    const Time time = in.number(property::time, 0);
    const Clip source(effect, clip::source);
    const RectD region = source.region(time);
    const PointD scale = in.point(property::render_scale, {1, 1});
    const double aspect = source.properties().number(property::pixel_aspect, 1);
    const RectI bounds{int(std::floor(region.x1 * scale.x / aspect)), int(std::floor(region.y1 * scale.y)),
                       int(std::ceil(region.x2 * scale.x / aspect)), int(std::ceil(region.y2 * scale.y))};
    if (!instance.get_fog().does_nothing(read_settings(effect, time), frame_of(effect, in, bounds, aspect)))
        return reply_default;
    withdraw_error(effect);
    out.set(property::name, clip::source);
    out.set(property::time, time);
    return ok;
} catch (const std::exception &) {
    return reply_default;  // rendering says what is wrong
}

Status render(EffectHandle effect, Properties in)
{
    Instance &instance = instance_of(effect);
    const std::lock_guard lock(instance.mutex);
    try {
        if (in.integer(property::gl_enabled, 0) == 0)
            fog_frame(instance, in);
        else if (const Status status = fog_textures(instance, in); status != ok)
            return status;
    } catch (const LibraryError &error) {
        if (error.status == BRUME_ERROR_CANCELLED)
            return ok;  // the host drops what it did not wait for
        throw;
    }
    withdraw_error(effect);
    return ok;
}

}  // namespace openfx
