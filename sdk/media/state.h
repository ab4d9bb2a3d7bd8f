#pragma once
#include <cstdint>
#include <vector>

#include "gaussians/gaussian.h"

namespace brume::media {

// What operations change.
struct State {
    std::vector<Gaussian> gaussians;
    std::vector<uint8_t> selected;  // 1 or 0 for each of them
    std::vector<Gaussian> clipboard;
};

// `operation` names the one at work in messages. Throws Error(BRUME_ERROR_ARGUMENT) where there are too many, or where this
// one could not be written to a file and read again.
void add(State &state, const Gaussian &gaussian, const char *operation, bool selected = false);

// Throws where `count` more would be too many; before they are worked out.
void expect_room(const State &state, double count, const char *operation);

}  // namespace brume::media
