#include "bench/report.hpp"

#include <cmath>
#include <fstream>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/baselines.hpp"
#include "support/error.hpp"
#include "support/pending_file.hpp"

namespace brume::tool {
namespace {

using nlohmann::ordered_json;

ordered_json number(double v)
{
    return std::isfinite(v) ? ordered_json(v) : ordered_json(nullptr);
}

ordered_json json_of(const std::optional<Metrics> &m)
{
    if (!m)
        return nullptr;
    return {{"error", number(error_of(*m))},
            {"rel_mse", number(m->relative_mse)},
            {"log2_rms", number(m->log2_rms)},
            {"energy", number(m->energy)}};
}

ordered_json json_of(const Row &row)
{
    ordered_json parameters = ordered_json::object();
    for (const auto &[name, value] : row.setting.parameters)
        parameters[name] = value;
    ordered_json out{{"name", row.setting.name}, {"kind", name_of(row.setting.kind)}, {"parameters", parameters}};
    if (!row.refusal.empty()) {
        out["refused"] = row.refusal;
        return out;
    }
    out["ms"] = number(row.ms);
    out["copies"] = number(row.copies);
    out["against"] = json_of(row.errors);
    out["on_front"] = {{"reference", row.on_reference_front}, {"truth", row.on_truth_front}};
    return out;
}

std::string cells_of(const std::optional<Metrics> &m)
{
    return m ? fmt::format("{:.3g} | {:.3g} | {:.3f}", error_of(*m), m->log2_rms, m->energy) : " | | ";
}

std::string cells_of(const Errors &errors)
{
    return cells_of(errors.reference) + " | " + cells_of(errors.truth);
}

std::string table_of(const Group &group)
{
    std::string text =
        "| # | setting | kind | ms | x a copy | error against the reference | log2 RMS | energy | error against truth | "
        "log2 RMS | energy | on the front of |\n"
        "| ---: | --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | --- |\n";
    std::map<std::string, std::string> reasons;
    for (std::size_t i = 0; i < group.rows.size(); ++i) {
        const Row &row = group.rows[i];
        text += fmt::format("| {} | {} | {} | ", i + 1, row.setting.name, name_of(row.setting.kind));
        if (!row.refusal.empty()) {
            text += "refused | | | | | | | | |\n";
            reasons[row.refusal] += (reasons[row.refusal].empty() ? "" : "; ") + row.setting.name;
            continue;
        }
        const char *front = row.on_reference_front && row.on_truth_front ? "both"
                            : row.on_reference_front                     ? "reference"
                            : row.on_truth_front                         ? "truth"
                                                                         : "";
        text += fmt::format("{:.3g} | {:.3g} | {} | {} |\n", row.ms, row.copies, cells_of(row.errors), front);
    }
    text += fmt::format("| | without fog | | | | {} | |\n", cells_of(group.without_fog));
    for (const auto &[reason, names] : reasons)
        text += fmt::format("\nRefused: {}: {}.\n", names, reason);
    return text;
}

}  // namespace

BenchReport report_for(const Context &context, const SceneText &scene, const Sample &sample, const BenchOptions &options)
{
    const brume_context_info info = context.info();
    BenchReport report;
    report.scene = scene.name;
    report.frame = sample.name;
    report.backend = backend_name(info.backend);
    report.device = info.device ? info.device : "";
    report.threads = info.threads;
    report.width = sample.width();
    report.height = sample.height();
    report.repeat = options.repeat;
    return report;
}

ordered_json json_of(const Errors &errors)
{
    return {{"reference", json_of(errors.reference)}, {"truth", json_of(errors.truth)}};
}

ordered_json json_of(const Group &group)
{
    ordered_json rows = ordered_json::array();
    for (const Row &row : group.rows)
        rows.push_back(json_of(row));
    return {{"effect", group.effect},
            {"reference",
             {{"width", group.reference_width},
              {"height", group.reference_height},
              {"ms", number(group.reference_ms)},
              {"against_truth", json_of(group.reference_truth)}}},
            {"without_fog", {{"against", json_of(group.without_fog)}}},
            {"settings", rows}};
}

ordered_json json_of(const BenchReport &report)
{
    ordered_json effects = ordered_json::array();
    for (const Group &group : report.groups)
        effects.push_back(json_of(group));
    return {{"scene", report.scene},
            {"frame", report.frame},
            {"backend", report.backend},
            {"device", report.device},
            {"threads", report.threads},
            {"width", report.width},
            {"height", report.height},
            {"repeat", report.repeat},
            {"copy_ms", number(report.copy_ms)},
            {"median_optical_depth", number(report.median_optical_depth)},
            {"effects", effects}};
}

std::string markdown_of(const BenchReport &report)
{
    std::string text =
        fmt::format("{}, {}: {} x {} on {} ({}, {} threads). Times are medians of {}; a copy of the image takes "
                    "{:.3g} ms. Median optical depth {:.3g}.\n",
                    report.scene, report.frame, report.width, report.height, report.backend, report.device, report.threads,
                    report.repeat, report.copy_ms, report.median_optical_depth);
    for (const Group &g : report.groups) {
        text += fmt::format("\n{}: the reference took {:.3g} ms; errors against it are at {} x {}", g.effect, g.reference_ms,
                            g.reference_width, g.reference_height);
        text += g.reference_truth ? fmt::format(", its own against truth is {:.3g} there.\n\n", error_of(*g.reference_truth))
                                  : ".\n\n";
        text += table_of(g);
    }
    text += "\nBaselines, on the CPU:";
    for (const Baseline &b : baselines())
        text += fmt::format("{} {}: {}", &b == &baselines().front() ? "" : ";", b.name, b.what);
    return text + ".\n";
}

ChartPanel panel_of(const Group &group, const std::string &title, std::optional<Metrics> Errors::*metrics)
{
    ChartPanel panel{title, "time / that of a copy of the image", "error (square root of relMSE)", {}, {}};
    if (group.without_fog.*metrics)
        panel.without_fog = error_of(*(group.without_fog.*metrics));
    for (std::size_t i = 0; i < group.rows.size(); ++i)
        if (const Row &row = group.rows[i]; row.errors.*metrics)
            panel.points.push_back({int(i) + 1, row.setting.kind, row.copies, error_of(*(row.errors.*metrics))});
    return panel;
}

std::vector<ChartKey> keys_of(const Group &group)
{
    std::vector<ChartKey> keys;
    for (const Row &row : group.rows)
        keys.push_back({int(keys.size()) + 1, row.setting.kind, row.setting.name, row.refusal.empty()});
    return keys;
}

Chart chart_of(const BenchReport &report)
{
    Chart chart{fmt::format("{}, {} on {} ({})", std::filesystem::path(report.scene).filename().string(),
                            std::filesystem::path(report.frame).filename().string(), report.backend, report.device),
                {}};
    for (const Group &g : report.groups) {
        ChartSection section{g.effect, {}, {}};
        section.panels.push_back(panel_of(
            g, fmt::format("against the reference, at {} x {}", g.reference_width, g.reference_height), &Errors::reference));
        if (ChartPanel truth = panel_of(g, "against path-traced truth", &Errors::truth); !truth.points.empty())
            section.panels.push_back(std::move(truth));
        section.keys = keys_of(g);
        chart.sections.push_back(std::move(section));
    }
    return chart;
}

void write_text(const std::filesystem::path &file, const std::string &text)
{
    PendingFile pending(file);
    std::ofstream stream(pending.path());
    stream << text;
    stream.close();
    if (!stream)
        throw FrameError(fmt::format("{}: cannot be written", file.string()));
    pending.commit();
}

}  // namespace brume::tool
