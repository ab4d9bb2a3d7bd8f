#pragma once

#include <string>

#include <cairo.h>

#include "bench/chart.hpp"

namespace brume::tool {

struct Box {
    double x, y, width, height;
};

enum class Align { kLeft, kCentre, kRight };

void set_font(cairo_t *cr, double size, bool bold = false);
/// `y` is of the baseline.
void draw_text(cairo_t *cr, double x, double y, const std::string &text, Align align);
void draw_marker(cairo_t *cr, Kind kind, double x, double y);
/// A piece of the front's line, for the key.
void draw_front_sample(cairo_t *cr, double x, double y);
void draw_panel(cairo_t *cr, const ChartPanel &panel, const Box &box);

}  // namespace brume::tool
