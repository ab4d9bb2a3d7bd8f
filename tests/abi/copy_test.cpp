// Plans that do nothing return the input bit for bit.
#include "client.h"

using namespace client;

namespace {

const char *const nothing[] = {
    R"({"brume": 1})",
    R"({"brume": 1, "medium": {}})",
    R"({"brume": 1, "medium": {"g": 0.9}, "effects": {"multiscatter": {}}})",
    R"({"brume": 1, "camera": {"vertical_fov": 50},
        "medium": {"scattering": 1, "density": [{"type": "constant", "value": 0}]}})",
    R"({"brume": 1, "effects": {"multiscatter": {}}})",
};

// Every class of bits, signalling NaNs with payloads included.
uint32_t odd_bits(uint32_t pixel, int index)
{
    static const uint32_t halves[] = {0x0000, 0x8000, 0x0001, 0x83ff, 0x3c00, 0x7bff, 0xfbff, 0x7c00,
                                      0xfc00, 0x7c01, 0x7d55, 0x7e00, 0xffff, 0xfe2a, 0x1234, 0xabcd};
    static const uint32_t floats[] = {0x00000000, 0x80000000, 0x00000001, 0x807fffff, 0x3f800000, 0x7f7fffff,
                                      0xff7fffff, 0x7f800000, 0xff800000, 0x7f800001, 0x7fa12345, 0x7fc00000,
                                      0xffffffff, 0xffc54321, 0x12345678, 0xdeadbeef};
    return (pixel == BRUME_PIXEL_F16 ? halves : floats)[index % 16];
}

void fill(Picture &picture, uint32_t pixel)
{
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x)
            for (int c = 0; c < picture.channels(); ++c)
                picture.set_bits(x, y, c, odd_bits(pixel, (y * picture.width() + x) * 5 + c));
}

class Copies : public EachBackend {};
INSTANTIATE_EACH_BACKEND(Copies);

}  // namespace

TEST_P(Copies, BitForBit)
{
    const Layout layouts[] = {
        {},
        {.channels = 1},
        {.channels = 2},
        {.channels = 3},
        {.pixel_padding = 4, .row_padding = 12},
        {.row_padding = 20, .negative_rows = true},
        {.channels = 3, .pixel_padding = 2, .row_padding = 6, .offset = 1},
        {.bottom_up = true},
    };
    for (const char *text : nothing) {
        Scene scene = make_scene(context, text);
        Plan plan = make_plan(context, scene, ray_format(37, 11));
        brume_plan_info info = BRUME_PLAN_INFO_INIT;
        ASSERT_EQ(brume_plan_get_info(plan.get(), &info), BRUME_OK);
        EXPECT_EQ(info.does_nothing, 1u) << text;
        EXPECT_EQ(info.camera_needs, 0u);
        EXPECT_EQ(info.image_bytes, 0u);
        EXPECT_GE(info.entry_count, 1u) << "a reason";
        for (uint32_t pixel : {BRUME_PIXEL_F32, BRUME_PIXEL_F16})
            for (Layout layout : layouts) {
                layout.pixel = pixel;
                SCOPED_TRACE(std::string(text) + " pixel " + std::to_string(pixel) + " channels " +
                             std::to_string(layout.channels) + " row padding " + std::to_string(layout.row_padding));
                Picture color(37, 11, layout), depth(37, 11, {.channels = 1});
                Picture packed(37, 11, {.channels = layout.channels, .pixel = pixel, .bottom_up = layout.bottom_up});
                Picture padded(37, 11, layout);
                fill(color, pixel);
                const Picture before = color;
                ASSERT_EQ(execute(plan.get(), color, depth, packed), BRUME_OK) << message(context.get());
                expect_same_bits(color, packed);
                ASSERT_EQ(execute(plan.get(), color, depth, padded), BRUME_OK) << message(context.get());
                expect_same_bits(color, padded);
                EXPECT_TRUE(padded.guards_untouched());
                ASSERT_EQ(execute(plan.get(), color, depth, color), BRUME_OK) << message(context.get());
                EXPECT_EQ(color.memory(), before.memory());
            }
    }
}

TEST_P(Copies, NeedNoDepth)
{
    Scene scene = make_scene(context, nothing[0]);
    Plan plan = make_plan(context, scene, ray_format(4, 4));
    Picture color(4, 4), output(4, 4);
    paint(color);
    const brume_image color_image = color.image(), output_image = output.image();
    brume_frame frame = BRUME_FRAME_INIT;
    frame.color = &color_image;
    frame.output = &output_image;
    ASSERT_EQ(brume_plan_execute(plan.get(), &frame), BRUME_OK) << message(context.get());
    expect_same_bits(color, output);
}

TEST_P(Copies, ConvertBetweenTypes)
{
    Scene scene = make_scene(context, nothing[0]);
    Plan plan = make_plan(context, scene, ray_format(8, 8));
    Picture color(8, 8), half(8, 8, {.pixel = BRUME_PIXEL_F16}), back(8, 8), depth(8, 8, {.channels = 1});
    paint(color);
    ASSERT_EQ(execute(plan.get(), color, depth, half), BRUME_OK) << message(context.get());
    ASSERT_EQ(execute(plan.get(), half, depth, back), BRUME_OK) << message(context.get());
    expect_same_bits(color, back);
}

TEST_P(Copies, ToHalfKeepFiniteValuesFinite)
{
    Scene scene = make_scene(context, nothing[0]);
    Plan plan = make_plan(context, scene, ray_format(8, 8));
    Picture color(8, 8), half(8, 8, {.pixel = BRUME_PIXEL_F16}), depth(8, 8, {.channels = 1});
    color.set(0, 0, 0, 1e9f);
    color.set(1, 0, 1, -70000.0f);
    color.set(2, 0, 2, INFINITY);
    color.set(3, 0, 0, NAN);
    ASSERT_EQ(execute(plan.get(), color, depth, half), BRUME_OK) << message(context.get());
    EXPECT_EQ(half.get(0, 0, 0), 65504.0f);
    EXPECT_EQ(half.get(1, 0, 1), -65504.0f);
    EXPECT_EQ(half.get(2, 0, 2), INFINITY);
    EXPECT_TRUE(std::isnan(half.get(3, 0, 0)));
}

// The outputs that were asked for are filled although the picture needs nothing; where no effect can, planning fails.
TEST_P(Copies, OutputLayersOfNothing)
{
    const std::vector<brume_layer> outputs{layer("transmittance"), layer("scattered")};
    for (const char *text : nothing) {
        SCOPED_TRACE(text);
        Scene scene = make_scene(context, text);
        if (!std::strstr(text, "medium")) {
            const brume_format format = ray_format(5, 4, outputs);
            brume_plan none = nullptr;
            expect_status(context.get(), brume_plan_create(scene.get(), &format, &none), BRUME_ERROR_UNSUPPORTED,
                          "no medium");
            continue;
        }
        Plan plan = make_plan(context, scene, ray_format(5, 4, outputs));
        Picture color(5, 4), depth(5, 4, {.channels = 1}), output(5, 4), transmittance(5, 4), scattered(5, 4);
        paint(color);
        paint_depth(depth);
        const brume_image transmittance_image = transmittance.image(), scattered_image = scattered.image();
        ASSERT_EQ(execute(plan.get(), color, depth, output,
                          {layer("transmittance", &transmittance_image), layer("scattered", &scattered_image)}),
                  BRUME_OK)
            << message(context.get());
        expect_same_bits(color, output);
        for (int c = 0; c < 3; ++c) {
            EXPECT_EQ(transmittance.get(2, 2, c), 1.0f);
            EXPECT_EQ(scattered.get(2, 2, c), 0.0f);
        }
    }
}
