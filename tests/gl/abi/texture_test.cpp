// A host with a context and textures of its own, through the C ABI.
#include <algorithm>
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include <brume/brume.hpp>

#include "gl_calls.h"
#include "host_context.h"
#include "host_state.h"

namespace brume::test {
namespace {

constexpr int32_t width = 72, height = 48;

const char *const scene_text = R"({
  "brume": 1,
  "camera": { "vertical_fov": 50, "camera_to_world": [[1,0,0,0],[0,1,0,2],[0,0,1,0],[0,0,0,1]] },
  "medium": { "scattering": [0.03, 0.03, 0.034], "absorption": [0.002, 0.003, 0.004], "g": 0.7,
              "density": [ {"type": "constant", "value": 0.5},
                           {"type": "exponential", "value": 1, "falloff": 0.2, "direction": [0, 1, 0]} ] }
})";

// Halves, so that both pixel types hold them: lamps, one of them beyond what halves hold after fog, and a dark ramp.
std::vector<float> lamps()
{
    std::vector<float> pixels(width * height * 4);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            float *p = &pixels[size_t(y * width + x) * 4];
            const bool lamp = x % 17 == 5 && y % 13 == 4;
            for (int c = 0; c < 3; ++c)
                p[c] = lamp ? 100.0f * float(c + 1) : float(x + 2 * y + 5 * c) / 1024.0f;
            p[3] = float(x % 5) / 4.0f;
        }
    pixels[size_t(20 * width + 30) * 4] = 60000.0f;
    return pixels;
}

std::vector<float> distances()
{
    std::vector<float> depth(width * height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            depth[size_t(y * width + x)] = y < 6 ? INFINITY : 2.0f + float((x / 9) * 8) + float(y) / 8.0f;
    return depth;
}

std::vector<float> flipped(const std::vector<float> &image, size_t channels)
{
    const size_t row = width * channels;
    std::vector<float> result(image.size());
    for (size_t y = 0; y < size_t(height); ++y)
        std::memcpy(&result[y * row], &image[(size_t(height) - 1 - y) * row], row * sizeof(float));
    return result;
}

GLuint filled_texture(GLenum format, GLenum layout, const std::vector<float> &pixels)
{
    const GLuint texture = make_texture(format, width, height);
    glTextureSubImage2D(texture, 0, 0, 0, width, height, layout, GL_FLOAT, pixels.data());
    return texture;
}

template <class Sample> std::vector<Sample> read(GLuint texture)
{
    std::vector<Sample> pixels(width * height * 4);
    glGetTextureImage(texture, 0, GL_RGBA, sizeof(Sample) == 2 ? GL_HALF_FLOAT : GL_FLOAT,
                      GLsizei(pixels.size() * sizeof(Sample)), pixels.data());
    return pixels;
}

brume_context_desc borrowed(uint32_t state = BRUME_GL_STATE_PRESERVE)
{
    brume_context_desc desc = BRUME_CONTEXT_DESC_INIT;
    desc.backend = BRUME_BACKEND_GL;
    desc.gl_context = BRUME_GL_BORROWED;
    desc.gl_state = state;
    return desc;
}

// With the origin of the host images it is compared with.
brume_image texture_image(GLuint texture, uint32_t channels = 4)
{
    brume_image image = brume::texture(texture, width, height, channels);
    image.origin = BRUME_ORIGIN_TOP_LEFT;
    return image;
}

class HostTextures : public testing::Test {
protected:
    HostContext host;
    const std::vector<float> color = lamps(), depth = distances();

    static Plan make_plan(const brume_context_desc &desc, const char *text = scene_text)
    {
        return Plan(Scene(Context(desc), text), brume::format(width, height));
    }
};

TEST_F(HostTextures, SameBitsAsHostMemory)
{
    Plan plan = make_plan(borrowed());
    const GLuint depth_texture = filled_texture(GL_R32F, GL_RED, depth);
    const brume_image host_depth = brume::image(depth.data(), width, height, 1);

    std::vector<float> floats(color.size());
    plan.execute(brume::image(color.data(), width, height, 4), host_depth, brume::image(floats.data(), width, height, 4));
    EXPECT_NE(floats, color);
    const GLuint full = filled_texture(GL_RGBA32F, GL_RGBA, color), full_out = make_texture(GL_RGBA32F, width, height);
    plan.execute(texture_image(full), texture_image(depth_texture, 1), texture_image(full_out));
    EXPECT_EQ(read<float>(full_out), floats);
    EXPECT_EQ(read<float>(full), color) << "the input changed";

    const GLuint half = filled_texture(GL_RGBA16F, GL_RGBA, color), half_out = make_texture(GL_RGBA16F, width, height);
    const std::vector<uint16_t> halves = read<uint16_t>(half);
    std::vector<uint16_t> half_result(halves.size());
    plan.execute(brume::half_image(halves.data(), width, height, 4), host_depth,
                 brume::half_image(half_result.data(), width, height, 4));
    plan.execute(texture_image(half), texture_image(depth_texture, 1), texture_image(half_out));
    EXPECT_EQ(read<uint16_t>(half_out), half_result);

    // And the owned context's.
    brume_context_desc owned = BRUME_CONTEXT_DESC_INIT;
    owned.backend = BRUME_BACKEND_GL;
    std::vector<float> from_owned(color.size());
    make_plan(owned).execute(brume::image(color.data(), width, height, 4), host_depth,
                             brume::image(from_owned.data(), width, height, 4));
    EXPECT_EQ(from_owned, floats);
}

// A float texture keeps radiance that halves do not hold.
TEST_F(HostTextures, FloatTexturesAreNotClampedToHalves)
{
    std::vector<float> bright = color;
    bright[size_t(20 * width + 3) * 4] = 1e6f;
    Plan plan = make_plan(borrowed());
    std::vector<float> floats(color.size());
    plan.execute(brume::image(bright.data(), width, height, 4), brume::image(depth.data(), width, height, 1),
                 brume::image(floats.data(), width, height, 4));
    const GLuint texture = filled_texture(GL_RGBA32F, GL_RGBA, bright);
    plan.execute(texture_image(texture), texture_image(filled_texture(GL_R32F, GL_RED, depth), 1), texture_image(texture));
    EXPECT_EQ(read<float>(texture), floats);
    EXPECT_GT(*std::max_element(floats.begin(), floats.end()), 65504.0f);
}

TEST_F(HostTextures, InPlaceEqualsNotInPlace)
{
    Plan plan = make_plan(borrowed());
    const brume_image depth_image = texture_image(filled_texture(GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, depth), 1);
    for (GLenum format : {GL_RGBA32F, GL_RGBA16F}) {
        const GLuint in = filled_texture(format, GL_RGBA, color), out = make_texture(format, width, height);
        plan.execute(texture_image(in), depth_image, texture_image(out));
        plan.execute(texture_image(in), depth_image, texture_image(in));
        EXPECT_EQ(read<uint16_t>(in), read<uint16_t>(out));
        EXPECT_EQ(read<float>(in), read<float>(out));
    }
}

// Textures and memory may be mixed, whatever their types.
TEST_F(HostTextures, MixedKinds)
{
    Plan plan = make_plan(borrowed());
    const brume_image memory_depth = brume::image(depth.data(), width, height, 1);
    std::vector<float> expected(color.size()), got(color.size());
    plan.execute(brume::image(color.data(), width, height, 4), memory_depth,
                 brume::image(expected.data(), width, height, 4));
    plan.execute(texture_image(filled_texture(GL_RGBA16F, GL_RGBA, color)), memory_depth,
                 brume::image(got.data(), width, height, 4));
    EXPECT_EQ(got, expected);
    const GLuint out = make_texture(GL_RGBA32F, width, height);
    plan.execute(brume::image(color.data(), width, height, 4), texture_image(filled_texture(GL_R32F, GL_RED, depth), 1),
                 texture_image(out));
    EXPECT_EQ(read<float>(out), expected);
}

TEST_F(HostTextures, BottomLeftOriginIsTheFlippedPicture)
{
    Scene scene{Context(borrowed()), scene_text};
    scene.set("multiscatter", "levels", 4);  // 48 rows halve evenly four times: that pyramid is symmetric
    Plan plan(scene, brume::format(width, height));
    std::vector<float> expected(color.size());
    plan.execute(brume::image(color.data(), width, height, 4), brume::image(depth.data(), width, height, 1),
                 brume::image(expected.data(), width, height, 4));
    const GLuint out = make_texture(GL_RGBA32F, width, height);
    plan.execute(brume::texture(filled_texture(GL_RGBA32F, GL_RGBA, flipped(color, 4)), width, height, 4),
                 brume::texture(filled_texture(GL_R32F, GL_RED, flipped(depth, 1)), width, height, 1),
                 brume::texture(out, width, height, 4));
    const std::vector<float> got = flipped(read<float>(out), 4);
    for (size_t i = 0; i < got.size(); ++i)
        ASSERT_NEAR(got[i], expected[i], 1e-5f * std::abs(expected[i]) + 1e-5f)
            << "pixel " << i / 4 % width << ", " << i / 4 / width;
}

TEST_F(HostTextures, PlanThatDoesNothingCopiesBits)
{
    Plan plan = make_plan(borrowed(), R"({"brume": 1, "camera": {"vertical_fov": 50}})");
    EXPECT_EQ(plan.info().does_nothing, 1u);
    for (GLenum format : {GL_RGBA32F, GL_RGBA16F}) {
        const GLuint in = filled_texture(format, GL_RGBA, color), out = make_texture(format, width, height);
        plan.execute(texture_image(in), texture_image(filled_texture(GL_R32F, GL_RED, depth), 1), texture_image(out));
        EXPECT_EQ(read<float>(in), read<float>(out));
    }
}

// Each question may wait for the driver's thread.
TEST_F(HostTextures, FramesAskLittle)
{
    const GLuint in = filled_texture(GL_RGBA16F, GL_RGBA, color), out = make_texture(GL_RGBA16F, width, height);
    const GLuint z = filled_texture(GL_R32F, GL_RED, depth);
    struct Case {
        uint32_t state;
        bool trusted;
        int most;
    };
    for (const Case &one : {Case{BRUME_GL_STATE_PRESERVE, false, 39}, Case{BRUME_GL_STATE_PRESERVE, true, 24},
                            Case{BRUME_GL_STATE_OWNED, false, 6}, Case{BRUME_GL_STATE_OWNED, true, 3}}) {
        Plan plan = make_plan(borrowed(one.state));
        brume_image images[] = {texture_image(in), texture_image(z, 1), texture_image(out)};
        for (brume_image &image : images) {
            image.kind = one.trusted ? BRUME_IMAGE_GL_TEXTURE_TRUSTED : BRUME_IMAGE_GL_TEXTURE;
            image.pixel = image.gl_texture == z ? BRUME_PIXEL_F32 : BRUME_PIXEL_F16;
        }
        plan.execute(images[0], images[1], images[2]);
        const QueryCount count;
        plan.execute(images[0], images[1], images[2]);
        EXPECT_GT(QueryCount::total(), 0) << "nothing is counted";
        EXPECT_LE(QueryCount::total(), one.most) << "state " << one.state << ", trusted " << one.trusted << "\n"
                                                 << QueryCount::list();
    }
}

// As docs/integrate.md says of resolutions that change with the frame.
TEST_F(HostTextures, PlansOfAnotherSizeCompileNothing)
{
    const Context context(borrowed());
    const Scene scene(context, scene_text);
    const auto programs_asked = [&](int32_t smaller) {
        brume_format other = brume::format(width - smaller, height - smaller);
        other.depth_kind = BRUME_DEPTH_RAY;
        const QueryCount count;
        const Plan plan(scene, other);
        return QueryCount::of("glGetProgramiv");
    };
    EXPECT_GT(programs_asked(0), 0) << "nothing is counted";
    for (const int32_t smaller : {1, 7, 24, 40})
        EXPECT_EQ(programs_asked(smaller), 0) << smaller << " pixels less a side";
}

TEST_F(HostTextures, TrustedTexturesGiveTheSameBits)
{
    Plan plan = make_plan(borrowed());
    for (GLenum format : {GL_RGBA32F, GL_RGBA16F}) {
        const GLuint in = filled_texture(format, GL_RGBA, color), out = make_texture(format, width, height);
        const GLuint trusted_out = make_texture(format, width, height);
        brume_image images[] = {texture_image(in), texture_image(filled_texture(GL_R32F, GL_RED, depth), 1),
                                texture_image(trusted_out)};
        plan.execute(images[0], images[1], texture_image(out));
        for (brume_image &image : images) {
            image.kind = BRUME_IMAGE_GL_TEXTURE_TRUSTED;
            image.pixel = image.channels == 4 && format == GL_RGBA16F ? BRUME_PIXEL_F16 : BRUME_PIXEL_F32;
        }
        plan.execute(images[0], images[1], images[2]);
        EXPECT_EQ(read<float>(trusted_out), read<float>(out));
        plan.execute(images[0], images[1], images[0]);
        EXPECT_EQ(read<float>(in), read<float>(out)) << "in place";
    }
}

// The picture in the formats of many engines' frames.
TEST_F(HostTextures, PackedOutputsAreTheFloatsRounded)
{
    Plan plan = make_plan(borrowed());
    const brume_image in = texture_image(filled_texture(GL_RGBA32F, GL_RGBA, color));
    const brume_image z = texture_image(filled_texture(GL_R32F, GL_RED, depth), 1);
    const GLuint full = make_texture(GL_RGBA32F, width, height), small = make_texture(GL_R11F_G11F_B10F, width, height),
                 display = make_texture(GL_RGB10_A2, width, height);
    for (GLuint output : {full, small, display})
        plan.execute(in, z, texture_image(output));
    const std::vector<float> floats = read<float>(full), eleven = read<float>(small), ten = read<float>(display);
    for (size_t i = 0; i < floats.size(); ++i) {
        if (i % 4 != 3) {
            ASSERT_NEAR(eleven[i], std::min(floats[i], 64512.0f), std::abs(floats[i]) / (i % 4 == 2 ? 64 : 128) + 0x1p-20f);
            ASSERT_NEAR(ten[i], std::clamp(floats[i], 0.0f, 1.0f), 0.5f / 1023 + 1e-6f);
        } else {
            ASSERT_EQ(eleven[i], 1.0f);
            ASSERT_NEAR(ten[i], floats[i], 0.5f / 3 + 1e-6f);
        }
    }
}

TEST_F(HostTextures, NothingGrowsOnceWarm)
{
    Context context(borrowed());
    Plan plan(Scene(context, scene_text), brume::format(width, height));
    const brume_image in = texture_image(filled_texture(GL_RGBA16F, GL_RGBA, color));
    const brume_image z = texture_image(filled_texture(GL_R32F, GL_RED, depth), 1);
    const brume_image out = texture_image(make_texture(GL_RGBA16F, width, height));
    plan.execute(in, z, out);
    const uint64_t warm = context.info().device_bytes;
    EXPECT_GT(warm, 0u);
    for (int frame = 0; frame < 5; ++frame)
        plan.execute(in, z, out);
    EXPECT_EQ(context.info().device_bytes, warm);
    double total = 0;
    for (const brume_plan_entry &entry : plan.entries())
        total += entry.runs ? entry.measured_ms : 0;
    EXPECT_GT(total, 0);
}

// Before the first frame and after many, with textures and with host memory.
TEST_F(HostTextures, APlanSaysWhatItHolds)
{
    std::string gaussians;
    for (int i = 0; i < 12; ++i)
        gaussians += (i ? ", " : "") + std::string(R"({"type": "gaussian", "center": [)") + std::to_string(i % 8 - 4) +
                     ", " + std::to_string(i % 5 - 1) + ", " + std::to_string(-6 - i % 7) +
                     R"(], "scale": 0.8, "amplitude": 1})";
    const std::string lit = R"({ "brume": 1,
        "camera": {"vertical_fov": 50, "camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]},
        "medium": {"scattering": 0.03, "absorption": 0.002, "density": [)" +
                            gaussians + R"(]},
        "lights": [{"type": "point", "position": [0, 1, -6], "intensity": 60, "radius": 0.1}],
        "effects": {"multiscatter": {}, "airlight": {"tier": "TIER", "max_error": 0.1}} })";
    const auto with = [&](const char *tier) { return std::string(lit).replace(lit.find("TIER"), 4, tier); };
    constexpr int32_t wide = 96, high = 54;
    std::vector<float> rgba(wide * high * 4, 0.5f), z(wide * high, 9.0f), result(wide * high * 4);
    std::vector<uint16_t> half(wide * high * 4, 0x3800), half_result(wide * high * 4);
    const GLuint names[] = {make_texture(GL_RGBA32F, wide, high), make_texture(GL_R32F, wide, high),
                            make_texture(GL_RGBA32F, wide, high)};
    enum Given { textures, floats, halves };
    struct Case {
        std::string text;
        Given given;
    };
    for (const Case &one : {Case{scene_text, textures}, Case{scene_text, floats}, Case{scene_text, halves},
                            Case{with("nodes"), textures}, Case{with("maps"), floats}}) {
        SCOPED_TRACE(testing::Message() << one.text << ", given " << one.given);
        const Context context(borrowed());
        const TextureBytes bytes;
        Plan plan(Scene(context, one.text), brume::format(wide, high));
        EXPECT_EQ(plan.info().image_bytes, TextureBytes::held()) << "before the first frame";
        for (int frame = 0; frame < 12; ++frame)
            if (one.given == textures)
                plan.execute(brume::texture(names[0], wide, high, 4), brume::texture(names[1], wide, high, 1),
                             brume::texture(names[2], wide, high, 4));
            else if (one.given == floats)
                plan.execute(brume::image(rgba.data(), wide, high, 4), brume::image(z.data(), wide, high, 1),
                             brume::image(result.data(), wide, high, 4));
            else
                plan.execute(brume::half_image(half.data(), wide, high, 4), brume::image(z.data(), wide, high, 1),
                             brume::half_image(half_result.data(), wide, high, 4));
        // Halves for host memory are rounded in one more texture, which is the pool's.
        const uint64_t rounded = one.given == halves ? wide * high * 8 : 0;
        EXPECT_EQ(plan.info().image_bytes + rounded, TextureBytes::held()) << "after 12 frames";
        EXPECT_EQ(context.info().device_bytes, TextureBytes::held());
    }
}

TEST_F(HostTextures, FailuresAreNamed)
{
    Context context(borrowed());
    Plan plan(Scene(context, scene_text), brume::format(width, height));
    const brume_image in = texture_image(filled_texture(GL_RGBA16F, GL_RGBA, color));
    const brume_image z = texture_image(filled_texture(GL_R32F, GL_RED, depth), 1);
    const auto message = [&](const brume_image &c, const brume_image &d, const brume_image &o, brume_status status) {
        try {
            plan.execute(c, d, o);
        } catch (const Error &error) {
            EXPECT_EQ(error.status(), status) << error.what();
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_NE(message(in, z, texture_image(make_texture(GL_RGBA8, width, height)), BRUME_ERROR_UNSUPPORTED).find("GL_RGBA8"),
              std::string::npos);
    EXPECT_NE(message(texture_image(12345), z, in, BRUME_ERROR_ARGUMENT).find("color: texture 12345 does not exist"),
              std::string::npos);
    EXPECT_NE(message(z, z, in, BRUME_ERROR_ARGUMENT), "") << "channels differ";
    EXPECT_NE(message(in, texture_image(in.gl_texture, 1), in, BRUME_ERROR_UNSUPPORTED).find("depth: "), std::string::npos);
    host.release();
    EXPECT_NE(message(in, z, in, BRUME_ERROR_GL).find("no OpenGL context is current"), std::string::npos);
    host.make_current();
    EXPECT_EQ(message(in, z, in, BRUME_OK), "");
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

// All that a client does, in a context whose whole state is dirty.
TEST(HostStateAbi, IsPreserved)
{
    for (bool compatibility : {false, true}) {
        HostContext host(compatibility ? Profile::compatibility : Profile::core);
        const std::vector<float> color = lamps(), depth = distances();
        const GLuint in = filled_texture(GL_RGBA16F, GL_RGBA, color), out = make_texture(GL_RGBA16F, width, height);
        const GLuint z = filled_texture(GL_R32F, GL_RED, depth);
        std::vector<float> memory(color.size());
        dirty_state(compatibility);
        const HostState before = read_state(compatibility);
        const auto expect_preserved = [&](const char *what) {
            EXPECT_EQ(difference(before, read_state(compatibility)), "") << "by " << what;
        };
        {
            Context context(borrowed());
            expect_preserved("brume_context_create");
            Scene scene(context, scene_text);
            Plan plan(scene, brume::format(width, height));
            expect_preserved("brume_plan_create");
            plan.execute(brume::texture(in, width, height, 4), brume::texture(z, width, height, 1),
                         brume::texture(out, width, height, 4));
            expect_preserved("brume_plan_execute on textures");
            plan.execute(brume::image(color.data(), width, height, 4), brume::image(depth.data(), width, height, 1),
                         brume::image(memory.data(), width, height, 4));
            expect_preserved("brume_plan_execute on memory");
            EXPECT_FALSE(plan.entries().empty());
            expect_preserved("brume_plan_get_entry");
            EXPECT_THROW(plan.execute(brume::texture(in, width, height, 4), brume::texture(z, width, height, 1),
                                      brume::texture(z, width, height, 4)),
                         Error);
            expect_preserved("a call that fails");
        }
        expect_preserved("brume_context_destroy");
        EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
    }
}

}  // namespace
}  // namespace brume::test
