#pragma once

#include <filesystem>
#include <string>

#include "media/fit.hpp"

namespace brume::tool {

/// A density grid out of an OpenVDB file, on a lattice of cubes: lattice point p lies at origin + p.x axes[0] + ...
struct VdbDensity {
    DensityGrid grid;  ///< negative values are 0
    std::string name;
    std::array<double, 3> origin{};
    std::array<std::array<double, 3>, 3> axes{};
    double voxel = 1;  ///< length of each axis, in the file's units
    int averaged = 1;  ///< edge in voxels of the cubes that became one lattice point
    bool level_set = false;
};

/// `name` empty: the grid "density", or the only one of floats. A level set counts as density 1 inside. Grids of more than
/// a million voxels are averaged down. Throws RequestError; also where the module is not installed.
VdbDensity read_vdb(const std::filesystem::path &file, const std::string &name);

/// What reads lies in a module of its own, `brume-vdb`: of what a command takes to start, loading OpenVDB would be the half.
using VdbReader = VdbDensity (*)(const std::filesystem::path &file, const std::string &name);

/// What the module exports: its VdbReader, if this text is the same in both.
constexpr const char *kVdbModuleEntry = "brume_vdb_reader";
constexpr const char *kVdbModuleVersion = "brume-vdb 1 " __VERSION__;

}  // namespace brume::tool
