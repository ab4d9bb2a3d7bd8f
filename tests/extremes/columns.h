#pragma once
// The table's columns: every effect with each of its kernels or tiers.
#include <string>
#include <vector>

#include "conditions.h"

namespace extremes {

struct Column {
    std::string name;
    Json effects;
    bool cpu_only = false;

    bool filters() const { return effects.contains("multiscatter"); }
    bool lit() const { return effects.contains("airlight"); }
    std::string tier() const { return lit() ? effects["airlight"].value("tier", "nodes") : ""; }
    fog::Names outputs() const;
    // What the published tiers refuse is no cell of the table.
    bool takes(const Condition &c) const;
    std::string scene(const Condition &c) const;
};

std::vector<Column> columns();
const Column &column(const std::string &name);

// Distances along the ray, of which zero and less are near.
fog::Options options_of(const Column &column);

// The extreme in the left half beside an ordinary right half; an odd size, so that one ray is the optical axis.
fog::Frame frame_of(const Column &column, const Condition &c);

}  // namespace extremes
