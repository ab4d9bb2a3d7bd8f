// Host memory in and out: every pixel type, channel count and stride, bit for bit.
#include <bit>
#include <cmath>
#include <cstring>
#include <random>

#include <gtest/gtest.h>

#include "base/half.h"
#include "support.h"

namespace brume::test {
namespace {

struct Layout {
    const char *name;
    int64_t gap_pixel, gap_row;  // bytes between pixels and between rows
    bool flipped, mirrored;
};

constexpr Layout layouts[] = {
    {"packed", 0, 0, false, false},
    {"whole pixels between rows", 0, 48, false, false},
    {"bytes between rows", 0, 5, false, false},
    {"samples between pixels", 8, 0, false, false},
    {"odd bytes between pixels", 3, 7, false, false},
    {"bottom row first", 0, 0, true, false},
    {"right to left", 4, 12, true, true},
};

// A caller's image in memory of its own, strides and signs included.
struct Memory {
    Memory(int32_t width, int32_t height, uint32_t channels, uint32_t pixel, const Layout &layout)
        : image(host_image(nullptr, width, height, channels, pixel))
    {
        sample = pixel == BRUME_PIXEL_F16 ? 2 : 4;
        const int64_t pixel_stride = int64_t(sample) * channels + layout.gap_pixel;
        const int64_t row_stride = pixel_stride * width + layout.gap_row;
        bytes.assign(size_t(row_stride * height), 0xab);
        image.pixel_stride = layout.mirrored ? -pixel_stride : pixel_stride;
        image.row_stride = layout.flipped ? -row_stride : row_stride;
        image.data = bytes.data() + (layout.flipped ? row_stride * (height - 1) : 0) +
                     (layout.mirrored ? pixel_stride * (width - 1) : 0);
    }

    unsigned char *at(int x, int y, uint32_t c) const
    {
        return static_cast<unsigned char *>(image.data) + y * image.row_stride + x * image.pixel_stride + c * sample;
    }
    uint32_t get(int x, int y, uint32_t c) const
    {
        uint32_t bits = 0;
        std::memcpy(&bits, at(x, y, c), sample);
        return bits;
    }
    void fill(uint32_t seed)
    {
        std::mt19937 random(seed);
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                for (uint32_t c = 0; c < image.channels; ++c) {
                    const uint32_t bits = random();
                    std::memcpy(at(x, y, c), &bits, sample);
                }
    }

    brume_image image;
    size_t sample;
    std::vector<unsigned char> bytes;
};

constexpr int32_t width = 13, height = 5;

class Transfer : public testing::Test {
protected:
    std::unique_ptr<Backend> backend = owned_backend();

    void check_round_trip(uint32_t from_channels, uint32_t to_channels, int32_t through, uint32_t pixel,
                          const Layout &layout)
    {
        SCOPED_TRACE(testing::Message() << layout.name << ", " << from_channels << " channels to " << to_channels
                                        << " through " << through << ", pixel type " << pixel);
        Memory from(width, height, from_channels, pixel, layout), to(width, height, to_channels, pixel, layout);
        from.fill(from_channels * 7 + to_channels);
        const std::vector<unsigned char> untouched = to.bytes;
        backend->invoke([&] {
            auto image = backend->import(from.image, through);
            backend->finish_output(to.image, *image);
        });
        const uint32_t one = pixel == BRUME_PIXEL_F16 ? 0x3c00u : 0x3f800000u;
        const bool alpha_in = from_channels == 2 || from_channels == 4;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (uint32_t c = 0; c < to_channels; ++c) {
                    const bool alpha = (to_channels == 2 || to_channels == 4) && c + 1 == to_channels;
                    uint32_t expected;
                    if (alpha)
                        expected = alpha_in && through == 4 ? from.get(x, y, from_channels - 1) : one;
                    else
                        expected = from.get(x, y, from_channels >= 3 && through == 4 ? c : 0);
                    ASSERT_EQ(to.get(x, y, c), expected) << "pixel " << x << ", " << y << " channel " << c;
                    std::memset(to.at(x, y, c), 0xab, to.sample);
                }
        EXPECT_EQ(to.bytes, untouched) << "bytes between the samples were written";
    }
};

// Random bits hold NaNs with payloads, infinities and subnormals.
TEST_F(Transfer, KeepsEveryBitInEveryLayout)
{
    for (const Layout &layout : layouts)
        for (uint32_t pixel : {BRUME_PIXEL_F32, BRUME_PIXEL_F16})
            for (uint32_t from = 1; from <= 4; ++from)
                for (uint32_t to = 1; to <= 4; ++to)
                    for (int32_t through : {1, 4})
                        check_round_trip(from, to, through, pixel, layout);
}

TEST_F(Transfer, ImagesLargerThanOneBand)
{
    constexpr int32_t w = 1100, h = 700;
    std::vector<float> rgb = ramp(size_t(w) * h * 3), back(rgb.size());
    backend->invoke([&] { backend->copy(host_image(rgb.data(), w, h, 3), host_image(back.data(), w, h, 3)); });
    EXPECT_EQ(rgb, back);
}

// The shader's rounding, or the driver's where it was found to be right, against the CPU backend's.
TEST_F(Transfer, FloatsBecomeTheNearestHalves)
{
    std::vector<float> floats = {
        0.0f,     -0.0f,        65504.0f,     65519.996f,      65520.0f,        -65520.0f, 1e30f,
        INFINITY, -INFINITY,    0x1p-24f,     0x1p-25f,        0x1.000002p-25f, 0x3p-25f,  -0x3p-25f,
        0x1p-14f, 0x1.ffcp-15f, 0x1.ffep-15f, 1.0f + 0x1p-11f, 1.0f + 0x3p-11f, 1e-30f,    0x1p-140f};
    std::mt19937 random(1);
    std::uniform_real_distribution<float> exponent(-27.0f, 17.0f), sign(-1.0f, 1.0f);
    while (floats.size() < 4096)
        floats.push_back(std::exp2(exponent(random)) * sign(random));
    std::vector<uint16_t> halves(floats.size());
    backend->invoke(
        [&] { backend->copy(host_image(floats.data(), 64, 16, 4), host_image(halves.data(), 64, 16, 4, BRUME_PIXEL_F16)); });
    for (size_t i = 0; i < floats.size(); ++i)
        ASSERT_EQ(halves[i],
                  float_to_half(std::isfinite(floats[i]) ? std::clamp(floats[i], -65504.0f, 65504.0f) : floats[i]))
            << floats[i];

    // An effect's output of halves rounds the same way.
    std::vector<uint16_t> written(floats.size());
    const brume_image output = host_image(written.data(), 64, 16, 4, BRUME_PIXEL_F16);
    backend->invoke([&] {
        auto source = backend->import(host_image(floats.data(), 64, 16, 4), 4);
        auto target = backend->begin_output(output, 4, true);
        scale(*backend, *source, *target, 1.0f);
        backend->finish_output(output, *target);
    });
    EXPECT_EQ(written, halves);
}

TEST_F(Transfer, HalvesBecomeExactFloats)
{
    std::vector<uint16_t> halves(0x10000);
    std::vector<float> floats(halves.size());
    for (size_t i = 0; i < halves.size(); ++i)
        halves[i] = uint16_t(i);
    backend->invoke([&] {
        backend->copy(host_image(halves.data(), 128, 128, 4, BRUME_PIXEL_F16), host_image(floats.data(), 128, 128, 4));
    });
    for (size_t i = 0; i < halves.size(); ++i) {
        const float expected = half_to_float(halves[i]);
        if (std::isnan(expected))
            ASSERT_TRUE(std::isnan(floats[i])) << i;
        else
            ASSERT_EQ(std::bit_cast<uint32_t>(floats[i]), std::bit_cast<uint32_t>(expected)) << i;
    }
}

TEST_F(Transfer, RefusesTexturesAndTheUnreadable)
{
    float value = 0;
    backend->invoke([&] {
        auto texture = failure_of([&] { backend->check(texture_image(1, 4, 4), "color", false); });
        EXPECT_EQ(texture.status, BRUME_ERROR_UNSUPPORTED);
        EXPECT_NE(texture.message.find("BRUME_GL_OWNED"), std::string::npos) << texture.message;
        EXPECT_EQ(failure_of([&] { backend->check(host_image(nullptr, 4, 4, 4), "color", false); }).status,
                  BRUME_ERROR_ARGUMENT);
        const int32_t largest = backend->largest_size();
        auto large = failure_of([&] { backend->check(host_image(&value, largest + 1, 1, 4), "color", false); });
        EXPECT_EQ(large.status, BRUME_ERROR_UNSUPPORTED);
        EXPECT_NE(large.message.find(std::to_string(largest)), std::string::npos) << large.message;
    });
}

}  // namespace
}  // namespace brume::test
