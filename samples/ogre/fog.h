// What an engine on OGRE takes from this sample: Brume in OGRE's own OpenGL context, on OGRE's own textures.
#pragma once
#include <vector>

#include <Ogre.h>

#include <brume/brume.hpp>

// A lamp of the fog. Those with a shadow map name the texture and the camera that took it.
struct Lamp {
    const Ogre::Light *light;
    Ogre::TexturePtr shadow;
    const Ogre::Camera *shadow_camera;
};

// OGRE draws into textures with the picture's top row first, other than OpenGL does into windows.
brume_image texture_image(const Ogre::TexturePtr &texture, uint32_t channels);
brume_camera fog_camera(const Ogre::Camera &camera);
brume_light fog_light(const Lamp &lamp);
// Reversed depth: 1 at the near plane, 0 at the far one, which shows nothing.
brume_format fog_format(const Ogre::TexturePtr &color, const Ogre::Camera &camera);

// Medium, effects, and lamps and camera as they are now.
brume::Scene fog_scene(const brume::Context &context, const Ogre::Camera &camera, const std::vector<Lamp> &lamps);

// Fogs a frame as soon as OGRE has drawn it: add it to the frame's target, for as long as that is drawn.
class Fog : public Ogre::RenderTargetListener {
public:
    // With OGRE's context current, which it is once a window has been made.
    Fog(const Ogre::TexturePtr &color, const Ogre::TexturePtr &depth, const Ogre::Camera &camera, std::vector<Lamp> lamps);
    void postRenderTargetUpdate(const Ogre::RenderTargetEvent &) override { apply(); }

    // The GPU's time for the last frame [ms]. Waits for it.
    double milliseconds() const;

private:
    void apply();

    Ogre::TexturePtr color_, depth_;
    const Ogre::Camera &camera_;
    std::vector<Lamp> lamps_;
    brume::Scene scene_;
    brume::Plan plan_;
};
