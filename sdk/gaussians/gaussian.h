#pragma once
#include <array>

namespace brume {

// One Gaussian of a medium: density amplitude * exp(-scale^2 |x - center|^2) (Zhou et al. 2007 eq. 7), in scene units.
struct Gaussian {
    std::array<double, 3> center{};
    double scale = 1.0;      // a [1/scene unit], > 0
    double amplitude = 1.0;  // c, ratio to unit density, >= 0
    std::array<float, 3> color{1.0f, 1.0f, 1.0f};
};

}  // namespace brume
