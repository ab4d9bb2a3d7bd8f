#include "metrics/limits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

namespace brume::tool {
namespace {

/// idiff's, where other limits of single pixels are given and this one is not.
constexpr double kUsualFail = 1e-6;

class Pixels {
public:
    Pixels(const Picture &a, const Picture &r, const Limits &limits, const Mask &mask)
        : a_(a), r_(r), mask_(mask), radius_(limits.search_radius), fail_(limits.fail.value_or(kUsualFail)),
          relative_(limits.fail_relative.value_or(0)),
          hard_(limits.hard_fail.value_or(std::numeric_limits<double>::infinity()))
    {
    }

    enum Outcome : std::uint8_t { kPasses = 0, kFails = 1, kFailsHard = 2 };

    /// Both ways: what one picture lacks altogether is near nothing in the other.
    int at(int x, int y) const { return radius_ == 0 ? difference(x, y, x, y) : best(x, y, true) | best(x, y, false); }

private:
    int best(int x, int y, bool from_a) const
    {
        int outcome = kFails | kFailsHard;
        for (int v = std::max(0, y - radius_); v <= std::min(a_.height - 1, y + radius_); ++v)
            for (int u = std::max(0, x - radius_); u <= std::min(a_.width - 1, x + radius_); ++u) {
                if (is_compared(mask_, a_.index(u, v)))
                    outcome &= from_a ? difference(x, y, u, v) : difference(u, v, x, y);
                if (outcome == kPasses)
                    return outcome;
            }
        return outcome;
    }

    int difference(int ax, int ay, int rx, int ry) const
    {
        const float *p = a_.at(ax, ay);
        const float *q = r_.at(rx, ry);
        int outcome = kPasses;
        for (std::size_t c = 0; c < 3; ++c)
            outcome |= of(p[c], q[c]);
        if (!a_.alpha.empty())
            outcome |= of(a_.alpha[a_.index(ax, ay)], r_.alpha[r_.index(rx, ry)]);
        return outcome;
    }

    int of(double a, double r) const
    {
        if (!std::isfinite(a) || !std::isfinite(r))
            return same_kind(float(a), float(r)) ? kPasses : kFails | kFailsHard;
        const double off = std::abs(a - r);
        const bool fails = off > fail_ && off > relative_ * (std::abs(a) + std::abs(r)) / 2;
        return (fails ? kFails : kPasses) | (off > hard_ ? kFailsHard : kPasses);
    }

    const Picture &a_, &r_;
    const Mask &mask_;
    const int radius_;
    const double fail_, relative_, hard_;
};

void judge_pixels(const Picture &a, const Picture &r, const Metrics &metrics, const Limits &limits, const Mask &mask,
                  Verdict &verdict)
{
    const Pixels pixels(a, r, limits, mask);
    std::vector<std::uint8_t> outcomes(std::size_t(a.width) * std::size_t(a.height));
    oneapi::tbb::parallel_for(0, a.height, [&](int y) {
        for (int x = 0; x < a.width; ++x)
            if (is_compared(mask, a.index(x, y)))
                outcomes[a.index(x, y)] = std::uint8_t(pixels.at(x, y));
    });
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
        if (outcomes[i] != 0 && verdict.failing + verdict.failing_hard == 0) {
            verdict.first_x = a.x + int(i % std::size_t(a.width));
            verdict.first_y = a.y + int(i / std::size_t(a.width));
        }
        verdict.failing += (outcomes[i] & Pixels::kFails) != 0;
        verdict.failing_hard += (outcomes[i] & Pixels::kFailsHard) != 0;
    }
    const double percent = limits.fail_percent.value_or(0);
    const bool too_many = double(verdict.failing) > percent / 100 * double(metrics.pixels);
    if (verdict.failing > limits.allow && too_many)
        verdict.beyond.push_back(
            fmt::format("{} of {} pixels fail, the first at ({}, {}); expected at most {}", verdict.failing, metrics.pixels,
                        verdict.first_x, verdict.first_y,
                        limits.fail_percent ? fmt::format("{}%", percent) : fmt::format("{}", limits.allow)));
    if (verdict.failing_hard > limits.allow)
        verdict.beyond.push_back(fmt::format("{} pixels are further off than --hard-fail {}, the first at ({}, {})",
                                             verdict.failing_hard, limits.hard_fail.value_or(0), verdict.first_x,
                                             verdict.first_y));
}

}  // namespace

Verdict judge(const Picture &a, const Picture &r, const Metrics &m, const Limits &limits, const Mask &mask)
{
    Verdict verdict;
    if (m.not_finite_mismatch > 0)
        verdict.beyond.push_back(
            fmt::format("{} components are NaN or infinite in one picture only", m.not_finite_mismatch));
    // Negated, so that a metric that is NaN keeps no limit.
    if (limits.max_relmse && !(m.relative_mse <= *limits.max_relmse))
        verdict.beyond.push_back(fmt::format("relMSE is {:.6g}, above --max-relmse {}", m.relative_mse, *limits.max_relmse));
    if (limits.max_log2 && !(m.log2_rms <= *limits.max_log2))
        verdict.beyond.push_back(fmt::format("log2 RMS is {:.6g}, above --max-log2 {}", m.log2_rms, *limits.max_log2));
    if (limits.energy && !(m.energy >= (*limits.energy)[0] && m.energy <= (*limits.energy)[1]))
        verdict.beyond.push_back(fmt::format("the energy ratio is {:.6g}, outside --energy {}:{}", m.energy,
                                             (*limits.energy)[0], (*limits.energy)[1]));
    if (limits.of_pixels())
        judge_pixels(a, r, m, limits, mask, verdict);
    return verdict;
}

}  // namespace brume::tool
