// A pass on GL and the uniforms of its own, which borrow their values.
#pragma once
#include <vector>

#include <brume/brume_plugin.h>

namespace brume_uniforms {

inline brume_plugin_uniform integer(const char *name, const int32_t &value)
{
    return {name, BRUME_UNIFORM_INT, 1, 1, 0, &value};
}

inline brume_plugin_uniform number(const char *name, const float &value)
{
    return {name, BRUME_UNIFORM_FLOAT, 1, 1, 0, &value};
}

// Images that are NULL are left unbound.
inline brume_status run_pass(const brume_services &services, brume_host host, const char *name, brume_program program,
                             std::vector<brume_plugin_binding> bindings, const std::vector<brume_plugin_uniform> &uniforms,
                             int32_t width, int32_t height)
{
    std::erase_if(bindings, [](const brume_plugin_binding &b) { return !b.image; });
    brume_plugin_pass pass{sizeof pass,     uint32_t(bindings.size()), name,  program, bindings.data(),
                           uniforms.data(), uint32_t(uniforms.size()), width, height,  0};
    return services.run(host, &pass);
}

}  // namespace brume_uniforms
