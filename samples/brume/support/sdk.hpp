#pragma once

#include <memory>
#include <string>

#include <brume/brume.h>

namespace brume::tool {

struct DestroyContext {
    void operator()(brume_context c) const { brume_context_destroy(c); }
};
struct DestroyScene {
    void operator()(brume_scene s) const { brume_scene_destroy(s); }
};
struct DestroyPlan {
    void operator()(brume_plan p) const { brume_plan_destroy(p); }
};
using ContextHandle = std::unique_ptr<brume_context_t, DestroyContext>;
using SceneHandle = std::unique_ptr<brume_scene_t, DestroyScene>;
using PlanHandle = std::unique_ptr<brume_plan_t, DestroyPlan>;

/// What the library says of the last failure; the status' name where it says nothing.
std::string sdk_message(brume_context context, brume_status status);

/// `backend` is auto, gl or cpu. Throws RequestError.
ContextHandle create_context(const std::string &backend);

/// Throws RequestError where the library refuses: for what comes from the command line or the scene file.
void check_request(brume_context context, brume_status status, const std::string &what);

brume_image host_image(void *data, int width, int height, int channels);

/// `name` and `image` are kept as they are given.
brume_layer layer_named(const char *name, const brume_image *image);

const char *backend_name(std::uint32_t backend);

}  // namespace brume::tool
