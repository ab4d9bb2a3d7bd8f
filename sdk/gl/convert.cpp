#include "gl/convert.h"

#include <cstddef>
#include <iterator>

namespace brume::gl {
namespace {

// As in the shader.
enum Rounding : int32_t { none, half, r11f_g11f_b10f, rgb10_a2 };

constexpr const char *source = R"(
uniform sampler2D source;
writeonly uniform image2D target;
uniform bool spread;
uniform int rounding;
uniform ivec2 source_first;
uniform ivec2 source_size;
uniform ivec2 target_first;

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
    // As nearest_pixel() in pixels.h; unsigned because sides of 32768 need that bit.
    uvec2 nearest_pixel = (2u * uvec2(at) + 1u) * uvec2(source_size) / (2u * uvec2(brume_grid));
    vec4 value = texelFetch(source, source_first + ivec2(nearest_pixel), 0);
    if (spread)
        value = vec4(value.xxx, 1.0);
    if (rounding == 1)
        value = vec4(nearest(value.x, 10), nearest(value.y, 10), nearest(value.z, 10), nearest(value.w, 10));
    else if (rounding == 2)
        value = vec4(nearest_unsigned(value.x, 6), nearest_unsigned(value.y, 6), nearest_unsigned(value.z, 5), 1.0);
    else if (rounding == 3)
        value = vec4(nearest_normalised(value.x, 1023.0), nearest_normalised(value.y, 1023.0),
                     nearest_normalised(value.z, 1023.0), nearest_normalised(value.w, 3.0));
    imageStore(target, target_first + at, value);
}
)";

struct Constants {
    int32_t spread, rounding;
    int32_t source_first[2], source_size[2], target_first[2];
};

PassLayout layout()
{
    static constexpr brume_slot slots[] = {{"source", BRUME_ACCESS_FETCH, 0}, {"target", BRUME_ACCESS_WRITE, 0}};
    static constexpr brume_constant constants[] = {
        {"spread", BRUME_CONSTANT_INT, 1, 1, offsetof(Constants, spread)},  // GLSL's bool is set by an integer
        {"rounding", BRUME_CONSTANT_INT, 1, 1, offsetof(Constants, rounding)},
        {"source_first", BRUME_CONSTANT_INT, 2, 1, offsetof(Constants, source_first)},
        {"source_size", BRUME_CONSTANT_INT, 2, 1, offsetof(Constants, source_size)},
        {"target_first", BRUME_CONSTANT_INT, 2, 1, offsetof(Constants, target_first)}};
    brume_pass_desc desc{};
    desc.struct_size = sizeof desc;
    desc.name = "convert";
    desc.slots = slots;
    desc.slot_count = 2;
    desc.constants = constants;
    desc.constant_count = uint32_t(std::size(constants));
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

void Converter::convert(const GlImage &from, const Rectangle &source, const GlImage &to, const Rectangle &target,
                        const Samplers &samplers, StateGuard &guard)
{
    run(from, source, to, target, rounding_for(to.format), samplers, guard);
}

void Converter::store(const GlImage &from, const GlImage &to, const Samplers &samplers, StateGuard &guard)
{
    run(from, all_of(from), to, all_of(to), none, samplers, guard);
}

void Converter::run(const GlImage &from, const Rectangle &source, const GlImage &to, const Rectangle &target,
                    int32_t rounding, const Samplers &samplers, StateGuard &guard)
{
    // Slots are not const because other passes write through them; this one reads `from`.
    const brume_plugin_image images[] = {const_cast<GlImage *>(&from), const_cast<GlImage *>(&to)};
    const Constants constants{from.channels == 1 && to.channels == 4,
                              rounding,
                              {source.x, source.y},
                              {source.width, source.height},
                              {target.x, target.y}};
    pass_.run(images, &constants, target.width, target.height, brume_plugin_scene{}, samplers, guard);
}

}  // namespace brume::gl
