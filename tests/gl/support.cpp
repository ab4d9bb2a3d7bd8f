#include "support.h"

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

Pass::Pass(const char *name, Program &program, int32_t width, int32_t height)
{
    pass.struct_size = sizeof pass;
    pass.name = name;
    pass.program = &program;
    pass.width = width;
    pass.height = height;
}

Pass &Pass::bind(const char *name, Image &image, uint32_t access)
{
    bindings.push_back({name, &image, access, 0});
    return *this;
}

Pass &Pass::set(const char *name, const std::vector<float> &values)
{
    floats.push_back(values);
    uniforms.push_back({name, BRUME_UNIFORM_FLOAT, uint32_t(values.size()), 1, 0, floats.back().data()});
    return *this;
}

Pass &Pass::set(const char *name, const std::vector<int32_t> &values)
{
    ints.push_back(values);
    uniforms.push_back({name, BRUME_UNIFORM_INT, uint32_t(values.size()), 1, 0, ints.back().data()});
    return *this;
}

void Pass::run(Backend &backend, const brume_plugin_scene &scene)
{
    pass.bindings = bindings.data();
    pass.binding_count = uint32_t(bindings.size());
    pass.uniforms = uniforms.data();
    pass.uniform_count = uint32_t(uniforms.size());
    backend.run(pass, scene);
}

const char *const scale_source = R"(
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

std::vector<float> ramp(size_t count)
{
    std::vector<float> values(count);
    for (size_t i = 0; i < count; ++i)
        values[i] = 0.25f + float(i) * 0.0625f;
    return values;
}

}  // namespace brume::test
