#include "host.h"

#include <dlfcn.h>

#include <cstdlib>
#include <stdexcept>

namespace host {

const void *fetch(const char *name, int version, const Options &options);

namespace {

// What was built, or installed.
std::string binary()
{
    const char *path = std::getenv("BRUME_TEST_OFX_PATH");
    return std::string(path ? path : OPENFX_PATH) + "/Brume.ofx.bundle/Contents/Linux-x86-64/Brume.ofx";
}

thread_local const Options *fetching = nullptr;

const void *fetch_suite(ofx::PropertySet, const char *name, int version)
{
    return fetch(name, version, *fetching);
}

}  // namespace

std::vector<std::string> Set::strings(const std::string &name) const
{
    std::vector<std::string> all;
    for (const Value &value : values.at(name))
        all.push_back(std::get<std::string>(value));
    return all;
}

Picture::Picture(ofx::RectI bounds, int channels, bool downwards, int padding)
    : bounds(bounds), channels(channels), downwards_(downwards), row_((bounds.x2 - bounds.x1) * channels + padding),
      memory_(size_t(row_) * size_t(bounds.y2 - bounds.y1), -7777.f)
{
    for (int y = bounds.y1; y < bounds.y2; ++y)
        for (int i = 0; i < (bounds.x2 - bounds.x1) * channels; ++i)
            (&at(bounds.x1, y, 0))[i] = 0;
}

float &Picture::at(int x, int y, int channel)
{
    const int row = downwards_ ? bounds.y2 - 1 - y : y - bounds.y1;
    return memory_[size_t(row) * size_t(row_) + size_t(x - bounds.x1) * size_t(channels) + size_t(channel)];
}

Set *Picture::hand_out()
{
    ++handed_out;
    properties_.put<std::string>(ofx::property::components, {channels == 4   ? ofx::pixels::rgba
                                                             : channels == 3 ? ofx::pixels::rgb
                                                                             : ofx::pixels::alpha});
    properties_.put<std::string>(ofx::property::depth, {depth});
    properties_.put<double>(ofx::property::pixel_aspect, {aspect});
    properties_.put<int>(ofx::property::bounds, {bounds.x1, bounds.y1, bounds.x2, bounds.y2});
    properties_.put<int>(ofx::property::row_bytes, {(downwards_ ? -1 : 1) * row_ * int(sizeof(float))});
    properties_.put<void *>(ofx::property::data, {&at(bounds.x1, bounds.y1, 0)});
    properties_.put<void *>("host's picture", {this});
    return &properties_;
}

Bundle::Bundle(const Options &options)
    : options_(options), properties_(std::make_unique<Set>()), host_(std::make_unique<ofx::Host>())
{
    library_ = dlopen(binary().c_str(), RTLD_LAZY | RTLD_LOCAL);
    if (!library_)
        throw std::runtime_error(dlerror());
    const auto count = reinterpret_cast<int (*)()>(dlsym(library_, "OfxGetNumberOfPlugins"));
    const auto get = reinterpret_cast<ofx::Plugin *(*)(int)>(dlsym(library_, "OfxGetPlugin"));
    if (!count || !get || count() != 1)
        throw std::runtime_error("not a bundle of one plugin");
    plugin = get(0);
    host_->properties = reinterpret_cast<ofx::PropertySet>(properties_.get());
    host_->fetch_suite = fetch_suite;
    plugin->set_host(host_.get());
    fetching = &options_;
    loaded = act(ofx::action::load);
}

Bundle::~Bundle()
{
    act(ofx::action::unload);
    dlclose(library_);
}

bool Bundle::is_mapped()
{
    void *library = dlopen(binary().c_str(), RTLD_LAZY | RTLD_NOLOAD);
    if (library)
        dlclose(library);
    return library != nullptr;
}

ofx::Status Bundle::act(const char *action, const void *handle, Set *in, Set *out) const
{
    return plugin->main(action, handle, reinterpret_cast<ofx::PropertySet>(in), reinterpret_cast<ofx::PropertySet>(out));
}

Effect Bundle::describe(const char *context) const
{
    Effect effect;
    Set in;
    in.put<std::string>(ofx::property::context, {context});
    if (act(ofx::action::describe, &effect) != ofx::ok || act(ofx::action::describe_in_context, &effect, &in) != ofx::ok)
        throw std::runtime_error("it does not describe itself: " + effect.error);
    return effect;
}

Instance::Instance(const Bundle &bundle, const char *context) : bundle(bundle), effect(bundle.describe(context))
{
    effect.properties.put<std::string>(ofx::property::context, {context});
    for (auto &[name, parameter] : effect.parameters)
        for (const Value &value : parameter.properties.values[ofx::property::initial])
            parameter.numbers.push_back(std::holds_alternative<int>(value) ? std::get<int>(value) : std::get<double>(value));
    for (auto &[name, clip] : effect.clips)
        clip.properties.put<int>(ofx::property::connected, {0});
    created = bundle.act(ofx::action::create_instance, &effect);
}

Instance::~Instance()
{
    bundle.act(ofx::action::destroy_instance, &effect);
}

void Instance::connect(const std::string &name, Picture &picture)
{
    Clip &clip = effect.clips.at(name);
    const ofx::RectI &bounds = picture.bounds;
    const double x = picture.aspect / scale.x, y = 1 / scale.y;
    clip.picture = &picture;
    clip.is_output = name == ofx::clip::output;
    clip.region = {bounds.x1 * x, bounds.y1 * y, bounds.x2 * x, bounds.y2 * y};
    clip.properties.put<int>(ofx::property::connected, {1});
    clip.properties.put<double>(ofx::property::pixel_aspect, {picture.aspect});
}

void Instance::project(double x, double y, double width, double height)
{
    effect.properties.put<double>(ofx::property::project_offset, {x, y});
    effect.properties.put<double>(ofx::property::project_size, {width, height});
}

ofx::Status Instance::act_on_frame(const char *action, const ofx::RectI &window, double time, Set *out) const
{
    Set in;
    in.put<double>(ofx::property::time, {time});
    in.put<double>(ofx::property::render_scale, {scale.x, scale.y});
    if (on_gl)
        in.put<int>(ofx::property::gl_enabled, {1});
    in.put<int>(ofx::property::render_window, {window.x1, window.y1, window.x2, window.y2});
    return bundle.act(action, &effect, &in, out);
}

std::string Instance::identity(double time) const
{
    Set out;
    const ofx::Status status = act_on_frame(ofx::action::is_identity, {}, time, &out);
    return status == ofx::ok ? out.get<std::string>(ofx::property::name) : "";
}

}  // namespace host
