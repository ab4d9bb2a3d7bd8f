#include "core/scene_check.h"

#include <algorithm>

#include "core/error.h"
#include "core/scene_ranges.h"

namespace brume {
namespace {

void check(const Number &number, const Range &range, const std::string &name)
{
    for (auto &[frame, value] : number.keys)
        if (!range.contains(value))
            throw Error(BRUME_ERROR_ARGUMENT, fmt::format("{}: {}; expected {}", name, value, range.describe()));
}

void check(const Number3 &numbers, const Range &range, const std::string &name)
{
    for (size_t i = 0; i < 3; ++i)
        check(numbers[i], range, fmt::format("{}[{}]", name, i));
}

}  // namespace

void check_medium(const Medium &medium)
{
    check(medium.scattering, ranges::not_negative, "medium.scattering");
    check(medium.absorption, ranges::not_negative, "medium.absorption");
    check(medium.emission, ranges::not_negative, "medium.emission");
    check(medium.g, ranges::asymmetry, "medium.g");
    if (medium.visibility)
        check(*medium.visibility, ranges::positive, "medium.visibility");
    if (medium.droplet_diameter)
        check(*medium.droplet_diameter, ranges::droplet_diameter, "medium.droplet_diameter");
    size_t exponential = 0;
    for (size_t i = 0; i < medium.density.size(); ++i) {
        const DensityTerm &term = medium.density[i];
        std::string name = fmt::format("medium.terms[{}]", i);
        if (term.type != BRUME_DENSITY_CONSTANT && term.type != BRUME_DENSITY_EXPONENTIAL)
            throw Error(BRUME_ERROR_ARGUMENT, fmt::format("{}.type: {}; expected a BRUME_DENSITY_...", name, term.type));
        check(term.value, ranges::not_negative, name + ".value");
        if (term.type != BRUME_DENSITY_EXPONENTIAL)
            continue;
        ++exponential;
        check(term.falloff, ranges::not_negative, name + ".falloff");
        check(term.direction, ranges::any, name + ".direction");
        check(term.origin, ranges::any, name + ".origin");
        if (std::all_of(term.direction.begin(), term.direction.end(), [](const Number &n) { return n.at(0) == 0; }))
            throw Error(BRUME_ERROR_ARGUMENT, name + ".direction: (0, 0, 0); expected a direction");
    }
    if (exponential > BRUME_MAX_DENSITY_TERMS)
        throw Error(BRUME_ERROR_ARGUMENT, fmt::format("medium.terms: {} exponential ones; expected at most {}", exponential,
                                                      BRUME_MAX_DENSITY_TERMS));
}

}  // namespace brume
