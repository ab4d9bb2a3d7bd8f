// What frames ask of the driver and of the dynamic loader, both of which may make them wait.
#include <atomic>

#include <dlfcn.h>

#include <gtest/gtest.h>

#include "gl_calls.h"
#include "support.h"

namespace {
std::atomic<int> loads = 0;
}

extern "C" __attribute__((visibility("default"))) void *dlopen(const char *file, int mode)
{
    using Function = void *(*)(const char *, int);
    static const auto real = reinterpret_cast<Function>(dlsym(RTLD_NEXT, "dlopen"));
    ++loads;
    return real(file, mode);
}

namespace brume::test {
namespace {

constexpr int32_t width = 24, height = 10;

// As a plan does, with the questions about images that a plan asks; output = color * depth.
void run_frame(Backend &backend, const brume_image &color, const brume_image &depth, const brume_image &output)
{
    backend.invoke([&] {
        backend.check(color, "color", false);
        backend.check(output, "output", true);
        backend.check(depth, "depth", false);
        backend.pixel(output);
        auto from = backend.import(color, 4);
        auto by = backend.import(depth, 1);
        auto to = backend.begin_output(output, 4, color.gl_texture != output.gl_texture);
        scale(backend, *from, *to, 2.0f);
        backend.finish_output(output, *to);
        backend.flush();
    });
}

struct Frame {
    brume_image color = texture_image(make_texture(GL_RGBA16F, width, height), width, height);
    brume_image depth = texture_image(make_texture(GL_R32F, width, height), width, height, 1);
    brume_image output = texture_image(make_texture(GL_RGBA16F, width, height), width, height);

    void run(Backend &backend) const { run_frame(backend, color, depth, output); }
};

class Asking : public testing::TestWithParam<bool> {
protected:
    HostContext host{GetParam() ? Profile::compatibility : Profile::core};
};
INSTANTIATE_TEST_SUITE_P(Profiles, Asking, testing::Bool(),
                         [](const auto &info) { return info.param ? "Compatibility" : "Core"; });

TEST_P(Asking, EachTextureIsLookedAtOnceAFrame)
{
    auto backend = borrowed_backend();
    Frame frame;
    frame.run(*backend);
    {
        const QueryCount count;
        frame.run(*backend);
        EXPECT_EQ(QueryCount::of("glGetTextureLevelParameteriv"), 3 * 3) << QueryCount::list();
        EXPECT_EQ(QueryCount::of("glGetTextureParameteriv"), 3 * 2) << QueryCount::list();
    }
    frame.output = frame.color;
    frame.run(*backend);
    const QueryCount count;
    frame.run(*backend);
    EXPECT_EQ(QueryCount::of("glGetTextureLevelParameteriv"), 2 * 3) << QueryCount::list();
}

// Between frames the host may do anything to its textures.
TEST_P(Asking, EachFrameLooksAgain)
{
    auto backend = borrowed_backend();
    Frame frame;
    frame.run(*backend);
    glTextureParameteri(frame.color.gl_texture, GL_TEXTURE_SWIZZLE_R, GL_BLUE);
    EXPECT_NE(failure_of([&] { frame.run(*backend); }).message.find("swizzled"), std::string::npos);
    glTextureParameteri(frame.color.gl_texture, GL_TEXTURE_SWIZZLE_R, GL_RED);
    EXPECT_EQ(failure_of([&] { frame.run(*backend); }).message, "");
    GLuint levels = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &levels);
    glTextureStorage2D(levels, 2, GL_RGBA16F, width, height);
    frame.color = texture_image(levels, width, height);
    EXPECT_EQ(failure_of([&] { frame.run(*backend); }).message, "");
    glTextureParameteri(levels, GL_TEXTURE_BASE_LEVEL, 1);
    EXPECT_NE(failure_of([&] { frame.run(*backend); }).message.find("BASE_LEVEL 1"), std::string::npos);
    glTextureParameteri(levels, GL_TEXTURE_BASE_LEVEL, 0);

    GLuint written = 0;  // whose completeness is what the host makes of it
    glGenTextures(1, &written);
    glBindTexture(GL_TEXTURE_2D, written);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA16F, width, height, 0, GL_RGBA, GL_FLOAT, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    frame.output = texture_image(written, width, height);
    EXPECT_EQ(failure_of([&] { frame.run(*backend); }).message, "");
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    EXPECT_NE(failure_of([&] { frame.run(*backend); }).message.find("level 1 is missing"), std::string::npos);
}

// Names come back for other textures, which compatibility profiles let the host choose.
TEST_P(Asking, TexturesMadeAnewUnderAnOldNameAreNoticed)
{
    for (uint32_t state : {BRUME_GL_STATE_PRESERVE, BRUME_GL_STATE_OWNED}) {
        auto backend = borrowed_backend(state);
        Frame frame;
        frame.run(*backend);
        const GLuint name = frame.color.gl_texture;
        const auto failure_with = [&](GLenum format, int32_t rows) {
            glDeleteTextures(1, &name);
            if (format) {
                glBindTexture(GL_TEXTURE_2D, name);
                glTexStorage2D(GL_TEXTURE_2D, 1, format, width, rows);
            }
            return failure_of([&] { frame.run(*backend); }).message;
        };
        EXPECT_NE(failure_with(GL_NONE, 0).find("does not exist"), std::string::npos) << state;
        if (GetParam()) {
            EXPECT_EQ(failure_with(GL_RGBA32F, height), "") << state;
            EXPECT_NE(failure_with(GL_R32F, height).find("is GL_R32F"), std::string::npos) << state;
            EXPECT_EQ(failure_with(GL_RGBA32F, height), "") << state;
            // A context that nobody else uses takes the host's word for sizes.
            EXPECT_EQ(failure_with(GL_RGBA32F, height + 1).find("the image says") != std::string::npos,
                      state == BRUME_GL_STATE_PRESERVE);
        }
        EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
    }
}

TEST_P(Asking, TrustedTexturesAreNotLookedAt)
{
    auto backend = borrowed_backend(BRUME_GL_STATE_OWNED);
    Frame frame;
    for (brume_image *image : {&frame.color, &frame.depth, &frame.output}) {
        image->kind = BRUME_IMAGE_GL_TEXTURE_TRUSTED;
        image->pixel = image == &frame.depth ? BRUME_PIXEL_F32 : BRUME_PIXEL_F16;
    }
    const std::vector<float> source = ramp(width * height * 4);
    glTextureSubImage2D(frame.color.gl_texture, 0, 0, 0, width, height, GL_RGBA, GL_FLOAT, source.data());
    frame.run(*backend);
    {
        const QueryCount count;
        frame.run(*backend);
        EXPECT_EQ(QueryCount::of("glIsTexture") + QueryCount::of("glGetTextureParameteriv") +
                      QueryCount::of("glGetTextureLevelParameteriv"),
                  0);
        EXPECT_LT(QueryCount::total(), 10) << QueryCount::list();
    }
    std::vector<float> written(source.size());
    glGetTextureImage(frame.output.gl_texture, 0, GL_RGBA, GL_FLOAT, GLsizei(written.size() * 4), written.data());
    for (size_t i = 0; i < source.size(); ++i)
        ASSERT_EQ(written[i], 2 * source[i]) << i;

    frame.output = frame.color;
    frame.output.channels = 2;
    EXPECT_NE(failure_of([&] { frame.run(*backend); }).message.find("trusted with 2 channels; expected 1, 3 or 4"),
              std::string::npos);
}

TEST_P(Asking, TheLoaderIsNotAskedAfterCreation)
{
    auto backend = borrowed_backend();
    const Frame frame;
    frame.run(*backend);
    const int before = loads;
    EXPECT_GT(before, 0) << "dlopen is not counted";
    frame.run(*backend);
    EXPECT_EQ(loads, before);
    backend.reset();
    EXPECT_EQ(loads, before);
}

// Errors are the host's to find: none of its debug messages may be of a question of ours.
TEST_P(Asking, TexturesOfOtherTargetsLeaveNoErrorInTheDebugLog)
{
    auto backend = borrowed_backend();
    std::vector<std::string> errors;
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(
        [](GLenum, GLenum type, GLuint, GLenum, GLsizei, const GLchar *message, const void *user) {
            if (type == GL_DEBUG_TYPE_ERROR)
                static_cast<std::vector<std::string> *>(const_cast<void *>(user))->emplace_back(message);
        },
        &errors);
    const auto count_again = [&] {
        errors.clear();
        glBindTexture(GL_TEXTURE_2D + 12345, 0);
        glGetError();
        return std::exchange(errors, {}).size();
    };
    ASSERT_EQ(count_again(), 1u) << "the driver logs no errors";
    for (GLenum target : {GL_TEXTURE_1D, GL_TEXTURE_2D_ARRAY, GL_TEXTURE_RECTANGLE, GL_TEXTURE_CUBE_MAP, GL_TEXTURE_3D,
                          GL_TEXTURE_2D_MULTISAMPLE, GL_TEXTURE_BUFFER}) {
        GLuint texture = 0;
        glCreateTextures(target, 1, &texture);
        const Failure failure = failure_of(
            [&] { backend->invoke([&] { backend->check(texture_image(texture, width, height), "color", false); }); });
        EXPECT_EQ(failure.status, BRUME_ERROR_UNSUPPORTED);
        EXPECT_NE(failure.message.find("is no GL_TEXTURE_2D"), std::string::npos) << failure.message;
    }
    EXPECT_NE(
        failure_of([&] { backend->invoke([&] { backend->check(texture_image(4711, 1, 1), "color", false); }); }).status,
        BRUME_OK);
    Frame().run(*backend);
    EXPECT_EQ(errors, std::vector<std::string>());
    EXPECT_EQ(count_again(), 1u) << "errors of the host's are no longer logged";
}

}  // namespace
}  // namespace brume::test
