#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "image/frame.hpp"
#include "image/library.hpp"

namespace brume::tool {

/// An extra output of the fog, added to the colour's part as brume.NAME.R/G/B, or brume.NAME.Y for one channel.
struct AddedLayer {
    std::string name;
    int channels = 3;
    SampleType type = SampleType::kHalf;
    std::vector<float> pixels;  ///< interleaved
};

struct WriteOptions {
    bool primaries_changed = false;  ///< the colour has been converted: what the header says of its space would be false
    std::optional<Chromaticities> chromaticities = {};  ///< of the new space, where they are known
    bool untouched = false;                             ///< the pixels are those that were read
    bool decoded = false;          ///< but for what a conversion there and back leaves, so that copying is not the same
    bool metadata = true;          ///< what the picture's file says of itself is written too
    std::string provenance = {};   ///< empty: not written
    std::string type = {};         ///< of channels, for what is no rewritten OpenEXR file; empty: what loses least
    std::string color_space = {};  ///< that the pixels are in, where files can say it: "sRGB" or empty
};

struct WriteReport {
    std::uint64_t clamped = 0;  ///< values beyond half's 65504, written as 65504
    std::vector<std::string> warnings;
};

/// A PNG of what a screen shows. Written beside and renamed, as every output.
void write_display(const Display &picture, const std::filesystem::path &output);

/// A layer by itself, as it is: integers hold 0 to 1, in the most bits that the format has. One channel where all are alike.
void write_layer(const Frame &frame, const AddedLayer &layer, const std::filesystem::path &output);

/// Whether write_frame() takes colour for not multiplied by alpha.
bool writes_straight_alpha(const Frame &frame, const std::filesystem::path &output, const std::string &type);

/// Writes the frame in the format that the output's name ends in; an OpenEXR file into a copy of it. The file appears under
/// its name only when it is whole.
WriteReport write_frame(const Frame &frame, const std::vector<AddedLayer> &layers, const std::filesystem::path &output,
                        const WriteOptions &options = {});

}  // namespace brume::tool
