#pragma once
#include <string_view>
#include <vector>

#include "state.h"

namespace multiscatter {

// The passes of kernel `calibrated` on one backend, in their order.
class CalibratedPasses {
public:
    virtual ~CalibratedPasses() = default;
    virtual brume_status spread() = 0;          // level 0
    virtual brume_status share(int level) = 0;  // from the finer one
    virtual brume_status smooth(int level) = 0;
    virtual brume_status collect() = 0;  // at reduced resolution
    virtual brume_status compose() = 0;
};

std::unique_ptr<CalibratedPasses> calibrated_on_cpu(const brume_services &services, brume_host host, const State &state,
                                                    const brume_plugin_frame &frame, brume_status &status);
std::unique_ptr<CalibratedPasses> calibrated_on_gl(const brume_services &services, brume_host host, const State &state,
                                                   const brume_plugin_frame &frame);

SpreadSource source_of(const State &state, const brume_plugin_scene &scene);
brume::maths_float::Calibrated calibrated_of(const State &state, const brume_plugin_scene &scene,
                                             const SpreadSource &tabled);

brume::maths_float::Level level_at(const State &state, int level);

std::string_view pass_text(std::string_view name);

}  // namespace multiscatter
