#pragma once
#include <functional>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include <brume/brume.h>
#include <brume/brume_media.h>
#include <fmt/format.h>

#include "plan/context.h"
#include "base/error.h"
#include "base/floating_point.h"
#include "media/history.h"
#include "plan/plan.h"
#include "scene/scene.h"

// What the opaque handles point to. Each keeps the context alive.
struct brume_context_t {
    std::shared_ptr<brume::Context> context;
};

struct brume_scene_t {
    std::shared_ptr<brume::Context> context;
    brume::Scene scene;
    std::vector<brume::Light> read{};  // what the next lights are read into, so that moving them takes no memory
};

struct brume_media_t {
    std::shared_ptr<brume::Context> context;
    brume::media::History history;
};

namespace brume::api {

// What was read of a frame's layers; kept so that frames allocate nothing once warm.
struct LayersOfFrame {
    std::vector<brume_layer> layers;
    std::vector<brume_image> images;
};

}  // namespace brume::api

struct brume_plan_t {
    std::shared_ptr<brume::Context> context;
    std::unique_ptr<brume_host_t> plan;
    std::string quality;
    brume::api::LayersOfFrame inputs, outputs;  // of the last frame
};

namespace brume::api {

// The calling thread's message for a context (nullptr: for calls without one).
void set_message(const Context *context, const std::string &message);
const std::string &message_of(const Context *context);
void forget_messages(const Context *context);

// The one exception barrier.
template <class Function> brume_status barrier(const Context *context, Function function)
{
    const DefaultFloatingPoint floating_point;
    auto failed = [&](brume_status status, const char *message) {
        try {
            set_message(context, message);
            if (context)
                context->log(BRUME_LOG_ERROR, message);
        } catch (...) {
        }
        return status;
    };
    try {
        function();
        return BRUME_OK;
    } catch (const Error &error) {
        return failed(error.status(), error.what());
    } catch (const std::bad_alloc &) {
        return failed(BRUME_ERROR_MEMORY, "out of memory");
    } catch (const std::exception &error) {
        return failed(BRUME_ERROR_INTERNAL, error.what());
    } catch (...) {
        return failed(BRUME_ERROR_INTERNAL, "unknown exception");
    }
}

// A caller's structs, by the size it gave, each field in its range.
brume_camera read_camera(const brume_camera *given, const char *name);
Format read_format(const brume_format *given);
brume_image read_image(const brume_image *given, const char *name);
std::vector<Gaussian> read_gaussians(const brume_gaussian *given, uint32_t count, const char *name, const char *count_name);

inline void expect(bool condition, const char *message)
{
    if (!condition)
        throw Error(BRUME_ERROR_ARGUMENT, message);
}

// "name: value; expected ..."
template <class Value> void expect(bool condition, std::string_view name, const Value &value, std::string_view expected)
{
    if (!condition)
        throw Error(BRUME_ERROR_ARGUMENT, fmt::format("{}: {}; expected {}", name, value, expected));
}

}  // namespace brume::api
