#include "media/vdb.hpp"

#include <algorithm>
#include <cstring>

#include <dlfcn.h>
#include <fmt/format.h>

#include "support/error.hpp"
#include "support/isolated.hpp"

namespace brume::tool {
namespace {

using Entry = VdbReader (*)(const char *version);

VdbReader load()
{
    // By its name alone: the loader looks where the tool's own libraries are.
    void *module = ::dlopen("brume-vdb.so", RTLD_NOW | RTLD_LOCAL);
    if (!module)
        throw RequestError(fmt::format("OpenVDB files can only be read with brume-vdb, which is built where OpenVDB is "
                                       "installed (libopenvdb-dev): {}",
                                       ::dlerror()));
    const auto entry = reinterpret_cast<Entry>(::dlsym(module, kVdbModuleEntry));
    const VdbReader reader = entry ? entry(kVdbModuleVersion) : nullptr;
    if (!reader)
        throw RequestError("brume-vdb.so is of another version than the tool");
    return reader;
}

// What has a fixed size, the name, the values: between two copies of this process.
struct Head {
    std::array<int, 3> size;
    std::array<double, 3> origin;
    std::array<std::array<double, 3>, 3> axes;
    double voxel;
    int averaged;
    bool level_set;
    std::size_t name_length;
};

std::string text_of(const VdbDensity &density)
{
    const Head head{density.grid.size, density.origin,    density.axes,       density.voxel,
                    density.averaged,  density.level_set, density.name.size()};
    std::string text(reinterpret_cast<const char *>(&head), sizeof head);
    text += density.name;
    text.append(reinterpret_cast<const char *>(density.grid.values.data()), density.grid.values.size() * sizeof(float));
    return text;
}

VdbDensity density_of(const std::string &text)
{
    Head head;
    std::memcpy(&head, text.data(), sizeof head);
    const std::size_t values = sizeof head + head.name_length;
    VdbDensity density{{head.size, std::vector<float>((text.size() - values) / sizeof(float))},
                       text.substr(sizeof head, head.name_length),
                       head.origin,
                       head.axes,
                       head.voxel,
                       head.averaged,
                       head.level_set};
    std::memcpy(density.grid.values.data(), text.data() + values, density.grid.values.size() * sizeof(float));
    return density;
}

}  // namespace

VdbDensity read_vdb(const std::filesystem::path &path, const std::string &name)
{
    // OpenVDB follows whatever offsets and sizes a damaged file has. Whole ones unpack to no more than this.
    std::error_code none;
    const std::uintmax_t bytes = std::filesystem::file_size(path, none);
    const std::uint64_t most = (std::uint64_t(2) << 30) + 256 * (none ? 0 : std::min<std::uint64_t>(bytes, 1ull << 48));
    return density_of(isolated(path.string(), most, [&] { return text_of(load()(path, name)); }));
}

}  // namespace brume::tool
