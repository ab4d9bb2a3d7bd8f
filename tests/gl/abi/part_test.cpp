// Images that are parts of larger textures of the host's, and depth textures of another size than colour.
#include <algorithm>
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include <brume/brume.hpp>

#include "gl_calls.h"
#include "host_context.h"

namespace brume::test {
namespace {

constexpr int32_t width = 72, height = 48;

const char *const scene_text = R"({
  "brume": 1,
  "camera": { "vertical_fov": 50, "camera_to_world": [[1,0,0,0],[0,1,0,2],[0,0,1,0],[0,0,0,1]] },
  "medium": { "scattering": [0.03, 0.03, 0.034], "absorption": [0.002, 0.003, 0.004], "g": 0.7,
              "density": [ {"type": "exponential", "value": 1, "falloff": 0.2, "direction": [0, 1, 0]} ] }
})";

// What of a texture is the image.
struct Place {
    int32_t x, y, width, height;  // in a texture of that size
};
constexpr Place places[] = {{0, 0, 80, 64}, {8, 16, 80, 64}, {5, 9, 200, 60}};

struct Format {
    GLenum name, layout;
    const char *text;
};
constexpr Format color_formats[] = {{GL_RGBA32F, GL_RGBA, "RGBA32F"},   {GL_RGBA16F, GL_RGBA, "RGBA16F"},
                                    {GL_RGB16F, GL_RGBA, "RGB16F"},     {GL_R11F_G11F_B10F, GL_RGBA, "R11F_G11F_B10F"},
                                    {GL_RGB10_A2, GL_RGBA, "RGB10_A2"}, {GL_RGBA16, GL_RGBA, "RGBA16"},
                                    {GL_RGBA8, GL_RGBA, "RGBA8"}};
constexpr Format depth_formats[] = {{GL_R32F, GL_RED, "R32F"},
                                    {GL_R16F, GL_RED, "R16F"},
                                    {GL_R16, GL_RED, "R16"},
                                    {GL_RG32F, GL_RED, "RG32F"},
                                    {GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT, "DEPTH_COMPONENT16"},
                                    {GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, "DEPTH_COMPONENT24"},
                                    {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, "DEPTH_COMPONENT32F"},
                                    {GL_DEPTH24_STENCIL8, GL_DEPTH_COMPONENT, "DEPTH24_STENCIL8"},
                                    {GL_DEPTH32F_STENCIL8, GL_DEPTH_COMPONENT, "DEPTH32F_STENCIL8"}};
constexpr Format output_formats[] = {color_formats[0], color_formats[1], color_formats[3], color_formats[4]};

size_t channels_of(const Format &format)
{
    return format.layout == GL_RGBA ? 4 : 1;
}

std::vector<float> lamps()
{
    std::vector<float> pixels(width * height * 4);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 4; ++c)
                pixels[size_t(y * width + x) * 4 + size_t(c)] =
                    c == 3 ? float(x % 5) / 4.0f
                           : (x % 17 == 5 && y % 13 == 4 ? 100.0f * float(c + 1) : float(x + 2 * y + 5 * c) / 1024.0f);
    return pixels;
}

// Device depth: 1 is the near plane.
std::vector<float> depths(int32_t columns, int32_t rows)
{
    std::vector<float> depth(size_t(columns * rows));
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x)
            depth[size_t(y * columns + x)] = y < rows / 8 ? 0.0f : 0.5f / (2.0f + float((x / 5) * 3) + float(y) / 8.0f);
    return depth;
}

GLuint filled(const Format &format, int32_t columns, int32_t rows, const std::vector<float> &pixels)
{
    const GLuint texture = make_texture(format.name, columns, rows);
    glTextureSubImage2D(texture, 0, 0, 0, columns, rows, format.layout, GL_FLOAT, pixels.data());
    return texture;
}

// `inside` in a texture of one value.
GLuint framed(const Format &format, const Place &place, const std::vector<float> &inside, float around)
{
    const std::vector<float> poison(size_t(place.width * place.height) * channels_of(format), around);
    const GLuint texture = filled(format, place.width, place.height, poison);
    glTextureSubImage2D(texture, 0, place.x, place.y, width, height, format.layout, GL_FLOAT, inside.data());
    return texture;
}

std::vector<float> read(const Format &format, GLuint texture, const Place &of)
{
    std::vector<float> pixels(size_t(width * height) * channels_of(format));
    glGetTextureSubImage(texture, 0, of.x, of.y, 0, width, height, 1, format.layout, GL_FLOAT,
                         GLsizei(pixels.size() * sizeof(float)), pixels.data());
    return pixels;
}

// Whether the texture has `around` everywhere but where the image is.
bool is_untouched_around(const Format &format, GLuint texture, const Place &place, float around)
{
    const size_t channels = channels_of(format);
    std::vector<float> pixels(size_t(place.width * place.height) * channels);
    const auto all = [&](GLuint of) {
        glGetTextureImage(of, 0, format.layout, GL_FLOAT, GLsizei(pixels.size() * sizeof(float)), pixels.data());
        for (int y = 0; y < height; ++y)
            std::memset(&pixels[size_t((y + place.y) * place.width + place.x) * channels], 0,
                        width * channels * sizeof(float));
        return pixels;
    };
    const std::vector<float> zeros(size_t(width * height) * channels, 0.0f);
    const std::vector<float> got = all(texture), expected = all(framed(format, place, zeros, around));
    return std::memcmp(got.data(), expected.data(), got.size() * sizeof(float)) == 0;
}

brume_image whole(GLuint name, uint32_t channels, int32_t columns = width, int32_t rows = height)
{
    return brume::texture(name, columns, rows, channels);
}

brume_image part_of(GLuint name, uint32_t channels, const Place &place)
{
    return brume::part(whole(name, channels, place.width, place.height), place.x, place.y, width, height);
}

// What 24 bits of depth are as floats differs in the last place by the way that a driver reads them. Light from behind an
// optical depth of ten changes by ten times as much, of nearly nothing.
double rounding_of(const Format &format)
{
    return std::string(format.text).find("24") != std::string::npos ? 1e-5 : 0;
}

void expect_near(const std::vector<float> &got, const std::vector<float> &expected, double relative, const std::string &what)
{
    ASSERT_EQ(got.size(), expected.size());
    for (size_t i = 0; i < got.size(); ++i)
        ASSERT_LE(std::abs(double(got[i]) - expected[i]), relative * std::max(std::abs(expected[i]), 1e-3f))
            << what << ": value " << i << " is " << got[i] << ", expected " << expected[i];
}

void expect_same_bits(const std::vector<float> &got, const std::vector<float> &expected, const std::string &what)
{
    ASSERT_EQ(got.size(), expected.size());
    for (size_t i = 0; i < got.size(); ++i)
        ASSERT_EQ(std::memcmp(&got[i], &expected[i], sizeof(float)), 0)
            << what << ": value " << i << " is " << got[i] << ", expected " << expected[i];
}

class TextureParts : public testing::Test {
protected:
    HostContext host;
    const std::vector<float> color = lamps(), depth = depths(width, height);
    const Context context{borrowed()};
    Plan plan = make_plan(scene_text);

    static brume_context_desc borrowed()
    {
        brume_context_desc desc = BRUME_CONTEXT_DESC_INIT;
        desc.backend = BRUME_BACKEND_GL;
        desc.gl_context = BRUME_GL_BORROWED;
        return desc;
    }
    Plan make_plan(const char *text, std::vector<brume_layer> layers = {}) const
    {
        brume_format format = brume::format(width, height);
        format.depth_kind = BRUME_DEPTH_DEVICE;
        format.depth_range[0] = INFINITY;
        format.depth_range[1] = 0.5;
        format.outputs = layers.data();
        format.output_count = uint32_t(layers.size());
        return Plan(Scene(context, text), format);
    }
    std::string failure(const brume_image &from, const brume_image &z, const brume_image &to)
    try {
        plan.execute(from, z, to);
        return "";
    } catch (const Error &error) {
        return error.what();
    }
};

TEST_F(TextureParts, ColorOfAnyFormat)
{
    const brume_image z = whole(filled(depth_formats[0], width, height, depth), 1);
    const Format &out = output_formats[0];
    for (const Format &format : color_formats)
        for (const Place &place : places)
            for (float around : {0.75f, NAN}) {
                const std::string what = std::string(format.text) + " at " + std::to_string(place.x);
                const GLuint from = framed(format, place, color, around);
                // The same texels as memory: passes then see floats, whatever the texture holds.
                const std::vector<float> texels = read(format, from, place);
                const GLuint expected = make_texture(out.name, width, height), to = make_texture(out.name, width, height);
                plan.execute(whole(filled(color_formats[0], width, height, texels), 4), z, whole(expected, 4));
                plan.execute(part_of(from, 4, place), z, whole(to, 4));
                expect_same_bits(read(out, to, {}), read(out, expected, {}), what);
                EXPECT_TRUE(is_untouched_around(format, from, place, around)) << what;
                expect_same_bits(read(format, from, place), texels, what + ", the input itself");
            }
}

TEST_F(TextureParts, DepthOfAnyFormat)
{
    const brume_image from = whole(filled(color_formats[0], width, height, color), 4);
    const Format &out = output_formats[0];
    for (const Format &format : depth_formats)
        for (const Place &place : places)
            for (float around : {0.9f, 0.0f}) {
                const std::string what = std::string(format.text) + " at " + std::to_string(place.x);
                const GLuint z = framed(format, place, depth, around);
                const GLuint expected = make_texture(out.name, width, height), to = make_texture(out.name, width, height);
                plan.execute(from, whole(filled(depth_formats[0], width, height, read(format, z, place)), 1),
                             whole(expected, 4));
                plan.execute(from, part_of(z, 1, place), whole(to, 4));
                expect_near(read(out, to, {}), read(out, expected, {}), rounding_of(format), what);
                EXPECT_TRUE(is_untouched_around(format, z, place, around)) << what;
            }
}

// Written straight by passes, or copied, or rounded by the converter.
TEST_F(TextureParts, OutputOfAnyFormat)
{
    const brume_image z = whole(filled(depth_formats[4], width, height, depth), 1);
    const brume_image from = whole(filled(color_formats[0], width, height, color), 4);
    for (const Format &format : output_formats) {
        const GLuint expected = make_texture(format.name, width, height);
        plan.execute(from, z, whole(expected, 4));
        for (const Place &place : places) {
            const std::string what = std::string(format.text) + " at " + std::to_string(place.x);
            const GLuint to = framed(format, place, color, 0.5f);
            plan.execute(from, z, part_of(to, 4, place));
            expect_same_bits(read(format, to, place), read(format, expected, {}), what);
            EXPECT_TRUE(is_untouched_around(format, to, place, 0.5f)) << what;
        }
    }
}

TEST_F(TextureParts, InPlace)
{
    const brume_image z = whole(filled(depth_formats[4], width, height, depth), 1);
    for (const Format &format : output_formats)
        for (const Place &place : places) {
            const GLuint at_once = framed(format, place, color, 0.5f), apart = framed(format, place, color, 0.5f);
            const GLuint expected = make_texture(format.name, width, height);
            plan.execute(part_of(apart, 4, place), z, whole(expected, 4));
            plan.execute(part_of(at_once, 4, place), z, part_of(at_once, 4, place));
            expect_same_bits(read(format, at_once, place), read(format, expected, {}), format.text);
            EXPECT_TRUE(is_untouched_around(format, at_once, place, 0.5f)) << format.text;
        }
}

TEST_F(TextureParts, Layers)
{
    brume_layer layers[] = {BRUME_LAYER_INIT, BRUME_LAYER_INIT};
    layers[0].name = "transmittance";
    layers[1].name = "blur_radius";
    plan = make_plan(scene_text, {layers[0], layers[1]});
    const brume_image from = whole(filled(color_formats[0], width, height, color), 4);
    const brume_image z = whole(filled(depth_formats[4], width, height, depth), 1);
    const brume_image to = whole(make_texture(GL_RGBA32F, width, height), 4);
    const std::vector<float> none(width * height * 4, 0.25f);
    for (const auto &[rgb, scalar] : {std::pair{color_formats[0], depth_formats[0]}, {color_formats[1], depth_formats[1]}}) {
        const auto execute = [&](const brume_image &straight, const brume_image &radius) {
            layers[0].image = &straight;
            layers[1].image = &radius;
            brume_frame frame = BRUME_FRAME_INIT;
            frame.color = &from;
            frame.depth = &z;
            frame.output = &to;
            frame.outputs = layers;
            frame.output_count = 2;
            plan.execute(frame);
        };
        const GLuint straight = make_texture(rgb.name, width, height), radius = make_texture(scalar.name, width, height);
        execute(whole(straight, 3), whole(radius, 1));
        for (const Place &place : places) {
            const GLuint straight_part = framed(rgb, place, none, 0.5f), radius_part = framed(scalar, place, none, 0.5f);
            execute(part_of(straight_part, 3, place), part_of(radius_part, 1, place));
            expect_same_bits(read(rgb, straight_part, place), read(rgb, straight, {}), rgb.text);
            expect_same_bits(read(scalar, radius_part, place), read(scalar, radius, {}), scalar.text);
            EXPECT_TRUE(is_untouched_around(rgb, straight_part, place, 0.5f));
            EXPECT_TRUE(is_untouched_around(scalar, radius_part, place, 0.5f));
        }
    }
}

TEST_F(TextureParts, TrustedOnes)
{
    for (const Format &format : {output_formats[0], output_formats[1]})
        for (const Place &place : places) {
            const GLuint from = framed(format, place, color, NAN), to = framed(format, place, color, 0.5f);
            const GLuint z = framed(depth_formats[7], place, depth, 0.9f),
                         expected = make_texture(format.name, width, height);
            brume_image images[] = {part_of(from, 4, place), part_of(z, 1, place), part_of(to, 4, place)};
            plan.execute(images[0], images[1], whole(expected, 4));
            for (brume_image &image : images) {
                image.kind = BRUME_IMAGE_GL_TEXTURE_TRUSTED;
                image.pixel = format.name == GL_RGBA16F ? BRUME_PIXEL_F16 : BRUME_PIXEL_F32;
            }
            plan.execute(images[0], images[1], images[2]);
            expect_same_bits(read(format, to, place), read(format, expected, {}), format.text);
            EXPECT_TRUE(is_untouched_around(format, to, place, 0.5f)) << format.text;
        }
}

TEST_F(TextureParts, AreCopiedWhereThereIsNoFog)
{
    plan = make_plan(R"({"brume": 1})");
    const brume_image z = whole(filled(depth_formats[0], width, height, depth), 1);
    for (const Format &format : output_formats) {
        const GLuint from = framed(format, places[1], color, 0.75f),
                     to = framed(format, places[2], {color.rbegin(), color.rend()}, 0.5f);
        plan.execute(part_of(from, 4, places[1]), z, part_of(to, 4, places[2]));
        expect_same_bits(read(format, to, places[2]), read(format, from, places[1]), format.text);
        EXPECT_TRUE(is_untouched_around(format, to, places[2], 0.5f)) << format.text;
    }
}

// Each pixel that in which its centre lies, in every format and from parts too.
TEST_F(TextureParts, DepthOfAnotherSizeIsNearest)
{
    const brume_image from = whole(filled(color_formats[1], width, height, color), 4);
    const Format &out = output_formats[0];
    const GLuint expected = make_texture(out.name, width, height), to = make_texture(out.name, width, height);
    for (const Format &format : depth_formats)
        for (auto [columns, rows] :
             {std::pair{width / 2, height / 2}, {48, 32}, {107, 71}, {2 * width, 2 * height}, {5, 3}}) {
            const GLuint other = filled(format, columns, rows, depths(columns, rows));
            std::vector<float> texels(size_t(columns * rows)), same(width * height);
            glGetTextureImage(other, 0, format.layout, GL_FLOAT, GLsizei(texels.size() * sizeof(float)), texels.data());
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x)
                    same[size_t(y * width + x)] = texels[size_t(int(std::floor((y + 0.5) * rows / height)) * columns +
                                                                int(std::floor((x + 0.5) * columns / width)))];
            plan.execute(from, whole(filled(depth_formats[0], width, height, same), 1), whole(expected, 4));
            const auto expect_the_same = [&](const brume_image &z) {
                plan.execute(from, z, whole(to, 4));
                expect_near(read(out, to, {}), read(out, expected, {}), rounding_of(format),
                            std::string(format.text) + " " + std::to_string(columns));
            };
            expect_the_same(whole(other, 1, columns, rows));
            const GLuint larger =
                filled(format, columns + 9, rows + 20, std::vector<float>(size_t((columns + 9) * (rows + 20)), 0.9f));
            glTextureSubImage2D(larger, 0, 3, 4, columns, rows, format.layout, GL_FLOAT, depths(columns, rows).data());
            expect_the_same(brume::part(whole(larger, 1, columns + 9, rows + 20), 3, 4, columns, rows));
        }
}

TEST_F(TextureParts, FailuresNameTheRectangle)
{
    const Place &place = places[1];
    const brume_image z = whole(filled(depth_formats[0], width, height, depth), 1);
    const brume_image from = part_of(framed(color_formats[0], place, color, 0.5f), 4, place);
    const brume_image to = whole(make_texture(GL_RGBA32F, width, height), 4);
    const std::string texture = "texture " + std::to_string(from.gl_texture);
    brume_image wrong = from;
    wrong.whole_width = 90;
    EXPECT_EQ(failure(wrong, z, to), "color: " + texture +
                                         " is 80 x 64; the image says 72 x 48 at (8, 16) of 90 x 64 (the image is "
                                         "72 x 48 at (8, 16) of 90 x 64)");
    wrong = whole(from.gl_texture, 4);
    EXPECT_EQ(failure(wrong, z, to), "color: " + texture +
                                         " is 80 x 64; the image says 72 x 48, and no whole_width x whole_height "
                                         "that it is a part of");
    wrong = part_of(framed(color_formats[6], place, color, 0.5f), 4, place);
    EXPECT_NE(failure(from, z, wrong).find("is GL_RGBA8; expected"), std::string::npos) << failure(from, z, wrong);
    EXPECT_NE(failure(from, z, wrong).find("(the image is 72 x 48 at (8, 16) of 80 x 64)"), std::string::npos);
    wrong = from;
    wrong.x -= 1;
    EXPECT_EQ(failure(from, z, wrong),
              "output: overlaps color; expected the very same image or none of its memory (output is 72 x 48 at (7, 16) of "
              "80 x 64, color 72 x 48 at (8, 16) of 80 x 64)");
    EXPECT_EQ(failure(from, z, to), "");
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

// Images of a texture that have no texel in common.
TEST_F(TextureParts, OfOneTextureMayLieSideBySide)
{
    const Format &format = color_formats[1];
    const Place left{0, 0, 2 * width, height}, right{width, 0, 2 * width, height};
    const GLuint atlas = framed(format, left, color, 0.5f), expected = make_texture(format.name, width, height);
    const brume_image z = whole(filled(depth_formats[0], width, height, depth), 1);
    plan.execute(part_of(atlas, 4, left), z, whole(expected, 4));
    plan.execute(part_of(atlas, 4, left), z, part_of(atlas, 4, right));
    expect_same_bits(read(format, atlas, right), read(format, expected, {}), "right");
    expect_same_bits(read(format, atlas, left), read(format, filled(format, width, height, color), {}), "left");
}

TEST_F(TextureParts, NothingGrowsOnceWarm)
{
    const Place &place = places[2];
    const brume_image from = part_of(framed(color_formats[1], place, color, 0.5f), 4, place);
    const brume_image z =
        whole(filled(depth_formats[4], width / 2, height / 2, depths(width / 2, height / 2)), 1, width / 2, height / 2);
    plan.execute(from, z, from);
    plan.execute(from, z, from);
    const uint64_t warm = context.info().device_bytes;
    for (int frame = 0; frame < 5; ++frame)
        plan.execute(from, z, from);
    EXPECT_EQ(context.info().device_bytes, warm);
}

}  // namespace
}  // namespace brume::test
