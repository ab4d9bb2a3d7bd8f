// The suites of the test host. Handles are pointers to its objects.
#include <cstdarg>
#include <cstdio>
#include <cstring>

#include "host.h"

namespace host {

extern const ofx::GlSuite gl_suite;

namespace {

using namespace ofx;

Set &of(PropertySet set)
{
    return *reinterpret_cast<Set *>(set);
}
Effect &of(EffectHandle effect)
{
    return *reinterpret_cast<Effect *>(effect);
}
Clip &of(ClipHandle clip)
{
    return *reinterpret_cast<Clip *>(clip);
}
Parameter &of(ParameterHandle parameter)
{
    return *reinterpret_cast<Parameter *>(parameter);
}
PropertySet handle(Set &set)
{
    return reinterpret_cast<PropertySet>(&set);
}

template <class Type, class Given> Status set(PropertySet to, const char *name, int index, Given value)
{
    auto &values = of(to).values[name];
    if (size_t(index) >= values.size())
        values.resize(size_t(index) + 1);
    values[size_t(index)] = Type(value);
    return ok;
}

template <class Type, class Given> Status set_all(PropertySet to, const char *name, int count, const Given *values)
{
    for (int i = 0; i < count; ++i)
        set<Type>(to, name, i, values[i]);
    return ok;
}

template <class Type> Type *find(PropertySet from, const char *name, int index)
{
    const auto values = of(from).values.find(name);
    return values == of(from).values.end() || size_t(index) >= values->second.size()
               ? nullptr
               : std::get_if<Type>(&values->second[size_t(index)]);
}

template <class Type> Status get(PropertySet from, const char *name, int index, Type *value)
{
    const Type *found = find<Type>(from, name, index);
    return found ? (*value = *found, ok) : unknown;
}

template <class Type> Status get_all(PropertySet from, const char *name, int count, Type *values)
{
    for (int i = 0; i < count; ++i)
        if (get(from, name, i, &values[i]) != ok)
            return unknown;
    return ok;
}

Status get_string(PropertySet from, const char *name, int index, char **value)
{
    std::string *found = find<std::string>(from, name, index);
    return found ? (*value = found->data(), ok) : unknown;
}

Status get_dimension(PropertySet from, const char *name, int *count)
{
    *count = int(of(from).values[name].size());
    return ok;
}

const PropertySuite properties = {set<void *, void *>,
                                  set<std::string, const char *>,
                                  set<double, double>,
                                  set<int, int>,
                                  nullptr,
                                  nullptr,
                                  set_all<double, double>,
                                  set_all<int, int>,
                                  get<void *>,
                                  get_string,
                                  get<double>,
                                  get<int>,
                                  get_all<void *>,
                                  nullptr,
                                  get_all<double>,
                                  get_all<int>,
                                  nullptr,
                                  get_dimension};

Status effect_properties(EffectHandle effect, PropertySet *set)
{
    *set = handle(of(effect).properties);
    return ok;
}

Status effect_parameters(EffectHandle effect, ParameterSet *set)
{
    *set = reinterpret_cast<ParameterSet>(effect);
    return ok;
}

Status clip_define(EffectHandle effect, const char *name, PropertySet *set)
{
    of(effect).order.emplace_back(name);
    *set = handle(of(effect).clips[name].properties);
    return ok;
}

Status clip_handle(EffectHandle effect, const char *name, ClipHandle *clip, PropertySet *set)
{
    const auto found = of(effect).clips.find(name);
    if (found == of(effect).clips.end())
        return unknown;
    *clip = reinterpret_cast<ClipHandle>(&found->second);
    if (set)
        *set = handle(found->second.properties);
    return ok;
}

Status clip_properties(ClipHandle clip, PropertySet *set)
{
    *set = handle(of(clip).properties);
    return ok;
}

Status clip_image(ClipHandle clip, Time, const RectD *, PropertySet *image)
{
    if (!of(clip).picture)
        return failed;
    *image = handle(*of(clip).picture->hand_out());
    return ok;
}

Status release_image(PropertySet image)
{
    --static_cast<Picture *>(of(image).get<void *>("host's picture"))->handed_out;
    return ok;
}

Status clip_region(ClipHandle clip, Time, RectD *region)
{
    *region = of(clip).region;
    return of(clip).picture ? ok : failed;
}

int asked_to_abort(EffectHandle effect)
{
    return ++of(effect).polls == of(effect).abort_at;
}

const EffectSuite effects = {effect_properties, effect_parameters, clip_define, clip_handle,    clip_properties,
                             clip_image,        release_image,     clip_region, asked_to_abort, nullptr,
                             nullptr,           nullptr,           nullptr};

Status define(ParameterSet set, const char *type, const char *name, PropertySet *properties)
{
    Parameter &parameter = of(reinterpret_cast<EffectHandle>(set)).parameters[name];
    if (!parameter.type.empty())
        return exists;
    parameter.type = type;
    *properties = handle(parameter.properties);
    return ok;
}

Status parameter_handle(ParameterSet set, const char *name, ParameterHandle *parameter, PropertySet *properties)
{
    auto &all = of(reinterpret_cast<EffectHandle>(set)).parameters;
    const auto found = all.find(name);
    if (found == all.end())
        return unknown;
    *parameter = reinterpret_cast<ParameterHandle>(&found->second);
    if (properties)
        *properties = handle(found->second.properties);
    return ok;
}

Status value_at_time(ParameterHandle handle, Time time, ...)
{
    Parameter &parameter = of(handle);
    va_list list;
    va_start(list, time);
    if (parameter.type == type::string)
        *va_arg(list, char **) = parameter.text.data();
    else if (parameter.type == type::choice)
        *va_arg(list, int *) = int(parameter.numbers.at(0));
    else
        for (double number : parameter.numbers)
            *va_arg(list, double *) = parameter.animated ? parameter.animated(time) : number;
    va_end(list);
    return ok;
}

const ParameterSuite parameters = {define,  parameter_handle, nullptr, nullptr, nullptr, value_at_time,
                                   nullptr, nullptr,          nullptr, nullptr, nullptr, nullptr,
                                   nullptr, nullptr,          nullptr, nullptr, nullptr, nullptr};

Status show(void *effect, const char *kind, const char *, const char *format, ...)
{
    char text[4096];
    va_list list;
    va_start(list, format);
    std::vsnprintf(text, sizeof text, format, list);
    va_end(list);
    if (std::strcmp(kind, message::error) != 0)
        return bad_value;
    static_cast<Effect *>(effect)->error = text;
    return ok;
}

Status withdraw(void *effect)
{
    static_cast<Effect *>(effect)->error.clear();
    return ok;
}

const MessageSuite messages = {show, show, withdraw};

Status cpu_count(unsigned *count)
{
    *count = 3;
    return ok;
}

const ThreadSuite threads = {nullptr, cpu_count, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr};

}  // namespace

const void *fetch(const char *name, int version, const Options &options)
{
    const std::string wanted = name;
    if (wanted == suite::messages && (version == 1 || version == 2) && options.messages)
        return &messages;
    if (version != 1)
        return nullptr;
    if (wanted == suite::properties)
        return &properties;
    if (wanted == suite::effects)
        return &effects;
    if (wanted == suite::parameters && options.parameters)
        return &parameters;
    if (wanted == suite::threads && options.threads)
        return &threads;
#ifdef BRUME_GL
    if (wanted == suite::gl && options.gl)
        return &gl_suite;
#endif
    return nullptr;
}

}  // namespace host
