// What the host calls.
#include <cstring>
#include <exception>
#include <new>

#include "effect.h"

namespace {

using namespace openfx;

const ofx::Host *host = nullptr;

void set_host(ofx::Host *given)
{
    host = given;
}

ofx::Status act(const char *name, ofx::EffectHandle effect, Properties in, Properties out)
{
    const auto is = [&](const char *action) { return std::strcmp(name, action) == 0; };
    if (is(ofx::action::load))
        return fetch_suites(host);
    if (is(ofx::action::unload)) {
        suites = {};
        return ofx::ok;
    }
    if (is(ofx::action::describe))
        return describe(effect);
    if (is(ofx::action::describe_in_context))
        return describe_in_context(effect, in.text(ofx::property::context));
    if (is(ofx::action::create_instance))
        return create_instance(effect);
    if (is(ofx::action::destroy_instance))
        return destroy_instance(effect);
    if (is(ofx::action::purge_caches))
        return purge_caches(effect);
    if (is(ofx::action::region_of_definition))
        return region_of_definition(effect, in, out);
    if (is(ofx::action::regions_of_interest))
        return regions_of_interest(effect, in, out);
    if (is(ofx::action::clip_preferences))
        return clip_preferences(effect, out);
    if (is(ofx::action::is_identity))
        return is_identity(effect, in, out);
    if (is(ofx::action::render))
        return render(effect, in);
    if (is(ofx::action::gl_attached))
        return attach_gl(effect);
    if (is(ofx::action::gl_detached) || is(ofx::action::gl_detached_as_documented))
        return detach_gl(effect);
    return ofx::reply_default;
}

ofx::Status enter(const char *name, const void *handle, ofx::PropertySet in, ofx::PropertySet out)
{
    const auto effect = static_cast<ofx::EffectHandle>(const_cast<void *>(handle));
    try {
        return act(name, effect, in, out);
    } catch (const std::bad_alloc &) {
        return ofx::out_of_memory;
    } catch (const std::exception &error) {
        show_error(effect, error.what());
        return ofx::failed;
    }
}

ofx::Plugin plugin = {ofx::api, 1, "org.brume.fog", BRUME_VERSION_MAJOR, BRUME_VERSION_MINOR, set_host, enter};

}  // namespace

#define ENTRY extern "C" __attribute__((visibility("default")))

ENTRY ofx::Status OfxSetHost(const ofx::Host *given)
{
    host = given;
    return ofx::ok;
}

ENTRY int OfxGetNumberOfPlugins()
{
    return 1;
}

ENTRY ofx::Plugin *OfxGetPlugin(int index)
{
    return index == 0 ? &plugin : nullptr;
}
