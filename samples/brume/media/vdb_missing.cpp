#include "media/vdb.hpp"
#include "support/error.hpp"

namespace brume::tool {

VdbDensity read_vdb(const std::filesystem::path &file, const std::string &)
{
    throw RequestError(file.string() +
                       ": this brume was built without OpenVDB (libopenvdb-dev); build it again where that is "
                       "installed");
}

}  // namespace brume::tool
