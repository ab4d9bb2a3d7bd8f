#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "plan/backend.h"
#include "effects/effects.h"
#include "base/log.h"
#include "base/progress.h"
#include "plan/rates.h"

namespace brume {

struct Context {
    const uint64_t id = new_id();  // of no other context, unlike its address
    Log log;
    Progress progress;
    std::unique_ptr<Backend> backend;
    EffectRegistry effects;
    Rates rates;
    bool warned_of_clamping = false;
    std::string device;  // what the backend says of itself, kept for callers of the C API

private:
    static uint64_t new_id();
};

using MakeBackend = std::unique_ptr<Backend> (*)(const brume_context_desc &desc, const Log &log);

// Makes the backend asked for and loads the effects; throws Error.
std::shared_ptr<Context> create_context(const brume_context_desc &desc, MakeBackend make_backend);

}  // namespace brume
