#include <algorithm>
#include <utility>

#include <brume/brume_media.h>

#include "media/operations.h"

namespace brume::media {
namespace {

Gaussian moved(Gaussian gaussian, const dvec3 &offset)
{
    for (int i = 0; i < 3; ++i)
        gaussian.center[size_t(i)] += offset[i];
    return gaussian;
}

}  // namespace

void SelectRectangle::apply(State &state) const
{
    for (size_t i = 0; i < state.gaussians.size(); ++i) {
        const auto &center = state.gaussians[i].center;
        const auto place = lens.project({center[0], center[1], center[2]});
        const bool inside = place && place->pixel.x >= rectangle[0] && place->pixel.x <= rectangle[2] &&
                            place->pixel.y >= rectangle[1] && place->pixel.y <= rectangle[3];
        if (mode == BRUME_MEDIA_SELECT_REPLACE)
            state.selected[i] = inside;
        else if (inside)
            state.selected[i] = mode == BRUME_MEDIA_SELECT_ADD;
    }
}

void SelectAll::apply(State &state) const
{
    std::fill(state.selected.begin(), state.selected.end(), uint8_t(1));
}

void SelectNone::apply(State &state) const
{
    std::fill(state.selected.begin(), state.selected.end(), uint8_t(0));
}

void Copy::apply(State &state) const
{
    state.clipboard.clear();
    for (size_t i = 0; i < state.gaussians.size(); ++i)
        if (state.selected[i])
            state.clipboard.push_back(state.gaussians[i]);
}

void Paste::apply(State &state) const
{
    expect_room(state, double(state.clipboard.size()), name);
    SelectNone().apply(state);
    for (const Gaussian &gaussian : state.clipboard)
        add(state, moved(gaussian, offset), name, true);
}

void Move::apply(State &state) const
{
    const State before = std::exchange(state, State{{}, {}, state.clipboard});
    for (size_t i = 0; i < before.gaussians.size(); ++i)
        add(state, before.selected[i] ? moved(before.gaussians[i], offset) : before.gaussians[i], name, before.selected[i]);
}

void Delete::apply(State &state) const
{
    size_t kept = 0;
    for (size_t i = 0; i < state.gaussians.size(); ++i)
        if (!state.selected[i])
            state.gaussians[kept++] = state.gaussians[i];
    state.gaussians.resize(kept);
    state.selected.assign(kept, 0);
}

void Put::apply(State &state) const
{
    expect_room(state, double(gaussians.size()), name);
    for (const Gaussian &gaussian : gaussians)
        add(state, gaussian, name);
}

}  // namespace brume::media
