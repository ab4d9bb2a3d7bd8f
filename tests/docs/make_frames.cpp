// make_frames DIRECTORY: shot.0001.exr to shot.0003.exr, what the commands in docs work on: a lamp before a wall under a
// sky, with depth and a camera; street.png and depth.png, a picture as data sets have it, depth in centimetres.
#include <cstdint>
#include <string>
#include <vector>

#include <ImathMatrix.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfMatrixAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <png.h>

namespace {

constexpr int width = 96, height = 54;

void write(const std::string &file, float lamp_x)
{
    std::vector<float> rgbz(4 * width * height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            float *p = rgbz.data() + 4 * (y * width + x);
            const float dx = float(x) - lamp_x, dy = float(y - height / 2);
            const bool sky = y < height / 4, lamp = dx * dx + dy * dy < 6;
            for (int c = 0; c < 3; ++c)
                p[c] = lamp ? 40.0f : sky ? 0.02f : 0.1f;
            p[3] = sky ? 1e10f : lamp ? 15.0f : 30.0f;
        }
    Imf::Header header(width, height);
    Imf::FrameBuffer buffer;
    const char *const names[] = {"R", "G", "B", "Z"};
    for (int c = 0; c < 4; ++c) {
        header.channels().insert(names[c], Imf::Channel(Imf::FLOAT));
        buffer.insert(names[c], Imf::Slice(Imf::FLOAT, reinterpret_cast<char *>(rgbz.data() + c), 4 * sizeof(float),
                                           4 * sizeof(float) * width));
    }
    std::vector<float> alpha(width * height, 1.0f);
    header.channels().insert("A", Imf::Channel(Imf::FLOAT));
    buffer.insert("A", Imf::Slice(Imf::FLOAT, reinterpret_cast<char *>(alpha.data()), sizeof(float), sizeof(float) * width));
    header.insert("worldToCamera", Imf::M44fAttribute(Imath::M44f()));
    Imf::OutputFile output(file.c_str(), header);
    output.setFrameBuffer(buffer);
    output.writePixels(height);
}

void write_png(const std::string &file, png_uint_32 format, const void *pixels)
{
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = width;
    image.height = height;
    image.format = format;
    png_image_write_to_file(&image, file.c_str(), 0, pixels, 0, nullptr);
}

void write_street(const std::string &folder)
{
    std::vector<std::uint8_t> rgb;
    std::vector<std::uint16_t> centimetres;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const int below = y - height / 2;
            const bool house = x / 12 % 2 == 0 && y > height / 5 && below < 6;
            const int metres = below > 5 ? 150 / below : house ? 12 + x / 2 : 0;
            for (const int c : {below > 5 ? 70
                                : house   ? 150
                                          : 140,
                                below > 5 ? 70
                                : house   ? 90
                                          : 170,
                                below > 5 ? 70
                                : house   ? 60
                                          : 200})
                rgb.push_back(std::uint8_t(c));
            centimetres.push_back(std::uint16_t(100 * metres));
        }
    write_png(folder + "/street.png", PNG_FORMAT_RGB, rgb.data());
    write_png(folder + "/depth.png", PNG_FORMAT_LINEAR_Y, centimetres.data());
}

}  // namespace

int main(int argc, char **argv)
{
    if (argc != 2)
        return 2;
    write_street(argv[1]);
    for (int frame = 1; frame <= 3; ++frame)
        write(std::string(argv[1]) + "/shot.000" + std::to_string(frame) + ".exr", float(30 + 10 * frame));
}
