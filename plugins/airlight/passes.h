#pragma once
#include <memory>

#include "state.h"

namespace airlight {

// One run of the gathering pass: airlight of some lights, of one pixel per square.
struct Gathering {
    brume_plugin_image radiance;
    brume_plugin_image error;      // NULL unless wanted
    brume_plugin_image distances;  // NULL unless reduction > 1
    int reduction;
    int first_light, last_light;
    bool environment;
};

// The passes of one frame on one backend.
class Passes {
public:
    virtual ~Passes() = default;
    // Density from each origin to each Gaussian, for tier fogshop.
    virtual brume_status blobs() = 0;
    virtual brume_status gather(const Gathering &gathering) = 0;
    virtual brume_status compose() = 0;
};

// Both borrow their arguments. *out stays null where a status other than BRUME_OK comes back.
brume_status make_cpu_passes(const brume_services &services, brume_host host, const State &state,
                             const brume_plugin_frame &frame, std::unique_ptr<Passes> &out);
brume_status make_gl_passes(const brume_services &services, brume_host host, const State &state,
                            const brume_plugin_frame &frame, std::unique_ptr<Passes> &out);

// The gathering pass of tier reference.
brume_status gather_reference(const brume_services &services, brume_host host, const State &state,
                              const brume_plugin_frame &frame, const Gathering &gathering);

// At planning: the tables that the tier reads, and the GL programs.
brume_status plan_tables(const brume_services &services, brume_host host, const brume_plugin_scene &scene, State &state);
brume_status compile_programs(const brume_services &services, brume_host host, uint32_t outputs, State &state);

// Which Gaussians shadow what, made again when something moved.
brume_status refresh_lists(const brume_services &services, brume_host host, const brume_plugin_frame &frame, State &state);

}  // namespace airlight
