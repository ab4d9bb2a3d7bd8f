#pragma once
#include <string_view>

namespace brume {

// Text of shaders/lib/<name>, embedded at build time; empty if there is none.
std::string_view shader_text(std::string_view name);

}  // namespace brume
