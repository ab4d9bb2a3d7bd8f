#include "support.h"

#include "effects/pass_layout.h"

namespace brume::test {

std::unique_ptr<Backend> owned_backend()
{
    return make_gl_backend(GlOptions{}, Log{});
}

std::unique_ptr<Backend> borrowed_backend(uint32_t state)
{
    return make_gl_backend(GlOptions{true, state}, Log{});
}

Failure failure_of(const std::function<void()> &work)
{
    try {
        work();
    } catch (const Error &error) {
        return {error.status(), error.what()};
    }
    return {BRUME_OK, ""};
}

brume_image host_image(void *data, int32_t width, int32_t height, uint32_t channels, uint32_t pixel)
{
    brume_image image = BRUME_IMAGE_INIT;
    image.data = data;
    image.width = width;
    image.height = height;
    image.channels = channels;
    image.pixel = pixel;
    return image;
}

brume_image texture_image(GLuint texture, int32_t width, int32_t height, uint32_t channels)
{
    brume_image image = host_image(nullptr, width, height, channels);
    image.kind = BRUME_IMAGE_GL_TEXTURE;
    image.gl_texture = texture;
    return image;
}

std::shared_ptr<Pass> make_pass(Backend &backend, const brume_pass_desc &desc)
{
    return backend.create_pass(desc, layout_of(desc));
}

brume_pass_desc describe(const char *name, const std::vector<brume_slot> &slots,
                         const std::vector<brume_constant> &constants, uint32_t constant_size, const char *source)
{
    brume_pass_desc desc{};
    desc.struct_size = sizeof desc;
    desc.name = name;
    desc.slots = slots.data();
    desc.slot_count = uint32_t(slots.size());
    desc.constants = constants.data();
    desc.constant_count = uint32_t(constants.size());
    desc.constant_size = constant_size;
    desc.source = source;
    return desc;
}

void scale(Backend &backend, Image &from, Image &to, float factor, uint32_t access)
{
    const std::vector<brume_slot> slots = {{"source", access, 0}, {"target", BRUME_ACCESS_WRITE, 0}};
    const std::vector<brume_constant> constants = {{"factor", BRUME_CONSTANT_FLOAT, 1, 1, 0}};
    const char *const source = R"(
uniform sampler2D source;
writeonly uniform image2D target;
uniform float factor;
void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, brume_grid)))
        return;
    imageStore(target, at, texelFetch(source, at, 0) * factor);
}
)";
    const auto pass = make_pass(backend, describe("scale", slots, constants, sizeof factor, source));
    const brume_plugin_image images[] = {&from, &to};
    backend.run(*pass, images, &factor, to.width, to.height, brume_plugin_scene{}, nullptr, nullptr);
}

std::vector<float> ramp(size_t count)
{
    std::vector<float> values(count);
    for (size_t i = 0; i < count; ++i)
        values[i] = 0.25f + float(i) * 0.0625f;
    return values;
}

}  // namespace brume::test
