#pragma once
#include <span>

#include <brume/brume_plugin.h>

namespace surface {

// By the numbers that shaders/lib/surface_published.glsl has for them.
enum class Method { calibrated, sun, psf, reference };

std::span<const brume_parameter_info> parameter_table();
Method read_method(const double *values);
float read_ground_albedo(const double *values);

}  // namespace surface
