// Lists of Gaussians (per tile, and per direction around each light) against sums over all Gaussians in double: nothing that
// matters is missed, wherever the camera is, and nothing is left of an earlier frame.
#include <gtest/gtest.h>

#include "lit_scene.h"
#include "scene_maths.hpp"
#include "gaussians/light_gaussians.h"

using namespace fog;
namespace f32 = brume::maths_float;

namespace {

class ListsOn : public testing::TestWithParam<const char *> {
protected:
    brume_context context() { return backend(GetParam()); }
};

INSTANTIATE_TEST_SUITE_P(All, ListsOn, testing::ValuesIn(fog::backend_names),
                         [](auto &info) { return std::string(info.param); });

// int rho dt of each pixel between the sum over those that matter and that over all.
void hold_optical_depth(brume_context context, const Json &scene, int width, int height, const Window &window,
                        uint32_t origin)
{
    const Exhaustive exact(scene, width, height, window);
    const Frame frame = lit_frame(width, height);
    Options options{[&](brume_format &f) {
                        f.display_x = window.x;
                        f.display_y = window.y;
                        f.display_width = window.width;
                        f.display_height = window.height;
                    },
                    {"optical_depth"}};
    options.origin = origin;
    const bool up = origin == BRUME_ORIGIN_BOTTOM_LEFT;
    const Result r = run(context, scene.dump(), up ? flipped(frame.color) : frame.color,
                         up ? flipped(frame.depth) : frame.depth, options);
    const Picture got = up ? flipped(r.optical_depth) : r.optical_depth;
    double largest = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const auto ray = exact.ray(x, y, frame.depth.at(x, y)[0]);
            double all = 0, near = 0, rounding = 1e-6;
            for (const auto &g : exact.gaussians()) {
                const double p = Exhaustive::density(g, ray);
                all += p;
                near += p > 1e-4 * Exhaustive::whole_density(g) ? p : 0;
                // A direction is good to 1e-7, which far off is a part of a narrow Gaussian's radius.
                rounding += p * (1e-5 + 4e-7 * g.scale * g.scale * glm::dot(g.center, g.center));
            }
            ASSERT_LE(got.at(x, y)[1], all + rounding) << width << "x" << height << " at " << x << "," << y;
            ASSERT_GE(got.at(x, y)[1], near - rounding) << width << "x" << height << " at " << x << "," << y;
            ASSERT_NEAR(got.at(x, y)[0], 0.5 * got.at(x, y)[1], 1e-5 * all + 1e-9);
            largest = std::max(largest, all);
        }
    ASSERT_GT(largest, 0);
}

}  // namespace

TEST_P(ListsOn, TilesMissNoGaussian)
{
    const struct {
        int width, height;
        Window window;
    } images[] = {{97, 61, {}},
                  {1, 1, {}},
                  {3, 5, {}},
                  {16, 16, {}},
                  {17, 33, {}},
                  {300, 2, {}},
                  {40, 30, {-50, 10, 160, 90}},     // a crop
                  {70, 50, {10, 8, 50, 34}},        // overscan
                  {20, 20, {200, -300, 160, 90}}};  // off the display window altogether
    for (double extent : {12.0, 400.0})
        for (uint32_t origin : {BRUME_ORIGIN_TOP_LEFT, BRUME_ORIGIN_BOTTOM_LEFT})
            for (auto &[width, height, window] : images) {
                Json medium{{"scattering", {0.5, 1, 1.5}}};
                medium["density"] = random_gaussians(120, 3, extent, extent / 4, 0.5);
                Json scene = lit_scene(medium, Json::array());
                hold_optical_depth(context(), scene, width, height, window, origin);
                scene["camera"]["camera_to_world"] = pose({1, 2, -extent / 3}, 2.6, -0.7);
                scene["camera"]["vertical_fov"] = 130;
                hold_optical_depth(context(), scene, width, height, window, origin);
            }
}

// Lists longer than what is read of them at once, of sharp Gaussians of which a pixel meets few.
TEST_P(ListsOn, LongListsMissNoGaussian)
{
    for (int count : {128, 129, 900}) {
        Json medium{{"scattering", {0.5, 1, 1.5}}};
        medium["density"] = random_gaussians(count, 5, 12, count > 500 ? 0.3 : 3, 0.5);
        const Json scene = lit_scene(medium, Json::array());
        for (auto [width, height] : {std::pair{16, 16}, {41, 30}})
            hold_optical_depth(context(), scene, width, height, {}, BRUME_ORIGIN_TOP_LEFT);
    }
}

TEST_P(ListsOn, FollowTheCameraAndTheKeys)
{
    // One plan through frames in which the camera, then the lights, then the Gaussians move, and a plan for each frame.
    Json medium{{"scattering", {0.1, 0.15, 0.2}}};
    medium["density"] = random_gaussians(30, 9, 14, 3, 2);
    Json moving = gaussian({0, 0, -6}, 0.7, 1);
    moving["center"] = {{{"keys", {{4, -3}, {6, 4}}}}, 0, -6};
    moving["amplitude"] = {{"keys", {{4, 2}, {6, 0}}}};
    medium["density"].push_back(moving);
    Json lamp = point_light({0, 1, -7}, 5);
    lamp["position"] = {{{"keys", {{2, -4}, {4, 3}}}}, 1, -7};
    const Json sun{{"type", "directional"}, {"direction", {0.4, -1, 0.2}}, {"intensity", 0.5}};
    Json spot{{"type", "spot"}, {"position", {3, 2, -9}}, {"direction", {-1, -0.6, 0.2}}, {"angle", 50}, {"intensity", 30}};
    spot["direction"] = {-1, {{"keys", {{3, -0.6}, {5, 0.6}}}}, 0.2};
    const Json scene = lit_scene(medium, Json::array({lamp, sun, spot}));
    const Frame frame = lit_frame(20, 15);
    const Plan plan(context(), scene.dump(), 20, 15, Options{{}, {"airlight_error"}});
    const Json poses[] = {pose({0, 0, 0}), pose({0, 0, 0}, 0.3, 0.1), pose({2, -1, -3}, 0.3, 0.1), pose({0, 0, 0}),
                          pose({0, 0, 0}, -2)};
    std::vector<float> before;
    for (double number : {0.0, 0.0, 3.0, 4.0, 5.0, 6.0, 0.0, 9.0})
        for (const Json &p : poses) {
            const brume_camera c = camera(p, 50);
            const Options options{{}, {"airlight_error"}, number, 0, &c};
            const Picture got = plan.execute(frame.color, frame.depth, options).output,
                          expected = run(context(), scene.dump(), frame.color, frame.depth, options).output;
            const Worst worst = compare(got, expected, 1e-3);
            EXPECT_LT(worst.error, 1e-5) << "frame " << number << " " << worst.describe();
            EXPECT_NE(got.data, before) << "frame " << number << ": nothing moved";
            before = got.data;
        }
}

// As many as the documentation promises, through the C ABI.
TEST_P(ListsOn, ManyGaussians)
{
    const Frame frame = lit_frame(12, 8);
    const Json scene = lit_scene({{"scattering", 0.05}}, Json::array({point_light({0.3, 1, -5}, 10, 0.05)}));
    for (uint32_t count : {0u, 1u, 1000u, 100000u}) {
        std::mt19937 random(count);
        std::uniform_real_distribution<double> u(-1, 1);
        std::vector<brume_gaussian> gaussians(count, brume_gaussian BRUME_GAUSSIAN_INIT);
        for (brume_gaussian &g : gaussians) {
            for (double &x : g.center)
                x = 30 * u(random);
            g.center[2] -= 20;
            g.scale = 0.05 * std::cbrt(double(count)) * std::exp(u(random));
            g.amplitude = 1;
        }
        const Plan plan(context(), scene.dump(), 12, 8, Options{{}, {"airlight", "airlight_error"}},
                        [&](brume_scene changed) {
                            brume_density_term term = BRUME_DENSITY_TERM_INIT;
                            term.value = 0.1;
                            brume_medium medium = BRUME_MEDIUM_INIT;
                            std::fill_n(medium.scattering, 3, 0.05);
                            medium.terms = &term;
                            medium.term_count = 1;
                            medium.gaussians = gaussians.data();
                            medium.gaussian_count = count;
                            Context::check(brume_scene_set_medium(changed, &medium), context());
                        });
        const Result r = plan.execute(frame.color, frame.depth, Options{{}, {"airlight", "airlight_error"}});
        for (float v : r.airlight.data)
            ASSERT_TRUE(std::isfinite(v) && v > 0) << count;
        for (float v : r.output.data)
            ASSERT_TRUE(std::isfinite(v) && v >= 0) << count;
    }
}

TEST_P(ListsOn, ACropIsTheSamePicture)
{
    const int width = 64, height = 42, x0 = 13, y0 = 9, w = 30, h = 21;
    const Frame frame = lit_frame(width, height);
    Frame part{Picture(w, h, 4), Picture(w, h, 1)};
    for (int y = 0; y < h; ++y) {
        std::copy_n(frame.color.at(x0, y0 + y), 4 * w, part.color.at(0, y));
        std::copy_n(frame.depth.at(x0, y0 + y), w, part.depth.at(0, y));
    }
    const Json scene = lit_scenes()[1].scene;
    Options options{{}, {"airlight_error"}};
    const Picture whole = run(context(), scene.dump(), frame.color, frame.depth, options).output;
    Picture expected(w, h, 4);
    for (int y = 0; y < h; ++y)
        std::copy_n(whole.at(x0, y0 + y), 4 * w, expected.at(0, y));
    options.format = [&](brume_format &f) {
        f.display_x = -x0;
        f.display_y = -y0;
        f.display_width = width;
        f.display_height = height;
    };
    const Worst worst = compare(run(context(), scene.dump(), part.color, part.depth, options).output, expected, 1e-2);
    // Other tiles: their lists are others, and so may be how nodes integrate them to the error asked.
    EXPECT_LT(worst.error, 1e-2) << worst.describe();
    printf("a crop against the whole: worst %.2g\n", worst.error);
}

namespace {

// A scene as effects see it, of Gaussians and lights around a camera that may move among them.
class World {
public:
    World(unsigned seed, int gaussians, double extent) : random_(seed)
    {
        for (int i = 0; i < gaussians; ++i) {
            centers_.push_back(somewhere(extent));
            brume_plugin_gaussian g{};
            g.scale = float(std::pow(10, 4.5 * u()) / extent);
            g.amplitude = float(0.1 * u());
            gaussians_.push_back(g);
        }
        for (int i = 0; i < 5; ++i) {
            brume_plugin_light l{};
            l.type = float(i < 3 ? BRUME_LIGHT_POINT : i == 3 ? BRUME_LIGHT_SPOT : BRUME_LIGHT_DIRECTIONAL);
            light_positions_.push_back(somewhere(i == 2 ? 20 * extent : extent));
            light_directions_.push_back(glm::normalize(somewhere(1)));
            lights_.push_back(l);
        }
        medium_.scattering[0] = medium_.scattering[1] = medium_.scattering[2] = 1;
        scene_.medium = &medium_;
        scene_.camera = &camera_;
        move({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    }
    World(const World &) = delete;

    glm::dvec3 somewhere(double extent) { return extent * glm::dvec3(2 * u() - 1, 2 * u() - 1, 2 * u() - 1); }
    double u() { return std::uniform_real_distribution<double>(0, 1)(random_); }

    void move(glm::dvec3 position, glm::dvec3 right, glm::dvec3 up)
    {
        const glm::dvec3 axes[3] = {glm::normalize(right), glm::normalize(glm::cross(glm::cross(right, up), right)),
                                    glm::normalize(glm::cross(right, up))};
        float(*const to[3])[3] = {&camera_.right, &camera_.up, &camera_.back};
        for (int a = 0; a < 3; ++a)
            for (int i = 0; i < 3; ++i)
                (*to[a])[i] = float(axes[a][i]);
        auto seen = [&](glm::dvec3 p, float(&out)[3]) {
            for (int a = 0; a < 3; ++a)
                out[a] = float(glm::dot(p, axes[a]));
        };
        for (size_t i = 0; i < gaussians_.size(); ++i)
            seen(centers_[i] - position, gaussians_[i].center);
        for (size_t i = 0; i < lights_.size(); ++i) {
            if (lights_[i].type != BRUME_LIGHT_DIRECTIONAL)
                seen(light_positions_[i] - position, lights_[i].position);
            if (lights_[i].type != BRUME_LIGHT_POINT)
                seen(light_directions_[i], lights_[i].direction);
        }
        scene_.gaussians = gaussians_.data();
        scene_.gaussian_count = uint32_t(gaussians_.size());
        scene_.gaussian_size = sizeof gaussians_[0];
        scene_.lights = lights_.data();
        scene_.light_count = uint32_t(lights_.size());
        scene_.light_size = sizeof lights_[0];
        for (size_t i = 0; i < 3; ++i)
            scene_.position[i] = position[int(i)];
    }

    const brume_plugin_scene &scene() const { return scene_; }

private:
    std::mt19937 random_;
    std::vector<glm::dvec3> centers_, light_positions_, light_directions_;
    std::vector<brume_plugin_gaussian> gaussians_;
    std::vector<brume_plugin_light> lights_;
    brume_plugin_medium medium_{};
    brume_plugin_camera camera_{};
    brume_plugin_scene scene_{};
};

// Between the sum over those Gaussians that matter and that over all; light -1 is the camera.
void hold_density(const brume_plugin_scene &scene, int light_index, const brume::maths_double::Light &light,
                  glm::dvec3 point, double listed, double rounding)
{
    const bool parallel = light.type == int(BRUME_LIGHT_DIRECTIONAL);
    const glm::dvec3 away = light.position - point;
    const double distance = parallel ? brume::maths_double::far_away : glm::length(away);
    const glm::dvec3 way = parallel ? -light.direction : away / std::max(distance, 1e-20);
    double all = 0, near = 0, loss = 0;
    for (uint32_t k = 0; k < scene.gaussian_count; ++k) {
        auto blob = brume::maths_double::gaussian_of(scene.gaussians[k]);
        blob.center -= point;
        const double p = Exhaustive::density(blob, {way, distance}), whole = Exhaustive::whole_density(blob);
        all += p;
        near += p > 1e-4 * whole ? p : 0;
        loss += 1e-7 * whole;
    }
    ASSERT_LE(listed, all * (1 + rounding) + loss) << scene.gaussian_count << " Gaussians, light " << light_index;
    ASSERT_GE(listed, near * (1 - rounding) - loss) << scene.gaussian_count << " Gaussians, light " << light_index;
}

}  // namespace

// What lies between a point and a light, or the camera, as shaders look it up, in double and in float.
TEST(LightGaussians, MissNoGaussian)
{
    using namespace brume::maths_double;
    size_t listed_pairs = 0, pairs = 0;
    for (int count : {0, 1, 2, 40, 900, 6000})
        for (double extent : {1.0, 3000.0}) {
            World world(unsigned(count) + 1, count, extent);
            brume::LightGaussians lists;
            for (int step = 0; step < 3; ++step) {
                if (step)
                    world.move(world.somewhere(extent), world.somewhere(1), world.somewhere(1));
                const brume_plugin_scene &scene = world.scene();
                lists.refresh(scene, step == 0, true);
                const Camera camera = camera_of(scene);
                const Data gaussians = gaussians_of(scene), lights = lights_of(scene),
                           listed(lists.texels.data(), lists.texels.size() / 4, 4);
                const Texture g = gaussians.texture(), all = listed.texture();
                const f32::Camera narrow_camera = f32::camera_of(scene);
                const f32::Data narrow_lights = f32::lights_of(scene),
                                narrow_listed(lists.texels.data(), lists.texels.size() / 4, 4);
                const f32::Texture narrow_all = narrow_listed.texture();
                const int points = count > 1000 ? 40 : 200;
                for (int i = 0; i < points; ++i)
                    for (int l = -1; l < int(scene.light_count); ++l) {
                        const Light light = l < 0 ? Light{} : light_at(lights.texture(), l);
                        // Anywhere; at the light; or where a Gaussian stands in the light's way.
                        vec3 point = i == 0 ? light.position : world.somewhere(i % 5 == 4 ? 30 * extent : extent);
                        if (count && i % 2 == 1) {
                            const Gaussian blob = gaussian_at(g, i % count);
                            const vec3 way = glm::normalize(light.type == light_directional ? light.direction
                                                                                            : blob.center - light.position);
                            point = blob.center + extent * world.u() * way + world.somewhere(1 / blob.scale);
                        }
                        hold_density(
                            scene, l, light, point,
                            l < 0 ? camera_density(all, camera, point) : shadow_density(all, camera, l, light, point), 1e-6);
                        const f32::Light narrow = l < 0 ? f32::Light{} : f32::light_at(narrow_lights.texture(), l);
                        const f32::vec3 at(point);
                        hold_density(scene, l, light, vec3(at),
                                     l < 0 ? f32::camera_density(narrow_all, narrow_camera, at)
                                           : f32::shadow_density(narrow_all, narrow_camera, l, narrow, at),
                                     2e-2);
                    }
                const size_t origins = 1 + scene.light_count, cells = size_t(lists.texels[9] * lists.texels[9]) * origins;
                for (size_t i = 3 * origins; step == 0 && i < 3 * origins + cells; ++i)
                    listed_pairs += size_t(lists.texels[4 * i + 1]);
                pairs += step ? 0 : scene.gaussian_count * cells;
            }
        }
    EXPECT_LT(listed_pairs, pairs / 2) << "nothing was culled";
}
