#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace brume {

// The content of a regular file; throws Error(BRUME_ERROR_SCENE) where it cannot be read or is larger than `limit`.
std::string read_whole_file(const std::string &path, size_t limit);

// Writes beside the path and renames: the file there stays as it was until the new one is whole.
// Throws Error(BRUME_ERROR_ARGUMENT).
void write_whole_file(const std::string &path, std::string_view content);

}  // namespace brume
