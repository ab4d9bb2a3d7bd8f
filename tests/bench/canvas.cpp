#include "canvas.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <png.h>

Canvas::Canvas(int width, int height, int zoom)
    : width_(zoom * width), height_(zoom * height), zoom_(zoom), rgb_(size_t(width_) * size_t(height_) * 3, 255)
{
}

void Canvas::set(int x, int y, const double (&linear)[3])
{
    for (int c = 0; c < 3; ++c) {
        const double v = std::clamp(linear[c], 0.0, 1.0),
                     encoded = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
        for (int i = 0; i < zoom_ * zoom_; ++i)
            rgb_[(size_t(zoom_ * y + i / zoom_) * size_t(width_) + size_t(zoom_ * x + i % zoom_)) * 3 + size_t(c)] =
                uint8_t(std::lround(255 * encoded));
    }
}

void Canvas::write(const std::string &file) const
{
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = png_uint_32(width_);
    image.height = png_uint_32(height_);
    image.format = PNG_FORMAT_RGB;
    if (!png_image_write_to_file(&image, file.c_str(), 0, rgb_.data(), 0, nullptr))
        throw std::runtime_error(file + ": " + image.message);
}
