#pragma once
#include <string>
#include <vector>

namespace brume::gl {

// A compute shader's whole text, and which file and line each of its lines came from. (#line directives would not do:
// Mesa reports many errors with the right line but source string 0.)
struct ProgramSource {
    struct Place {
        std::string file;
        int line;
    };
    std::string text;
    std::vector<Place> places;
};

// Version, defines, prelude.glsl and the source, with `#include "x.glsl"` of shaders/lib replaced by the file, once
// each. Throws Error(BRUME_ERROR_GL) on an include that cannot be had.
ProgramSource assemble_program(const std::string &name, const std::string &source, const std::string &defines);

// The compiler's log with files and their lines for lines of the whole text, in any of the drivers' notations.
std::string with_file_names(const std::string &log, const ProgramSource &source);

}  // namespace brume::gl
