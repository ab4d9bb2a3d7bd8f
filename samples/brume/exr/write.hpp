#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <ImfChromaticitiesAttribute.h>

#include "exr/frame.hpp"

namespace brume::tool {

/// An extra output of the fog, added to the colour's part as brume.NAME.R/G/B, or brume.NAME.Y for one channel.
struct AddedLayer {
    std::string name;
    int channels = 3;
    Imf::PixelType type = Imf::HALF;
    std::vector<float> pixels;  ///< interleaved
};

/// Attribute of the part with the colour: what made it. One of an earlier run is replaced or goes.
constexpr const char *kProvenance = "brume:provenance";

struct WriteOptions {
    bool primaries_changed = false;  ///< the colour has been converted: what the header says of its space would be false
    std::optional<Imf::Chromaticities> chromaticities = {};  ///< of the new space, where they are known
    bool untouched = false;       ///< the pixels are those that were read: they are copied as they are coded
    std::string provenance = {};  ///< empty: not written
};

struct WriteReport {
    std::uint64_t clamped = 0;  ///< values beyond half's 65504, written as 65504
    std::vector<std::string> warnings;
};

/// Writes the frame's pixels over the colour channels of a copy of its file. Parts without colour are copied
/// undecoded. The file appears under its name only when it is whole.
WriteReport write_frame(const Frame &frame, const std::vector<AddedLayer> &layers, const std::filesystem::path &output,
                        const WriteOptions &options = {});

}  // namespace brume::tool
