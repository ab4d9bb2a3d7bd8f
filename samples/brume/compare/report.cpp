#include "compare/report.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace brume::tool {
namespace {

using nlohmann::ordered_json;

std::string channel_of(const Metrics &m)
{
    return std::string(1, "RGB"[m.max_channel]);
}

/// What --update did, notes, changed headers.
std::string remarks_of(const Comparison &c, const std::string &indent)
{
    std::string text;
    for (const std::string &note : c.notes)
        text += fmt::format("{}{}\n", indent, note);
    for (const std::string &line : c.header)
        text += fmt::format("{}header: {}\n", indent, line);
    if (!c.updated.empty())
        text += fmt::format("{}updated: {}\n", indent, c.updated);
    return text;
}

std::ptrdiff_t count_of(const std::vector<Comparison> &comparisons, std::string_view outcome)
{
    return std::count_if(comparisons.begin(), comparisons.end(),
                         [&](const Comparison &c) { return outcome_of(c) == outcome; });
}

ordered_json json_of(const Comparison &c)
{
    const auto number = [](double v) { return std::isfinite(v) ? ordered_json(v) : ordered_json(nullptr); };
    ordered_json out{{"a", c.files.a}, {"reference", c.files.b}, {"outcome", outcome_of(c)}};
    if (!c.error.empty())
        out["error"] = c.error;
    out["beyond"] = c.verdict.beyond;
    out["notes"] = c.notes;
    out["header"] = c.header;
    if (!c.updated.empty())
        out["updated"] = c.updated;
    if (!c.compared())
        return out;
    const Metrics &m = c.metrics;
    out["pixels"] = m.pixels;
    out["same_window"] = c.same_window;
    out["rel_mse"] = number(m.relative_mse);
    out["log2_rms"] = number(m.log2_rms);
    out["energy_ratio"] = number(m.energy);
    out["mean_difference"] = number(m.mean_difference);
    if (c.flip)
        out["hdr_flip"] = number(*c.flip);
    out["max_difference"] = {{"value", m.max_difference}, {"x", m.max_x}, {"y", m.max_y},
                             {"channel", channel_of(m)},  {"a", m.max_a}, {"reference", m.max_reference}};
    out["different_pixels"] = m.different;
    out["failing_pixels"] = c.verdict.failing;
    out["not_finite"] = {
        {"a", m.not_finite_a}, {"reference", m.not_finite_reference}, {"mismatched", m.not_finite_mismatch}};
    return out;
}

}  // namespace

const char *outcome_of(const Comparison &c)
{
    return !c.updated.empty() ? "updated" : c.within() ? "within" : c.compared() ? "beyond" : "failed";
}

std::string summary_line(const std::vector<Comparison> &comparisons)
{
    const auto count = [&](const char *outcome) { return count_of(comparisons, outcome); };
    std::string text = fmt::format("{} pairs: {} within, {} beyond, {} failed", comparisons.size(), count("within"),
                                   count("beyond"), count("failed"));
    if (count("updated") > 0)
        text += fmt::format(", {} updated", count("updated"));
    const auto worst =
        std::max_element(comparisons.begin(), comparisons.end(), [](const Comparison &a, const Comparison &b) {
            return a.metrics.relative_mse < b.metrics.relative_mse;
        });
    if (worst->metrics.relative_mse > 0)
        text += fmt::format("; largest relMSE {:.3g} in {}", worst->metrics.relative_mse, worst->files.name);
    return text;
}

std::string text_of(const Comparison &c)
{
    if (!c.compared())
        return remarks_of(c, "");
    const Metrics &m = c.metrics;
    std::string text =
        fmt::format("relMSE           {:.6g}\nlog2 RMS         {:.6g}\nenergy ratio     {:.6g}\nmean difference  {:+.6g}\n",
                    m.relative_mse, m.log2_rms, m.energy, m.mean_difference);
    text += fmt::format("max difference   {:.6g} at ({}, {}) in {}: {:.6g}, reference {:.6g}\n", m.max_difference, m.max_x,
                        m.max_y, channel_of(m), m.max_a, m.max_reference);
    text += fmt::format("different        {} of {} pixels\n", m.different, m.pixels);
    if (c.flip)
        text += fmt::format("HDR-FLIP         {:.6g}\n", *c.flip);
    if (m.not_finite_a || m.not_finite_reference)
        text += fmt::format("not finite       {} pixels, reference {}; {} components of another kind\n", m.not_finite_a,
                            m.not_finite_reference, m.not_finite_mismatch);
    for (const std::string &reason : c.verdict.beyond)
        text += fmt::format("beyond: {}\n", reason);
    return text + remarks_of(c, "");
}

std::string text_of(const std::vector<Comparison> &comparisons)
{
    std::string text;
    for (const Comparison &c : comparisons) {
        if (c.compared())
            text += fmt::format("{}  {}  relMSE {:.3g}  log2 RMS {:.3g}  energy {:.4g}  max {:.3g}  mean {:+.3g}{}\n",
                                outcome_of(c), c.files.name, c.metrics.relative_mse, c.metrics.log2_rms, c.metrics.energy,
                                c.metrics.max_difference, c.metrics.mean_difference,
                                c.flip ? fmt::format("  FLIP {:.3g}", *c.flip) : "");
        else
            text += fmt::format("{}  {}  {}\n", outcome_of(c), c.files.name, c.error);
        for (const std::string &reason : c.verdict.beyond)
            text += fmt::format("        {}\n", reason);
        text += remarks_of(c, "        ");
    }
    return text + summary_line(comparisons) + "\n";
}

std::string json_of(const std::vector<Comparison> &comparisons, bool one_pair)
{
    ordered_json out;
    if (one_pair) {
        out = json_of(comparisons.front());
    } else {
        out["pairs"] = ordered_json::array();
        for (const Comparison &c : comparisons)
            out["pairs"].push_back(json_of(c));
        const auto count = [&](const char *outcome) { return count_of(comparisons, outcome); };
        out["summary"] = {{"pairs", comparisons.size()},
                          {"within", count("within")},
                          {"beyond", count("beyond")},
                          {"failed", count("failed")},
                          {"updated", count("updated")}};
    }
    return out.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace brume::tool
