#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "metrics/metrics.hpp"

namespace brume::tool {

/// What a picture may differ by from its reference; what is not given is no limit. Limits of single pixels mean what idiff's
/// do: a pixel fails where a component, alpha included, is further off than `fail`, and than `fail_relative` of the two's
/// mean.
struct Limits {
    std::optional<double> max_relmse = {}, max_log2 = {}, fail = {}, fail_relative = {}, fail_percent = {}, hard_fail = {};
    std::optional<std::array<double, 2>> energy = {};
    std::uint64_t allow = 0;  ///< this many pixels may fail, by whatever
    int search_radius = 0;    ///< a pixel passes where a pixel of the other picture no further away in x and in y would do

    bool of_pixels() const { return fail || fail_relative || fail_percent || hard_fail || allow > 0 || search_radius > 0; }
    bool any() const { return of_pixels() || max_relmse || max_log2 || energy; }
};

struct Verdict {
    std::uint64_t failing = 0, failing_hard = 0;  ///< pixels
    int first_x = 0, first_y = 0;                 ///< of those that fail, in reading order
    std::vector<std::string> beyond;              ///< a sentence for each limit that is not kept
};

/// Counts nothing where no limit of single pixels is given. A component that is NaN or infinite in one picture only is
/// beyond every limit, and also where there is none.
Verdict judge(const Picture &a, const Picture &reference, const Metrics &metrics, const Limits &limits,
              const Mask &mask = {});

}  // namespace brume::tool
