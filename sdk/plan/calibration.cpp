#include "plan/calibration.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "effects/parameters.h"
#include "plan/context.h"
#include "plan/plan.h"

namespace brume {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds most_time(14);  // after which nothing more is begun
constexpr int rounds = 3;

// For effects that name no scenes of their own: one of each kind of density.
const std::vector<std::string> usual_scenes = {
    R"({"brume":1,"camera":{"vertical_fov":50,"camera_to_world":[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]},
        "medium":{"scattering":[0.03,0.035,0.04],"absorption":0.002,"g":0.8},
        "lights":[{"type":"point","position":[2,1,-12],"intensity":40,"radius":0.1},
                  {"type":"point","position":[-4,2,-20],"intensity":40,"radius":0.1}]})",
    R"({"brume":1,"camera":{"vertical_fov":50,"camera_to_world":[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]},
        "medium":{"scattering":0.03,"density":[{"type":"exponential","value":1,"falloff":0.2}]},
        "lights":[{"type":"point","position":[2,1,-12],"intensity":40,"radius":0.1}]})",
    R"({"brume":1,"camera":{"vertical_fov":50,"camera_to_world":[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]},
        "medium":{"scattering":0.05,"g":0.3,"density":[{"type":"constant","value":0.2},
          {"type":"gaussian","center":[0,0,-10],"scale":0.3,"amplitude":2},{"type":"gaussian","center":[5,1,-15],"scale":0.2,"amplitude":2},
          {"type":"gaussian","center":[-6,0,-18],"scale":0.25,"amplitude":2},{"type":"gaussian","center":[2,-2,-8],"scale":0.5,"amplitude":2}]},
        "lights":[{"type":"point","position":[2,1,-12],"intensity":40,"radius":0.1}]})"};

// The second so much larger that what a pass takes at its start and what it takes an operation can be told apart.
constexpr std::pair<int, int> sizes[] = {{96, 54}, {320, 180}};

// A floor that recedes under a sky, boxes on it, and lamps. Layers have one value, which may be a direction or a share.
struct TestFrame {
    std::vector<float> color, depth, output, layer;
    brume_image images[4];
    brume_frame frame = BRUME_FRAME_INIT;

    TestFrame(int width, int height)
        : color(size_t(width) * size_t(height) * 4, 0.2f), depth(size_t(width) * size_t(height)), output(color.size()),
          layer(color.size(), 0.577f)
    {
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const float below = (float(y) + 0.5f) / float(height) - 0.4f;
                const bool box = (x * 16 / width) % 5 == 1 && below > -0.2f;
                const size_t i = size_t(y) * size_t(width) + size_t(x);
                depth[i] = box ? 6.0f : below > 0.02f ? 3 / below : INFINITY;
                if ((x * 40 / width) % 7 == 2 && (y * 24 / height) % 6 == 3)
                    std::fill_n(color.begin() + ptrdiff_t(4 * i), 3, 60.0f);
            }
        float *const data[] = {color.data(), depth.data(), output.data(), layer.data()};
        for (int i = 0; i < 4; ++i) {
            images[i] = BRUME_IMAGE_INIT;
            images[i].width = width;
            images[i].height = height;
            images[i].channels = i == 1 ? 1 : 4;
            images[i].data = data[i];
        }
        frame.color = &images[0];
        frame.depth = &images[1];
        frame.output = &images[2];
    }
    TestFrame(const TestFrame &) = delete;
};

struct Sample {
    double operations, ms;
};

using Samples = std::map<std::pair<std::string, std::string>, std::vector<Sample>>;  // by effect and pass

// What is measured: an effect alone, with some parameters and layers, so that what others take is not measured for each.
struct Case {
    size_t offer = 0, place = 0;  // among the effect's offers and scenes
    Scene scene;
    std::vector<const Layer *> layers;
};

Format format_of(const Case &of, int width, int height)
{
    brume_format plain = BRUME_FORMAT_INIT;
    plain.width = width;
    plain.height = height;
    Format format(plain);
    for (const Layer *layer : of.layers)
        format.input_layers.push_back({layer->name, 0});
    return format;
}

void measure(const std::shared_ptr<Context> &context, const Case &of, TestFrame &test, Clock::time_point end,
             Samples &samples)
{
    std::vector<brume_layer> layers;
    for (const Layer *layer : of.layers)
        for (uint32_t light = 0; light < (layer->flags & BRUME_LAYER_OF_LIGHT ? of.scene.lights.size() : 1); ++light)
            layers.push_back({sizeof(brume_layer), 0, layer->name.c_str(), &test.images[3], light, 0});
    test.frame.inputs = layers.data();
    test.frame.input_count = uint32_t(layers.size());
    brume_host_t plan(context, of.scene, format_of(of, test.images[0].width, test.images[0].height));
    std::vector<double> least(plan.entries().size(), INFINITY);
    for (int round = 0; round < rounds && (round == 0 || Clock::now() < end); ++round) {
        plan.execute(test.frame);
        const std::vector<double> ms = plan.measured_ms();
        // What runs when something moved alone took no time in the others.
        for (size_t i = 0; i < ms.size(); ++i)
            if (ms[i] > 0)
                least[i] = std::min(least[i], ms[i]);
    }
    for (size_t i = 0; i < least.size(); ++i) {
        const PlanEntry &entry = plan.entries()[i];
        if (entry.runs && entry.operations > 0 && least[i] > 0 && std::isfinite(least[i]))
            samples[{entry.effect, entry.name}].push_back({double(entry.operations), least[i]});
    }
}

bool keeps(const EffectSettings &asked, const Effect &effect, const Offer &offer)
{
    return std::all_of(asked.parameters.begin(), asked.parameters.end(), [&](const auto &parameter) {
        return offer.parameters[find_parameter(effect, parameter.first)] == parameter.second;
    });
}

// Of one effect in one scene: with each of its offers that leave what the scene sets, or else as the scene sets it.
void add_cases(const std::shared_ptr<Context> &context, const Effect &effect, Case of, std::vector<Case> &all)
{
    const brume_host_t open(context, of.scene, format_of(of, sizes[0].first, sizes[0].second), Purpose::rehearsal);
    if (open.does_nothing())
        return;
    const EffectSettings asked = of.scene.effects[0];
    const size_t before = all.size();
    const std::vector<Offer> &offers = open.effects()[0].offers;
    for (of.offer = 0; of.offer < offers.size(); ++of.offer) {
        const Offer &offer = offers[of.offer];
        if (offer.error == 0 || !keeps(asked, effect, offer))
            continue;
        for (size_t i = 0; i < effect.parameters.size(); ++i)
            of.scene.effects[0].parameters[effect.parameters[i].name] = offer.parameters[i];
        all.push_back(of);
    }
    if (all.size() > before)
        return;
    of.offer = 0;
    of.scene.effects[0] = asked;
    all.push_back(std::move(of));
}

// Of each effect, with the layers that it needs, then with all of the frame's size that it reads. Cheap ones first, and of
// these the first of every effect.
std::vector<Case> cases(const std::shared_ptr<Context> &context)
{
    std::vector<Case> all;
    for (const Effect &effect : context->effects.all()) {
        if (!effect.refusal.empty())
            continue;
        const auto layers = [&](bool needed) {
            std::vector<const Layer *> some;
            for (const Layer &layer : effect.layers)
                if (layer.flags & BRUME_LAYER_INPUT && !(layer.flags & BRUME_LAYER_ANY_SIZE) &&
                    (!needed || layer.flags & BRUME_LAYER_NEEDED))
                    some.push_back(&layer);
            return some;
        };
        const auto needed = layers(true), read = layers(false);
        const std::vector<std::string> &texts = effect.scenes.empty() ? usual_scenes : effect.scenes;
        for (size_t place = 0; place < texts.size(); ++place)
            for (const auto *given : {&needed, &read}) {
                if (given == &read && read == needed)
                    continue;
                // One effect that cannot be planned, a stranger's say, is no reason not to measure the others.
                try {
                    Case of{0, place, parse_scene(texts[place], effect.name + ", scene to calibrate with", context->effects),
                            *given};
                    std::erase_if(of.scene.effects, [&](const EffectSettings &s) { return s.name != effect.name; });
                    if (of.scene.effects.empty())
                        of.scene.effects.push_back({effect.name, {}});
                    of.scene.effects_named = true;
                    add_cases(context, effect, std::move(of), all);
                } catch (const Error &error) {
                    context->log(BRUME_LOG_WARNING, fmt::format("calibration: {}", error.what()));
                }
            }
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const Case &a, const Case &b) { return std::tie(a.offer, a.place) < std::tie(b.offer, b.place); });
    return all;
}

// The line through two samples, or through one without a start, that all of them are nearest to as ratios.
Rate fit(const std::vector<Sample> &samples)
{
    Rate best;
    double least = INFINITY;
    auto consider = [&](Rate rate) {
        if (rate.start_ms < 0 || rate.ms_per_operation < 0)
            return;
        double miss = 0;
        for (const Sample &s : samples)
            miss += std::abs(std::log((rate.start_ms + s.operations * rate.ms_per_operation) / s.ms));
        if (miss < least) {
            least = miss;
            best = rate;
        }
    };
    for (const Sample &a : samples) {
        consider({0, a.ms / a.operations});
        for (const Sample &b : samples)
            if (a.operations < b.operations) {
                const double slope = (b.ms - a.ms) / (b.operations - a.operations);
                consider({a.ms - slope * a.operations, slope});
            }
    }
    return best;
}

}  // namespace

void calibrate(const std::shared_ptr<Context> &context)
{
    const auto end = Clock::now() + most_time;
    Samples samples;
    TestFrame small(sizes[0].first, sizes[0].second), large(sizes[1].first, sizes[1].second);
    const std::vector<Case> measured_cases = cases(context);
    Progress &progress = context->progress;
    const double parts = 2 * double(measured_cases.size());
    double part = 0;
    for (const Case &of : measured_cases)
        for (TestFrame *test : {&small, &large}) {
            if (Clock::now() >= end)
                break;
            progress.enter_part(part / parts, (part + 1) / parts);
            try {
                measure(context, of, *test, end, samples);
            } catch (const Error &error) {
                if (error.status() != BRUME_ERROR_PLUGIN && error.status() != BRUME_ERROR_UNSUPPORTED)
                    throw;
                context->log(BRUME_LOG_WARNING, fmt::format("calibration: {}", error.what()));
            }
            ++part;
            progress.report(1);
            progress.throw_if_cancelled();
        }
    Rates rates;
    for (const auto &[pass, measured] : samples)
        rates.set(pass.first, pass.second, fit(measured));
    context->rates = rates;
}

}  // namespace brume
