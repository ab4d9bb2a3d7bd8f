// The data images that follow the scene, made again when something moved.
#include <algorithm>
#include <cstring>

#include "state.h"
#include "uploads.h"

namespace airlight {
namespace {

brume_status refresh_environment(const brume_services &services, brume_host host, const brume_plugin_scene &scene,
                                 State &state)
{
    return upload(services, host, upload_environment, 4, brume::maths_float::environment_of(scene).values,
                  state.environment);
}

}  // namespace

brume_status refresh(const brume_services &services, brume_host host, const brume_plugin_scene &scene, State &state)
{
    const bool moved = !state.fresh || scene.revision != state.revision;
    const bool camera_moved = moved || std::memcmp(scene.camera, &state.camera, sizeof state.camera) != 0 ||
                              !std::equal(std::begin(state.position), std::end(state.position), std::begin(scene.position));
    if (!camera_moved)
        return BRUME_OK;
    state.fresh = false;
    if (moved && state.environment_order > 0)
        if (brume_status s = refresh_environment(services, host, scene, state))
            return s;
    if (state.maps.used)
        if (brume_status s = refresh_maps(services, host, scene, moved, state))
            return s;
    if (state.scattered.used)
        if (brume_status s = refresh_scattered(services, host, scene, state))
            return s;
    state.blobs_pending = false;
    if (state.has_blobs && scene.gaussian_count > 0) {
        state.values.assign(size_t(scene.gaussian_count) * (1 + scene.light_count), 0.0f);
        if (brume_status s = upload(services, host, upload_blob_density, 1, state.values, state.blob_density))
            return s;
        state.blobs_pending = true;
    }
    state.revision = scene.revision;
    state.camera = *scene.camera;
    std::copy_n(scene.position, 3, state.position);
    state.fresh = true;
    return BRUME_OK;
}

}  // namespace airlight
