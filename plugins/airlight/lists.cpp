// The data images of shaders/lib/shadow.glsl, made again when something moved.
#include <algorithm>
#include <cstring>
#include <string>

#include "passes.h"

namespace airlight {

brume_status refresh_lists(const brume_services &services, brume_host host, const brume_plugin_frame &frame, State &state)
{
    const brume_plugin_scene &scene = *frame.scene;
    const bool moved = !state.listed || scene.revision != state.revision;
    const bool camera_moved =
        moved || std::memcmp(&scene.camera, &state.camera, sizeof state.camera) != 0 ||
        !std::equal(std::begin(state.position), std::end(state.position), std::begin(scene.position));
    if (!camera_moved)
        return BRUME_OK;
    state.listed = false;
    if (!state.lists.refresh(scene, moved, state.parameters.tier == Tier::fogshop))
        return services.fail(host, BRUME_ERROR_UNSUPPORTED,
                             ("medium.density: " + std::to_string(scene.gaussian_count) +
                              " Gaussians shadow too much of each other; expected fewer or smaller ones")
                                 .c_str());
    auto upload = [&](Slot slot, int32_t channels, const std::vector<float> &values, brume_plugin_image &out) {
        return services.upload(host, slot, channels, values.data(), values.size() / size_t(channels), &out);
    };
    if (brume_status s = upload(slot_origins, 4, state.lists.origins, state.origins))
        return s;
    if (brume_status s = upload(slot_cells, 4, state.lists.cells, state.cells))
        return s;
    if (brume_status s = upload(slot_cell_gaussians, 1, state.lists.cell_gaussians, state.cell_gaussians))
        return s;
    if (state.parameters.tier == Tier::fogshop && scene.gaussian_count > 0) {
        const std::vector<float> empty(size_t(scene.gaussian_count) * (1 + scene.light_count));
        if (brume_status s = upload(slot_blob_density, 1, empty, state.blob_density))
            return s;
        state.blobs_pending = true;
    }
    state.revision = scene.revision;
    state.camera = scene.camera;
    std::copy_n(scene.position, 3, state.position);
    state.listed = true;
    return BRUME_OK;
}

}  // namespace airlight
