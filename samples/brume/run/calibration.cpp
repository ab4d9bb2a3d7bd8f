#include "run/calibration.hpp"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include <fmt/format.h>

#include "support/sdk.hpp"

namespace brume::tool {

std::filesystem::path calibration_file(const Context &context)
{
    const brume_context_info info = context.info();
    const char *cache = std::getenv("XDG_CACHE_HOME"), *home = std::getenv("HOME");
    std::filesystem::path folder;
    if (cache && *cache == '/')
        folder = cache;
    else if (home && *home == '/')
        folder = std::filesystem::path(home) / ".cache";
    else
        return {};
    std::string device;
    for (const char *c = info.device; *c; ++c)
        device += std::isalnum(static_cast<unsigned char>(*c)) ? *c : '-';
    return folder / "brume" / fmt::format("{}-{}-{}-threads.json", backend_name(info.backend), device, info.threads);
}

void load_calibration(const Context &context)
{
    const std::filesystem::path file = calibration_file(context);
    std::ifstream in(file, std::ios::binary);
    if (file.empty() || !in)
        return;
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    if (context.set_calibration(text) != BRUME_OK)
        fmt::print(stderr, "brume: {} is not used: {}\n", file.string(), context.message());
}

}  // namespace brume::tool
