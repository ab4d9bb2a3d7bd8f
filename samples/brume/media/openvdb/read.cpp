// The module brume-vdb.
#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetUtil.h>

#include "media/vdb.hpp"
#include "support/error.hpp"

namespace brume::tool {
namespace {

constexpr double kMostVoxels = 1e6;
// Empty space around, as a share of the longest edge: outside, too, the Gaussians must come to nothing.
constexpr double kMargin = 0.25;
constexpr int kLeastMargin = 4;  // [voxel]

openvdb::GridBase::Ptr find_grid(openvdb::io::File &file, const std::string &path, const std::string &name)
{
    std::string listed;
    std::vector<std::string> floats;
    for (auto it = file.beginName(); it != file.endName(); ++it) {
        const auto grid = file.readGridMetadata(it.gridName());
        listed += fmt::format("{}{} ({})", listed.empty() ? "" : ", ", it.gridName(), grid->valueType());
        if (grid->isType<openvdb::FloatGrid>())
            floats.push_back(it.gridName());
    }
    std::string chosen = name;
    if (name.empty())
        chosen = std::find(floats.begin(), floats.end(), "density") != floats.end() ? "density"
                 : floats.size() == 1                                               ? floats.front()
                                                                                    : "";
    if (std::find(floats.begin(), floats.end(), chosen) == floats.end())
        throw RequestError(fmt::format("{}: {}; expected {} among its grids: {}", path,
                                       name.empty() ? "which grid?" : fmt::format("no grid of floats '{}'", name),
                                       name.empty() ? "one of floats, or --grid" : "one", listed.empty() ? "none" : listed));
    return file.readGrid(chosen);
}

VdbDensity read_here(const std::filesystem::path &path, const std::string &name)
try {
    if (!std::filesystem::is_regular_file(path))
        throw RequestError(fmt::format("{}: cannot be opened for reading", path.string()));
    openvdb::initialize();
    openvdb::io::File file(path.string());
    file.open();
    const auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(find_grid(file, path.string(), name));
    VdbDensity density;
    density.name = grid->getName();
    density.level_set = grid->getGridClass() == openvdb::GRID_LEVEL_SET;
    if (density.level_set)
        openvdb::tools::sdfToFogVolume(*grid);

    const auto &transform = grid->transform();
    const openvdb::Vec3d size = transform.voxelSize();
    const double largest = std::max({size.x(), size.y(), size.z()}), least = std::min({size.x(), size.y(), size.z()});
    if (!transform.isLinear() || !(least > 0) || largest > least * 1.001)
        throw RequestError(fmt::format("{}: {}: voxels of {} x {} x {}; expected cubes", path.string(), density.name,
                                       size.x(), size.y(), size.z()));
    openvdb::CoordBBox box = grid->evalActiveVoxelBoundingBox();
    if (box.empty())
        throw RequestError(fmt::format("{}: {}: expected a grid with active voxels", path.string(), density.name));

    const auto dim = [&](int axis) { return double(box.max()[axis]) - box.min()[axis] + 1; };
    int step = 1;
    while (std::ceil(dim(0) / step) * std::ceil(dim(1) / step) * std::ceil(dim(2) / step) > kMostVoxels)
        ++step;
    const int margin = std::max(kLeastMargin, int(std::ceil(kMargin * std::max({dim(0), dim(1), dim(2)}) / step)));
    DensityGrid &to = density.grid;
    for (int i = 0; i < 3; ++i)
        to.size[std::size_t(i)] = int(std::ceil(dim(i) / step)) + 2 * margin;
    to.values.resize(to.index(0, 0, to.size[2]));
    const float share = 1 / (float(step) * float(step) * float(step));
    const auto add = [&](const openvdb::Coord &at, float value) {
        const openvdb::Coord from_box = at - box.min();
        to.values[to.index(margin + from_box.x() / step, margin + from_box.y() / step, margin + from_box.z() / step)] +=
            share * std::max(value, 0.0f);
    };
    for (auto it = grid->cbeginValueOn(); it; ++it) {
        if (!std::isfinite(*it))
            throw RequestError(fmt::format("{}: {}: a value of {} at {}, {}, {}; expected finite ones", path.string(),
                                           density.name, *it, it.getCoord().x(), it.getCoord().y(), it.getCoord().z()));
        openvdb::CoordBBox tile;
        it.getBoundingBox(tile);
        for (auto at = tile.begin(); at; ++at)
            add(*at, *it);
    }

    const openvdb::Vec3d first =
        box.min().asVec3d() + openvdb::Vec3d(0.5 * (step - 1)) - openvdb::Vec3d(double(step) * margin);
    const openvdb::Vec3d origin = transform.indexToWorld(first);
    for (int i = 0; i < 3; ++i) {
        openvdb::Vec3d along = first;
        along[i] += step;
        const openvdb::Vec3d axis = transform.indexToWorld(along) - origin;
        density.origin[std::size_t(i)] = origin[i];
        for (int j = 0; j < 3; ++j)
            density.axes[std::size_t(i)][std::size_t(j)] = axis[j];
    }
    density.voxel = largest * step;
    density.averaged = step;
    return density;
} catch (const openvdb::Exception &e) {
    throw RequestError(fmt::format("{}: {}", path.string(), e.what()));
}

}  // namespace

extern "C" __attribute__((visibility("default"))) VdbReader brume_vdb_reader(const char *version)
{
    return std::string_view(version) == kVdbModuleVersion ? read_here : nullptr;
}

}  // namespace brume::tool
