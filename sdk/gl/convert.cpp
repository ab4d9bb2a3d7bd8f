#include "gl/convert.h"

namespace brume::gl {
namespace {

// As in the shader.
enum Rounding : int32_t { none, half, r11f_g11f_b10f, rgb10_a2 };

constexpr const char *source = R"(
uniform sampler2D source;
writeonly uniform image2D target;
uniform bool spread;
uniform int rounding;

// The nearest float of 5 exponent bits and as many mantissa bits, ties to even; by bits, since drivers are free in how their
// stores round. What is finite stays finite: it saturates, as on the CPU.
float nearest(float x, int mantissa)
{
    uint bits = floatBitsToUint(x);
    uint magnitude = bits & 0x7fffffffu;
    uint sign = bits & 0x80000000u;
    if (magnitude >= 0x7f800000u)
        return x;
    int drop = 23 - mantissa;
    uint step = 1u << drop;
    if (magnitude >= 0x38800000u)  // 2^-14, the smallest normal one
        return uintBitsToFloat(sign | min(0x47800000u - step,
                                          (magnitude + step / 2u - 1u + (magnitude >> drop & 1u)) & ~(step - 1u)));
    float steps = roundEven(uintBitsToFloat(magnitude) * float(1 << (14 + mantissa)));
    return uintBitsToFloat(sign | floatBitsToUint(steps / float(1 << (14 + mantissa))));
}

float nearest_unsigned(float x, int mantissa)
{
    return x < 0.0 ? 0.0 : nearest(x, mantissa);
}

float nearest_normalised(float x, float steps)
{
    return x > 0.0 ? roundEven(min(x, 1.0) * steps) / steps : 0.0;
}

void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, brume_grid)))
        return;
    vec4 value = texelFetch(source, at, 0);
    if (spread)
        value = vec4(value.xxx, 1.0);
    if (rounding == 1)
        value = vec4(nearest(value.x, 10), nearest(value.y, 10), nearest(value.z, 10), nearest(value.w, 10));
    else if (rounding == 2)
        value = vec4(nearest_unsigned(value.x, 6), nearest_unsigned(value.y, 6), nearest_unsigned(value.z, 5), 1.0);
    else if (rounding == 3)
        value = vec4(nearest_normalised(value.x, 1023.0), nearest_normalised(value.y, 1023.0),
                     nearest_normalised(value.z, 1023.0), nearest_normalised(value.w, 3.0));
    imageStore(target, at, value);
}
)";

Rounding rounding_for(GLenum format)
{
    if (is_half(format))
        return half;
    return format == GL_R11F_G11F_B10F ? r11f_g11f_b10f : format == GL_RGB10_A2 ? rgb10_a2 : none;
}

}  // namespace

bool is_half(GLenum format)
{
    return format == GL_RGBA16F || format == GL_RG16F || format == GL_R16F;
}

bool is_packed(GLenum format)
{
    return format == GL_R11F_G11F_B10F || format == GL_RGB10_A2;
}

Converter::Converter(std::shared_ptr<Disposal> disposal) : program_("brume/convert", source, "", std::move(disposal)) {}

void Converter::convert(const GlImage &from, const GlImage &to, const Samplers &samplers, StateGuard &guard)
{
    run(from, to, rounding_for(to.format), samplers, guard);
}

void Converter::store(const GlImage &from, const GlImage &to, const Samplers &samplers, StateGuard &guard)
{
    run(from, to, none, samplers, guard);
}

void Converter::run(const GlImage &from, const GlImage &to, int32_t rounding, const Samplers &samplers, StateGuard &guard)
{
    // Bindings are not const because other passes write through them; this one reads `from`.
    const brume_plugin_binding bindings[] = {
        {"source", const_cast<GlImage *>(&from), BRUME_ACCESS_FETCH, 0},
        {"target", const_cast<GlImage *>(&to), BRUME_ACCESS_WRITE, 0},
    };
    const int32_t spread = from.channels == 1 && to.channels == 4;
    const brume_plugin_uniform uniforms[] = {
        {"spread", BRUME_UNIFORM_INT, 1, 1, 0, &spread},
        {"rounding", BRUME_UNIFORM_INT, 1, 1, 0, &rounding},
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
