#pragma once

#include <string>
#include <vector>

namespace brume::tool {

/// oiiotool's frame syntax: "200", "1-100", "1-100x2" (every second), "1-100y2" (all but every second), "10-1x-1",
/// comma-separated; numbers may be negative ("-10--5"). In the order given, without repeats. Throws RequestError.
std::vector<int> parse_frames(const std::string &text);

}  // namespace brume::tool
