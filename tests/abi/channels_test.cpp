// Channels of an image that do not lie alone and side by side: with other images in one pixel, or in planes.
#include "client.h"

using namespace client;

namespace {

constexpr int width = 37, height = 23;

class Channels : public EachBackend {
protected:
    void SetUp() override
    {
        EachBackend::SetUp();
        if (!context)
            return;
        paint(color);
        paint_depth(depth);
        plan = make_plan(context, make_scene(context, foggy), ray_format(width, height, {layer("transmittance")}));
    }

    // What packed images of `channels` give.
    Picture packed(uint32_t channels)
    {
        Picture output(width, height, {.channels = channels});
        EXPECT_EQ(execute(plan.get(), color_of(channels), depth, output), BRUME_OK) << message(context.get());
        return output;
    }
    Picture color_of(uint32_t channels) const
    {
        Picture picture(width, height, {.channels = channels});
        for_samples(channels, [&](int x, int y, int c) { picture.set(x, y, c, color.get(x, y, c)); });
        return picture;
    }
    template <class Function> static void for_samples(uint32_t channels, Function function)
    {
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (int c = 0; c < int(channels); ++c)
                    function(x, y, c);
    }
    brume_status run(const brume_image &from, const brume_image &z, const brume_image &to,
                     const brume_layer *layer = nullptr)
    {
        brume_frame frame = BRUME_FRAME_INIT;
        frame.color = &from;
        frame.depth = &z;
        frame.output = &to;
        frame.output_count = layer ? 1 : 0;
        frame.outputs = layer;
        return brume_plan_execute(plan.get(), &frame);
    }

    Picture color{width, height}, depth{width, height, {.channels = 1}};
    Plan plan;
};

// Pixels of several floats, of which an image is some.
struct Pixels {
    explicit Pixels(int samples) : samples(samples), memory(size_t(width) * height * size_t(samples), -7.0f) {}

    float &at(int x, int y, int sample)
    {
        return memory[(size_t(y) * width + size_t(x)) * size_t(samples) + size_t(sample)];
    }
    brume_image image(int first, uint32_t channels)
    {
        brume_image image = BRUME_IMAGE_INIT;
        image.width = width;
        image.height = height;
        image.channels = channels;
        image.data = memory.data() + first;
        image.pixel_stride = 4 * samples;
        return image;
    }

    int samples;
    std::vector<float> memory;
};

struct Planes {
    Planes(uint32_t channels, bool backwards = false)
        : channels(channels), backwards(backwards), memory(size_t(width) * height * channels)
    {
    }

    size_t plane(int c) const { return size_t(backwards ? int(channels) - 1 - c : c) * width * height; }
    float &at(int x, int y, int c) { return memory[plane(c) + size_t(y) * width + size_t(x)]; }
    brume_image image()
    {
        brume_image image = BRUME_IMAGE_INIT;
        image.width = width;
        image.height = height;
        image.channels = channels;
        image.data = memory.data() + plane(0);
        image.plane_stride = (backwards ? -4 : 4) * width * height;
        return image;
    }

    uint32_t channels;
    bool backwards;
    std::vector<float> memory;
};

}  // namespace

TEST_P(Channels, OfColorAndDepthInOnePixel)
{
    const Picture expected = packed(4);
    Pixels pixels(5);
    for_samples(4, [&](int x, int y, int c) { pixels.at(x, y, c) = color.get(x, y, c); });
    for_samples(1, [&](int x, int y, int) { pixels.at(x, y, 4) = depth.get(x, y, 0); });
    ASSERT_EQ(run(pixels.image(0, 4), pixels.image(4, 1), pixels.image(0, 4)), BRUME_OK) << message(context.get());
    for_samples(4, [&](int x, int y, int c) { ASSERT_EQ(pixels.at(x, y, c), expected.get(x, y, c)) << x << ", " << y; });
    for_samples(1, [&](int x, int y, int) { ASSERT_EQ(pixels.at(x, y, 4), depth.get(x, y, 0)) << x << ", " << y; });
}

TEST_P(Channels, OfAllImagesInOnePixel)
{
    const Picture expected = packed(3);
    Pixels pixels(11);
    for_samples(3, [&](int x, int y, int c) { pixels.at(x, y, c) = color.get(x, y, c); });
    for_samples(1, [&](int x, int y, int) { pixels.at(x, y, 3) = depth.get(x, y, 0); });
    const brume_image transmittance = pixels.image(7, 3);
    const brume_layer of_transmittance = layer("transmittance", &transmittance);
    ASSERT_EQ(run(pixels.image(0, 3), pixels.image(3, 1), pixels.image(4, 3), &of_transmittance), BRUME_OK)
        << message(context.get());
    for_samples(3, [&](int x, int y, int c) {
        ASSERT_EQ(pixels.at(x, y, c), color.get(x, y, c)) << x << ", " << y;
        ASSERT_EQ(pixels.at(x, y, 4 + c), expected.get(x, y, c)) << x << ", " << y;
        ASSERT_GT(pixels.at(x, y, 7 + c), -1.0f) << x << ", " << y;
        ASSERT_EQ(pixels.at(x, y, 10), -7.0f) << x << ", " << y;
    });
    expect_status(context.get(), run(pixels.image(0, 3), pixels.image(3, 1), pixels.image(2, 3)), BRUME_ERROR_ARGUMENT,
                  "output: overlaps color");
    // A row further the sample behind a pixel's last is the next row's first.
    brume_image color_image = pixels.image(0, 3), output = pixels.image(9, 3);
    expect_status(context.get(), run(color_image, pixels.image(3, 1), output), BRUME_ERROR_ARGUMENT,
                  "output: overlaps color");
}

TEST_P(Channels, InPlanes)
{
    for (uint32_t channels : {2u, 3u, 4u})
        for (bool backwards : {false, true}) {
            const Picture expected = packed(channels);
            Planes from(channels, backwards), to(channels);
            for_samples(channels, [&](int x, int y, int c) { from.at(x, y, c) = color.get(x, y, c); });
            ASSERT_EQ(run(from.image(), depth.image(), to.image()), BRUME_OK) << message(context.get());
            for_samples(channels,
                        [&](int x, int y, int c) { ASSERT_EQ(to.at(x, y, c), expected.get(x, y, c)) << channels; });
            const brume_image in_place = from.image();
            ASSERT_EQ(run(in_place, depth.image(), in_place), BRUME_OK) << message(context.get());
            EXPECT_EQ(std::memcmp(from.memory.data() + from.plane(0), to.memory.data(), 4 * width * height), 0);
        }
}

TEST_P(Channels, InPlanesAreCopiedWhereNothingIsToDo)
{
    plan = make_plan(context, make_scene(context, R"({"brume": 1})"), ray_format(width, height));
    Planes from(3), to(3, true);
    for_samples(3, [&](int x, int y, int c) { from.at(x, y, c) = color.get(x, y, c); });
    ASSERT_EQ(run(from.image(), depth.image(), to.image()), BRUME_OK) << message(context.get());
    for_samples(3, [&](int x, int y, int c) { ASSERT_EQ(to.at(x, y, c), color.get(x, y, c)); });
    brume_image shared = from.image();
    shared.data = from.memory.data() + width * height;
    shared.channels = from.image().channels;
    expect_status(context.get(), run(from.image(), depth.image(), shared), BRUME_ERROR_ARGUMENT, "output: overlaps color");
}

TEST_P(Channels, PlanesDoNotOverlap)
{
    Planes planes(3);
    brume_image image = planes.image();
    image.plane_stride = 4 * width * height - 4;
    expect_status(context.get(), run(image, depth.image(), image), BRUME_ERROR_ARGUMENT, "color.plane_stride: ");
    image.plane_stride = INT64_MIN;
    expect_status(context.get(), run(image, depth.image(), image), BRUME_ERROR_ARGUMENT,
                  "color.plane_stride: -9223372036854775808; expected");
    // Rows of planes beside each other.
    image.plane_stride = 4 * width;
    image.row_stride = 3 * 4 * width;
    EXPECT_EQ(run(image, depth.image(), image), BRUME_OK) << message(context.get());
}

INSTANTIATE_EACH_BACKEND(Channels);
