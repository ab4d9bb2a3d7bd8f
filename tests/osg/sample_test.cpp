// samples/osg: frames are fogged, and OpenSceneGraph does not notice.
#include <epoxy/gl.h>

#include <gtest/gtest.h>

#include "fogged_viewer.h"
#include "host_state.h"

namespace {

constexpr int width = 120, height = 80;

std::vector<float> pixels(Hall &hall)
{
    osg::GraphicsContext *context = hall.viewer.getCamera()->getGraphicsContext();
    context->makeCurrent();
    std::vector<float> all(size_t(width * height * 4));
    glGetTextureImage(hall.color->getTextureObject(context->getState()->getContextID())->id(), 0, GL_RGBA, GL_FLOAT,
                      GLsizei(all.size() * sizeof(float)), all.data());
    return all;
}

// What the fog changes of the state, which is to be nothing.
class Watched : public osg::Camera::DrawCallback {
public:
    explicit Watched(Fog *fog) : fog_(fog) {}
    void operator()(osg::RenderInfo &info) const override
    {
        const brume::test::HostState before = brume::test::read_state(true);
        (*fog_)(info);
        changed += brume::test::difference(before, brume::test::read_state(true));
        ++frames;
    }
    mutable std::string changed;
    mutable int frames = 0;

private:
    osg::ref_ptr<Fog> fog_;
};

TEST(OsgSample, FramesAreFoggedAndStateIsUnharmed)
{
    Hall hall(width, height);
    osg::Camera *camera = hall.viewer.getCamera();
    std::vector<float> clear[2], fogged[2];
    for (int frame : {0, 1}) {
        hall.draw(frame);
        clear[frame] = pixels(hall);
    }
    EXPECT_NE(clear[0], clear[1]);

    osg::ref_ptr<Fog> fog = new Fog(hall.color, hall.depth, hall.lamp);
    osg::ref_ptr<Watched> watched = new Watched(fog);
    camera->setFinalDrawCallback(watched);
    for (int frame : {0, 1}) {
        hall.draw(frame);
        fogged[frame] = pixels(hall);
        // Above is the sky, far away in the dark; rows are from the bottom.
        const size_t sky = size_t((height - 3) * width + 3) * 4;
        EXPECT_GT(fogged[frame][sky], 1.2f * clear[frame][sky]);
        // The ground before the camera is near.
        const size_t ground = size_t(2 * width + width / 2) * 4;
        EXPECT_LT(clear[frame][ground], 0.9f) << "is not lit, but white";
        EXPECT_NEAR(fogged[frame][ground], clear[frame][ground], 0.5f * clear[frame][ground]);
    }
    EXPECT_NE(fogged[0], fogged[1]);
    EXPECT_EQ(watched->frames, 2);
    EXPECT_EQ(watched->changed, "");

    camera->setFinalDrawCallback(nullptr);
    for (int frame : {0, 1}) {
        hall.draw(frame);
        EXPECT_EQ(pixels(hall), clear[frame]);
    }
    camera->getGraphicsContext()->makeCurrent();
    fog->release();
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

}  // namespace
