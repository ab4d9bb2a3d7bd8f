/* An engine on OGRE whose frames Brume fogs where they lie: in the engine's textures and OpenGL context.
 *
 *   ogre_fog BEFORE.png AFTER.png [FRAMES]
 *
 * engine.cpp is the engine; what one takes from here is fog.cpp.
 */
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "engine.h"

namespace {

// Tone mapped by x / (1 + x).
void write_picture(const Ogre::TexturePtr &color, const char *path)
{
    Ogre::Image linear(Ogre::PF_FLOAT32_RGBA, color->getWidth(), color->getHeight()),
        display(Ogre::PF_BYTE_RGB, color->getWidth(), color->getHeight());
    color->getBuffer()->blitToMemory(linear.getPixelBox());
    for (uint32_t y = 0; y < linear.getHeight(); ++y)
        for (uint32_t x = 0; x < linear.getWidth(); ++x) {
            Ogre::ColourValue value = linear.getColourAt(x, y, 0);
            for (int c = 0; c < 3; ++c)
                value[c] = std::pow(4 * value[c] / (1 + 4 * value[c]), 1 / 2.2f);
            display.setColourAt(value, x, y, 0);
        }
    display.save(path);
}

void run(const char *before, const char *after, int frames)
{
    Engine engine(480, 270);
    engine.move(0);
    Fog fog(engine.color(), engine.depth(), engine.camera(), engine.lamps());
    Ogre::Timer timer;
    for (int frame = 0; frame < frames; ++frame) {
        engine.move(5 * float(frame) / float(frames));
        if (frame == frames - 1) {
            engine.draw();
            write_picture(engine.color(), before);
        }
        timer.reset();
        engine.target().addListener(&fog);
        engine.draw();
        engine.target().removeListener(&fog);
        const double fogged = fog.milliseconds();
        std::printf("frame %d: %.1f ms, of which fog %.1f ms\n", frame, double(timer.getMicroseconds()) / 1000, fogged);
    }
    write_picture(engine.color(), after);
}

}  // namespace

int main(int argc, char **argv)
{
    if (argc < 3 || argc > 4) {
        std::fprintf(stderr, "usage: ogre_fog BEFORE.png AFTER.png [FRAMES]\n");
        return 2;
    }
    try {
        run(argv[1], argv[2], argc > 3 ? std::max(std::atoi(argv[3]), 1) : 8);
    } catch (const std::exception &error) {
        std::fprintf(stderr, "ogre_fog: %s\n", error.what());
        return 1;
    }
    return 0;
}
