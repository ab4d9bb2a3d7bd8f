#include "bench/measure.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <memory>
#include <numbers>

#include <nlohmann/json.hpp>

#include "bench/baselines.hpp"
#include "bench/pareto.hpp"
#include "bench/run_setting.hpp"
#include "support/error.hpp"
#include "support/memory.hpp"

namespace brume::tool {
namespace {

/// References begin at no more than this width.
constexpr int kSmallestReference = 32;

template <class Work> double milliseconds(const Work &work)
{
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values)
{
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

template <class Work> double median_of(int repeat, const Work &work)
{
    std::vector<double> times;
    for (int i = 0; i < repeat; ++i)
        times.push_back(work());
    return median(std::move(times));
}

std::vector<float> optical_depths(const Context &context, const SceneText &scene, const Sample &sample)
{
    std::vector<float> tau(sample.depth.size());
    // Without a medium nothing fills the layer; effects of others may run all the same.
    const auto json = nlohmann::json::parse(scene.text, nullptr, false);
    if (!json.is_object() || !json.contains("medium"))
        return tau;
    SettingRun run(context, scene, nullptr, sample, "optical_depth");
    run.execute();
    for (std::size_t i = 0; i < tau.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c)
            tau[i] += float(sample.weights[c]) * run.extra()[3 * i + c];
    return tau;
}

/// Half the image's height over the image plane's distance, where the picture or the scene says it; else what one without a
/// camera is taken to have.
double half_height(const SceneText &scene, const Sample &sample)
{
    if (sample.camera.given & BRUME_CAMERA_FIELD_OF_VIEW)
        return std::tan(sample.camera.vertical_fov / 2);
    const auto json = nlohmann::json::parse(scene.text, nullptr, false);
    const auto camera = json.is_object() ? json.value("camera", nlohmann::json::object()) : nlohmann::json::object();
    const auto half = [&](const char *key) {
        const auto found = camera.find(key);
        return found != camera.end() && found->is_number() ? std::tan(found->get<double>() * std::numbers::pi / 360) : 0;
    };
    const double vertical = half("vertical_fov"), horizontal = half("horizontal_fov") * sample.height() / sample.width();
    return vertical > 0 ? vertical : horizontal > 0 ? horizontal : 0.5;
}

BaselineInput baseline_input(const Context &context, const SceneText &scene, const Sample &sample)
{
    std::vector<float> values = optical_depths(context, scene, sample);
    std::transform(values.begin(), values.end(), values.begin(), [](float tau) { return std::exp(-tau); });
    return {picture_of(sample.color, sample.width(), sample.height(), sample.channels), std::move(values),
            0.5 * sample.height() / half_height(scene, sample)};
}

Errors errors_of(const Sample &sample, const Reference &reference, const Picture &full, const Picture &small)
{
    Errors errors{measure(small, reference.image, sample.weights), {}};
    if (sample.truth)
        errors.truth = measure(full, *sample.truth, sample.weights);
    return errors;
}

/// Plans whose images fit in memory together take turns, so that what else the machine does meets all alike.
class Turns {
public:
    explicit Turns(int repeat) : repeat_(repeat), most_bytes_(memory_of_machine() / 4) {}

    void add(Row &row, std::unique_ptr<SettingRun> run)
    {
        bytes_ += run->bytes();
        waiting_.push_back({&row, std::move(run), {}});
        if (bytes_ > most_bytes_)
            take();
    }

    void take()
    {
        for (int i = 0; i < repeat_; ++i)
            for (Entry &entry : waiting_)
                entry.ms.push_back(entry.run->execute());
        for (Entry &entry : waiting_)
            entry.row->ms = median(std::move(entry.ms));
        waiting_.clear();
        bytes_ = 0;
    }

private:
    struct Entry {
        Row *row;
        std::unique_ptr<SettingRun> run;
        std::vector<double> ms;
    };
    int repeat_;
    std::uint64_t most_bytes_, bytes_ = 0;
    std::vector<Entry> waiting_;
};

void measure_settings(const Context &context, const SceneText &scene, const Sample &sample, const Reference &reference,
                      int repeat, std::vector<Row> &rows)
{
    Turns turns(repeat);
    for (Row &row : rows)
        try {
            auto run = std::make_unique<SettingRun>(context, scene, &row.setting, sample);
            run->execute();
            SettingRun small(context, scene, &row.setting, reference.sample);
            small.execute();
            row.errors = errors_of(sample, reference, run->picture(), small.picture());
            turns.add(row, std::move(run));
        } catch (const RequestError &e) {
            row.refusal = e.what();
        }
    turns.take();
}

Row measure_baseline(const BaselineInput &full, const BaselineInput &small, const Baseline &baseline, const Sample &sample,
                     const Reference &reference, int repeat)
{
    Row row;
    row.setting = {reference.effect, baseline.name, Kind::kBaseline, {}};
    Picture out = full.image, small_out = small.image;
    baseline.apply(full, out);
    row.ms = median_of(repeat, [&] { return milliseconds([&] { baseline.apply(full, out); }); });
    baseline.apply(small, small_out);
    row.errors = errors_of(sample, reference, out, small_out);
    return row;
}

}  // namespace

double error_of(const Metrics &metrics)
{
    return std::sqrt(metrics.relative_mse);
}

std::vector<std::string> effects_to_measure(const Context &context, const SceneText &scene, const Sample &sample)
{
    const SettingRun run(context, scene, nullptr, sample);
    std::vector<std::string> effects;
    for (const brume_effect_info &effect : context.effects())
        if (!effect.refusal && run.runs(effect.name))
            effects.push_back(effect.name);
    return effects;
}

double copy_ms(const Sample &sample, int repeat)
{
    // Together larger than any cache.
    const std::size_t bytes = sample.color.size() * sizeof(float), count = (std::size_t(256) << 20) / bytes / 2 + 1;
    const std::vector<std::vector<float>> from(count, sample.color);
    std::vector<std::vector<float>> to(from);
    return median_of(repeat, [&] {
        return milliseconds([&] {
                   for (std::size_t i = 0; i < count; ++i)
                       std::memcpy(to[i].data(), from[i].data(), bytes);
               }) /
               double(count);
    });
}

double median_optical_depth(const Context &context, const SceneText &scene, const Sample &sample)
{
    const std::vector<float> tau = optical_depths(context, scene, sample);
    return median({tau.begin(), tau.end()});
}

Reference make_reference(const Context &cpu, const SceneText &scene, const Sample &sample, const std::string &effect,
                         const BenchOptions &options)
{
    const Setting setting = reference_of(cpu, effect);
    const auto at = [&](int factor) {
        Reference r{effect, factor == 1 ? sample : reduced(sample, factor), {}, 0};
        SettingRun run(cpu, scene, &setting, r.sample);
        r.ms = milliseconds([&] { run.execute(); });
        r.image = run.picture();
        return r;
    };
    int factor = 1;
    if (options.reference_width > 0) {
        while (sample.width() / factor > options.reference_width)
            factor *= 2;
        return at(factor);
    }
    while (sample.width() / factor > kSmallestReference && std::min(sample.width(), sample.height()) / factor > 1)
        factor *= 2;
    Reference best = at(factor);
    // Time grows with the pixels, or with their square where each takes from all.
    double growth = 16;
    while (factor > 1 && best.ms * growth < 1000 * options.reference_seconds) {
        const double before = best.ms;
        factor /= 2;
        best = at(factor);
        growth = std::clamp(best.ms / before, 4.0, 16.0);
    }
    return best;
}

Group measure_group(const Context &context, const SceneText &scene, const Sample &sample, const Reference &reference,
                    double copy, const BenchOptions &options)
{
    Group group;
    group.effect = reference.effect;
    group.reference_width = reference.sample.width();
    group.reference_height = reference.sample.height();
    group.reference_ms = reference.ms;
    if (reference.sample.truth)
        group.reference_truth = measure(reference.image, *reference.sample.truth, sample.weights);
    for (Setting &setting : settings_of(context, reference.effect))
        group.rows.emplace_back().setting = std::move(setting);
    measure_settings(context, scene, sample, reference, options.repeat, group.rows);
    const BaselineInput full = baseline_input(context, scene, sample),
                        small = baseline_input(context, scene, reference.sample);
    group.without_fog = errors_of(sample, reference, full.image, small.image);
    for (const Baseline &baseline : baselines())
        group.rows.push_back(measure_baseline(full, small, baseline, sample, reference, options.repeat));
    for (Row &row : group.rows)
        row.copies = row.ms / copy;
    mark_fronts(group.rows);
    return group;
}

void mark_fronts(std::vector<Row> &rows)
{
    const auto mark = [&](std::optional<Metrics> Errors::*error, bool Row::*flag) {
        std::vector<Cost> costs;
        for (const Row &row : rows)
            costs.push_back({row.ms, row.errors.*error ? error_of(*(row.errors.*error)) : NAN});
        for (const std::size_t i : pareto_front(costs))
            rows[i].*flag = true;
    };
    mark(&Errors::reference, &Row::on_reference_front);
    mark(&Errors::truth, &Row::on_truth_front);
}

}  // namespace brume::tool
