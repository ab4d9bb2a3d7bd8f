#include "engine.h"

#include <cmath>

#include <OgreDepthBuffer.h>

namespace {

constexpr uint32_t shadow_size = 1024;
constexpr float lantern_radius = 0.15f;
constexpr uint32_t casts_shadow = 1, glows = 2;
const char *const resources = Ogre::RGN_DEFAULT;

const char *const vertex_text = R"(#version 430 core
in vec4 vertex;
in vec3 normal;
uniform mat4 world_view_projection, world, normal_to_world;
out vec3 place, facing;
void main()
{
    place = (world * vertex).xyz;
    facing = mat3(normal_to_world) * normal;
    gl_Position = world_view_projection * vertex;
}
)";

// Lambert's surfaces in the light of a point lamp and of a spot with a shadow map.
const char *const fragment_text = R"(#version 430 core
in vec3 place, facing;
uniform vec3 albedo, emission, lantern_place, lantern_intensity, beam_place, beam_direction, beam_intensity;
uniform vec2 beam_cosines, shadow_range;
uniform mat4 to_shadow;
uniform sampler2D shadow_map;
out vec4 color;
vec3 arriving(vec3 lamp, vec3 intensity)
{
    vec3 way = lamp - place;
    return intensity * max(dot(normalize(facing), normalize(way)), 0.0) / dot(way, way);
}
float in_light()
{
    vec4 there = to_shadow * vec4(place, 1.0);
    vec2 at = there.xy / there.w * vec2(0.5, -0.5) + 0.5;
    float near = shadow_range.x, far = shadow_range.y;
    float first = near * far / (texture(shadow_map, at).r * (far - near) + near);
    return there.w <= first * 1.01 + 0.02 ? 1.0 : 0.0;
}
void main()
{
    float cosine = dot(normalize(place - beam_place), beam_direction);
    float cone = smoothstep(beam_cosines.y, beam_cosines.x, cosine);
    vec3 light = arriving(lantern_place, lantern_intensity);
    if (cone > 0.0)
        light += arriving(beam_place, beam_intensity) * cone * in_light();
    color = vec4(emission + albedo * (light / 3.14159265 + 0.01), 1.0);
}
)";

const char *const depth_text = R"(#version 430 core
void main() {}
)";

Ogre::HighLevelGpuProgramPtr make_program(const char *name, Ogre::GpuProgramType type, const char *text)
{
    auto program = Ogre::HighLevelGpuProgramManager::getSingleton().createProgram(name, resources, "glsl", type);
    program->setSource(text);
    program->load();
    return program;
}

Ogre::TexturePtr make_texture(const char *name, uint32_t width, uint32_t height, Ogre::PixelFormat format)
{
    auto texture = Ogre::TextureManager::getSingleton().createManual(name, resources, Ogre::TEX_TYPE_2D, width, height, 0,
                                                                     format, Ogre::TU_RENDERTARGET);
    texture->getBuffer()->getRenderTarget()->setAutoUpdated(false);
    return texture;
}

Ogre::Vector3 intensity(const Ogre::Light &light)
{
    const Ogre::ColourValue color = light.getDiffuseColour() * light.getPowerScale();
    return {color.r, color.g, color.b};
}

}  // namespace

Engine::Engine(uint32_t width, uint32_t height) : root_("", "", "")
{
    make_window();
    color_ = make_texture("color", width, height, Ogre::PF_FLOAT16_RGBA);
    depth_ = make_texture("depth", width, height, Ogre::PF_DEPTH32F);
    shadow_ = make_texture("shadow", shadow_size, shadow_size, Ogre::PF_DEPTH32F);
    scene_ = root_.createSceneManager();
    make_scene();
    make_lamps();

    camera_ = scene_->createCamera("camera");
    camera_->setFOVy(Ogre::Radian(0.9f));
    camera_->setAspectRatio(float(width) / float(height));
    camera_->setNearClipDistance(0.1f);
    camera_->setFarClipDistance(500);
    camera_node_ = scene_->getRootSceneNode()->createChildSceneNode();
    camera_node_->attachObject(camera_);

    // Both textures are the frame's, so it has no depth buffer of OGRE's besides.
    frame_ = root_.getRenderSystem()->createMultiRenderTarget("frame");
    frame_->bindSurface(0, color_->getBuffer()->getRenderTarget());
    frame_->bindSurface(1, depth_->getBuffer()->getRenderTarget());
    frame_->setDepthBufferPool(Ogre::DepthBuffer::POOL_NO_DEPTH);
    frame_->setAutoUpdated(false);
    Ogre::Viewport *view = frame_->addViewport(camera_);
    view->setBackgroundColour(Ogre::ColourValue(0.004f, 0.006f, 0.012f));
    view->setOverlaysEnabled(false);
}

void Engine::make_window()
{
    log_.createLog("", true, false, true);
    root_.loadPlugin(OGRE_PLUGINS "/RenderSystem_GL3Plus");
    root_.loadPlugin(OGRE_PLUGINS "/Codec_STBI");
    Ogre::RenderSystem *gl = root_.getAvailableRenderers().front();
    gl->setConfigOption("Reversed Z-Buffer", "Yes");
    root_.setRenderSystem(gl);
    root_.initialise(false);
    const Ogre::NameValuePairList hidden{{"hidden", "true"}};
    root_.createRenderWindow("ogre", 64, 64, false, &hidden)->setAutoUpdated(false);
}

Ogre::MaterialPtr Engine::make_material(const char *name, const Ogre::Vector3 &albedo, float emission)
{
    auto material = Ogre::MaterialManager::getSingleton().create(name, resources);
    Ogre::Technique *seen = material->getTechnique(0);
    Ogre::Pass *pass = seen->getPass(0);
    pass->setVertexProgram("vertex");
    pass->setFragmentProgram("fragment");
    pass->getVertexProgramParameters()->setNamedAutoConstant("world_view_projection",
                                                             Ogre::GpuProgramParameters::ACT_WORLDVIEWPROJ_MATRIX);
    pass->getVertexProgramParameters()->setNamedAutoConstant("world", Ogre::GpuProgramParameters::ACT_WORLD_MATRIX);
    pass->getVertexProgramParameters()->setNamedAutoConstant("normal_to_world",
                                                             Ogre::GpuProgramParameters::ACT_INVERSE_TRANSPOSE_WORLD_MATRIX);
    pass->getFragmentProgramParameters()->setNamedConstant("albedo", albedo);
    pass->getFragmentProgramParameters()->setNamedConstant("emission", albedo * emission);
    Ogre::TextureUnitState *map = pass->createTextureUnitState();
    map->setTexture(shadow_);
    map->setTextureFiltering(Ogre::TFO_NONE);
    map->setTextureAddressingMode(Ogre::TextureAddressingMode::TAM_CLAMP);

    Ogre::Technique *from_lamp = material->createTechnique();
    from_lamp->setSchemeName("shadow");
    Ogre::Pass *only_depth = from_lamp->createPass();
    only_depth->setVertexProgram("vertex");
    only_depth->setFragmentProgram("only_depth");
    only_depth->getVertexProgramParameters()->setNamedAutoConstant("world_view_projection",
                                                                   Ogre::GpuProgramParameters::ACT_WORLDVIEWPROJ_MATRIX);
    materials_.push_back(material);
    return material;
}

void Engine::add(Ogre::SceneManager::PrefabType type, const Ogre::MaterialPtr &material, const Ogre::Vector3 &place,
                 const Ogre::Vector3 &size)
{
    Ogre::Entity *thing = scene_->createEntity(type);
    thing->setMaterial(material);
    thing->setVisibilityFlags(casts_shadow);
    Ogre::SceneNode *node = scene_->getRootSceneNode()->createChildSceneNode(place);
    node->setScale(size / 100);  // OGRE's prefabs are 100 wide
    node->attachObject(thing);
}

// A yard with two rows of walls, a fence across and balls on the ground.
void Engine::make_scene()
{
    make_program("vertex", Ogre::GPT_VERTEX_PROGRAM, vertex_text);
    make_program("fragment", Ogre::GPT_FRAGMENT_PROGRAM, fragment_text);
    make_program("only_depth", Ogre::GPT_FRAGMENT_PROGRAM, depth_text);
    const auto ground = make_material("ground", {0.3f, 0.3f, 0.32f}, 0),
               wall = make_material("wall", {0.5f, 0.35f, 0.25f}, 0), post = make_material("post", {0.2f, 0.25f, 0.2f}, 0),
               ball = make_material("ball", {0.7f, 0.7f, 0.75f}, 0);
    const auto cube = Ogre::SceneManager::PT_CUBE, sphere = Ogre::SceneManager::PT_SPHERE;
    add(cube, ground, {0, -0.5f, -40}, {200, 1, 200});
    for (int i = 0; i < 6; ++i) {
        add(cube, wall, {-8, 2, -6 - 12.0f * float(i)}, {1, 4, 7});
        add(cube, wall, {8, 2, -10 - 12.0f * float(i)}, {1, 4, 7});
        add(sphere, ball, {-4 + 1.6f * float(i), 0.7f, -9 - 6.0f * float(i)}, {1.4f, 1.4f, 1.4f});
    }
    for (int i = 0; i < 9; ++i)
        add(cube, post, {-4 + float(i), 1.2f, -20}, {0.3f, 2.4f, 0.3f});
}

void Engine::make_lamps()
{
    Ogre::SceneNode *root = scene_->getRootSceneNode();
    lantern_ = scene_->createLight();
    lantern_->setType(Ogre::Light::LT_POINT);
    lantern_->setDiffuseColour(1, 0.7f, 0.4f);
    lantern_->setPowerScale(40);
    lantern_node_ = root->createChildSceneNode();
    lantern_node_->attachObject(lantern_);
    Ogre::Entity *globe = scene_->createEntity(Ogre::SceneManager::PT_SPHERE);
    const float radiance = 40 / (Ogre::Math::PI * lantern_radius * lantern_radius);
    globe->setMaterial(make_material("globe", {1, 0.7f, 0.4f}, radiance));
    globe->setVisibilityFlags(glows);
    Ogre::SceneNode *globe_node = lantern_node_->createChildSceneNode();
    globe_node->setScale(Ogre::Vector3(2 * lantern_radius / 100));
    globe_node->attachObject(globe);

    beam_ = scene_->createLight();
    beam_->setType(Ogre::Light::LT_SPOTLIGHT);
    beam_->setDiffuseColour(0.7f, 0.85f, 1);
    beam_->setPowerScale(900);
    beam_->setSpotlightRange(Ogre::Degree(44), Ogre::Degree(50));
    beam_node_ = root->createChildSceneNode();
    beam_node_->attachObject(beam_);  // lights, too, look down -z of their nodes
    shadow_camera_ = scene_->createCamera("shadow");
    shadow_camera_->setFOVy(Ogre::Degree(52));
    shadow_camera_->setAspectRatio(1);
    shadow_camera_->setNearClipDistance(0.2f);
    shadow_camera_->setFarClipDistance(100);
    beam_node_->attachObject(shadow_camera_);
    Ogre::Viewport *view = shadow_->getBuffer()->getRenderTarget()->addViewport(shadow_camera_);
    view->setMaterialScheme("shadow");
    view->setVisibilityMask(casts_shadow);
    view->setOverlaysEnabled(false);
    lamps_ = {{lantern_, {}, nullptr}, {beam_, shadow_, shadow_camera_}};
}

void Engine::move(float time)
{
    camera_node_->setPosition(std::sin(time) * 0.8f, 1.7f, 2 - 0.5f * time);
    camera_node_->resetOrientation();  // lookAt() turns from where it looked before
    camera_node_->lookAt({0, 1.4f, -30}, Ogre::Node::TS_WORLD);
    lantern_node_->setPosition(-3 + 0.6f * time, 2.6f, -11);
    beam_node_->setPosition(1.5f, 4.5f, -34);
    beam_node_->resetOrientation();
    beam_node_->lookAt({-3 + 1.2f * time, 0.4f, -10}, Ogre::Node::TS_WORLD);
    scene_->getRootSceneNode()->_update(true, false);  // lights and cameras hear of their nodes' places only here

    for (const auto &material : materials_) {
        auto values = material->getTechnique(0)->getPass(0)->getFragmentProgramParameters();
        values->setNamedConstant("lantern_place", lantern_->getDerivedPosition(true));
        values->setNamedConstant("lantern_intensity", intensity(*lantern_));
        values->setNamedConstant("beam_place", beam_->getDerivedPosition(true));
        values->setNamedConstant("beam_direction", beam_->getDerivedDirection());
        values->setNamedConstant("beam_intensity", intensity(*beam_));
        values->setNamedConstant("beam_cosines", Ogre::Vector2(Ogre::Math::Cos(beam_->getSpotlightInnerAngle() / 2),
                                                               Ogre::Math::Cos(beam_->getSpotlightOuterAngle() / 2)));
        values->setNamedConstant("shadow_range",
                                 Ogre::Vector2(shadow_camera_->getNearClipDistance(), shadow_camera_->getFarClipDistance()));
        values->setNamedConstant("to_shadow",
                                 shadow_camera_->getProjectionMatrix() * Ogre::Matrix4(shadow_camera_->getViewMatrix(true)));
    }
}

void Engine::draw()
{
    shadow_->getBuffer()->getRenderTarget()->update(false);
    frame_->update(false);
}
