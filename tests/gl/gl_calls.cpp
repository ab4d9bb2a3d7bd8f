#include "gl_calls.h"

#include <type_traits>
#include <utility>

#include <epoxy/gl.h>

namespace brume::test {
namespace {

// Stands in for one of epoxy's function pointers.
template <auto &pointer, class = std::remove_reference_t<decltype(pointer)>> struct Counted;
template <auto &pointer, class Result, class... Arguments> struct Counted<pointer, Result (*)(Arguments...)> {
    static inline Result (*real)(Arguments...) = nullptr;
    static inline int calls = 0;

    static Result call(Arguments... arguments)
    {
        ++calls;
        // epoxy's first call of a function puts the driver's in the pointer.
        struct Keep {
            ~Keep()
            {
                if (pointer != call)
                    real = std::exchange(pointer, call);
            }
        } keep;
        return real(arguments...);
    }
    static void install()
    {
        calls = 0;
        real = std::exchange(pointer, call);
    }
    static void remove() { pointer = real; }
};

template <class Visitor> void for_each(Visitor visit)
{
#define VISIT(function) visit(#function, Counted<epoxy_##function>())
    VISIT(glGetBooleanv);
    VISIT(glGetError);
    VISIT(glGetFloatv);
    VISIT(glGetInteger64v);
    VISIT(glGetIntegeri_v);
    VISIT(glGetIntegerv);
    VISIT(glGetInternalformativ);
    VISIT(glGetObjectLabel);
    VISIT(glGetProgramiv);
    VISIT(glGetString);
    VISIT(glGetTextureLevelParameteriv);
    VISIT(glGetTextureParameteriv);
    VISIT(glGetUniformLocation);
    VISIT(glIsEnabled);
    VISIT(glIsProgramPipeline);
    VISIT(glIsSampler);
    VISIT(glIsTexture);
#undef VISIT
}

}  // namespace

QueryCount::QueryCount()
{
    for_each([](const char *, auto function) { function.install(); });
}

QueryCount::~QueryCount()
{
    for_each([](const char *, auto function) { function.remove(); });
}

std::map<std::string, int> QueryCount::calls()
{
    std::map<std::string, int> calls;
    for_each([&](const char *name, auto function) { calls[name] = function.calls; });
    return calls;
}

int QueryCount::of(const std::string &function)
{
    return calls().at(function);
}

int QueryCount::total()
{
    int sum = 0;
    for (const auto &[name, count] : calls())
        sum += count;
    return sum;
}

std::string QueryCount::list()
{
    std::string text;
    for (const auto &[name, count] : calls())
        if (count > 0)
            text += name + " " + std::to_string(count) + "\n";
    return text;
}

}  // namespace brume::test
