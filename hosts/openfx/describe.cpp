#include "effect.h"
#include "settings.h"

namespace openfx {

using namespace ofx;

Status describe(EffectHandle effect)
{
    const Properties properties = properties_of(effect);
    properties.set(property::label, "Brume Fog");
    properties.set(property::grouping, "Brume");
    properties.set(property::description, "Fog by depth: loss of contrast, and the glow that multiple scattering makes");
    properties.set(property::supported_contexts, context::general, 0);
    properties.set(property::supported_contexts, context::filter, 1);
    properties.set(property::supported_depths, pixels::floating);
    properties.set(property::thread_safety, property::instance_safe);
    // Light is spread over the whole picture by threads of the effect's own.
    properties.set(property::frame_threading, 0);
    properties.set(property::tiles, 0);
    properties.set(property::multi_resolution, 1);
    properties.set(property::multiple_depths, 0);
    properties.set(property::multiple_aspects, 0);
#ifdef BRUME_GL
    if (suites.gl) {
        properties.set(property::gl_supported, "true");
        properties.set(property::gl_depths, pixels::floating);
    }
#endif
    return ok;
}

Status describe_in_context(EffectHandle effect, const std::string &context)
{
    const bool filter = context == context::filter;
    const auto define = [&](const char *name, std::initializer_list<const char *> components) {
        PropertySet set = nullptr;
        if (suites.effects->clip_define(effect, name, &set) != ok)
            throw Refusal(std::string(name) + ": the host takes no clip of this name");
        const Properties clip = set;
        clip.set(property::label, name);
        int count = 0;
        for (const char *one : components)
            clip.set(property::supported_components, one, count++);
        clip.set(property::tiles, 0);
    };
    define(clip::source, {pixels::rgba, pixels::rgb});
    if (!filter)
        define(clip::depth, {pixels::rgba, pixels::rgb, pixels::alpha});
    define(clip::output, {pixels::rgba, pixels::rgb});
    ParameterSet parameters = nullptr;
    if (suites.effects->get_parameter_set(effect, &parameters) != ok)
        return failed;
    define_settings(parameters, filter);
    return ok;
}

}  // namespace openfx
