#include "bench/chart.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <cairo-svg.h>
#include <fmt/format.h>

#include "bench/chart_panel.hpp"
#include "support/error.hpp"
#include "support/pending_file.hpp"

namespace brume::tool {
namespace {

constexpr double kPanelWidth = 470, kPanelHeight = 330, kKeyWidth = 270, kKeyLine = 17, kMargin = 16, kHeading = 34;
constexpr double kPngScale = 1.25;

double rows_of(const ChartSection &section)
{
    return std::ceil(double(section.panels.size()) / 2);
}

double panels_height(const ChartSection &section)
{
    return std::max(rows_of(section) * kPanelHeight, kKeyLine * double(section.keys.size() + 6) + 24);
}

double chart_width(const Chart &chart)
{
    std::size_t columns = 1;
    for (const ChartSection &s : chart.sections)
        columns = std::max(columns, std::min<std::size_t>(s.panels.size(), 2));
    return double(columns) * kPanelWidth + kKeyWidth + 2 * kMargin;
}

double chart_height(const Chart &chart)
{
    double height = kHeading + kMargin;
    for (const ChartSection &s : chart.sections)
        height += kHeading + panels_height(s);
    return height;
}

void key_line(cairo_t *cr, double x, double y, Kind kind, const std::string &number, const std::string &text)
{
    draw_marker(cr, kind, x + 6, y - 4);
    cairo_set_source_rgb(cr, 0.1, 0.1, 0.1);
    draw_text(cr, x + 34, y, number, Align::kRight);
    draw_text(cr, x + 42, y, text, Align::kLeft);
}

void draw_refused(cairo_t *cr, double x, double y, const ChartKey &key)
{
    cairo_set_source_rgb(cr, 0.6, 0.6, 0.6);
    draw_text(cr, x + 34, y, std::to_string(key.number), Align::kRight);
    draw_text(cr, x + 42, y, key.name, Align::kLeft);
}

void draw_key(cairo_t *cr, const ChartSection &section, double x, double y)
{
    set_font(cr, 12);
    y += 24;
    for (const ChartKey &key : section.keys) {
        if (key.measured)
            key_line(cr, x, y, key.kind, std::to_string(key.number), key.name);
        else
            draw_refused(cr, x, y, key);
        y += kKeyLine;
    }
    y += kKeyLine / 2;
    for (const auto &[kind, what] : {std::pair(Kind::kSetting, "setting of this library"),
                                     {Kind::kPublished, "a paper's published mode"},
                                     {Kind::kBaseline, "what peers do, on the CPU"}}) {
        key_line(cr, x, y, kind, "", what);
        y += kKeyLine;
    }
    draw_front_sample(cr, x, y - 4);
    cairo_set_source_rgb(cr, 0.1, 0.1, 0.1);
    draw_text(cr, x + 42, y, "Pareto front", Align::kLeft);
    if (std::any_of(section.keys.begin(), section.keys.end(), [](const ChartKey &key) { return !key.measured; })) {
        cairo_set_source_rgb(cr, 0.6, 0.6, 0.6);
        draw_text(cr, x + 42, y + kKeyLine, "grey: refused here", Align::kLeft);
    }
}

void draw(cairo_t *cr, const Chart &chart)
{
    cairo_set_source_rgb(cr, 1, 1, 1);
    cairo_paint(cr);
    cairo_set_source_rgb(cr, 0, 0, 0);
    set_font(cr, 17, true);
    draw_text(cr, kMargin, kMargin + 14, chart.title, Align::kLeft);
    double y = kHeading;
    for (const ChartSection &section : chart.sections) {
        cairo_set_source_rgb(cr, 0, 0, 0);
        set_font(cr, 14, true);
        draw_text(cr, kMargin, y + 24, section.title, Align::kLeft);
        y += kHeading;
        const double height = panels_height(section) / rows_of(section);
        for (std::size_t i = 0; i < section.panels.size(); ++i)
            draw_panel(cr, section.panels[i],
                       {kMargin + double(i % 2) * kPanelWidth, y + double(i / 2) * height, kPanelWidth, height});
        draw_key(cr, section, chart_width(chart) - kKeyWidth, y);
        y += panels_height(section);
    }
}

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Pen = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

}  // namespace

void draw_chart(const std::filesystem::path &file, const Chart &chart)
{
    const bool svg = file.extension() == ".svg";
    const double width = chart_width(chart), height = chart_height(chart);
    PendingFile pending(file);
    const std::string path = pending.path().string();
    const Surface surface(
        svg ? cairo_svg_surface_create(path.c_str(), width, height)
            : cairo_image_surface_create(CAIRO_FORMAT_RGB24, int(width * kPngScale), int(height * kPngScale)),
        cairo_surface_destroy);
    {
        const Pen cr(cairo_create(surface.get()), cairo_destroy);
        if (!svg)
            cairo_scale(cr.get(), kPngScale, kPngScale);
        draw(cr.get(), chart);
    }
    cairo_status_t status = svg ? CAIRO_STATUS_SUCCESS : cairo_surface_write_to_png(surface.get(), path.c_str());
    cairo_surface_finish(surface.get());
    if (status == CAIRO_STATUS_SUCCESS)
        status = cairo_surface_status(surface.get());
    if (status != CAIRO_STATUS_SUCCESS)
        throw FrameError(fmt::format("{}: cannot be written: {}", file.string(), cairo_status_to_string(status)));
    pending.commit();
}

}  // namespace brume::tool
