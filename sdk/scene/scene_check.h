#pragma once
#include "base/value_name.h"
#include "scene/scene.h"

namespace brume {

// What came in structs, held to the same ranges as a scene file's; throw Error(BRUME_ERROR_ARGUMENT).
void check_medium(const Medium &medium);
void check_gaussian(const Gaussian &gaussian, const ValueName &name);
void check_light(const Light &light, const ValueName &name);
void check_environment(const Environment &environment);

// Says what is wrong with a matrix as a rigid motion; empty if nothing is.
std::string rigid_defect(const std::array<double, 16> &m);

// Spherical harmonics up to a whole order, at most the fifth.
constexpr bool is_environment_count(size_t count)
{
    return count == 1 || count == 4 || count == 9 || count == 16 || count == 25 || count == 36;
}

}  // namespace brume
