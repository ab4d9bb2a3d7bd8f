#include "host.h"

namespace openfx {

using namespace ofx;

Suites suites;

Status fetch_suites(const Host *host)
{
    if (!host || !host->fetch_suite)
        return missing_host_feature;
    const auto fetch = [&](auto &suite, const char *name, int version) {
        suite = static_cast<std::remove_reference_t<decltype(suite)>>(host->fetch_suite(host->properties, name, version));
    };
    fetch(suites.properties, suite::properties, 1);
    fetch(suites.effects, suite::effects, 1);
    fetch(suites.parameters, suite::parameters, 1);
    fetch(suites.persistent_messages, suite::messages, 2);
    fetch(suites.messages, suite::messages, 1);
    fetch(suites.threads, suite::threads, 1);
    fetch(suites.gl, suite::gl, 1);
    if (!suites.messages)
        suites.messages = suites.persistent_messages;
    return suites.properties && suites.effects && suites.parameters ? ok : missing_host_feature;
}

void Properties::set(const char *name, const RectD &value) const
{
    const double numbers[] = {value.x1, value.y1, value.x2, value.y2};
    suites.properties->set_doubles(set_, name, 4, numbers);
}

std::string Properties::text(const char *name) const
{
    char *value = nullptr;
    return suites.properties->get_string(set_, name, 0, &value) == ok && value ? value : "";
}

double Properties::number(const char *name, double otherwise) const
{
    double value = 0;
    return suites.properties->get_double(set_, name, 0, &value) == ok ? value : otherwise;
}

int Properties::integer(const char *name, int otherwise) const
{
    int value = 0;
    return suites.properties->get_int(set_, name, 0, &value) == ok ? value : otherwise;
}

void *Properties::pointer(const char *name) const
{
    void *value = nullptr;
    return suites.properties->get_pointer(set_, name, 0, &value) == ok ? value : nullptr;
}

PointD Properties::point(const char *name, PointD otherwise) const
{
    double values[2];
    return suites.properties->get_doubles(set_, name, 2, values) == ok ? PointD{values[0], values[1]} : otherwise;
}

RectI Properties::rectangle(const char *name) const
{
    int values[4];
    if (suites.properties->get_ints(set_, name, 4, values) != ok)
        throw Refusal("The host: no " + std::string(name) + "; expected four integers");
    return {values[0], values[1], values[2], values[3]};
}

Properties properties_of(EffectHandle effect)
{
    PropertySet set = nullptr;
    suites.effects->get_property_set(effect, &set);
    return set;
}

Clip::Clip(EffectHandle effect, const char *name) : name_(name), properties_(nullptr)
{
    PropertySet set = nullptr;
    if (suites.effects->clip_get_handle(effect, name, &handle_, &set) == ok)
        properties_ = set;
}

RectD Clip::region(Time time) const
{
    RectD region{};
    if (suites.effects->clip_get_region_of_definition(handle_, time, &region) != ok)
        throw Refusal(std::string(name_) + ": the host has no region of it");
    return region;
}

ClipImage::ClipImage(const Clip &clip, Time time) : properties_(nullptr)
{
    const std::string name = clip.name();
    if (suites.effects->clip_get_image(clip.handle(), time, nullptr, &image_) != ok || !image_)
        throw Refusal(name + ": the host has no image of it at this time");
    properties_ = image_;
    try {
        const std::string depth = properties_.text(property::depth), components = properties_.text(property::components);
        if (depth != pixels::floating)
            throw Refusal(name + ": pixels of " + depth + "; expected " + pixels::floating);
        channels_ = components == pixels::rgba ? 4 : components == pixels::rgb ? 3 : components == pixels::alpha ? 1 : 0;
        if (channels_ == 0)
            throw Refusal(name + ": components " + components + "; expected RGBA, RGB or Alpha");
        bounds_ = properties_.rectangle(property::bounds);
        row_bytes_ = properties_.integer(property::row_bytes, 0);
        data_ = static_cast<char *>(properties_.pointer(property::data));
        if (!data_ || width() <= 0 || height() <= 0)
            throw Refusal(name + ": the host's image has no pixels");
    } catch (...) {
        suites.effects->clip_release_image(image_);
        throw;
    }
}

float *ClipImage::at(int x, int y) const
{
    return reinterpret_cast<float *>(data_ + std::ptrdiff_t(y - bounds_.y1) * row_bytes_) +
           std::ptrdiff_t(x - bounds_.x1) * channels_;
}

brume_image ClipImage::all_channels() const
{
    brume_image image = BRUME_IMAGE_INIT;
    image.width = width();
    image.height = height();
    image.channels = uint32_t(channels_);
    image.data = at(bounds_.x1, bounds_.y2 - 1);
    image.pixel_stride = channels_ * int64_t(sizeof(float));
    image.row_stride = -int64_t(row_bytes_);
    return image;
}

brume_image ClipImage::one_channel(int channel) const
{
    brume_image image = all_channels();
    image.channels = 1;
    image.data = at(bounds_.x1, bounds_.y2 - 1) + channel;
    return image;
}

void show_error(EffectHandle effect, const std::string &text)
{
    // Never the format itself: names of files may have a %.
    if (suites.persistent_messages)
        suites.persistent_messages->set_persistent(effect, message::error, "", "%s", text.c_str());
    else if (suites.messages)
        suites.messages->message(effect, message::error, "", "%s", text.c_str());
}

void withdraw_error(EffectHandle effect)
{
    if (suites.persistent_messages)
        suites.persistent_messages->clear_persistent(effect);
}

unsigned granted_threads()
{
    unsigned count = 0;
    return suites.threads && suites.threads->cpu_count(&count) == ok ? count : 0;
}

}  // namespace openfx
