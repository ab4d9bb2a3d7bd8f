#pragma once
#include <cmath>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <brume/brume.h>

#include "base/half.h"

namespace client {

struct Destroy {
    void operator()(brume_context context) const { brume_context_destroy(context); }
    void operator()(brume_scene scene) const { brume_scene_destroy(scene); }
    void operator()(brume_plan plan) const { brume_plan_destroy(plan); }
};
using Context = std::unique_ptr<brume_context_t, Destroy>;
using Scene = std::unique_ptr<brume_scene_t, Destroy>;
using Plan = std::unique_ptr<brume_plan_t, Destroy>;

std::string message(brume_context context);

// Fails the test unless `got` is `wanted` and the calling thread's message holds `part`.
void expect_status(brume_context context, brume_status got, brume_status wanted, const std::string &part);

// These throw std::runtime_error with the library's message where the call fails.
Context make_context(const brume_context_desc &desc);
Context make_context(uint32_t backend = BRUME_BACKEND_CPU, uint32_t threads = 2);
Scene make_scene(const Context &context, const std::string &text);
Plan make_plan(const Context &context, const Scene &scene, const brume_format &format);

// Scattering, absorbing, emitting and denser towards the ground, with a camera; the whole filter has work to do.
extern const char *const foggy;
// The same fog everywhere, which only absorbs.
extern const char *const absorbing;

// A layer of an image, or one for formats.
brume_layer layer(const char *name, const brume_image *image = nullptr);

// Ray distances, and these layers. It refers to them.
brume_format ray_format(int32_t width, int32_t height, const std::vector<brume_layer> &outputs = {},
                        const std::vector<brume_layer> &inputs = {});

// What a picture's memory looks like; the default is packed RGBA floats.
struct Layout {
    uint32_t channels = 4;
    uint32_t pixel = BRUME_PIXEL_F32;
    int pixel_padding = 0;  // [bytes]
    int row_padding = 0;
    bool negative_rows = false;  // descriptor's first row is last in memory
    bool bottom_up = false;      // origin BOTTOM_LEFT: row 0 of the descriptor is the picture's bottom
    int offset = 0;              // of the first byte, to break alignment
};

// Pixels in memory of a given layout, with guard bytes wherever no pixel is. Coordinates are from the top left.
class Picture {
public:
    Picture(int width, int height, Layout layout = {});

    brume_image image() const;
    float get(int x, int y, int channel) const;
    void set(int x, int y, int channel, float value);
    uint32_t bits(int x, int y, int channel) const;
    void set_bits(int x, int y, int channel, uint32_t bits);
    bool guards_untouched() const;
    const std::vector<unsigned char> &memory() const { return memory_; }

    int width() const { return width_; }
    int height() const { return height_; }
    int channels() const { return int(layout_.channels); }

private:
    size_t position(int x, int y, int channel) const;

    int width_, height_;
    Layout layout_;
    int sample_size_, pixel_stride_, row_stride_;
    std::vector<unsigned char> memory_;
};

// Lamps of up to 200 among a dark pattern; alpha from 0 to 1. The values are halves, so that both types hold them.
void paint(Picture &color);
// Ray distances from 2 to 80 m with jumps, and some sky.
void paint_depth(Picture &depth);

brume_status execute(brume_plan plan, const Picture &color, const Picture &depth, Picture &output,
                     const std::vector<brume_layer> &outputs = {}, const std::vector<brume_layer> &inputs = {});

// Bit for bit, or an expectation that names the first pixel that differs.
void expect_same_bits(const Picture &a, const Picture &b);

// Tests of everything that both backends do; GL is skipped where no context of it can be made.
class EachBackend : public testing::TestWithParam<uint32_t> {
protected:
    void SetUp() override;
    Context context;
};
#ifdef BRUME_GL
inline constexpr uint32_t backends[] = {BRUME_BACKEND_CPU, BRUME_BACKEND_GL};
#else
inline constexpr uint32_t backends[] = {BRUME_BACKEND_CPU};
#endif
#define INSTANTIATE_EACH_BACKEND(suite)                                                                                     \
    INSTANTIATE_TEST_SUITE_P(, suite, testing::ValuesIn(client::backends),                                                  \
                             [](auto &info) { return std::string(info.param == BRUME_BACKEND_GL ? "gl" : "cpu"); })

}  // namespace client
