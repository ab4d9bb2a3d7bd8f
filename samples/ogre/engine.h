// The engine: OGRE with a night scene made in code, drawn with reversed depth into textures.
#pragma once
#include <vector>

#include <Ogre.h>

#include "fog.h"

class Engine {
public:
    Engine(uint32_t width, uint32_t height);

    // Camera and lamps as they are at a time [s].
    void move(float time);
    // The shadow map, then the frame; listeners of its target hear of it.
    void draw();

    Ogre::RenderTarget &target() { return *frame_; }
    const Ogre::TexturePtr &color() const { return color_; }
    const Ogre::TexturePtr &depth() const { return depth_; }
    const Ogre::Camera &camera() const { return *camera_; }
    const std::vector<Lamp> &lamps() const { return lamps_; }

private:
    void make_window();
    Ogre::MaterialPtr make_material(const char *name, const Ogre::Vector3 &albedo, float emission);
    void add(Ogre::SceneManager::PrefabType type, const Ogre::MaterialPtr &material, const Ogre::Vector3 &place,
             const Ogre::Vector3 &size);
    void make_scene();
    void make_lamps();

    Ogre::LogManager log_;
    Ogre::Root root_;
    Ogre::SceneManager *scene_;
    Ogre::TexturePtr color_, depth_, shadow_;
    Ogre::MultiRenderTarget *frame_;
    Ogre::Camera *camera_, *shadow_camera_;
    Ogre::SceneNode *camera_node_, *lantern_node_, *beam_node_;
    Ogre::Light *lantern_, *beam_;
    std::vector<Lamp> lamps_;
    std::vector<Ogre::MaterialPtr> materials_;
};
