// Owned and borrowed contexts: which thread, which context, whose errors; the host's textures.
#include <array>
#include <thread>

#include <gtest/gtest.h>

#include "support.h"

namespace brume::test {
namespace {

constexpr int32_t width = 6, height = 4;

std::vector<float> scaled(Backend &backend, float factor)
{
    std::vector<float> values = ramp(width * height * 4);
    backend.invoke([&] {
        const brume_image image = host_image(values.data(), width, height, 4);
        auto from = backend.import(image, 4);
        auto to = backend.begin_output(image, 4, false);
        scale(backend, *from, *to, factor);
        backend.finish_output(image, *to);
        backend.flush();
    });
    return values;
}

std::vector<float> expected(float factor)
{
    std::vector<float> values = ramp(width * height * 4);
    for (float &value : values)
        value *= factor;
    return values;
}

TEST(Owned, ServesAnyThreadAndPassesExceptionsOn)
{
    auto backend = owned_backend();
    EXPECT_EQ(backend->kind(), BRUME_BACKEND_GL);
    EXPECT_FALSE(backend->device().empty());
    std::vector<std::thread> threads;
    for (int i = 1; i <= 4; ++i)
        threads.emplace_back([&backend, i] { EXPECT_EQ(scaled(*backend, float(i)), expected(float(i))); });
    for (std::thread &thread : threads)
        thread.join();
    EXPECT_THROW(backend->invoke([] { throw std::out_of_range("x"); }), std::out_of_range);
    backend->invoke([&] { EXPECT_EQ(scaled(*backend, 3), expected(3)) << "nested"; });
}

TEST(Owned, LeavesTheCallersContextAlone)
{
    HostContext host;
    const EGLContext before = eglGetCurrentContext();
    {
        auto backend = owned_backend();
        EXPECT_EQ(scaled(*backend, 2), expected(2));
        EXPECT_EQ(eglGetCurrentContext(), before);
    }
    EXPECT_EQ(eglGetCurrentContext(), before);
    // Still alive: ending the owned context must not have ended the display.
    EXPECT_NE(make_texture(GL_R8, 4, 4), 0u);
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

TEST(Owned, SeveralAtOnceAndOneAfterAnother)
{
    for (int round = 0; round < 2; ++round) {
        auto a = owned_backend(), b = owned_backend();
        EXPECT_EQ(scaled(*a, 2), expected(2));
        a.reset();
        EXPECT_EQ(scaled(*b, 3), expected(3));
    }
}

// As brume_log_callback promises, though the work is done on the library's thread.
TEST(Owned, LogsOnTheThreadOfTheCall)
{
    struct Received {
        std::vector<std::pair<std::thread::id, std::string>> messages;
        static void add(void *user, uint32_t, const char *message)
        {
            static_cast<Received *>(user)->messages.emplace_back(std::this_thread::get_id(), message);
        }
    } received;
    const Log log{Received::add, &received, BRUME_LOG_WARNING};
    auto backend = make_gl_backend(GlOptions{}, log);
    backend->invoke([&] {
        log(BRUME_LOG_WARNING, "first");
        backend->invoke([&] { log(BRUME_LOG_WARNING, "second"); });
    });
    EXPECT_THROW(backend->invoke([&] {
        log(BRUME_LOG_WARNING, "before a failure");
        throw std::out_of_range("x");
    }),
                 std::out_of_range);
    std::vector<std::pair<std::thread::id, std::string>> expected;
    for (const char *message : {"first", "second", "before a failure"})
        expected.emplace_back(std::this_thread::get_id(), message);
    EXPECT_EQ(received.messages, expected);
}

TEST(Owned, HardwareIsNotSoftware)
{
    const std::string device = owned_backend()->device();
    if (device.find("llvmpipe") != std::string::npos) {
        EXPECT_FALSE(gl_is_hardware(GlOptions{}));
    }
    EXPECT_FALSE(gl_is_hardware(GlOptions{true})) << "nothing is current here";
}

TEST(Borrowed, NeedsTheRightContext)
{
    const Failure none = failure_of([] { borrowed_backend(); });
    EXPECT_EQ(none.status, BRUME_ERROR_GL);
    EXPECT_NE(none.message.find("no OpenGL context is current"), std::string::npos) << none.message;

    auto host = std::make_unique<HostContext>();
    auto backend = borrowed_backend();
    EXPECT_EQ(scaled(*backend, 2), expected(2));
    std::thread([&] {
        const Failure other_thread = failure_of([&] { scaled(*backend, 2); });
        EXPECT_EQ(other_thread.status, BRUME_ERROR_GL);
        EXPECT_NE(other_thread.message.find("no OpenGL context is current"), std::string::npos) << other_thread.message;
    }).join();
    {
        HostContext other;
        const Failure another = failure_of([&] { scaled(*backend, 2); });
        EXPECT_EQ(another.status, BRUME_ERROR_GL);
        EXPECT_NE(another.message.find("another OpenGL context"), std::string::npos) << another.message;
    }
    host->make_current();
    EXPECT_EQ(scaled(*backend, 2), expected(2));

    // The context may move to another thread.
    host->release();
    std::thread([&] {
        host->make_current();
        EXPECT_EQ(scaled(*backend, 3), expected(3));
        host->release();
    }).join();
    host->make_current();
}

TEST(Borrowed, RefusesOtherApis)
{
    HostContext host(Profile::es);
    const Failure es = failure_of([] { borrowed_backend(); });
    EXPECT_EQ(es.status, BRUME_ERROR_GL);
    EXPECT_NE(es.message.find("OpenGL ES"), std::string::npos) << es.message;
    EXPECT_NE(es.message.find("expected OpenGL 4.5"), std::string::npos) << es.message;
    EXPECT_FALSE(gl_is_hardware(GlOptions{true}));
}

struct Logged {
    std::vector<std::string> messages;
    static void add(void *user, uint32_t, const char *message) { static_cast<Logged *>(user)->messages.push_back(message); }
};

TEST(Borrowed, PendingErrorsOfTheHostAreReportedAndNotOurs)
{
    HostContext host;
    Logged logged;
    auto backend = make_gl_backend(GlOptions{true, BRUME_GL_STATE_PRESERVE}, Log{Logged::add, &logged, BRUME_LOG_WARNING});
    EXPECT_TRUE(logged.messages.empty());
    glEnable(GL_TEXTURE_2D + 12345);  // GL_INVALID_ENUM
    EXPECT_EQ(scaled(*backend, 2), expected(2));
    ASSERT_EQ(logged.messages.size(), 1u);
    EXPECT_NE(logged.messages[0].find("GL_INVALID_ENUM"), std::string::npos) << logged.messages[0];
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

TEST(Borrowed, DestroyedWithoutItsContext)
{
    HostContext host;
    Logged logged;
    auto backend = make_gl_backend(GlOptions{true, BRUME_GL_STATE_PRESERVE}, Log{Logged::add, &logged, BRUME_LOG_WARNING});
    host.release();
    backend.reset();
    ASSERT_EQ(logged.messages.size(), 1u);
    EXPECT_NE(logged.messages[0].find("left behind"), std::string::npos) << logged.messages[0];
}

TEST(Borrowed, DeletesItsObjects)
{
    HostContext host;
    auto names = [] {
        int count = 0;
        for (GLuint name = 1; name < 200; ++name)
            count += glIsTexture(name) + glIsProgram(name) + glIsSampler(name) + glIsQuery(name) + glIsProgramPipeline(name);
        return count;
    };
    auto backend = borrowed_backend();
    std::shared_ptr<Image> image;
    std::unique_ptr<FrameTimer> timer;
    backend->invoke([&] {
        image = backend->create_image(4, 4, 4, BRUME_PIXEL_F32);
        timer = backend->create_timer();
        timer->begin();
        timer->end();
    });
    scaled(*backend, 2);
    EXPECT_GT(names(), 0);
    backend.reset();
    image.reset();
    timer.reset();
    EXPECT_EQ(names(), 0);
}

// A context made anew often gets the address of the one before it. Whether it does is up to the allocator, so this one
// stays, without what Brume knows it by: with no object of that name, then with one of the host's.
TEST(Borrowed, RemadeContextAtTheSameAddressIsAnother)
{
    for (bool taken : {false, true}) {
        HostContext host;
        Logged logged;
        auto backend =
            make_gl_backend(GlOptions{true, BRUME_GL_STATE_PRESERVE}, Log{Logged::add, &logged, BRUME_LOG_WARNING});
        scaled(*backend, 2);
        std::shared_ptr<Image> image;
        std::unique_ptr<FrameTimer> timer;
        backend->invoke([&] {
            image = backend->create_image(4, 4, 4, BRUME_PIXEL_F32);
            timer = backend->create_timer();
            timer->begin();
            timer->end();
        });
        const auto names = [] {
            std::vector<std::array<bool, 5>> names;
            for (GLuint name = 1; name < 200; ++name)
                names.push_back({glIsTexture(name) != 0, glIsProgram(name) != 0, glIsSampler(name) != 0,
                                 glIsQuery(name) != 0, glIsProgramPipeline(name) != 0});
            return names;
        };
        int markers = 0;
        for (GLuint name = 1; name < 200; ++name)
            if (glIsProgramPipeline(name)) {
                ++markers;
                if (taken)
                    glObjectLabel(GL_PROGRAM_PIPELINE, name, -1, "the host's");
                else
                    glDeleteProgramPipelines(1, &name);
            }
        EXPECT_EQ(markers, 1);
        const auto before = names();
        const Failure failure = failure_of([&] { scaled(*backend, 2); });
        EXPECT_EQ(failure.status, BRUME_ERROR_GL);
        EXPECT_NE(failure.message.find("has been destroyed"), std::string::npos) << failure.message;
        backend.reset();
        image.reset();
        timer.reset();
        EXPECT_EQ(names(), before);
        ASSERT_EQ(logged.messages.size(), 1u);
        EXPECT_NE(logged.messages[0].find("left behind"), std::string::npos) << logged.messages[0];
        EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
    }
}

// What the host's textures may be.
class Textures : public testing::Test {
protected:
    HostContext host;
    std::unique_ptr<Backend> backend = borrowed_backend();

    // The message of refusing that texture as colour, depth (channels 1) or output.
    std::string refusal(GLuint texture, int32_t channels, bool output, int32_t w = width, int32_t h = height)
    {
        const brume_image image = texture_image(texture, w, h, channels == 1 ? 1 : 4);
        const Failure failure = failure_of([&] {
            backend->invoke([&] {
                backend->check(image, "image", output);
                if (output)
                    backend->begin_output(image, channels, true);
                else
                    backend->import(image, channels);
            });
        });
        EXPECT_TRUE(failure.status == BRUME_OK || failure.message.find("texture") != std::string::npos) << failure.message;
        return failure.message;
    }
};

TEST_F(Textures, Formats)
{
    for (GLenum format : {GL_RGBA32F, GL_RGBA16F, GL_RGB16F, GL_R11F_G11F_B10F, GL_RGBA8, GL_SRGB8_ALPHA8, GL_RGB10_A2,
                          GL_RGB9_E5, GL_RGBA16_SNORM})
        EXPECT_EQ(refusal(make_texture(format, width, height), 4, false), "") << format;
    for (GLenum format : {GL_R8, GL_R32F, GL_RG16F, GL_RGBA8UI, GL_RGBA32I, GL_DEPTH_COMPONENT32F})
        EXPECT_NE(refusal(make_texture(format, width, height), 4, false), "") << format;
    for (GLenum format : {GL_R32F, GL_R16F, GL_R16, GL_RG32F, GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT24,
                          GL_DEPTH_COMPONENT32F, GL_DEPTH24_STENCIL8, GL_DEPTH32F_STENCIL8})
        EXPECT_EQ(refusal(make_texture(format, width, height), 1, false), "") << format;
    for (GLenum format : {GL_RGBA32F, GL_R8, GL_R32UI})
        EXPECT_NE(refusal(make_texture(format, width, height), 1, false), "") << format;
    for (GLenum format : {GL_RGBA32F, GL_RGBA16F, GL_R11F_G11F_B10F, GL_RGB10_A2})
        EXPECT_EQ(refusal(make_texture(format, width, height), 4, true), "") << format;
    EXPECT_NE(refusal(make_texture(GL_R11F_G11F_B10F, width, height), 1, true), "");
    for (GLenum format : {GL_RGB16F, GL_RGBA8, GL_R32F, GL_DEPTH_COMPONENT32F})
        EXPECT_NE(refusal(make_texture(format, width, height), 4, true), "") << format;
    EXPECT_EQ(refusal(make_texture(GL_R32F, width, height), 1, true), "");
    EXPECT_EQ(refusal(make_texture(GL_RGBA16F, width, height), 1, true), "");
}

TEST_F(Textures, NamesSizesAndTargets)
{
    EXPECT_NE(refusal(0, 4, false), "");
    EXPECT_NE(refusal(4711, 4, false).find("does not exist"), std::string::npos);
    EXPECT_NE(refusal(make_texture(GL_RGBA16F, 8, 8), 4, false).find("8 x 8"), std::string::npos);
    GLuint array = 0, empty = 0;
    glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &array);
    glTextureStorage3D(array, 1, GL_RGBA16F, width, height, 2);
    EXPECT_NE(refusal(array, 4, false).find("GL_TEXTURE_2D"), std::string::npos);
    glCreateTextures(GL_TEXTURE_2D, 1, &empty);
    EXPECT_NE(refusal(empty, 4, false).find("level 0"), std::string::npos);
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

TEST_F(Textures, Parameters)
{
    const GLuint swizzled = make_texture(GL_RGBA16F, width, height);
    glTextureParameteri(swizzled, GL_TEXTURE_SWIZZLE_R, GL_BLUE);
    EXPECT_NE(refusal(swizzled, 4, false).find("SWIZZLE"), std::string::npos);
    GLuint levels = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &levels);
    glTextureStorage2D(levels, 2, GL_RGBA16F, width, height);
    EXPECT_EQ(refusal(levels, 4, true), "");
    glTextureParameteri(levels, GL_TEXTURE_BASE_LEVEL, 1);
    EXPECT_NE(refusal(levels, 4, false).find("BASE_LEVEL 1"), std::string::npos);
    const GLuint stencil = make_texture(GL_DEPTH24_STENCIL8, width, height);
    glTextureParameteri(stencil, GL_DEPTH_STENCIL_TEXTURE_MODE, GL_STENCIL_INDEX);
    EXPECT_NE(refusal(stencil, 1, false).find("STENCIL"), std::string::npos);

    GLuint incomplete = 0;  // as glTexImage2D without a filter leaves it
    glGenTextures(1, &incomplete);
    glBindTexture(GL_TEXTURE_2D, incomplete);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA16F, width, height, 0, GL_RGBA, GL_FLOAT, nullptr);
    EXPECT_NE(refusal(incomplete, 4, true).find("level 1 is missing"), std::string::npos);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    EXPECT_EQ(refusal(incomplete, 4, true), "");
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glGenerateMipmap(GL_TEXTURE_2D);
    EXPECT_EQ(refusal(incomplete, 4, true), "");
}

// A shadow map's comparison must not turn depth into 0 and 1.
TEST_F(Textures, DepthIsReadAsItIs)
{
    for (GLenum format : {GL_DEPTH_COMPONENT32F, GL_DEPTH24_STENCIL8}) {
        const GLuint depth = make_texture(format, width, height);
        const float value = 0.25f;
        glClearTexImage(depth, 0, format == GL_DEPTH24_STENCIL8 ? GL_DEPTH_STENCIL : GL_DEPTH_COMPONENT,
                        format == GL_DEPTH24_STENCIL8 ? GL_UNSIGNED_INT_24_8 : GL_FLOAT,
                        format == GL_DEPTH24_STENCIL8 ? static_cast<const void *>("\0\0\0\x40") : &value);
        glTextureParameteri(depth, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
        std::vector<float> values(width * height, -1);
        backend->invoke([&] {
            const brume_image output = host_image(values.data(), width, height, 1);
            auto from = backend->import(texture_image(depth, width, height, 1), 1);
            auto to = backend->begin_output(output, 1, true);
            scale(*backend, *from, *to, 1.0f);
            backend->finish_output(output, *to);
        });
        for (float got : values)
            ASSERT_NEAR(got, 0.25f, 1e-7f);
    }
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

TEST_F(Textures, DepthIsTheRedOfTwoOrNormalised)
{
    for (GLenum format : {GL_R16, GL_RG32F}) {
        const GLuint depth = make_texture(format, width, height);
        const float value[2] = {0.5f, 7};
        glClearTexImage(depth, 0, GL_RG, GL_FLOAT, value);
        std::vector<float> values(width * height, -1);
        backend->invoke([&] {
            const brume_image output = host_image(values.data(), width, height, 1);
            auto from = backend->import(texture_image(depth, width, height, 1), 1);
            EXPECT_EQ(from->channels, 1);
            auto to = backend->begin_output(output, 1, true);
            scale(*backend, *from, *to, 1.0f);
            backend->finish_output(output, *to);
        });
        for (float got : values)
            ASSERT_NEAR(got, 0.5f, 1e-5f) << format;
    }
}

// Of 5 exponent bits and 6, 6 and 5 mantissa bits.
TEST_F(Textures, OutputsOfElevenBitsRoundToNearest)
{
    struct Case {
        float written[4];
        float stored[3];
    };
    const Case cases[] = {
        {{1, 0.5f, 0.25f, 0.5f}, {1, 0.5f, 0.25f}},
        {{-3, -0.0f, -1e-3f, 0}, {0, 0, 0}},
        {{1 + 0x1p-7f, 1 + 0x3p-7f, 1 + 0x1p-6f, 1}, {1, 1 + 0x1p-5f, 1}},  // ties go to even
        {{1 + 0x1.1p-7f, 1 + 0x0.fp-7f, 1 + 0x3p-6f, 1}, {1 + 0x1p-6f, 1, 1 + 0x1p-4f}},
        {{1e9f, 65504, 1e9f, 1}, {65024, 65024, 64512}},
        {{0x1.8p-20f, 0x1.01p-21f, 0x1.8p-19f, 1}, {0x1p-19f, 0x1p-20f, 0x1p-18f}},
    };
    for (const Case &one : cases) {
        std::vector<float> values;
        for (int i = 0; i < width * height; ++i)
            values.insert(values.end(), one.written, one.written + 4);
        const GLuint texture = make_texture(GL_R11F_G11F_B10F, width, height);
        backend->invoke([&] {
            EXPECT_EQ(backend->copy(host_image(values.data(), width, height, 4), texture_image(texture, width, height)),
                      not_counted);
        });
        std::vector<float> stored(width * height * 4);
        glGetTextureImage(texture, 0, GL_RGBA, GL_FLOAT, GLsizei(stored.size() * 4), stored.data());
        for (int c = 0; c < 3; ++c)
            EXPECT_EQ(stored[size_t(4 * 9 + c)], one.stored[c]) << one.written[c] << ", component " << c;
    }
}

TEST_F(Textures, OutputsOfTenBitsAreClampedAndRoundToNearest)
{
    const float written[][4] = {{0.5f, -1, 7, 0.4f}, {1 / 1023.0f, 1.4f / 1023, 1.6f / 1023, 0.6f}, {1, 0, 0.25f, 9}};
    const uint32_t stored[][4] = {{512, 0, 1023, 1}, {1, 1, 2, 2}, {1023, 0, 256, 3}};
    for (size_t i = 0; i < std::size(written); ++i) {
        std::vector<float> values;
        for (int k = 0; k < width * height; ++k)
            values.insert(values.end(), written[i], written[i] + 4);
        const GLuint texture = make_texture(GL_RGB10_A2, width, height);
        backend->invoke([&] {
            // By a pass, as effects write it.
            const brume_image output = texture_image(texture, width, height);
            auto from = backend->import(host_image(values.data(), width, height, 4), 4);
            auto to = backend->begin_output(output, 4, true);
            scale(*backend, *from, *to, 1.0f);
            backend->finish_output(output, *to);
        });
        std::vector<uint32_t> packed(width * height);
        glGetTextureImage(texture, 0, GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV, GLsizei(packed.size() * 4), packed.data());
        const uint32_t *want = stored[i];
        EXPECT_EQ(packed[5], want[0] | want[1] << 10 | want[2] << 20 | want[3] << 30) << i;
    }
}

TEST_F(Textures, CopiesBetweenTexturesAndMemory)
{
    std::vector<float> values = ramp(width * height * 4), back(values.size());
    const brume_image source = host_image(values.data(), width, height, 4),
                      target = host_image(back.data(), width, height, 4);
    const brume_image full = texture_image(make_texture(GL_RGBA32F, width, height), width, height);
    const brume_image half = texture_image(make_texture(GL_RGBA16F, width, height), width, height);
    const brume_image second = texture_image(make_texture(GL_RGBA16F, width, height), width, height);
    backend->invoke([&] {
        for (const brume_image *image : {&full, &half, &second})
            EXPECT_EQ(backend->pixel(*image), image == &full ? BRUME_PIXEL_F32 : BRUME_PIXEL_F16);
        backend->copy(source, full);
        backend->copy(full, full);
        backend->copy(full, half);
        backend->copy(half, second);
        backend->copy(second, target);
        backend->flush();
    });
    EXPECT_EQ(values, back);  // a ramp of 1/16 steps is exact in halves
}

TEST_F(Textures, ScalarOutputs)
{
    std::vector<float> values = ramp(width * height), back(values.size() * 4);
    const GLuint texture = make_texture(GL_RGBA32F, width, height);
    const brume_image output = texture_image(texture, width, height, 1);
    backend->invoke([&] {
        auto from = backend->import(host_image(values.data(), width, height, 1), 1);
        auto to = backend->begin_output(output, 1, true);
        EXPECT_EQ(to->channels, 1);
        scale(*backend, *from, *to, 2.0f);
        backend->finish_output(output, *to);
        backend->copy(output, host_image(back.data(), width, height, 4));
    });
    for (size_t i = 0; i < values.size(); ++i) {
        EXPECT_EQ(back[4 * i], 2 * values[i]);
        EXPECT_EQ(back[4 * i + 1], 2 * values[i]);
        EXPECT_EQ(back[4 * i + 3], 1.0f);
    }
}

}  // namespace
}  // namespace brume::test
