#include "api/backends.h"
#include "api/handles.h"
#include "api/structs.h"
#include "plan/calibration.h"

using namespace brume;
using namespace brume::api;

namespace {

struct Message {
    uint64_t context;
    std::string text;
};

// A context may be destroyed after its thread's other objects: from the destructor of something static.
thread_local bool ended = false;

struct Messages : std::vector<Message> {
    ~Messages() { ended = true; }
};

// Of the contexts this thread failed in last; short, so that threads which meet many contexts do not grow.
thread_local Messages messages;
constexpr size_t message_limit = 16;

// Null: there is no such effect.
const std::vector<Layer> *layers_of(const Context &context, const char *effect)
{
    if (!effect)
        return &host_layers();
    for (const Effect &one : context.effects.all())
        if (one.refusal.empty() && one.name == effect)
            return &one.layers;
    return nullptr;
}

uint64_t id_of(const Context *context)
{
    return context ? context->id : 0;
}

}  // namespace

void api::set_message(const Context *context, const std::string &message)
{
    if (ended)
        return;
    forget_messages(context);
    if (messages.size() == message_limit)
        messages.erase(messages.begin());
    messages.push_back({id_of(context), message});
}

const std::string &api::message_of(const Context *context)
{
    static const std::string none;
    if (ended)
        return none;
    for (const Message &message : messages)
        if (message.context == id_of(context))
            return message.text;
    return none;
}

void api::forget_messages(const Context *context)
{
    if (!ended)
        std::erase_if(messages, [&](const Message &message) { return message.context == id_of(context); });
}

extern "C" {

const char *brume_status_name(brume_status status)
{
    static const char *const names[] = {"BRUME_OK",           "BRUME_ERROR_ARGUMENT",  "BRUME_ERROR_UNSUPPORTED",
                                        "BRUME_ERROR_MEMORY", "BRUME_ERROR_NOT_FOUND", "BRUME_ERROR_SCENE",
                                        "BRUME_ERROR_CAMERA", "BRUME_ERROR_FORMAT",    "BRUME_ERROR_GL",
                                        "BRUME_ERROR_PLUGIN", "BRUME_ERROR_INTERNAL",  "BRUME_ERROR_CANCELLED"};
    bool known = status >= 0 && size_t(status) < sizeof names / sizeof *names;
    return known ? names[status] : "BRUME_ERROR_UNKNOWN";
}

uint32_t brume_version(void)
{
    return BRUME_VERSION_MAJOR * 10000 + BRUME_VERSION_MINOR * 100 + BRUME_VERSION_PATCH;
}

brume_status brume_context_create(const brume_context_desc *given, brume_context *out)
{
    if (out)
        *out = nullptr;
    return barrier(nullptr, [&] {
        expect(out, "out: NULL");
        brume_context_desc desc = BRUME_CONTEXT_DESC_INIT;
        if (given)
            desc =
                read_struct(given, desc, "brume_context_desc", &brume_context_desc::backend, &brume_context_desc::gl_context,
                            &brume_context_desc::gl_state, &brume_context_desc::threads, &brume_context_desc::log_level,
                            &brume_context_desc::log, &brume_context_desc::log_user, &brume_context_desc::plugin_directory,
                            &brume_context_desc::progress, &brume_context_desc::progress_user);
        expect(desc.backend <= BRUME_BACKEND_GL, "brume_context_desc.backend", desc.backend, "a BRUME_BACKEND_...");
        expect(desc.gl_context <= BRUME_GL_BORROWED, "brume_context_desc.gl_context", desc.gl_context,
               "BRUME_GL_OWNED or BRUME_GL_BORROWED");
        expect(desc.gl_state <= BRUME_GL_STATE_OWNED, "brume_context_desc.gl_state", desc.gl_state, "a BRUME_GL_STATE_...");
        expect(desc.threads <= 1024, "brume_context_desc.threads", desc.threads, "0 to 1024");
        expect(desc.log_level >= BRUME_LOG_ERROR && desc.log_level <= BRUME_LOG_DEBUG, "brume_context_desc.log_level",
               desc.log_level, "a BRUME_LOG_...");
        *out = new brume_context_t{create_context(desc, make_backend)};
    });
}

void brume_context_destroy(brume_context context)
{
    if (context)
        forget_messages(context->context.get());
    delete context;
}

brume_status brume_context_get_info(brume_context context, brume_context_info *info)
{
    if (!context)
        return barrier(nullptr, [] { expect(false, "context: NULL"); });
    return barrier(context->context.get(), [&] {
        const Backend &backend = *context->context->backend;
        write_struct(info,
                     {0, backend.kind(), backend.threads(), 0, backend.host_bytes(), backend.device_bytes(),
                      context->context->device.c_str()},
                     "brume_context_info");
    });
}

brume_status brume_context_trim(brume_context context)
{
    if (!context)
        return barrier(nullptr, [] { expect(false, "context: NULL"); });
    return barrier(context->context.get(), [&] {
        Backend &backend = *context->context->backend;
        backend.invoke([&] { backend.trim(); });
    });
}

brume_status brume_context_calibrate(brume_context context)
{
    if (!context)
        return barrier(nullptr, [] { expect(false, "context: NULL"); });
    return barrier(context->context.get(), [&] {
        context->context->progress.begin();
        calibrate(context->context);
        context->context->progress.end();
    });
}

size_t brume_context_calibration(brume_context context, char *buffer, size_t capacity)
{
    return copy_text(context ? context->context->rates.write(*context->context->backend) : "", buffer, capacity);
}

brume_status brume_context_set_calibration(brume_context context, const char *text, size_t length)
{
    if (!context)
        return barrier(nullptr, [] { expect(false, "context: NULL"); });
    return barrier(context->context.get(), [&] {
        expect(text, "text: NULL");
        context->context->rates.read(*context->context->backend, std::string(text, length));
    });
}

size_t brume_message(brume_context context, char *buffer, size_t capacity)
{
    return copy_text(message_of(context ? context->context.get() : nullptr), buffer, capacity);
}

uint32_t brume_effect_count(brume_context context)
{
    return context ? uint32_t(context->context->effects.all().size()) : 0;
}

brume_status brume_effect_get_info(brume_context context, uint32_t index, brume_effect_info *info)
{
    if (!context)
        return barrier(nullptr, [] { expect(false, "context: NULL"); });
    return barrier(context->context.get(), [&] {
        const auto &all = context->context->effects.all();
        if (index >= all.size())
            throw Error(BRUME_ERROR_ARGUMENT,
                        "index: " + std::to_string(index) + "; there are " + std::to_string(all.size()) + " effects");
        const Effect &effect = all[index];
        write_struct(info,
                     {0, uint32_t(effect.parameters.size()), effect.name.c_str(), effect.help.c_str(), effect.file.c_str(),
                      effect.refusal.empty() ? nullptr : effect.refusal.c_str()},
                     "brume_effect_info");
    });
}

uint32_t brume_layer_count(brume_context handle, const char *effect)
{
    if (!handle)
        return 0;
    const std::vector<Layer> *layers = layers_of(*handle->context, effect);
    return layers ? uint32_t(layers->size()) : 0;
}

brume_status brume_layer_get_info(brume_context handle, const char *effect, uint32_t index, brume_layer_info *info)
{
    if (!handle)
        return barrier(nullptr, [] { expect(false, "context: NULL"); });
    return barrier(handle->context.get(), [&] {
        const std::vector<Layer> *layers = layers_of(*handle->context, effect);
        if (!layers)
            handle->context->effects.find(effect);  // says why not
        if (!layers || index >= layers->size())
            throw Error(BRUME_ERROR_ARGUMENT, "index: " + std::to_string(index) + "; there are " +
                                                  std::to_string(layers ? layers->size() : 0) + " layers");
        const Layer &layer = (*layers)[index];
        write_struct(info, {0, layer.flags, layer.channels, 0, layer.name.c_str(), layer.help.c_str()}, "brume_layer_info");
    });
}

brume_status brume_parameter_get_info(brume_context context, const char *effect, uint32_t index, brume_parameter_info *info)
{
    if (!context)
        return barrier(nullptr, [] { expect(false, "context: NULL"); });
    return barrier(context->context.get(), [&] {
        expect(effect, "effect: NULL");
        const Effect &found = context->context->effects.find(effect);
        if (index >= found.parameters.size())
            throw Error(BRUME_ERROR_ARGUMENT, "index: " + std::to_string(index) + "; " + found.name + " has " +
                                                  std::to_string(found.parameters.size()) + " parameters");
        const Parameter &p = found.parameters[index];
        write_struct(info,
                     {0, p.type, p.minimum, p.maximum, p.default_value, p.name.c_str(), p.unit.c_str(), p.help.c_str(),
                      p.choices_text.c_str(), p.alias.c_str()},
                     "brume_parameter_info");
    });
}

}  // extern "C"
