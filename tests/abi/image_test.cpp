// Host memory: layouts, in place, threads, origins. Whatever the memory looks like, the bits are the same.
#include "client.h"

using namespace client;

namespace {

constexpr int width = 45, height = 31;

class Images : public EachBackend {
protected:
    void SetUp() override
    {
        EachBackend::SetUp();
        if (!context)
            return;
        scene = make_scene(context, foggy);
        plan = make_plan(context, scene, ray_format(width, height));
    }
    // The picture of a layout, painted; `same` values for any layout of as many channels.
    static Picture painted(Layout layout)
    {
        Picture picture(width, height, layout);
        paint(picture);
        return picture;
    }
    static Picture painted_depth(Layout layout = {})
    {
        layout.channels = 1;
        Picture picture(width, height, layout);
        paint_depth(picture);
        return picture;
    }
    Picture fogged(const Picture &color, const Picture &depth, Layout layout)
    {
        Picture output(width, height, layout);
        EXPECT_EQ(execute(plan.get(), color, depth, output), BRUME_OK) << message(context.get());
        EXPECT_TRUE(output.guards_untouched());
        return output;
    }

    Scene scene;
    Plan plan;
};
INSTANTIATE_EACH_BACKEND(Images);

std::string name_of(const Layout &layout)
{
    return "channels " + std::to_string(layout.channels) + " pixel " + std::to_string(layout.pixel) + " padding " +
           std::to_string(layout.pixel_padding) + ", " + std::to_string(layout.row_padding) +
           (layout.negative_rows ? " negative rows" : "") + " offset " + std::to_string(layout.offset);
}

const Layout memory_layouts[] = {
    {},
    {.row_padding = 16},
    {.row_padding = 7},
    {.negative_rows = true},
    {.pixel_padding = 8, .row_padding = 4, .negative_rows = true},
    {.pixel_padding = 3, .offset = 1},
};

}  // namespace

TEST_P(Images, AnyMemoryLayoutGivesTheSameBits)
{
    for (uint32_t channels = 1; channels <= 4; ++channels)
        for (uint32_t pixel : {BRUME_PIXEL_F32, BRUME_PIXEL_F16}) {
            const Layout packed{.channels = channels, .pixel = pixel};
            const Picture expected = fogged(painted(packed), painted_depth(), packed);
            EXPECT_NE(expected.memory(), painted(packed).memory());
            for (Layout layout : memory_layouts) {
                layout.channels = channels;
                layout.pixel = pixel;
                SCOPED_TRACE(name_of(layout));
                expect_same_bits(
                    expected,
                    fogged(painted(layout), painted_depth(layout.pixel == BRUME_PIXEL_F32 ? layout : Layout{}), layout));
                expect_same_bits(expected, fogged(painted(packed), painted_depth(), layout));
                expect_same_bits(expected, fogged(painted(layout), painted_depth(), packed));
            }
        }
}

TEST_P(Images, InPlaceGivesTheSameBits)
{
    for (uint32_t channels = 1; channels <= 4; ++channels)
        for (uint32_t pixel : {BRUME_PIXEL_F32, BRUME_PIXEL_F16})
            for (Layout layout : memory_layouts) {
                layout.channels = channels;
                layout.pixel = pixel;
                SCOPED_TRACE(name_of(layout));
                Picture color = painted(layout);
                const Picture expected = fogged(color, painted_depth(), layout);
                ASSERT_EQ(execute(plan.get(), color, painted_depth(), color), BRUME_OK) << message(context.get());
                expect_same_bits(expected, color);
                EXPECT_TRUE(color.guards_untouched());
            }
}

TEST_P(Images, ChannelsAreThoseOfRgba)
{
    const Picture rgba = painted({}), depth = painted_depth();
    const Picture expected = fogged(rgba, depth, {});
    Picture rgb(width, height, {.channels = 3}), grey_as_rgb(width, height, {.channels = 3}),
        grey(width, height, {.channels = 1}), grey_alpha(width, height, {.channels = 2});
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            for (int c = 0; c < 3; ++c) {
                rgb.set(x, y, c, rgba.get(x, y, c));
                grey_as_rgb.set(x, y, c, rgba.get(x, y, 0));
            }
            grey.set(x, y, 0, rgba.get(x, y, 0));
            grey_alpha.set(x, y, 0, rgba.get(x, y, 0));
            grey_alpha.set(x, y, 1, rgba.get(x, y, 3));
        }
    const Picture rgb_out = fogged(rgb, depth, {.channels = 3}), grey_rgb_out = fogged(grey_as_rgb, depth, {.channels = 3}),
                  grey_out = fogged(grey, depth, {.channels = 1}),
                  grey_alpha_out = fogged(grey_alpha, depth, {.channels = 2});
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            for (int c = 0; c < 3; ++c)
                ASSERT_EQ(rgb_out.bits(x, y, c), expected.bits(x, y, c)) << x << ", " << y;
            ASSERT_EQ(grey_out.bits(x, y, 0), grey_rgb_out.bits(x, y, 0)) << x << ", " << y;
            ASSERT_EQ(grey_alpha_out.bits(x, y, 0), grey_out.bits(x, y, 0)) << x << ", " << y;
            ASSERT_EQ(grey_alpha_out.bits(x, y, 1), grey_alpha.bits(x, y, 1)) << x << ", " << y;
        }
}

TEST_P(Images, MixedTypes)
{
    const Picture color = painted({}), depth = painted_depth();
    const Picture expected = fogged(color, depth, {});
    // The painted values are halves, so reading them from halves changes nothing, and writing halves only rounds.
    const Picture half_in = fogged(painted({.pixel = BRUME_PIXEL_F16}), painted_depth({.pixel = BRUME_PIXEL_F16}), {});
    expect_same_bits(expected, half_in);
    const Picture half_out = fogged(color, depth, {.pixel = BRUME_PIXEL_F16});
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 4; ++c)
                ASSERT_EQ(half_out.bits(x, y, c), brume::float_to_half(expected.get(x, y, c)))
                    << x << ", " << y << ", " << c;
}

// The same picture bottom up. Where the sides are powers of two the pyramid's texels lie the same either way; elsewhere
// only what needs no pyramid agrees.
TEST_P(Images, OriginsAgree)
{
    const Layout flipped{.bottom_up = true}, scalar{.channels = 1}, scalar_flipped{.channels = 1, .bottom_up = true};
    const auto largest_difference = [&](const char *text, int w, int h) {
        Scene fog = make_scene(context, text);
        Plan both_ways = make_plan(context, fog, ray_format(w, h));
        Picture color(w, h), color_flipped(w, h, flipped), depth(w, h, scalar), depth_flipped(w, h, scalar_flipped),
            output(w, h), output_flipped(w, h, flipped);
        paint(color), paint(color_flipped), paint_depth(depth), paint_depth(depth_flipped);
        EXPECT_EQ(execute(both_ways.get(), color, depth, output), BRUME_OK) << message(context.get());
        EXPECT_EQ(execute(both_ways.get(), color_flipped, depth_flipped, output_flipped), BRUME_OK)
            << message(context.get());
        float largest = 0;
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x)
                for (int c = 0; c < 4; ++c)
                    largest = std::max(largest, std::abs(output.get(x, y, c) - output_flipped.get(x, y, c)) /
                                                    (1 + std::abs(output.get(x, y, c))));
        return largest;
    };
    EXPECT_LE(largest_difference(absorbing, width, height), 1e-6f);
    // Hardware weighs the texels of a bilinear fetch with 8 bits.
    EXPECT_LE(largest_difference(foggy, 64, 32), GetParam() == BRUME_BACKEND_GL ? 5e-3f : 2e-5f);
}

TEST_P(Images, OverlapIsRefused)
{
    std::vector<float> memory(size_t(width) * height * 4 * 3, 0.5f);
    brume_image color = painted({}).image();
    color.data = memory.data();
    const Picture depth = painted_depth();
    const brume_image depth_image = depth.image();
    brume_image output = color;
    brume_frame frame = BRUME_FRAME_INIT;
    frame.color = &color;
    frame.depth = &depth_image;
    frame.output = &output;
    EXPECT_EQ(brume_plan_execute(plan.get(), &frame), BRUME_OK) << message(context.get());
    const auto refused = [&](const char *named) {
        expect_status(context.get(), brume_plan_execute(plan.get(), &frame), BRUME_ERROR_ARGUMENT, named);
    };
    output.data = memory.data() + 4;
    refused("output: overlaps");
    output.data = memory.data() + size_t(width) * (height - 1) * 4;
    refused("output: overlaps");
    output.data = memory.data() + size_t(width) * height * 4 - 1;
    refused("output: overlaps");
    output.data = memory.data();
    output.row_stride = (width + 1) * 16;
    refused("output: overlaps");
    output.row_stride = 0;
    output.data = memory.data() + size_t(width) * height * 4;
    EXPECT_EQ(brume_plan_execute(plan.get(), &frame), BRUME_OK) << message(context.get());
    // An image may not overlap itself; a transposed one does not.
    color.row_stride = output.row_stride = width * 16 - 4;
    refused("color.row_stride");
    color.row_stride = output.row_stride = 16;
    color.pixel_stride = output.pixel_stride = height * 16;
    EXPECT_EQ(brume_plan_execute(plan.get(), &frame), BRUME_OK) << message(context.get());
}

TEST_P(Images, ExtraOutputsShareNoMemory)
{
    Plan with_outputs = make_plan(context, scene, ray_format(width, height, {layer("transmittance"), layer("blur_radius")}));
    Picture color = painted({}), depth = painted_depth(), output(width, height), straight(width, height),
            radius(width, height, {.channels = 1});
    const auto with = [&](const Picture &transmittance, const Picture &blur_radius) {
        const brume_image a = transmittance.image(), b = blur_radius.image();
        return execute(with_outputs.get(), color, depth, output, {layer("transmittance", &a), layer("blur_radius", &b)});
    };
    EXPECT_EQ(with(straight, radius), BRUME_OK) << message(context.get());
    expect_status(context.get(), with(color, radius), BRUME_ERROR_ARGUMENT, "outputs[0]");
    expect_status(context.get(), with(output, radius), BRUME_ERROR_ARGUMENT, "outputs[0]");
    expect_status(context.get(), with(straight, depth), BRUME_ERROR_ARGUMENT, "outputs[1]");
    brume_image within = radius.image();
    within.data = straight.image().data;
    const brume_image whole = straight.image();
    expect_status(
        context.get(),
        execute(with_outputs.get(), color, depth, output, {layer("transmittance", &whole), layer("blur_radius", &within)}),
        BRUME_ERROR_ARGUMENT, "outputs[1]");
}

TEST_P(Images, OddSizes)
{
    const int sizes[][2] = {{1, 1}, {1, 9}, {9, 1}, {2, 2}, {3, 5}, {1, 300}, {300, 1}, {33, 17}};
    for (auto [w, h] : sizes) {
        Plan small = make_plan(context, scene, ray_format(w, h));
        Picture color(w, h), depth(w, h, {.channels = 1}), output(w, h), again(w, h);
        paint(color);
        paint_depth(depth);
        ASSERT_EQ(execute(small.get(), color, depth, output), BRUME_OK) << message(context.get());
        ASSERT_EQ(execute(small.get(), color, depth, again), BRUME_OK) << message(context.get());
        expect_same_bits(output, again);
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x)
                for (int c = 0; c < 4; ++c)
                    ASSERT_TRUE(std::isfinite(output.get(x, y, c))) << w << " x " << h << " at " << x << ", " << y;
    }
}

TEST(Threads, GiveTheSameBits)
{
    Picture color(301, 203), depth(301, 203, {.channels = 1});
    paint(color);
    paint_depth(depth);
    Picture first(301, 203);
    for (uint32_t threads : {1u, 2u, 7u}) {
        Context context = make_context(BRUME_BACKEND_CPU, threads);
        Scene scene = make_scene(context, foggy);
        Plan plan = make_plan(context, scene, ray_format(301, 203));
        Picture output(301, 203);
        ASSERT_EQ(execute(plan.get(), color, depth, output), BRUME_OK) << message(context.get());
        if (threads == 1)
            first = output;
        expect_same_bits(first, output);
    }
}
