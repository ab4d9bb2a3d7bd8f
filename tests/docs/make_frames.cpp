// make_frames DIRECTORY: shot.0001.exr to shot.0003.exr, what the commands in docs work on: a lamp before a wall under a
// sky, with depth and a camera.
#include <string>
#include <vector>

#include <ImathMatrix.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfMatrixAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>

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

}  // namespace

int main(int argc, char **argv)
{
    if (argc != 2)
        return 2;
    for (int frame = 1; frame <= 3; ++frame)
        write(std::string(argv[1]) + "/shot.000" + std::to_string(frame) + ".exr", float(30 + 10 * frame));
}
