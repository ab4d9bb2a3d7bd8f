#include "client.h"

#include <stdexcept>

namespace client {
namespace {

constexpr unsigned char guard = 0xa5;

void throw_failure(brume_context context, brume_status status)
{
    if (status != BRUME_OK)
        throw std::runtime_error(std::string(brume_status_name(status)) + ": " + message(context));
}

uint32_t hash(uint32_t x, uint32_t y)
{
    uint32_t h = x * 0x9e3779b1u ^ y * 0x85ebca77u;
    h = (h ^ h >> 15) * 0x2c1b3c6du;
    return h ^ h >> 13;
}

}  // namespace

const char *const foggy = R"({
  "brume": 1,
  "camera": { "vertical_fov": 50, "camera_to_world": [[1,0,0,0],[0,1,0,2],[0,0,1,0],[0,0,0,1]] },
  "medium": { "scattering": [0.03, 0.03, 0.034], "absorption": [0.002, 0.003, 0.004], "emission": 0.001, "g": 0.7,
              "density": [ {"type": "constant", "value": 0.5},
                           {"type": "exponential", "value": 1, "falloff": 0.2, "direction": [0, 1, 0]} ] }
})";

const char *const absorbing = R"({
  "brume": 1,
  "camera": { "vertical_fov": 50 },
  "medium": { "absorption": [0.01, 0.02, 0.04] }
})";

std::string message(brume_context context)
{
    std::string text(brume_message(context, nullptr, 0), '\0');
    brume_message(context, text.data(), text.size());
    text.pop_back();
    return text;
}

void expect_status(brume_context context, brume_status got, brume_status wanted, const std::string &part)
{
    EXPECT_STREQ(brume_status_name(got), brume_status_name(wanted)) << message(context);
    if (wanted != BRUME_OK) {
        EXPECT_NE(message(context).find(part), std::string::npos)
            << "no \"" << part << "\" in \"" << message(context) << '"';
    }
}

Context make_context(const brume_context_desc &desc)
{
    brume_context context = nullptr;
    throw_failure(nullptr, brume_context_create(&desc, &context));
    return Context(context);
}

Context make_context(uint32_t backend, uint32_t threads)
{
    brume_context_desc desc = BRUME_CONTEXT_DESC_INIT;
    desc.backend = backend;
    desc.threads = threads;
    return make_context(desc);
}

Scene make_scene(const Context &context, const std::string &text)
{
    brume_scene scene = nullptr;
    throw_failure(context.get(), brume_scene_create_from_text(context.get(), text.data(), text.size(), nullptr, &scene));
    return Scene(scene);
}

Plan make_plan(const Context &context, const Scene &scene, const brume_format &format)
{
    brume_plan plan = nullptr;
    throw_failure(context.get(), brume_plan_create(scene.get(), &format, &plan));
    return Plan(plan);
}

brume_layer layer(const char *name, const brume_image *image)
{
    brume_layer layer = BRUME_LAYER_INIT;
    layer.name = name;
    layer.image = image;
    return layer;
}

brume_format ray_format(int32_t width, int32_t height, const std::vector<brume_layer> &outputs,
                        const std::vector<brume_layer> &inputs)
{
    brume_format format = BRUME_FORMAT_INIT;
    format.width = width;
    format.height = height;
    format.depth_kind = BRUME_DEPTH_RAY;
    format.output_count = uint32_t(outputs.size());
    format.outputs = outputs.data();
    format.input_count = uint32_t(inputs.size());
    format.inputs = inputs.data();
    return format;
}

Picture::Picture(int width, int height, Layout layout)
    : width_(width), height_(height), layout_(layout), sample_size_(layout.pixel == BRUME_PIXEL_F16 ? 2 : 4),
      pixel_stride_(sample_size_ * int(layout.channels) + layout.pixel_padding),
      row_stride_(pixel_stride_ * width + layout.row_padding),
      memory_(size_t(layout.offset) + size_t(row_stride_) * size_t(height), guard)
{
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < channels(); ++c)
                set_bits(x, y, c, 0);
}

brume_image Picture::image() const
{
    brume_image image = BRUME_IMAGE_INIT;
    image.width = width_;
    image.height = height_;
    image.channels = layout_.channels;
    image.pixel = layout_.pixel;
    image.origin = layout_.bottom_up ? BRUME_ORIGIN_BOTTOM_LEFT : BRUME_ORIGIN_TOP_LEFT;
    auto *first = const_cast<unsigned char *>(memory_.data()) + layout_.offset;
    image.data = layout_.negative_rows ? first + row_stride_ * (height_ - 1) : first;
    image.pixel_stride = layout_.pixel_padding ? pixel_stride_ : 0;
    image.row_stride = layout_.negative_rows ? -row_stride_ : layout_.row_padding ? row_stride_ : 0;
    return image;
}

size_t Picture::position(int x, int y, int channel) const
{
    int row = layout_.bottom_up ? height_ - 1 - y : y;
    if (layout_.negative_rows)
        row = height_ - 1 - row;
    return size_t(layout_.offset) + size_t(row) * size_t(row_stride_) + size_t(x) * size_t(pixel_stride_) +
           size_t(channel) * size_t(sample_size_);
}

uint32_t Picture::bits(int x, int y, int channel) const
{
    uint32_t bits = 0;
    std::memcpy(&bits, memory_.data() + position(x, y, channel), size_t(sample_size_));
    return bits;
}

void Picture::set_bits(int x, int y, int channel, uint32_t bits)
{
    std::memcpy(memory_.data() + position(x, y, channel), &bits, size_t(sample_size_));
}

float Picture::get(int x, int y, int channel) const
{
    uint32_t b = bits(x, y, channel);
    return sample_size_ == 2 ? brume::half_to_float(uint16_t(b)) : std::bit_cast<float>(b);
}

void Picture::set(int x, int y, int channel, float value)
{
    set_bits(x, y, channel, sample_size_ == 2 ? brume::float_to_half(value) : std::bit_cast<uint32_t>(value));
}

bool Picture::guards_untouched() const
{
    std::vector<unsigned char> rest = memory_;
    for (int y = 0; y < height_; ++y)
        for (int x = 0; x < width_; ++x)
            std::memset(rest.data() + position(x, y, 0), guard, size_t(sample_size_) * layout_.channels);
    return rest == std::vector<unsigned char>(rest.size(), guard);
}

void paint(Picture &color)
{
    const bool alpha = color.channels() == 2 || color.channels() == 4;
    for (int y = 0; y < color.height(); ++y)
        for (int x = 0; x < color.width(); ++x)
            for (int c = 0; c < color.channels(); ++c) {
                const uint32_t h = hash(uint32_t(x * 4 + c), uint32_t(y));
                const bool lamp = hash(uint32_t(x), uint32_t(y)) % 61 == 0;
                const bool is_alpha = alpha && c == color.channels() - 1;
                color.set(x, y, c, is_alpha ? float(h % 257) / 256 : lamp ? 8.0f * float(h % 26) : float(h % 256) / 1024);
            }
}

void paint_depth(Picture &depth)
{
    for (int y = 0; y < depth.height(); ++y)
        for (int x = 0; x < depth.width(); ++x) {
            const bool sky = y < depth.height() / 5 && x > depth.width() / 2;
            depth.set(x, y, 0, sky ? INFINITY : 2.0f + 0.5f * float((x / 5 * 13 + y) % 156));
        }
}

brume_status execute(brume_plan plan, const Picture &color, const Picture &depth, Picture &output,
                     const std::vector<brume_layer> &outputs, const std::vector<brume_layer> &inputs)
{
    const brume_image color_image = color.image(), depth_image = depth.image(), output_image = output.image();
    brume_frame frame = BRUME_FRAME_INIT;
    frame.color = &color_image;
    frame.depth = &depth_image;
    frame.output = &output_image;
    frame.output_count = uint32_t(outputs.size());
    frame.outputs = outputs.data();
    frame.input_count = uint32_t(inputs.size());
    frame.inputs = inputs.data();
    return brume_plan_execute(plan, &frame);
}

void expect_same_bits(const Picture &a, const Picture &b)
{
    ASSERT_EQ(a.channels(), b.channels());
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x)
            for (int c = 0; c < a.channels(); ++c)
                ASSERT_EQ(a.bits(x, y, c), b.bits(x, y, c))
                    << "pixel " << x << ", " << y << " channel " << c << ": " << a.get(x, y, c) << " and " << b.get(x, y, c);
}

void EachBackend::SetUp()
{
    try {
        context = make_context(GetParam());
    } catch (const std::runtime_error &error) {
        if (GetParam() == BRUME_BACKEND_CPU)
            throw;
        GTEST_SKIP() << error.what();
    }
}

}  // namespace client
