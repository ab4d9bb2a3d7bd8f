// What the user says of the fog and the pictures: the plugin's parameters.
#pragma once
#include <string>

#include "host.h"

namespace openfx {

struct Settings {
    double visibility, scattering[3], absorption[3], g, falloff;
    int quality;  // BRUME_PRESET_...
    std::string scene_file, scene_text;
    int depth_channel, depth_kind;  // index; BRUME_DEPTH_...
    double near_distance, far_distance, metres;
    int sky;  // BRUME_SKY_...
    double sky_distance;
    double vertical_fov, camera_height, camera_tilt;  // [degrees], [m], [degrees]
    bool operator==(const Settings &) const = default;
};

// In a filter depth comes with the source, in its alpha.
void define_settings(ofx::ParameterSet parameters, bool filter);

// "" where there is none.
std::string scene_file(ofx::EffectHandle effect, ofx::Time time);

// Throws Refusal, which names the parameter and its value.
Settings read_settings(ofx::EffectHandle effect, ofx::Time time);

extern const char *const channel_names[4];

}  // namespace openfx
