#pragma once
#include <cstdint>
#include <string>
#include <vector>

// A picture of docs/ in the making: linear values, each a square of zoom x zoom pixels of a PNG in sRGB. White to begin
// with.
class Canvas {
public:
    Canvas(int width, int height, int zoom);

    void set(int x, int y, const double (&linear)[3]);

    // Throws std::runtime_error with the file's name.
    void write(const std::string &file) const;

private:
    int width_, height_, zoom_;
    std::vector<uint8_t> rgb_;
};
