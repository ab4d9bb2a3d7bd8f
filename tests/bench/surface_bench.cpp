// surface_bench [WIDTH HEIGHT]: what effect surface costs beside multiscatter, with four lamps and with a sun and a sky, by
// what frames bring. The two take turns; a time is the median of all passes of an effect.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <deque>

#include "lit_scene.h"

using namespace fog;

namespace {

// A floor that recedes under a sky, lamps above it.
struct Shot {
    Picture color, depth, normal, albedo, group, specular, roughness, output;

    Shot(int width, int height)
        : color(width, height, 4, 0.3f), depth(width, height, 1), normal(width, height, 3), albedo(width, height, 3, 0.4f),
          group(width, height, 3, 0.05f), specular(width, height, 3, 0.04f), roughness(width, height, 1, 0.4f),
          output(width, height, 4)
    {
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const float v = (float(y) + 0.5f) / float(height) - 0.3f;
                *depth.at(x, y) = v > 0.005f ? 1.5f / v : INFINITY;
                normal.at(x, y)[1] = 1;
            }
    }
};

Json four_lamps()
{
    const Json lamps{point_light({-3, 3, -6}, 40, 0.1), point_light({3, 3, -9}, 40, 0.1), point_light({-3, 3, -14}, 40, 0.1),
                     point_light({3, 3, -20}, 40, 0.1)};
    return lit_scene({{"scattering", {0.03, 0.03, 0.032}}, {"g", 0.8}}, lamps);
}

Json sun_and_sky()
{
    Json scene = lit_scene({{"scattering", {0.03, 0.03, 0.032}}, {"g", 0.8}},
                           Json::array({{{"type", "directional"}, {"direction", {-0.5, -1, -0.3}}, {"intensity", 3}}}));
    scene["medium"]["density"] =
        Json::array({{{"type", "exponential"}, {"value", 0.7}, {"direction", {0, 1, 0}}, {"falloff", 0.1}}});
    scene["environment"]["sh"] = {{0.8, 0.9, 1}, {0.3, 0.3, 0.4}, {0.1, 0.1, 0.1}, {0, 0, 0}};
    return scene;
}

class Run {
public:
    Run(brume_context context, Shot &shot, Json scene, const Json &effects, const Names &layers) : context_(context)
    {
        const size_t lights = scene["lights"].size();
        scene["effects"] = effects;
        const std::string text = scene.dump();
        Context::check(brume_scene_create_from_text(context, text.data(), text.size(), "bench.json", &scene_), context);
        const std::pair<const char *, Picture *> known[] = {{"normal", &shot.normal},
                                                            {"albedo", &shot.albedo},
                                                            {"specular", &shot.specular},
                                                            {"roughness", &shot.roughness},
                                                            {"light_group", &shot.group}};
        std::vector<brume_layer> named;
        for (auto &[name, picture] : known)
            if (std::find(layers.begin(), layers.end(), name) != layers.end()) {
                named.push_back(layer(name));
                for (uint32_t l = 0; l < (std::string(name) == "light_group" ? lights : 1); ++l)
                    given_.push_back(layer(name, &images_.emplace_back(describe(*picture)), l));
            }
        brume_format format = BRUME_FORMAT_INIT;
        format.width = shot.color.width;
        format.height = shot.color.height;
        format.inputs = named.data();
        format.input_count = uint32_t(named.size());
        Context::check(brume_plan_create(scene_, &format, &plan_), context);
        frame_.color = &images_.emplace_back(describe(shot.color));
        frame_.depth = &images_.emplace_back(describe(shot.depth));
        frame_.output = &images_.emplace_back(describe(shot.output));
        frame_.inputs = given_.data();
        frame_.input_count = uint32_t(given_.size());
    }
    ~Run()
    {
        brume_plan_destroy(plan_);
        brume_scene_destroy(scene_);
    }
    Run(const Run &) = delete;

    void execute()
    {
        Context::check(brume_plan_execute(plan_, &frame_), context_);
        brume_plan_info info = BRUME_PLAN_INFO_INIT;
        brume_plan_get_info(plan_, &info);
        double total = 0;
        for (uint32_t e = 0; e < info.entry_count; ++e) {
            brume_plan_entry entry = BRUME_PLAN_ENTRY_INIT;
            brume_plan_get_entry(plan_, e, &entry);
            total += entry.runs ? entry.measured_ms : 0;
        }
        times_.push_back(total);
    }
    double median()
    {
        std::sort(times_.begin(), times_.end());
        return times_[times_.size() / 2];
    }
    void forget() { times_.clear(); }

private:
    brume_context context_;
    brume_scene scene_ = nullptr;
    brume_plan plan_ = nullptr;
    std::deque<brume_image> images_;
    std::vector<brume_layer> given_;
    brume_frame frame_ = BRUME_FRAME_INIT;
    std::vector<double> times_;
};

}  // namespace

int main(int argc, char **argv)
{
    if (argc != 1 && argc != 3) {
        fprintf(stderr, "usage: surface_bench [WIDTH HEIGHT]\n");
        return 2;
    }
    Shot shot(argc == 3 ? atoi(argv[1]) : 1920, argc == 3 ? atoi(argv[2]) : 1080);
    const std::pair<const char *, Names> variants[] = {
        {"depth alone", {}},
        {"normals", {"normal"}},
        {"normals, albedo", {"normal", "albedo"}},
        {"normals, light groups", {"normal", "light_group"}},
        {"normals, light groups, materials", {"normal", "albedo", "specular", "roughness", "light_group"}}};
    printf("| %d x %d: on | lights | layers | surface ms | multiscatter ms | times |\n"
           "| --- | --- | --- | ---: | ---: | ---: |\n",
           shot.color.width, shot.color.height);
    std::vector<std::pair<const char *, brume_context>> devices{{"CPU", cpu()}};
    if (gl())
        devices.push_back({"OpenGL", *gl()});
    const std::pair<const char *, Json> scenes[] = {{"four lamps", four_lamps()}, {"sun and sky", sun_and_sky()}};
    for (auto &[device, context] : devices)
        for (auto &[lights, scene] : scenes)
            for (auto &[name, layers] : variants) {
                Run filter(context, shot, scene, {{"multiscatter", Json::object()}}, {});
                Run surface(context, shot, scene, {{"surface", Json::object()}}, layers);
                for (int round = 0; round < 6; ++round) {
                    filter.execute();
                    surface.execute();
                    if (round == 0) {
                        filter.forget();
                        surface.forget();
                    }
                }
                const double a = surface.median(), b = filter.median();
                printf("| %s | %s | %s | %.3g | %.3g | %.2f |\n", device, lights, name, a, b, a / b);
                fflush(stdout);
            }
}
