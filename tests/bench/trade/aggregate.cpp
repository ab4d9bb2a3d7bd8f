#include "aggregate.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

using namespace brume::tool;

namespace trade {
namespace {

// An error of exactly 0 would make any mean 0.
constexpr double kLeast = 1e-16;

class Mean {
public:
    void add(const std::optional<Metrics> &m)
    {
        ++pictures_;
        if (!m)
            return;
        ++count_;
        relative_mse_ += std::log(std::max(m->relative_mse, kLeast));
        log2_rms_ += std::log(std::max(m->log2_rms, kLeast));
        energy_ += std::log(std::max(m->energy, kLeast));
    }
    std::optional<Metrics> value() const
    {
        if (count_ == 0 || count_ < pictures_)
            return {};
        Metrics m;
        m.relative_mse = std::exp(relative_mse_ / count_);
        m.log2_rms = std::exp(log2_rms_ / count_);
        m.energy = std::exp(energy_ / count_);
        return m;
    }

private:
    double relative_mse_ = 0, log2_rms_ = 0, energy_ = 0;
    int count_ = 0, pictures_ = 0;
};

double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

template <class Get> Errors mean_errors(const std::vector<Group> &groups, const Get &get)
{
    Mean reference, truth;
    for (const Group &g : groups) {
        reference.add(get(g).reference);
        truth.add(get(g).truth);
    }
    return {reference.value(), truth.value()};
}

}  // namespace

Group aggregated(const std::vector<Group> &groups)
{
    Group all = groups.front();
    all.without_fog = mean_errors(groups, [](const Group &g) { return g.without_fog; });
    Mean own;
    for (const Group &g : groups) {
        all.reference_width = std::min(all.reference_width, g.reference_width);
        all.reference_height = std::min(all.reference_height, g.reference_height);
        all.reference_ms = std::max(all.reference_ms, g.reference_ms);
        own.add(g.reference_truth);
    }
    all.reference_truth = own.value();
    for (std::size_t i = 0; i < all.rows.size(); ++i) {
        Row &row = all.rows[i];
        row.on_reference_front = row.on_truth_front = false;
        std::vector<double> ms, copies;
        std::size_t refused = 0;
        for (const Group &g : groups) {
            ms.push_back(g.rows[i].ms);
            copies.push_back(g.rows[i].copies);
            if (!g.rows[i].refusal.empty()) {
                ++refused;
                row.refusal = g.rows[i].refusal;
            }
        }
        if (refused) {
            row.ms = row.copies = NAN;
            row.errors = {};
            continue;
        }
        row.ms = median(ms);
        row.copies = median(copies);
        row.errors = mean_errors(groups, [i](const Group &g) { return g.rows[i].errors; });
    }
    mark_fronts(all.rows);
    return all;
}

}  // namespace trade
