// Uniforms of a pass's own. They borrow the values.
#pragma once
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

}  // namespace brume_uniforms
