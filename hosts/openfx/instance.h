// One instance of the effect, as the actions on it share it.
#pragma once
#include <memory>
#include <mutex>
#include <optional>

#include "fog.h"

namespace openfx {

class GlFog;

struct Instance {
    explicit Instance(ofx::EffectHandle effect)
        : effect(effect), filter(properties_of(effect).text(ofx::property::context) == ofx::context::filter)
    {
    }

    const ofx::EffectHandle effect;
    const bool filter;
    std::mutex mutex;  // a host may ask on its main thread while it renders on another
    std::optional<Fog> fog;
    std::shared_ptr<GlFog> gl;  // in the context that is attached

    Fog &get_fog()
    {
        if (!fog)
            fog.emplace(BRUME_BACKEND_CPU, is_aborted, effect);
        return *fog;
    }
    static int32_t is_aborted(void *effect, double)
    {
        return suites.effects->abort(static_cast<ofx::EffectHandle>(effect)) != 0;
    }
};

Instance &instance_of(ofx::EffectHandle effect);

// The scale that the host renders at, and where the project lies in pixels of that scale.
Frame frame_of(ofx::EffectHandle effect, Properties in, const ofx::RectI &bounds, double pixel_aspect);

// The frame in the host's textures. What cannot be done there is left to the CPU, which says what is wrong if it cannot
// either.
ofx::Status fog_textures(Instance &instance, Properties in);

}  // namespace openfx
