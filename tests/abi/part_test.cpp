// Images that are parts of larger ones in memory, and depth of another size than colour. Textures:
// tests/gl/abi/part_test.cpp.
#include "client.h"

using namespace client;

namespace {

constexpr int width = 45, height = 31;

struct Place {
    int x, y, width, height;  // in a whole of that size
};
constexpr Place places[] = {{0, 0, 64, 40}, {64 - width, 40 - height, 64, 40}, {7, 3, 61, 53}};

// A picture in a larger one of one value.
class Framed {
public:
    Framed(const Picture &inside, const Place &place, Layout layout, float around)
        : place_(place), around_(around), whole_(place.width, place.height, layout)
    {
        for (int y = 0; y < place.height; ++y)
            for (int x = 0; x < place.width; ++x)
                for (int c = 0; c < whole_.channels(); ++c)
                    whole_.set(x, y, c, is_inside(x, y) ? inside.get(x - place.x, y - place.y, c) : around);
    }

    brume_image image() const
    {
        brume_image image = whole_.image();
        image.x = place_.x;
        image.y = image.origin == BRUME_ORIGIN_TOP_LEFT ? place_.y : place_.height - place_.y - height;
        image.whole_width = image.width;
        image.whole_height = image.height;
        image.width = width;
        image.height = height;
        return image;
    }

    Picture inside(Layout layout) const
    {
        Picture picture(width, height, layout);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (int c = 0; c < picture.channels(); ++c)
                    picture.set_bits(x, y, c, whole_.bits(x + place_.x, y + place_.y, c));
        return picture;
    }

    void expect_untouched_around() const
    {
        Picture same(1, 1, {.channels = 1, .pixel = whole_.image().pixel});
        same.set(0, 0, 0, around_);
        EXPECT_TRUE(whole_.guards_untouched());
        for (int y = 0; y < place_.height; ++y)
            for (int x = 0; x < place_.width; ++x)
                for (int c = 0; c < whole_.channels() && !is_inside(x, y); ++c)
                    ASSERT_EQ(whole_.bits(x, y, c), same.bits(0, 0, 0)) << "written at " << x << ", " << y;
    }

private:
    bool is_inside(int x, int y) const
    {
        return x >= place_.x && x < place_.x + width && y >= place_.y && y < place_.y + height;
    }

    Place place_;
    float around_;
    Picture whole_;
};

class Parts : public EachBackend {
protected:
    void SetUp() override
    {
        EachBackend::SetUp();
        if (!context)
            return;
        scene = make_scene(context, foggy);
        plan = make_plan(context, scene, ray_format(width, height, {layer("transmittance"), layer("blur_radius")}));
        paint(color);
        paint_depth(depth);
    }

    brume_status run(const brume_image &from, const brume_image &z, const brume_image &to,
                     const std::vector<brume_layer> &outputs = {})
    {
        brume_frame frame = BRUME_FRAME_INIT;
        frame.color = &from;
        frame.depth = &z;
        frame.output = &to;
        frame.outputs = outputs.data();
        frame.output_count = uint32_t(outputs.size());
        return brume_plan_execute(plan.get(), &frame);
    }
    void expect_refused(const brume_image &from, const brume_image &z, const brume_image &to, brume_status status,
                        const std::string &text)
    {
        expect_status(context.get(), run(from, z, to), status, text);
    }

    Scene scene;
    Plan plan;
    Picture color{width, height}, depth{width, height, {.channels = 1}};
};
INSTANTIATE_EACH_BACKEND(Parts);

}  // namespace

TEST_P(Parts, GiveTheSameBitsWhateverIsAroundThem)
{
    for (uint32_t pixel : {BRUME_PIXEL_F32, BRUME_PIXEL_F16})
        for (Layout layout : {Layout{}, Layout{.row_padding = 12}, Layout{.pixel_padding = 4, .negative_rows = true}}) {
            layout.pixel = pixel;
            Layout scalar = layout, rgb = layout;
            scalar.channels = 1;
            rgb.channels = 3;
            Picture expected(width, height, layout), transmittance(width, height, rgb), radius(width, height, scalar);
            const brume_image whole_layers[] = {transmittance.image(), radius.image()};
            ASSERT_EQ(execute(plan.get(), color, depth, expected,
                              {layer("transmittance", &whole_layers[0]), layer("blur_radius", &whole_layers[1])}),
                      BRUME_OK)
                << message(context.get());
            for (const Place &place : places)
                for (float around : {3e4f, -NAN}) {
                    const Framed from(color, place, layout, around), z(depth, place, scalar, around),
                        to(Picture(width, height, layout), place, layout, around),
                        straight(Picture(width, height, rgb), place, rgb, around),
                        blur(Picture(width, height, scalar), place, scalar, around);
                    const brume_image layers[] = {straight.image(), blur.image()};
                    ASSERT_EQ(run(from.image(), z.image(), to.image(),
                                  {layer("transmittance", &layers[0]), layer("blur_radius", &layers[1])}),
                              BRUME_OK)
                        << message(context.get());
                    expect_same_bits(to.inside(layout), expected);
                    expect_same_bits(straight.inside(rgb), transmittance);
                    expect_same_bits(blur.inside(scalar), radius);
                    for (const Framed *framed : {&from, &z, &to, &straight, &blur})
                        framed->expect_untouched_around();
                    ASSERT_EQ(run(from.image(), z.image(), from.image()), BRUME_OK) << message(context.get());
                    expect_same_bits(from.inside(layout), expected);
                    from.expect_untouched_around();
                }
        }
}

TEST_P(Parts, RowsAreCountedAsTheyAreStored)
{
    const Layout flipped{.bottom_up = true}, flipped_scalar{.channels = 1, .bottom_up = true};
    Picture color_flipped(width, height, flipped), depth_flipped(width, height, flipped_scalar),
        expected(width, height, flipped);
    paint(color_flipped);
    paint_depth(depth_flipped);
    ASSERT_EQ(execute(plan.get(), color_flipped, depth_flipped, expected), BRUME_OK) << message(context.get());
    for (const Place &place : places) {
        const Framed from(color_flipped, place, flipped, 3e4f), z(depth_flipped, place, flipped_scalar, 3e4f);
        ASSERT_EQ(run(from.image(), z.image(), from.image()), BRUME_OK) << message(context.get());
        expect_same_bits(from.inside(flipped), expected);
        from.expect_untouched_around();
    }
}

// A plan that does nothing has a way of its own to copy.
TEST_P(Parts, AreCopiedWhereThereIsNoFog)
{
    const Scene clear = make_scene(context, R"({"brume": 1})");
    plan = make_plan(context, clear, ray_format(width, height));
    const Place a{3, 5, 60, 40}, b{9, 2, 55, 64};
    for (uint32_t pixel : {BRUME_PIXEL_F32, BRUME_PIXEL_F16}) {
        const Layout layout{.pixel = pixel};
        const Framed from(color, a, {}, NAN), to(Picture(width, height, layout), b, layout, 7);
        ASSERT_EQ(run(from.image(), depth.image(), to.image()), BRUME_OK) << message(context.get());
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (int c = 0; c < 4; ++c)
                    ASSERT_EQ(to.inside(layout).get(x, y, c), color.get(x, y, c));
        to.expect_untouched_around();
    }
}

// Two halves of one image: what an atlas is.
TEST_P(Parts, OfOneImageMayLieSideBySide)
{
    Picture expected(width, height), atlas(2 * width, height);
    ASSERT_EQ(execute(plan.get(), color, depth, expected), BRUME_OK) << message(context.get());
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 4; ++c)
                atlas.set(x, y, c, color.get(x, y, c));
    brume_image left = atlas.image();
    left.whole_width = left.width;
    left.whole_height = left.height;
    left.width = width;
    brume_image right = left;
    right.x = width;
    ASSERT_EQ(run(left, depth.image(), right), BRUME_OK) << message(context.get());
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 4; ++c) {
                ASSERT_EQ(atlas.bits(x, y, c), color.bits(x, y, c));
                ASSERT_EQ(atlas.bits(x + width, y, c), expected.bits(x, y, c));
            }
    right.x = width - 1;
    expect_refused(
        left, depth.image(), right, BRUME_ERROR_ARGUMENT,
        "output: overlaps color; expected the very same image or none of its memory (output is 45 x 31 at (44, 0) of "
        "90 x 31, color 45 x 31 at (0, 0) of 90 x 31)");
}

TEST_P(Parts, WhatLiesOutsideIsRefused)
{
    const Picture output(width, height);
    const Framed framed(color, places[0], {}, 0);
    const auto refused = [&](auto change, brume_status status, const std::string &text) {
        brume_image image = framed.image();
        change(image);
        expect_refused(image, depth.image(), output.image(), status, text);
    };
    const std::string within = "; expected a part that lies within";
    refused([](brume_image &i) { i.x = 20; }, BRUME_ERROR_ARGUMENT,
            "color: 45 x 31 at (20, 0) of whole_width x whole_height 64 x 40" + within);
    refused([](brume_image &i) { i.y = -1; }, BRUME_ERROR_ARGUMENT,
            "color: 45 x 31 at (0, -1) of whole_width x whole_height 64 x 40" + within);
    refused([](brume_image &i) { i.x = INT32_MAX; }, BRUME_ERROR_ARGUMENT, within);
    refused([](brume_image &i) { i.width = INT32_MIN; }, BRUME_ERROR_ARGUMENT, within);
    refused([](brume_image &i) { i.whole_height = 0; }, BRUME_ERROR_ARGUMENT, within);
    refused([](brume_image &i) { i.whole_width = 65537; }, BRUME_ERROR_ARGUMENT, within + ", of at most 65536 a side");
    refused([](brume_image &i) { i.x = 1, i.whole_width = i.whole_height = 0; }, BRUME_ERROR_ARGUMENT,
            "color: 45 x 31 at (1, 0) of whole_width x whole_height 0 x 0; expected the size of what it is a part of");
    refused([](brume_image &i) { i.x = 1, i.width = 44; }, BRUME_ERROR_FORMAT,
            "color: 44 x 31 at (1, 0) of 64 x 40; the plan was made for 45 x 31");
    refused([](brume_image &i) { i.row_stride = 63 * 16; }, BRUME_ERROR_ARGUMENT, "color.row_stride: ");
    refused([](brume_image &i) { i.kind = BRUME_IMAGE_GL_TEXTURE, i.gl_texture = 1; }, BRUME_ERROR_UNSUPPORTED,
            "(the image is 45 x 31 at (0, 0) of 64 x 40)");
}

// As if depth had been given at colour's size, each pixel that in which its centre lies.
TEST_P(Parts, DepthOfAnotherSizeIsNearest)
{
    // Half of it, rounded down and up; thrice; other factors, with centres between pixels and at their borders; the limits.
    const int sizes[][2] = {{22, 15}, {23, 16}, {135, 93}, {30, 21}, {90, 62}, {64, 44}, {3, 2}, {720, 496}};
    for (uint32_t pixel : {BRUME_PIXEL_F32, BRUME_PIXEL_F16})
        for (auto [w, h] : sizes) {
            SCOPED_TRACE(std::to_string(w) + " x " + std::to_string(h));
            Picture other(w, h, {.channels = 1, .pixel = pixel, .row_padding = 8}), same(width, height, {.channels = 1}),
                expected(width, height), output(width, height);
            paint_depth(other);
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x)
                    same.set(x, y, 0,
                             other.get(int(std::floor((x + 0.5) * w / width)), int(std::floor((y + 0.5) * h / height)), 0));
            ASSERT_EQ(execute(plan.get(), color, same, expected), BRUME_OK) << message(context.get());
            ASSERT_EQ(execute(plan.get(), color, other, output), BRUME_OK) << message(context.get());
            expect_same_bits(output, expected);
        }
}

TEST_P(Parts, DepthOfAnotherSizeMayBeAPart)
{
    Picture small(width, height, {.channels = 1});
    paint_depth(small);
    const Framed framed(small, places[2], {.channels = 1}, 1e-3f);
    const Scene fog = make_scene(context, foggy);
    plan = make_plan(context, fog, ray_format(2 * width, 2 * height));
    Picture large(2 * width, 2 * height), expected(2 * width, 2 * height), output(2 * width, 2 * height);
    paint(large);
    ASSERT_EQ(execute(plan.get(), large, small, expected), BRUME_OK) << message(context.get());
    ASSERT_EQ(run(large.image(), framed.image(), output.image()), BRUME_OK) << message(context.get());
    expect_same_bits(output, expected);
    EXPECT_NE(output.memory(), large.memory());
}

TEST_P(Parts, DepthOfAnotherPictureIsRefused)
{
    const Picture output(width, height);
    const auto refused = [&](int w, int h, const std::string &text) {
        const Picture other(w, h, {.channels = 1});
        expect_refused(color.image(), other.image(), output.image(), BRUME_ERROR_FORMAT, text);
    };
    const std::string expected =
        "; the plan was made for 45 x 31; expected that size, or both sides larger or smaller by one factor, at most 16";
    for (auto [w, h] :
         {std::pair{31, 45}, {45, 62}, {22, 31}, {22, 17}, {135, 96}, {44, 31}, {46, 32}, {1, 1}, {2, 1}, {721, 497}})
        refused(w, h, "depth: " + std::to_string(w) + " x " + std::to_string(h) + expected);
    brume_image none = depth.image();
    none.height = 0;
    expect_refused(color.image(), none, output.image(), BRUME_ERROR_FORMAT, "depth: 45 x 0; expected sides from 1 to ");
    none.height = INT32_MAX;
    expect_refused(color.image(), none, output.image(), BRUME_ERROR_FORMAT, "depth: 45 x 2147483647; expected sides from");
    // Colour, output and layers are of the plan's size.
    const Picture half(23, 16);
    expect_refused(half.image(), depth.image(), output.image(), BRUME_ERROR_FORMAT, "color: 23 x 16; the plan was made for");
    expect_refused(color.image(), depth.image(), half.image(), BRUME_ERROR_FORMAT, "output: 23 x 16; the plan was made for");
}
