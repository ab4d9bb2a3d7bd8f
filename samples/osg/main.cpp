// osg_fog OUTPUT.png [FRAMES]: the last of some frames, fogged.
#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include <osgDB/WriteFile>

#include "fogged_viewer.h"

namespace {

osg::ref_ptr<osg::Image> picture(Hall &hall)
{
    osg::GraphicsContext *context = hall.viewer.getCamera()->getGraphicsContext();
    context->makeCurrent();
    context->getState()->applyTextureAttribute(0, hall.color);
    osg::ref_ptr<osg::Image> linear = new osg::Image, display = new osg::Image;
    linear->readImageFromCurrentTexture(context->getState()->getContextID(), false, GL_FLOAT);
    display->allocateImage(linear->s(), linear->t(), 1, GL_RGB, GL_UNSIGNED_BYTE);
    for (int y = 0; y < linear->t(); ++y)
        for (int x = 0; x < linear->s(); ++x) {
            osg::Vec4 value = linear->getColor(x, y);
            for (int c = 0; c < 3; ++c)
                value[c] = std::pow(4 * value[c] / (1 + 4 * value[c]), 1 / 2.2f);
            display->setColor(value, x, y);
        }
    return display;
}

}  // namespace

int main(int argc, char **argv)
{
    if (argc < 2) {
        std::fprintf(stderr, "usage: osg_fog OUTPUT.png [FRAMES]\n");
        return 2;
    }
    try {
        Hall hall(480, 270);
        osg::ref_ptr<Fog> fog = new Fog(hall.color, hall.depth, hall.lamp);
        hall.viewer.getCamera()->setFinalDrawCallback(fog);
        for (int frame = 0, frames = argc > 2 ? std::max(std::atoi(argv[2]), 1) : 8; frame < frames; ++frame)
            hall.draw(0.2 * frame);
        const bool written = osgDB::writeImageFile(*picture(hall), argv[1]);
        fog->release();
        return written ? 0 : 1;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "osg_fog: %s\n", error.what());
        return 1;
    }
}
