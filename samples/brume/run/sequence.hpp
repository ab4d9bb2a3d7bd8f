#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "colour/color_manager.hpp"
#include "frames/pattern.hpp"
#include "run/fogger.hpp"
#include "run/stats.hpp"

namespace brume::tool {

struct SequenceOptions {
    FogOptions fog;
    ColorRequest spaces;
    std::string input, output, frames, preview, stats;
    std::string output_type;   ///< of channels; empty: what loses least
    int jobs = 0;              ///< 0: as many as there are threads
    std::uint64_t memory = 0;  ///< [MiB]; 0: half of the machine's
    bool skip_existing = false, keep_going = false, quiet = false, provenance = true;
};

/// One picture with its depth, opened and resolved, pixels not yet read.
struct OpenFrame {
    ImageFile file;
    ColorChoice color;
    std::optional<ImageFile> depth_file;  ///< where depth has a file of its own
    DepthChoice depth;
};

/// Throws FrameError for files that cannot be read, RequestError where layers cannot be resolved.
OpenFrame open_frame(const FrameFile &files, const PictureOptions &picture, const ReadLimits &limits);

/// Does everything that was asked and reports on stderr; returns the exit status. Throws RequestError while nothing has
/// been written.
int run_sequence(const SequenceOptions &options);

}  // namespace brume::tool
