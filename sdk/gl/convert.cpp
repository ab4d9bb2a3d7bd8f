#include "gl/convert.h"

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

}  // namespace

bool is_half(GLenum format)
{
    return format == GL_RGBA16F || format == GL_RG16F || format == GL_R16F;
}

Converter::Converter(std::shared_ptr<Disposal> disposal) : program_("brume/convert", source, "", std::move(disposal)) {}

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
    // Bindings are not const because other passes write through them; this one reads `from`.
    const brume_plugin_binding bindings[] = {
        {"source", const_cast<GlImage *>(&from), BRUME_ACCESS_FETCH, 0},
        {"target", const_cast<GlImage *>(&to), BRUME_ACCESS_WRITE, 0},
    };
    const int32_t spread = from.channels == 1 && to.channels == 4;
    const int32_t rounded = round_to_half;
    const brume_plugin_uniform uniforms[] = {
        {"spread", BRUME_UNIFORM_INT, 1, 1, 0, &spread},
        {"round_to_half", BRUME_UNIFORM_INT, 1, 1, 0, &rounded},
    };
    brume_plugin_pass pass{};
    pass.struct_size = sizeof pass;
    pass.name = "convert";
    pass.program = &program_;
    pass.bindings = bindings;
    pass.binding_count = 2;
    pass.uniforms = uniforms;
    pass.uniform_count = 2;
    pass.width = to.width;
    pass.height = to.height;
    run_pass(pass, brume_plugin_scene{}, samplers, guard);
}

}  // namespace brume::gl
