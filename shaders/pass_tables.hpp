// What the tables of passes are made of.
#pragma once
#include <cstddef>
#include <string>

#include <brume/brume_plugin.h>

#include "scene_maths.hpp"

namespace brume_passes {

constexpr brume_slot fetch(const char *name)
{
    return {name, BRUME_ACCESS_FETCH, 0};
}

constexpr brume_slot linear(const char *name)
{
    return {name, BRUME_ACCESS_LINEAR, 0};
}

constexpr brume_slot write(const char *name)
{
    return {name, BRUME_ACCESS_WRITE, 0};
}

// The uniform that a member's type is.
template <class Member> struct ConstantType;
template <> struct ConstantType<int32_t> {
    static constexpr uint32_t type = BRUME_CONSTANT_INT, components = 1;
};
template <> struct ConstantType<float> {
    static constexpr uint32_t type = BRUME_CONSTANT_FLOAT, components = 1;
};
template <> struct ConstantType<brume::maths_float::ivec2> {
    static constexpr uint32_t type = BRUME_CONSTANT_INT, components = 2;
};
template <> struct ConstantType<brume::maths_float::ivec4> {
    static constexpr uint32_t type = BRUME_CONSTANT_INT, components = 4;
};
template <> struct ConstantType<brume::maths_float::vec2> {
    static constexpr uint32_t type = BRUME_CONSTANT_FLOAT, components = 2;
};
template <> struct ConstantType<brume::maths_float::vec3> {
    static constexpr uint32_t type = BRUME_CONSTANT_FLOAT, components = 3;
};
template <> struct ConstantType<brume::maths_float::vec4> {
    static constexpr uint32_t type = BRUME_CONSTANT_FLOAT, components = 4;
};

// The member of a pass's constants, and of the GLSL uniform of the same name.
#define BRUME_CONSTANT(Struct, member)                                                                                      \
    {                                                                                                                       \
#member, brume_passes::ConstantType < decltype(Struct::member)> ::type,                                             \
            brume_passes::ConstantType < decltype(Struct::member)> ::components, 1, uint32_t(offsetof(Struct, member))      \
    }
// A member of a member.
#define BRUME_CONSTANT_OF(Struct, outer, member)                                                                            \
    {                                                                                                                       \
#outer "." #member, brume_passes::ConstantType < decltype(decltype(Struct::outer)::member)> ::type,                 \
            brume_passes::ConstantType < decltype(decltype(Struct::outer)::member)> ::components, 1,                        \
            uint32_t(offsetof(Struct, outer) + offsetof(decltype(Struct::outer), member))                                   \
    }

// A pass but for its shader and rows.
template <size_t Slots, size_t Constants>
brume_pass_desc described(const char *name, const brume_slot (&slots)[Slots], const brume_constant (&constants)[Constants],
                          size_t constant_size)
{
    brume_pass_desc desc{};
    desc.struct_size = sizeof desc;
    desc.name = name;
    desc.slots = slots;
    desc.slot_count = Slots;
    desc.constants = constants;
    desc.constant_count = Constants;
    desc.constant_size = uint32_t(constant_size);
    desc.grain = 8;
    return desc;
}

// With the shader of a file whose text the effect embeds.
inline brume_status create(const brume_services &services, brume_host host, brume_pass_desc desc, const char *file,
                           std::string_view text, const std::string &defines, brume_rows_function rows, brume_pass &out)
{
    const std::string source(text);
    desc.source = source.c_str();
    desc.source_name = file;
    desc.defines = defines.c_str();
    desc.rows = rows;
    return services.create_pass(host, &desc, &out);
}

inline std::string define(const char *name, int value)
{
    return "#define " + std::string(name) + " " + std::to_string(value) + "\n";
}

}  // namespace brume_passes
