#include "scene.h"

#include <bit>
#include <cmath>

namespace scene {

void paint(host::Picture &picture)
{
    const ofx::RectI &b = picture.bounds;
    for (int y = b.y1; y < b.y2; ++y)
        for (int x = b.x1; x < b.x2; ++x) {
            const bool lamp = (x % 16 == 5) && (y % 12 == 3);
            for (int c = 0; c < picture.channels; ++c)
                picture.at(x, y, c) = c == 3 ? float((x + y) & 7) / 8
                                      : lamp ? 40.f + float(c)
                                             : .05f * float(1 + (x * 3 + y * 5 + c) % 7);
        }
}

void paint_depth(host::Picture &picture, int channel)
{
    const ofx::RectI &b = picture.bounds;
    for (int y = b.y1; y < b.y2; ++y)
        for (int x = b.x1; x < b.x2; ++x)
            picture.at(x, y, channel) = y > b.y2 - 8 ? 0.f : 4.f + float((x * 7 + y * 3) % 86);
}

World::World()
{
    const brume_medium nothing = BRUME_MEDIUM_INIT;
    medium = nothing;
    for (double &sigma : medium.scattering)
        sigma = 3.912 / 150;
    medium.g = .8;
    term.type = BRUME_DENSITY_EXPONENTIAL;
    term.origin[1] = -1.7;
    const brume_camera standing = BRUME_CAMERA_INIT;
    camera = standing;
    camera.given = BRUME_CAMERA_FIELD_OF_VIEW | BRUME_CAMERA_POSE;
    camera.vertical_fov = 50 * 3.14159265358979323846 / 180;
    format.depth_range[0] = .1;
    format.depth_range[1] = 1000;
    format.sky_distance = 500;
}

void expect_fogged(const host::Picture &output, const host::Picture &source, const host::Picture &depth, int channel,
                   const World &world)
{
    const ofx::RectI &b = source.bounds, &d = depth.bounds;
    const int width = b.x2 - b.x1, height = b.y2 - b.y1, channels = source.channels;
    std::vector<float> color, distance, fogged(size_t(width * height * channels));
    for (int y = b.y2 - 1; y >= b.y1; --y)
        for (int x = b.x1; x < b.x2; ++x) {
            for (int c = 0; c < channels; ++c)
                color.push_back(source.at(x, y, c));
            const bool inside = x >= d.x1 && x < d.x2 && y >= d.y1 && y < d.y2;
            distance.push_back(inside ? depth.at(x, y, channel) : 0);
        }
    brume_context_desc desc = BRUME_CONTEXT_DESC_INIT;
    desc.backend = BRUME_BACKEND_CPU;
    const brume::Context context(desc);
    brume::Scene scene = world.text ? brume::Scene(context, world.text) : brume::Scene(context);
    if (!world.text) {
        brume_medium medium = world.medium;
        medium.terms = &world.term;
        medium.term_count = world.term.falloff > 0;
        scene.set_metres_per_unit(world.metres);
        scene.set_medium(medium);
    }
    if (!(scene.camera_given() & BRUME_CAMERA_FIELD_OF_VIEW))
        scene.set_camera(world.camera);
    brume_quality quality = BRUME_QUALITY_INIT;
    quality.preset = world.preset;
    if (world.preset)
        scene.set_quality(quality);
    brume_format format = world.format;
    format.width = width;
    format.height = height;
    brume::Plan plan(scene, format);
    plan.execute(brume::image(color.data(), width, height, uint32_t(channels)),
                 brume::image(distance.data(), width, height, 1),
                 brume::image(fogged.data(), width, height, uint32_t(channels)), nullptr, world.frame);
    const float *wanted = fogged.data();
    bool changed = false;
    for (int y = b.y2 - 1; y >= b.y1; --y)
        for (int x = b.x1; x < b.x2; ++x)
            for (int c = 0; c < channels; ++c, ++wanted) {
                changed |= *wanted != source.at(x, y, c);
                ASSERT_EQ(std::bit_cast<uint32_t>(output.at(x, y, c)), std::bit_cast<uint32_t>(*wanted))
                    << "pixel " << x << ", " << y << ", channel " << c << ": " << output.at(x, y, c) << "; expected "
                    << *wanted;
            }
    EXPECT_TRUE(changed) << "the library left the picture as it was";
}

}  // namespace scene
