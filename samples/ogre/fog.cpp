#include "fog.h"

#include <algorithm>

namespace {

brume::Context borrowed_context()
{
    brume_context_desc desc = BRUME_CONTEXT_DESC_INIT;
    desc.backend = BRUME_BACKEND_GL;
    desc.gl_context = BRUME_GL_BORROWED;
    return brume::Context(desc);
}

void set(double to[3], const Ogre::Vector3 &from)
{
    std::copy_n(from.ptr(), 3, to);
}

// Cameras of OGRE look down -z, and +y is up: as Brume's do.
void set_pose(double camera_to_world[16], const Ogre::Camera &camera)
{
    Ogre::Affine3 pose;
    pose.makeTransform(camera.getDerivedPosition(), Ogre::Vector3::UNIT_SCALE, camera.getDerivedOrientation());
    std::copy_n(pose[0], 16, camera_to_world);
}

}  // namespace

brume_image texture_image(const Ogre::TexturePtr &texture, uint32_t channels)
{
    uint32_t name = 0;
    texture->getCustomAttribute("GLID", &name);
    brume_image image = brume::texture(name, int32_t(texture->getWidth()), int32_t(texture->getHeight()), channels);
    image.origin = BRUME_ORIGIN_TOP_LEFT;
    return image;
}

brume_camera fog_camera(const Ogre::Camera &camera)
{
    brume_camera fog = BRUME_CAMERA_INIT;
    fog.given = BRUME_CAMERA_FIELD_OF_VIEW | BRUME_CAMERA_POSE;
    fog.vertical_fov = camera.getFOVy().valueRadians();
    set_pose(fog.camera_to_world, camera);
    return fog;
}

brume_light fog_light(const Lamp &lamp)
{
    const Ogre::Light &light = *lamp.light;
    brume_light fog = BRUME_LIGHT_INIT;
    const Ogre::ColourValue intensity = light.getDiffuseColour() * light.getPowerScale();
    set(fog.position, light.getDerivedPosition());
    set(fog.intensity, {intensity.r, intensity.g, intensity.b});
    if (light.getType() == Ogre::Light::LT_SPOTLIGHT) {
        fog.type = BRUME_LIGHT_SPOT;
        set(fog.direction, light.getDerivedDirection());
        fog.angle = light.getSpotlightOuterAngle().valueRadians();
        fog.penumbra = 1 - light.getSpotlightInnerAngle().valueRadians() / fog.angle;
    }
    if (lamp.shadow_camera) {
        fog.shadow_kind = BRUME_SHADOW_PERSPECTIVE;
        fog.shadow_depth = BRUME_DEPTH_DEVICE;
        fog.shadow_extent = lamp.shadow_camera->getFOVy().valueRadians();
        fog.shadow_range[0] = lamp.shadow_camera->getFarClipDistance();
        fog.shadow_range[1] = lamp.shadow_camera->getNearClipDistance();
        set_pose(fog.shadow_to_world, *lamp.shadow_camera);
    }
    return fog;
}

brume_format fog_format(const Ogre::TexturePtr &color, const Ogre::Camera &camera)
{
    static brume_layer shadow = BRUME_LAYER_INIT;
    shadow.name = "shadow";
    brume_format format = brume::format(int32_t(color->getWidth()), int32_t(color->getHeight()));
    format.depth_kind = BRUME_DEPTH_DEVICE;
    format.depth_range[0] = camera.getFarClipDistance();
    format.depth_range[1] = camera.getNearClipDistance();
    format.sky = BRUME_SKY_CLAMP;
    format.sky_distance = 80;
    format.inputs = &shadow;
    format.input_count = 1;
    return format;
}

brume::Scene fog_scene(const brume::Context &context, const Ogre::Camera &camera, const std::vector<Lamp> &lamps)
{
    brume::Scene scene(context);
    brume_medium medium = BRUME_MEDIUM_INIT;
    medium.visibility = 120; /* [m] */
    medium.g = 0.6;
    scene.set_medium(medium);
    scene.add_effect("surface");
    scene.add_effect("multiscatter");
    scene.set("airlight", "resolution", "quarter");
    scene.set("airlight", "orders", "single");
    std::vector<brume_light> lights;
    for (const Lamp &lamp : lamps)
        lights.push_back(fog_light(lamp));
    scene.set_lights(lights);
    scene.set_camera(fog_camera(camera));
    return scene;
}

Fog::Fog(const Ogre::TexturePtr &color, const Ogre::TexturePtr &depth, const Ogre::Camera &camera, std::vector<Lamp> lamps)
    : color_(color), depth_(depth), camera_(camera), lamps_(std::move(lamps)),
      scene_(fog_scene(borrowed_context(), camera, lamps_)), plan_(scene_, fog_format(color, camera))
{
}

void Fog::apply()
{
    std::vector<brume_light> lights;
    std::vector<brume_image> maps;
    std::vector<brume_layer> shadows;
    maps.reserve(lamps_.size());
    for (const Lamp &lamp : lamps_) {
        if (lamp.shadow) {
            maps.push_back(texture_image(lamp.shadow, 1));
            brume_layer layer = BRUME_LAYER_INIT;
            layer.name = "shadow";
            layer.image = &maps.back();
            layer.light = uint32_t(lights.size());
            shadows.push_back(layer);
        }
        lights.push_back(fog_light(lamp));
    }
    scene_.set_lights(lights);
    scene_.set_camera(fog_camera(camera_));
    scene_.context().check(brume_plan_update(plan_.get(), scene_.get(), nullptr));

    const brume_image color = texture_image(color_, 4), depth = texture_image(depth_, 1);
    brume_frame frame = BRUME_FRAME_INIT;
    frame.color = frame.output = &color; /* where it lies */
    frame.depth = &depth;
    frame.inputs = shadows.data();
    frame.input_count = uint32_t(shadows.size());
    plan_.execute(frame);
}

double Fog::milliseconds() const
{
    double sum = 0;
    for (const brume_plan_entry &entry : plan_.entries())
        sum += entry.runs ? entry.measured_ms : 0;
    return sum;
}
