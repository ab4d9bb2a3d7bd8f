#include "gl/convert.h"

#include <cstddef>

namespace brume::gl {
namespace {

constexpr const char *source = R"(
uniform sampler2D source;
writeonly uniform image2D target;
uniform bool spread;
uniform bool round_to_half;

// The nearest half, ties to even, as a float; by bits, since drivers are free in how their stores round. What is finite
// stays finite: it saturates, as on the CPU.
float nearest_half(float x)
{
    uint bits = floatBitsToUint(x);
    uint magnitude = bits & 0x7fffffffu;
    uint sign = bits & 0x80000000u;
    if (magnitude >= 0x7f800000u)
        return x;
    if (magnitude >= 0x477ff000u)  // 65520
        return uintBitsToFloat(sign | 0x477fe000u);
    if (magnitude >= 0x38800000u)  // 2^-14, the smallest normal half
        return uintBitsToFloat(sign | ((magnitude + 0xfffu + (magnitude >> 13 & 1u)) & ~0x1fffu));
    float steps = roundEven(uintBitsToFloat(magnitude) * 16777216.0);
    return uintBitsToFloat(sign | floatBitsToUint(steps / 16777216.0));
}

void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, brume_grid)))
        return;
    vec4 value = texelFetch(source, at, 0);
    if (spread)
        value = vec4(value.xxx, 1.0);
    if (round_to_half)
        value = vec4(nearest_half(value.x), nearest_half(value.y), nearest_half(value.z), nearest_half(value.w));
    imageStore(target, at, value);
}
)";

struct Constants {
    int32_t spread, round_to_half;
};

PassLayout layout()
{
    static constexpr brume_slot slots[] = {{"source", BRUME_ACCESS_FETCH, 0}, {"target", BRUME_ACCESS_WRITE, 0}};
    static constexpr brume_constant constants[] = {
        // GLSL's bool is set by an integer.
        {"spread", BRUME_CONSTANT_INT, 1, 1, offsetof(Constants, spread)},
        {"round_to_half", BRUME_CONSTANT_INT, 1, 1, offsetof(Constants, round_to_half)}};
    brume_pass_desc desc{};
    desc.struct_size = sizeof desc;
    desc.name = "convert";
    desc.slots = slots;
    desc.slot_count = 2;
    desc.constants = constants;
    desc.constant_count = 2;
    desc.constant_size = sizeof(Constants);
    return layout_of(desc);
}

}  // namespace

bool is_half(GLenum format)
{
    return format == GL_RGBA16F || format == GL_RG16F || format == GL_R16F;
}

Converter::Converter(std::shared_ptr<Disposal> disposal) 
    : pass_(std::make_shared<GlProgram>("brume/convert", source, "", std::move(disposal)), layout())
{
}

void Converter::convert(const GlImage &from, const GlImage &to, const Samplers &samplers, StateGuard &guard)
{
    run(from, to, is_half(to.format), samplers, guard);
}

void Converter::store(const GlImage &from, const GlImage &to, const Samplers &samplers, StateGuard &guard)
{
    run(from, to, false, samplers, guard);
}

void Converter::run(const GlImage &from, const GlImage &to, bool round_to_half, const Samplers &samplers, StateGuard &guard)
{
    // Slots are not const because other passes write through them; this one reads `from`.
    const brume_plugin_image images[] = {const_cast<GlImage *>(&from), const_cast<GlImage *>(&to)};
    const Constants constants{from.channels == 1 && to.channels == 4, round_to_half};
    pass_.run(images, &constants, to.width, to.height, brume_plugin_scene{}, samplers, guard);
}

}  // namespace brume::gl
