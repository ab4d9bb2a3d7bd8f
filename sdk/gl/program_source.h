#pragma once
#include <string>
#include <vector>

namespace brume::gl {

// A compute shader's whole text, and the files that its #line numbers stand for.
struct ProgramSource {
    std::string text;
    std::vector<std::string> files;
};

// Version, defines, prelude.glsl and the source, with `#include "x.glsl"` of shaders/lib replaced by the file, once each.
// Throws Error(BRUME_ERROR_GL) on an include that cannot be had.
ProgramSource assemble_program(const std::string &name, const std::string &source, const std::string &defines);

// The compiler's log with file names for numbers, in any of the drivers' notations.
std::string with_file_names(const std::string &log, const std::vector<std::string> &files);

}  // namespace brume::gl
