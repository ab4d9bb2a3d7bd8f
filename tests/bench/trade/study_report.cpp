#include "study_report.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

using namespace brume::tool;

namespace trade {
namespace {

using nlohmann::ordered_json;

ordered_json json_of(const Study &study)
{
    ordered_json sets = ordered_json::array(), limits = ordered_json::array();
    for (const SetResult &set : study.sets) {
        ordered_json pictures = ordered_json::array(), means = ordered_json::array();
        for (const BenchReport &report : set.pictures)
            pictures.push_back(brume::tool::json_of(report));
        for (const auto &[device, group] : set.means)
            means.push_back({{"device", device}, {"means", brume::tool::json_of(group)}});
        sets.push_back({{"set", set.name}, {"effect", set.effect}, {"devices", means}, {"pictures", pictures}});
    }
    for (const Limit &l : study.limits)
        limits.push_back({{"scene", l.scene},
                          {"median_optical_depth", l.optical_depth},
                          {"g", l.g},
                          {"error",
                           {{"without_fog", l.without_fog},
                            {"multiscatter", l.filter},
                            {"airlight", l.lights_once},
                            {"both", l.both},
                            {"half_of_whole", l.half_of_whole},
                            {"half_alone", l.half_alone}}}});
    return {{"seed", study.seed}, {"quick", study.quick}, {"sets", sets}, {"limits", limits}};
}

std::string cell(const std::optional<Metrics> &m)
{
    return m ? fmt::format(" {:.2g} |", error_of(*m)) : " |";
}

// "llvmpipe (LLVM 15.0.6, 256 bits)" is llvmpipe.
std::string short_name(const std::string &device)
{
    return device.substr(0, device.find_first_of(", ("));
}

std::string head_of(const SetResult &set, bool truth)
{
    std::string names = "| # | setting | error against the reference |", rule = "| ---: | --- | ---: |";
    const auto add = [&](const std::string &name) {
        names += " " + name + " |";
        rule += " ---: |";
    };
    if (truth)
        add("against truth");
    for (const auto &[device, group] : set.means)
        add("copies on " + short_name(device));
    return names + " front |\n" + rule + " --- |\n";
}

// On every device, whose times differ: "reference" where no device has anything better in both.
std::string front_of(const SetResult &set, std::size_t row)
{
    bool reference = true, truth = true;
    for (const auto &[device, group] : set.means) {
        reference &= group.rows[row].on_reference_front;
        truth &= group.rows[row].on_truth_front;
    }
    return reference && truth ? "both" : reference ? "reference" : truth ? "truth" : "";
}

// On a front on some device, a baseline or the default.
bool matters(const SetResult &set, std::size_t row)
{
    bool matters = row == 0;
    for (const auto &[device, group] : set.means) {
        const Row &r = group.rows[row];
        matters |= r.on_reference_front || r.on_truth_front || r.setting.kind == Kind::kBaseline;
    }
    return matters;
}

std::string table_of(const SetResult &set, bool all_rows)
{
    const Group &first = set.means.front().second;
    const bool truth = first.without_fog.truth.has_value();
    std::string text = head_of(set, truth), refused;
    for (std::size_t i = 0; i < first.rows.size(); ++i) {
        const Row &row = first.rows[i];
        if (!row.refusal.empty()) {
            refused += (refused.empty() ? "" : "; ") + row.setting.name;
            continue;
        }
        if (!all_rows && !matters(set, i))
            continue;
        text += fmt::format("| {} | {} |", i + 1, row.setting.name) + cell(row.errors.reference);
        if (truth)
            text += cell(row.errors.truth);
        for (const auto &[device, group] : set.means)
            text += fmt::format(" {:.3g} |", group.rows[i].copies);
        text += fmt::format(" {} |\n", front_of(set, i));
    }
    text += "| | without fog |" + cell(first.without_fog.reference) + (truth ? cell(first.without_fog.truth) : "");
    for (std::size_t d = 0; d < set.means.size(); ++d)
        text += " |";
    text += " |\n";
    if (!refused.empty())
        text += fmt::format("\nRefused here: {}.\n", refused);
    return text;
}

std::string sentence_of(const SetResult &set)
{
    const Group &first = set.means.front().second;
    std::string text = fmt::format("{}, {}: {} of {} x {} pixels; the reference at {} x {}", set.effect, set.name,
                                   set.pictures.size() / set.means.size(), set.pictures.front().width,
                                   set.pictures.front().height, first.reference_width, first.reference_height);
    if (first.reference_truth)
        text += fmt::format(", its own error against truth {:.2g}", error_of(*first.reference_truth));
    return text + ".\n";
}

std::string limits_table(const std::vector<Limit> &limits)
{
    std::string text =
        "| scene | median optical depth | g | without fog | filter | lights, scattered once | both | half of the "
        "picture | that half alone |\n| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n";
    for (const Limit &l : limits)
        text +=
            fmt::format("| {} | {:.2g} | {:.2g} | {:.2g} | {:.2g} | {:.2g} | {:.2g} | {:.2g} | {:.2g} |\n", l.scene,
                        l.optical_depth, l.g, l.without_fog, l.filter, l.lights_once, l.both, l.half_of_whole, l.half_alone);
    return text;
}

// Each effect's first two sets: what the plot shows, and what docs/accuracy.md quotes.
std::vector<const SetResult *> shown(const Study &study)
{
    std::vector<const SetResult *> sets;
    for (const SetResult &set : study.sets)
        if (std::count_if(sets.begin(), sets.end(), [&](const SetResult *s) { return s->effect == set.effect; }) < 2)
            sets.push_back(&set);
    return sets;
}

std::string devices_of(const Study &study)
{
    std::string names;
    for (const auto &[device, group] : study.sets.front().means)
        names += (names.empty() ? "" : "; ") + device;
    return fmt::format("Devices: {}. Random pictures of seed {}{}.\n\n", names, study.seed,
                       study.quick ? "; a quick run" : "");
}

std::string markdown_of(const Study &study, bool all)
{
    std::string text = devices_of(study);
    std::vector<const SetResult *> sets = shown(study);
    if (all) {
        sets.clear();
        for (const SetResult &set : study.sets)
            sets.push_back(&set);
    }
    for (const SetResult *set : sets)
        text += sentence_of(*set) + "\n" + table_of(*set, all) + "\n";
    if (!study.limits.empty())
        text += "Errors against truth by scene:\n\n" + limits_table(study.limits);
    return text;
}

// One column for each device.
Chart chart_of(const Study &study)
{
    Chart chart{"Error against time", {}};
    for (const SetResult *set : shown(study)) {
        const bool truth = set->means.front().second.without_fog.truth.has_value();
        if (chart.sections.empty() || chart.sections.back().title != set->effect)
            chart.sections.push_back({set->effect, {}, keys_of(set->means.front().second)});
        ChartSection &section = chart.sections.back();
        for (const auto &[device, group] : set->means)
            section.panels.push_back(
                panel_of(group, fmt::format("{}, {}: {}", set->name, truth ? "truth" : "reference", short_name(device)),
                         truth ? &Errors::truth : &Errors::reference));
    }
    return chart;
}

}  // namespace

void write_study(const std::string &folder, const Study &study)
{
    write_text(folder + "/trade.json", json_of(study).dump(1) + "\n");
    write_text(folder + "/trade.md", markdown_of(study, true));
    write_text(folder + "/trade_short.md", markdown_of(study, false));
    for (const char *ending : {".svg", ".png"})
        draw_chart(folder + "/trade" + ending, chart_of(study));
}

}  // namespace trade
