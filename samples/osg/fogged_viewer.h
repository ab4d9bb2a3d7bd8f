// OpenSceneGraph in OpenGL's compatibility profile: frames drawn into textures, and Brume, which fogs them there.
#pragma once
#include <cmath>
#include <memory>
#include <stdexcept>

#include <osg/LightSource>
#include <osg/ShapeDrawable>
#include <osg/Texture2D>
#include <osgViewer/Viewer>

#include <brume/brume.hpp>

constexpr double near_plane = 0.5, far_plane = 300, lamp_power = 12;  // [m], [m], [radiance m^2]

// Fogs each frame when it has been drawn, with OpenSceneGraph's context current.
class Fog : public osg::Camera::DrawCallback {
public:
    Fog(osg::Texture2D *color, osg::Texture2D *depth, osg::Light *lamp) : color_(color), depth_(depth), lamp_(lamp) {}

    void operator()(osg::RenderInfo &info) const override
    {
        const osg::Camera &camera = *info.getCurrentCamera();
        if (!plan_)
            make_plan(camera);
        place(camera);
        scene_->context().check(brume_plan_update(plan_->get(), scene_->get(), nullptr));
        const brume_image color = image(*color_, info, 4);
        plan_->execute(color, image(*depth_, info, 1), color);
    }
    // With the context current that frames were drawn in.
    void release()
    {
        plan_.reset();
        scene_.reset();
    }

private:
    static brume_image image(const osg::Texture2D &texture, osg::RenderInfo &info, uint32_t channels)
    {
        return brume::texture(texture.getTextureObject(info.getContextID())->id(), texture.getTextureWidth(),
                              texture.getTextureHeight(), channels);
    }

    void make_plan(const osg::Camera &camera) const
    {
        brume_context_desc desc = BRUME_CONTEXT_DESC_INIT;
        desc.backend = BRUME_BACKEND_GL;
        desc.gl_context = BRUME_GL_BORROWED;
        scene_ = std::make_unique<brume::Scene>(brume::Context(desc));
        brume_medium medium = BRUME_MEDIUM_INIT;
        medium.visibility = 100;  // [m]
        medium.g = 0.6;
        scene_->set_medium(medium);
        scene_->set("airlight", "orders", "single");
        place(camera);
        brume_format format = brume::format(color_->getTextureWidth(), color_->getTextureHeight());
        format.depth_kind = BRUME_DEPTH_DEVICE;
        format.depth_range[0] = near_plane;
        format.depth_range[1] = far_plane;
        format.sky = BRUME_SKY_CLAMP;
        format.sky_distance = 80;
        plan_ = std::make_unique<brume::Plan>(*scene_, format);
    }

    void place(const osg::Camera &from) const
    {
        double aspect, z_near, z_far;
        brume_camera camera = BRUME_CAMERA_INIT;
        camera.given = BRUME_CAMERA_FIELD_OF_VIEW | BRUME_CAMERA_POSE;
        from.getProjectionMatrixAsPerspective(camera.vertical_fov, aspect, z_near, z_far);
        camera.vertical_fov = osg::DegreesToRadians(camera.vertical_fov);
        const osg::Matrixd to_world = from.getInverseViewMatrix();
        for (int row = 0; row < 4; ++row)
            for (int column = 0; column < 4; ++column)
                camera.camera_to_world[4 * row + column] = to_world(column, row);  // OpenSceneGraph's points are rows
        scene_->set_camera(camera);
        brume_light lamp = BRUME_LIGHT_INIT;
        for (int i = 0; i < 3; ++i) {
            lamp.position[i] = lamp_->getPosition()[i];
            lamp.intensity[i] = lamp_power * lamp_->getDiffuse()[i];
        }
        scene_->set_lights({lamp});
    }

    osg::ref_ptr<osg::Texture2D> color_, depth_;
    osg::ref_ptr<osg::Light> lamp_;
    mutable std::unique_ptr<brume::Scene> scene_;
    mutable std::unique_ptr<brume::Plan> plan_;
};

// A dark hall of columns with a lamp that moves.
class Hall {
public:
    Hall(int width, int height)
    {
        color = make_texture(width, height, GL_RGBA16F_ARB, GL_RGBA);
        depth = make_texture(width, height, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT);
        osg::ref_ptr<osg::GraphicsContext::Traits> traits = new osg::GraphicsContext::Traits;
        traits->readDISPLAY();
        traits->width = traits->height = 64;
        traits->pbuffer = true;
        osg::Camera *camera = viewer.getCamera();
        camera->setGraphicsContext(osg::GraphicsContext::createGraphicsContext(traits));
        if (!camera->getGraphicsContext())
            throw std::runtime_error("OpenSceneGraph has no graphics context; is there a display?");
        camera->setViewport(0, 0, width, height);
        camera->setProjectionMatrixAsPerspective(50, double(width) / height, near_plane, far_plane);
        camera->setComputeNearFarMode(osg::Camera::DO_NOT_COMPUTE_NEAR_FAR);
        camera->setClearColor({0.02f, 0.03f, 0.05f, 1});
        camera->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
        camera->attach(osg::Camera::COLOR_BUFFER, color);
        camera->attach(osg::Camera::DEPTH_BUFFER, depth);
        viewer.setThreadingModel(osgViewer::Viewer::SingleThreaded);
        viewer.setLightingMode(osg::View::NO_LIGHT);

        osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
        lamp = source->getLight();
        lamp->setDiffuse({1, 0.8f, 0.6f, 1});
        lamp->setConstantAttenuation(0.05f);  // fixed function clamps what is lit to 1
        lamp->setQuadraticAttenuation(float(osg::PI / lamp_power));
        source->addChild(new osg::ShapeDrawable(new osg::Box({0, 0, -0.1f}, 60, 200, 0.2f)));
        for (int i = 0; i < 16; ++i)
            source->addChild(
                new osg::ShapeDrawable(new osg::Cylinder({i % 2 ? 5.0f : -5.0f, 6.0f * float(i / 2), 2}, 0.6f, 4)));
        source->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::ON);
        source->getOrCreateStateSet()->setMode(GL_LIGHT0, osg::StateAttribute::ON);
        viewer.setSceneData(source);
        viewer.realize();
    }

    void draw(double time)
    {
        viewer.getCamera()->setViewMatrixAsLookAt({std::sin(time), -8, 1.7}, {0, 20, 1.7}, {0, 0, 1});
        lamp->setPosition({-2, 6 + float(time), 3, 1});
        viewer.frame(time);
    }

    osgViewer::Viewer viewer;
    osg::ref_ptr<osg::Texture2D> color, depth;
    osg::ref_ptr<osg::Light> lamp;

private:
    static osg::Texture2D *make_texture(int width, int height, GLint internal, GLenum layout)
    {
        osg::Texture2D *texture = new osg::Texture2D;
        texture->setTextureSize(width, height);
        texture->setInternalFormat(internal);
        texture->setSourceFormat(layout);
        texture->setSourceType(GL_FLOAT);
        texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
        texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
        return texture;
    }
};
