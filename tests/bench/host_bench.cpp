// host_bench: what the host takes of a frame beside the passes, on the CPU and in pictures of one pixel, with what stands
// still and with what moves (medians of 200); and what lights without a radius cost the filter beside airlight, at 480 x 270
// (the least of 25, by turns).
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <vector>

#include "fog.h"

using namespace fog;

namespace {

constexpr const char *one_gaussian =
    R"({"scattering": 0.03, "density": [{"type": "gaussian", "center": [0, 0, -9], "scale": 1}]})";

class Frames {
public:
    Frames(const char *medium, const char *effects, int width, int height)
        : color_(width, height, 4, 0.5f), depth_(width, height, 1, 20), output_(width, height, 4)
    {
        const std::string text =
            R"({"brume": 1, "camera": {"vertical_fov": 50, "camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}, "medium": )" +
            std::string(medium) + R"(, "effects": )" + effects + "}";
        check(brume_scene_create_from_text(cpu(), text.data(), text.size(), "bench.json", &scene_));
    }
    ~Frames()
    {
        brume_plan_destroy(plan_);
        brume_scene_destroy(scene_);
    }
    Frames(const Frames &) = delete;

    void set_lights(size_t count, double shift = 0)
    {
        lights_.resize(count);
        for (size_t i = 0; i < count; ++i) {
            lights_[i] = BRUME_LIGHT_INIT;
            const double at[] = {double(i % 8) - 4 + shift, 2, -4.0 - double(i % 90)};
            std::copy_n(at, 3, lights_[i].position);
        }
        check(brume_scene_set_lights(scene_, lights_.data(), uint32_t(count)));
    }
    void set_gaussians(size_t count, double scattering, double shift = 0, double absorption = 0)
    {
        gaussians_.resize(count);
        for (size_t i = 0; i < count; ++i) {
            gaussians_[i] = BRUME_GAUSSIAN_INIT;
            gaussians_[i].center[0] = double(i % 100) - 50 + shift;
            gaussians_[i].center[2] = -5.0 - double(i / 100);
        }
        brume_medium medium = BRUME_MEDIUM_INIT;
        std::fill_n(medium.scattering, 3, scattering);
        std::fill_n(medium.absorption, 3, absorption);
        medium.gaussians = gaussians_.data();
        medium.gaussian_count = uint32_t(count);
        check(brume_scene_set_medium(scene_, &medium));
    }
    void plan()
    {
        brume_format format = BRUME_FORMAT_INIT;
        format.width = color_.width;
        format.height = color_.height;
        format.depth_kind = BRUME_DEPTH_RAY;
        check(brume_plan_create(scene_, &format, &plan_));
    }
    void update() { check(brume_plan_update(plan_, scene_, nullptr)); }
    void execute(double camera_shift = 0)
    {
        const brume_image color = describe(color_), depth = describe(depth_), output = describe(output_);
        brume_camera camera = BRUME_CAMERA_INIT;
        camera.given = BRUME_CAMERA_POSE;
        camera.camera_to_world[3] = camera_shift;
        brume_frame frame = BRUME_FRAME_INIT;
        frame.color = &color;
        frame.depth = &depth;
        frame.output = &output;
        frame.camera = &camera;
        check(brume_plan_execute(plan_, &frame));
    }
    // Of the last frame, those of one effect or (NULL) all.
    double ms_of_passes(const char *effect = nullptr) const
    {
        brume_plan_info info = BRUME_PLAN_INFO_INIT;
        check(brume_plan_get_info(plan_, &info));
        double total = 0;
        for (uint32_t i = 0; i < info.entry_count; ++i) {
            brume_plan_entry entry = BRUME_PLAN_ENTRY_INIT;
            check(brume_plan_get_entry(plan_, i, &entry));
            total += entry.runs && (!effect || std::string(effect) == entry.effect) ? entry.measured_ms : 0;
        }
        return total;
    }

private:
    static void check(brume_status status) { Context::check(status, cpu()); }

    brume_scene scene_ = nullptr;
    brume_plan plan_ = nullptr;
    Picture color_, depth_, output_;
    std::vector<brume_light> lights_;
    std::vector<brume_gaussian> gaussians_;
};

double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

double ms_of(const std::function<void()> &work)
{
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    work();
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// frame: of this number, whatever an engine does for it.
void print_host(const char *what, const char *goal, Frames &frames, const std::function<void(int)> &frame)
{
    std::vector<double> host, passes;
    for (int i = 0; i < 220; ++i) {
        const double ms = ms_of([&] { frame(i); });
        if (i < 20)
            continue;
        passes.push_back(frames.ms_of_passes());
        host.push_back(ms - passes.back());
    }
    printf("| %s | %.4f | %.4f | %s |\n", what, median(host), median(passes), goal);
}

void print_moving_lights(const char *what, const char *medium)
{
    Frames frames(medium, R"({"multiscatter": {}, "airlight": {"orders": "single"}})", 1, 1);
    frames.set_lights(64);
    frames.plan();
    print_host(what, ".1", frames, [&](int i) {
        frames.set_lights(64, 0.01 * i);
        frames.update();
        frames.execute(0.02 * i);
    });
}

void print_host_times()
{
    printf("| the host's time of a frame | host ms | passes ms | goal ms |\n| --- | ---: | ---: | ---: |\n");
    const char *all = R"({"multiscatter": {}, "airlight": {}})";
    {
        Frames frames(R"({"emission": 0})", all, 1, 1);
        frames.set_lights(4096);
        frames.plan();
        print_host("4,096 lights stand still, nothing runs", ".02", frames, [&](int) { frames.execute(); });
    }
    {
        Frames frames(one_gaussian, all, 1, 1);
        frames.set_gaussians(10000, 0);
        frames.plan();
        print_host("10,000 Gaussians stand still, nothing runs", ".02", frames, [&](int) { frames.execute(); });
    }
    print_moving_lights("64 lights and the camera move", R"({"scattering": 0.03})");
    print_moving_lights("the same, airlight dropped", R"({"absorption": 0.03})");
    {
        // What was dropped is looked at anew with each medium.
        Frames frames(one_gaussian, all, 1, 1);
        frames.set_lights(64);
        frames.set_gaussians(10000, 0, 0, 0.03);
        frames.plan();
        std::vector<double> updates;
        print_host("10,000 Gaussians move and the medium's absorption changes, airlight dropped", "", frames, [&](int i) {
            frames.set_gaussians(10000, 0, 0.01 * i, 0.03 + 1e-4 * i);
            updates.push_back(ms_of([&] { frames.update(); }));
            frames.execute();
        });
        printf("| of that `brume_plan_update` | %.4f | | .05 |\n", median(updates));
    }
    {
        Frames frames(one_gaussian, R"({"multiscatter": {}})", 1, 1);
        frames.set_gaussians(10000, 0.03);
        frames.plan();
        print_host("10,000 Gaussians and the camera move", "", frames, [&](int i) {
            frames.set_gaussians(10000, 0.03, 0.01 * i);
            frames.update();
            frames.execute(0.02 * i);
        });
    }
}

// The least, for these are to tell apart by a few percent on busy machines.
void print_lights_without_radius()
{
    constexpr int rounds = 25, width = 480, height = 270;
    const char *medium = R"({"scattering": 0.03})",
               *effects = R"({"multiscatter": {}, "airlight": {"tier": "sun", "resolution": "quarter"}})";
    Frames none(medium, effects, width, height);
    none.plan();
    printf("\n| lights without a radius | filter ms | without lights ms | times |\n| ---: | ---: | ---: | ---: |\n");
    for (size_t count = 1; count <= 128; count *= 2) {
        Frames lit(medium, effects, width, height);
        lit.set_lights(count);
        lit.plan();
        std::vector<double> with, without;
        for (int i = 0; i < rounds; ++i) {
            none.execute();
            without.push_back(none.ms_of_passes("multiscatter"));
            lit.execute();
            with.push_back(lit.ms_of_passes("multiscatter"));
        }
        const double a = *std::min_element(with.begin(), with.end()), b = *std::min_element(without.begin(), without.end());
        printf("| %zu | %.1f | %.1f | %.2f |\n", count, a, b, a / b);
        fflush(stdout);
    }
}

}  // namespace

int main()
{
    print_host_times();
    print_lights_without_radius();
}
