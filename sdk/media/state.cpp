#include "media/state.h"

#include <fmt/format.h>

#include "base/error.h"
#include "scene/scene_check.h"

namespace brume::media {

void expect_room(const State &state, double count, const char *operation)
{
    const double total = double(state.gaussians.size()) + count;
    if (total > BRUME_MAX_GAUSSIANS)
        throw Error(BRUME_ERROR_ARGUMENT, fmt::format("{}: makes {:.0f} Gaussians of {}; expected {} at most", operation,
                                                      total, state.gaussians.size(), BRUME_MAX_GAUSSIANS));
}

void add(State &state, const Gaussian &gaussian, const char *operation, bool selected)
{
    check_gaussian(gaussian, operation);
    expect_room(state, 1, operation);
    state.gaussians.push_back(gaussian);
    state.selected.push_back(selected);
}

}  // namespace brume::media
