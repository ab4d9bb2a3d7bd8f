#pragma once
#include <span>
#include <string>
#include <vector>

#include "gaussians/gaussian.h"

namespace brume {

// Media of Gaussians as files, CSV or PLY by the path's extension; docs/media.md has their columns. A file that is cut,
// damaged or no such file throws Error(BRUME_ERROR_SCENE) as "path: ..." or "path:line: ...", before anything of the size
// it claims is allocated.
std::vector<Gaussian> read_gaussians(const std::string &path);

// PLY is written as binary. Reading gives back the same bits from either. The file appears whole or not at all.
void write_gaussians(const std::string &path, std::span<const Gaussian> gaussians);

}  // namespace brume
