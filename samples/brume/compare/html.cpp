#include "compare/html.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <new>

#include <fmt/format.h>
#include <half.h>
#include <zlib.h>

#include "compare/junit.hpp"
#include "compare/report.hpp"
#include "support/pending_file.hpp"

namespace brume::tool {

std::string_view page_text(std::string_view name);

namespace {

std::string base64(const std::vector<std::uint8_t> &bytes)
{
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t three = 0;
        for (std::size_t k = 0; k < 3; ++k)
            three = three << 8 | (i + k < bytes.size() ? bytes[i + k] : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k > bytes.size() ? '=' : digits[three >> (18 - 6 * k) & 63];
    }
    return text;
}

std::vector<std::uint8_t> deflated(const std::vector<std::uint8_t> &bytes)
{
    uLongf size = compressBound(uLong(bytes.size()));
    std::vector<std::uint8_t> packed(size);
    if (compress2(packed.data(), &size, bytes.data(), uLong(bytes.size()), 6) != Z_OK)
        throw std::bad_alloc();
    packed.resize(size);
    return packed;
}

/// As page.html unpacks it.
template <class Value> std::string packed(const Picture &picture, Value &&value)
{
    const std::size_t count = picture.rgb.size() / 3, values = picture.rgb.size();
    std::vector<std::uint8_t> bytes(2 * values);
    for (std::size_t i = 0; i < values; ++i) {
        const float v = value(i);
        const std::uint16_t bits = half(std::isfinite(v) ? std::clamp(v, -65504.0f, 65504.0f) : v).bits();
        const std::size_t at = i % 3 * count + i / 3;
        bytes[at] = std::uint8_t(bits >> 8);
        bytes[at + values] = std::uint8_t(bits & 255);
    }
    return base64(deflated(bytes));
}

/// Each @KEY@ once or more often; one pass, so that values may hold anything.
std::string filled(std::string_view form, const std::vector<std::pair<std::string, std::string>> &values)
{
    std::string text;
    while (!form.empty()) {
        const auto at = form.find('@');
        text += form.substr(0, at);
        if (at == std::string_view::npos)
            break;
        form.remove_prefix(at + 1);
        const auto key = form.substr(0, form.find('@'));
        const auto value = std::find_if(values.begin(), values.end(), [&](const auto &v) { return v.first == key; });
        text += value->second;
        form.remove_prefix(key.size() + 1);
    }
    return text;
}

std::string figures_of(const Comparison &c)
{
    const Metrics &m = c.metrics;
    std::string rows;
    const auto row = [&](const char *name, const std::string &value) {
        rows += fmt::format("<tr><th>{}</th><td>{}</td></tr>\n", name, value);
    };
    row("relMSE", fmt::format("{:.6g}", m.relative_mse));
    row("log2 RMS", fmt::format("{:.6g}", m.log2_rms));
    row("energy ratio", fmt::format("{:.6g}", m.energy));
    row("mean difference", fmt::format("{:+.6g}", m.mean_difference));
    row("max difference", fmt::format("{:.6g} at ({}, {}) in {}", m.max_difference, m.max_x, m.max_y, "RGB"[m.max_channel]));
    row("different", fmt::format("{} of {} pixels", m.different, m.pixels));
    if (c.flip)
        row("HDR-FLIP", fmt::format("{:.6g}", *c.flip));
    return rows;
}

std::string lines_of(const Comparison &c)
{
    std::string text = fmt::format("<p>A: {}<br />B: {}</p>\n", escaped(c.files.a), escaped(c.files.b));
    const auto list = [&](const std::vector<std::string> &lines, const char *kind) {
        for (const std::string &line : lines)
            text += fmt::format("<p class=\"{}\">{}</p>\n", kind, escaped(line));
    };
    list(c.verdict.beyond, "beyond");
    list(c.notes, "note");
    list(c.header, "header");
    return text;
}

}  // namespace

std::string page_of(const PairFiles &files)
{
    std::string name;
    for (const char c : files.name) {
        const bool plain = std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '-';
        name += plain ? std::string(1, c) : fmt::format("_{:02x}", static_cast<unsigned char>(c));
    }
    return name + ".html";
}

void write_pair_page(const std::filesystem::path &file, const Picture &a, const Picture &reference, const Comparison &c)
{
    const double largest = c.metrics.max_difference;
    const double gain = largest > 0 ? std::clamp(std::floor(-4 * std::log2(largest)) / 4, -16.0, 24.0) : 0;
    const auto value_of = [](const Picture &p) { return [&p](std::size_t i) { return p.rgb[i]; }; };
    const auto difference = [&](std::size_t i) { return std::abs(a.rgb[i] - reference.rgb[i]); };
    write_text_file(file, filled(page_text("page.html"), {{"name", escaped(c.files.name)},
                                                          {"outcome", outcome_of(c)},
                                                          {"lines", lines_of(c)},
                                                          {"figures", figures_of(c)},
                                                          {"gain", fmt::format("{}", gain)},
                                                          {"width", fmt::format("{}", a.width)},
                                                          {"height", fmt::format("{}", a.height)},
                                                          {"left", fmt::format("{}", a.x)},
                                                          {"top", fmt::format("{}", a.y)},
                                                          {"a", packed(a, value_of(a))},
                                                          {"b", packed(reference, value_of(reference))},
                                                          {"difference", packed(a, difference)}}));
}

void write_index_page(const std::filesystem::path &folder, const std::vector<Comparison> &comparisons)
{
    std::string rows;
    for (const Comparison &c : comparisons) {
        const std::string name = escaped(c.files.name);
        rows += fmt::format("<tr><td class=\"{0}\">{0}</td><td>{1}</td>", outcome_of(c),
                            c.compared() ? fmt::format("<a href=\"{}\">{}</a>", escaped(page_of(c.files)), name) : name);
        const Metrics &m = c.metrics;
        if (c.compared())
            rows += fmt::format("<td>{:.3g}</td><td>{:.3g}</td><td>{:.4g}</td><td>{:.3g}</td><td>{:.3g}</td><td>",
                                m.relative_mse, m.log2_rms, m.energy, m.max_difference, c.flip.value_or(0));
        else
            rows += "<td></td><td></td><td></td><td></td><td></td><td>" + escaped(c.error);
        for (const std::string &reason : c.verdict.beyond)
            rows += escaped(reason) + "<br />";
        rows += "</td></tr>\n";
    }
    write_text_file(
        folder / "index.html",
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\" />\n<title>brume compare</title>\n<style>\n"
        "body { margin: 1.5em; background: #1e1e1e; color: #ddd; font: 14px/1.5 sans-serif; }\n"
        "td, th { padding: 0.1em 1em 0.1em 0; text-align: left; vertical-align: top; }\n"
        "a { color: #8bf; } .within { color: #6c6; } .beyond, .failed { color: #f76; } .updated { color: #fc6; }\n"
        "</style>\n</head>\n<body>\n<h1>brume compare</h1>\n<p>" +
            escaped(summary_line(comparisons)) +
            "</p>\n<table>\n<tr><th></th><th>pair</th><th>relMSE</th><th>log2 RMS</th><th>energy</th><th>max</th>"
            "<th>FLIP</th><th></th></tr>\n" +
            rows + "</table>\n</body>\n</html>\n");
}

}  // namespace brume::tool
