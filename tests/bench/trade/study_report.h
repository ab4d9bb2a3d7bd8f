#pragma once
// The study as JSON, tables and plot.
#include "aggregate.h"
#include "bench/report.hpp"
#include "limits.h"

namespace trade {

struct SetResult {
    std::string name, effect;
    std::vector<brume::tool::BenchReport> pictures;                 // one for each picture and device
    std::vector<std::pair<std::string, brume::tool::Group>> means;  // by device
};

struct Study {
    unsigned seed = 0;
    bool quick = false;
    std::vector<SetResult> sets;
    std::vector<Limit> limits;
};

// trade.json, trade.md, what docs/accuracy.md quotes of it as trade_short.md, trade.svg and trade.png.
void write_study(const std::string &folder, const Study &study);

}  // namespace trade
