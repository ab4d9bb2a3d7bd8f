#include "bench/chart_panel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "bench/pareto.hpp"

namespace brume::tool {
namespace {

constexpr double kMarker = 4.5;  // half its width
constexpr double kFontSize = 11;

struct Axis {
    double low = 0, high = 0;  // exponents of 10
    double from = 0, to = 0;   // on the page

    double at(double v) const { return from + (std::log10(v) - low) / (high - low) * (to - from); }
};

Axis axis_over(const std::vector<double> &values, double from, double to)
{
    Axis axis{1e300, -1e300, from, to};
    for (const double v : values) {
        axis.low = std::min(axis.low, std::log10(v));
        axis.high = std::max(axis.high, std::log10(v));
    }
    const double room = std::max(0.08 * (axis.high - axis.low), 0.1);
    axis.low -= room;
    axis.high += room;
    return axis;
}

/// 1, 2 and 5 of each decade that lies in the axis, or powers of ten where there are many.
template <class Visit> void for_ticks(const Axis &axis, const Visit &visit)
{
    const double decades = axis.high - axis.low;
    for (int e = int(std::floor(axis.low)); e <= int(std::ceil(axis.high)); ++e)
        for (int m = 1; m < 10; ++m) {
            const double at = e + std::log10(double(m));
            if (at < axis.low || at > axis.high)
                continue;
            const bool labelled = m == 1 || ((m == 2 || m == 5) && decades < 2.2);
            const std::string label =
                e < -2 || e > 3 ? fmt::format("{}e{}", m, e) : fmt::format("{:.4g}", m * std::pow(10.0, e));
            visit(std::pow(10.0, at), labelled ? label : "");
        }
}

void colour(cairo_t *cr, Kind kind)
{
    if (kind == Kind::kSetting)
        cairo_set_source_rgb(cr, 0.05, 0.35, 0.70);
    else if (kind == Kind::kPublished)
        cairo_set_source_rgb(cr, 0.80, 0.35, 0.05);
    else
        cairo_set_source_rgb(cr, 0.25, 0.25, 0.25);
}

bool overlap(const Box &a, const Box &b)
{
    return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

/// Numbers beside their points: nearest first, where they hide neither a marker nor another number.
class Labels {
public:
    Labels(cairo_t *cr, const Box &frame) : cr_(cr), frame_(frame) {}

    void keep_free(const Box &box) { taken_.push_back(box); }

    void place(double x, double y, const std::string &text)
    {
        cairo_text_extents_t size;
        cairo_text_extents(cr_, text.c_str(), &size);
        Box best = box_at(x, y, size, 0, 10);
        bool found = false;
        for (double distance = 10; distance <= 46 && !found; distance += 6)
            for (int k = 0; k < 12 && !found; ++k) {
                const Box box = box_at(x, y, size, k * std::numbers::pi / 6 + std::numbers::pi / 4, distance);
                if (inside(box) &&
                    std::none_of(taken_.begin(), taken_.end(), [&](const Box &b) { return overlap(b, box); })) {
                    best = box;
                    found = true;
                }
            }
        taken_.push_back(best);
        const double cx = best.x + best.width / 2, cy = best.y + best.height / 2;
        const double distance = std::hypot(cx - x, cy - y);
        if (distance > 18) {
            cairo_set_source_rgb(cr_, 0.6, 0.6, 0.6);
            cairo_set_line_width(cr_, 0.6);
            cairo_move_to(cr_, x + (cx - x) * kMarker / distance, y + (cy - y) * kMarker / distance);
            cairo_line_to(cr_, cx - (cx - x) * 7 / distance, cy - (cy - y) * 7 / distance);
            cairo_stroke(cr_);
        }
        cairo_set_source_rgb(cr_, 0.1, 0.1, 0.1);
        draw_text(cr_, cx, best.y + best.height - 1, text, Align::kCentre);
    }

private:
    Box box_at(double x, double y, const cairo_text_extents_t &size, double angle, double distance) const
    {
        const double w = size.width + 3, h = size.height + 2;
        return {x + distance * std::cos(angle) * 1.1 - w / 2, y - distance * std::sin(angle) - h / 2, w, h};
    }
    bool inside(const Box &b) const
    {
        return b.x > frame_.x && b.y > frame_.y && b.x + b.width < frame_.x + frame_.width &&
               b.y + b.height < frame_.y + frame_.height;
    }

    cairo_t *cr_;
    Box frame_;
    std::vector<Box> taken_;
};

void draw_axes(cairo_t *cr, const ChartPanel &panel, const Box &frame, const Axis &x, const Axis &y)
{
    const double bottom = frame.y + frame.height;
    set_font(cr, kFontSize);
    cairo_set_line_width(cr, 1);
    const auto grid = [&](bool strong) {
        cairo_set_source_rgb(cr, strong ? 0.82 : 0.93, strong ? 0.82 : 0.93, strong ? 0.82 : 0.93);
    };
    for_ticks(x, [&](double v, const std::string &label) {
        grid(!label.empty());
        cairo_move_to(cr, x.at(v), frame.y);
        cairo_line_to(cr, x.at(v), bottom);
        cairo_stroke(cr);
        cairo_set_source_rgb(cr, 0.2, 0.2, 0.2);
        draw_text(cr, x.at(v), bottom + 14, label, Align::kCentre);
    });
    for_ticks(y, [&](double v, const std::string &label) {
        grid(!label.empty());
        cairo_move_to(cr, frame.x, y.at(v));
        cairo_line_to(cr, frame.x + frame.width, y.at(v));
        cairo_stroke(cr);
        cairo_set_source_rgb(cr, 0.2, 0.2, 0.2);
        draw_text(cr, frame.x - 5, y.at(v) + 4, label, Align::kRight);
    });
    cairo_set_source_rgb(cr, 0.3, 0.3, 0.3);
    cairo_rectangle(cr, frame.x, frame.y, frame.width, frame.height);
    cairo_stroke(cr);
    cairo_set_source_rgb(cr, 0, 0, 0);
    draw_text(cr, frame.x + frame.width / 2, bottom + 31, panel.x_label, Align::kCentre);
    cairo_save(cr);
    cairo_translate(cr, frame.x - 44, frame.y + frame.height / 2);
    cairo_rotate(cr, -std::numbers::pi / 2);
    draw_text(cr, 0, 0, panel.y_label, Align::kCentre);
    cairo_restore(cr);
    set_font(cr, 12, true);
    draw_text(cr, frame.x + frame.width / 2, frame.y - 7, panel.title, Align::kCentre);
    set_font(cr, kFontSize);
}

void front_style(cairo_t *cr)
{
    cairo_set_source_rgb(cr, 0.15, 0.60, 0.25);
    cairo_set_line_width(cr, 1.8);
}

/// In steps: between two settings there is nothing, so until the next one's time the error stays.
void draw_front(cairo_t *cr, const std::vector<ChartPoint> &points, const Axis &x, const Axis &y)
{
    std::vector<Cost> costs;
    for (const ChartPoint &p : points)
        costs.push_back({p.x, p.y});
    const std::vector<std::size_t> front = pareto_front(costs);
    front_style(cr);
    for (std::size_t i = 0; i < front.size(); ++i) {
        const ChartPoint &p = points[front[i]];
        if (i == 0)
            cairo_move_to(cr, x.at(p.x), y.at(p.y));
        else
            cairo_line_to(cr, x.at(p.x), y.at(points[front[i - 1]].y));
        cairo_line_to(cr, x.at(p.x), y.at(p.y));
    }
    cairo_line_to(cr, x.to, y.at(points[front.back()].y));
    cairo_stroke(cr);
}

/// A dashed line across and its name; returns where that stands.
Box draw_level(cairo_t *cr, const Box &frame, double y, const std::string &name)
{
    const double dashes[] = {5, 4};
    cairo_set_source_rgb(cr, 0.45, 0.45, 0.45);
    cairo_set_line_width(cr, 1.2);
    cairo_set_dash(cr, dashes, 2, 0);
    cairo_move_to(cr, frame.x, y);
    cairo_line_to(cr, frame.x + frame.width, y);
    cairo_stroke(cr);
    cairo_set_dash(cr, nullptr, 0, 0);
    draw_text(cr, frame.x + 5, y - 4, name, Align::kLeft);
    return {frame.x + 5, y - 14, 70, 12};
}

}  // namespace

void set_font(cairo_t *cr, double size, bool bold)
{
    cairo_select_font_face(cr, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cr, size);
}

void draw_text(cairo_t *cr, double x, double y, const std::string &text, Align align)
{
    cairo_text_extents_t size;
    cairo_text_extents(cr, text.c_str(), &size);
    const double shift = align == Align::kLeft ? 0 : align == Align::kCentre ? 0.5 : 1;
    cairo_move_to(cr, x - shift * size.x_advance, y);
    cairo_show_text(cr, text.c_str());
}

void draw_marker(cairo_t *cr, Kind kind, double x, double y)
{
    cairo_new_path(cr);
    colour(cr, kind);
    if (kind == Kind::kSetting) {
        cairo_arc(cr, x, y, kMarker, 0, 2 * std::numbers::pi);
    } else if (kind == Kind::kPublished) {
        cairo_rectangle(cr, x - kMarker + 0.5, y - kMarker + 0.5, 2 * kMarker - 1, 2 * kMarker - 1);
    } else {
        cairo_move_to(cr, x, y - kMarker - 0.5);
        cairo_line_to(cr, x + kMarker, y + kMarker - 1);
        cairo_line_to(cr, x - kMarker, y + kMarker - 1);
        cairo_close_path(cr);
    }
    cairo_fill_preserve(cr);
    // So that markers on each other can be told apart.
    cairo_set_source_rgb(cr, 1, 1, 1);
    cairo_set_line_width(cr, 0.8);
    cairo_stroke(cr);
}

void draw_front_sample(cairo_t *cr, double x, double y)
{
    front_style(cr);
    cairo_move_to(cr, x, y);
    cairo_line_to(cr, x + 34, y);
    cairo_stroke(cr);
}

void draw_panel(cairo_t *cr, const ChartPanel &panel, const Box &box)
{
    const Box frame{box.x + 58, box.y + 24, box.width - 74, box.height - 66};
    std::vector<ChartPoint> points;
    std::copy_if(panel.points.begin(), panel.points.end(), std::back_inserter(points),
                 [](const ChartPoint &p) { return p.x > 0 && p.y > 0 && std::isfinite(p.x) && std::isfinite(p.y); });
    if (points.empty()) {
        set_font(cr, 12, true);
        cairo_set_source_rgb(cr, 0, 0, 0);
        draw_text(cr, frame.x + frame.width / 2, frame.y - 7, panel.title + ": nothing to show", Align::kCentre);
        return;
    }
    std::vector<double> times, errors;
    for (const ChartPoint &p : points) {
        times.push_back(p.x);
        errors.push_back(p.y);
    }
    if (panel.without_fog)
        errors.push_back(*panel.without_fog);
    const Axis x = axis_over(times, frame.x, frame.x + frame.width), y = axis_over(errors, frame.y + frame.height, frame.y);
    draw_axes(cr, panel, frame, x, y);
    draw_front(cr, points, x, y);
    Labels labels(cr, frame);
    if (panel.without_fog)
        labels.keep_free(draw_level(cr, frame, y.at(*panel.without_fog), "without fog"));
    for (const ChartPoint &p : points) {
        draw_marker(cr, p.kind, x.at(p.x), y.at(p.y));
        labels.keep_free({x.at(p.x) - kMarker, y.at(p.y) - kMarker, 2 * kMarker, 2 * kMarker});
    }
    for (const ChartPoint &p : points)
        labels.place(x.at(p.x), y.at(p.y), std::to_string(p.number));
}

}  // namespace brume::tool
