#pragma once
#include <memory>
#include <string>

#include "plan/plan.h"

namespace brume {

struct Chosen {
    std::unique_ptr<brume_host_t> plan;
    std::string quality;  // what was chosen for it and why; "" where none is asked
};

// Plans a scene with those of its effects' offers that the quality it asks for needs. Parameters that the scene sets stay.
Chosen plan_with_quality(const std::shared_ptr<Context> &context, const Scene &scene, const Format &format);

}  // namespace brume
