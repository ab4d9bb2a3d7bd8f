#include "gl/convert.h"

#include <cstddef>

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

struct Constants {
    int32_t spread, rounding;
};

PassLayout layout()
{
    static constexpr brume_slot slots[] = {{"source", BRUME_ACCESS_FETCH, 0}, {"target", BRUME_ACCESS_WRITE, 0}};
    static constexpr brume_constant constants[] = {// GLSL's bool is set by an integer.
                                                   {"spread", BRUME_CONSTANT_INT, 1, 1, offsetof(Constants, spread)},
                                                   {"rounding", BRUME_CONSTANT_INT, 1, 1, offsetof(Constants, rounding)}};
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

Converter::Converter(std::shared_ptr<Disposal> disposal)
    : pass_(std::make_shared<GlProgram>("brume/convert", source, "", std::move(disposal)), layout())
{
}

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
    // Slots are not const because other passes write through them; this one reads `from`.
    const brume_plugin_image images[] = {const_cast<GlImage *>(&from), const_cast<GlImage *>(&to)};
    const Constants constants{from.channels == 1 && to.channels == 4, rounding};
    pass_.run(images, &constants, to.width, to.height, brume_plugin_scene{}, samplers, guard);
}

}  // namespace brume::gl
