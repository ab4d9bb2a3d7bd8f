#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <png.h>

#include "files.hpp"

namespace brume::tests {

/// By libpng, so that what the tool reads and writes is judged by another program.
template <class T>
void write_png(const fs::path &path, int channels, const std::vector<T> &pixels, int width = kWidth, int height = kHeight,
               int color_type = -1)
{
    std::FILE *file = std::fopen(path.c_str(), "wb");
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    constexpr int types[] = {0, PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                             PNG_COLOR_TYPE_RGB_ALPHA};
    png_set_IHDR(png, info, png_uint_32(width), png_uint_32(height), 8 * sizeof(T),
                 color_type < 0 ? types[channels] : color_type, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    std::vector<png_color> palette(256);
    for (int i = 0; i < 256; ++i)
        palette[std::size_t(i)] = {png_byte(i), png_byte(255 - i), png_byte(i / 2)};
    if (color_type == PNG_COLOR_TYPE_PALETTE)
        png_set_PLTE(png, info, palette.data(), 256);
    png_write_info(png, info);
    if (sizeof(T) == 2)
        png_set_swap(png);
    for (int y = 0; y < height; ++y)
        png_write_row(png, reinterpret_cast<png_const_bytep>(pixels.data() + std::size_t(y * width * channels)));
    png_write_end(png, nullptr);
    png_destroy_write_struct(&png, &info);
    std::fclose(file);
}

template <class T> std::vector<T> read_png(const fs::path &path, int &channels)
{
    std::FILE *file = std::fopen(path.c_str(), "rb");
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_read_info(png, info);
    EXPECT_EQ(png_get_bit_depth(png, info), 8 * sizeof(T));
    channels = png_get_channels(png, info);
    if (sizeof(T) == 2)
        png_set_swap(png);
    const auto height = png_get_image_height(png, info), width = png_get_image_width(png, info);
    std::vector<T> pixels(std::size_t(width) * height * std::size_t(channels));
    for (png_uint_32 y = 0; y < height; ++y)
        png_read_row(png, reinterpret_cast<png_bytep>(pixels.data() + std::size_t(y) * width * std::size_t(channels)),
                     nullptr);
    png_destroy_read_struct(&png, &info, nullptr);
    std::fclose(file);
    return pixels;
}

inline void write_npy(const fs::path &path, const std::string &header, const std::string &data)
{
    std::string text = header;
    text.append(117 - header.size(), ' ');
    text += '\n';
    write_text(path, std::string("\x93NUMPY\x01\x00\x76\x00", 10) + text + data);
}

template <class T> std::string bytes(const std::vector<T> &numbers, bool swapped = false)
{
    std::string out;
    for (const T &n : numbers) {
        char b[sizeof(T)];
        std::memcpy(b, &n, sizeof(T));
        if (swapped)
            std::reverse(b, b + sizeof(T));
        out.append(b, sizeof(T));
    }
    return out;
}

}  // namespace brume::tests
