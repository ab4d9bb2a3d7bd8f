#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "image/metadata.hpp"
#include "image/types.hpp"

namespace brume::tool {

struct NewChannel {
    std::string name;
    SampleType type = SampleType::kFloat;
    const float *values = nullptr;
    std::size_t stride = 1;  ///< in floats
};

struct NewPicture {
    Window data, display;
    double pixel_aspect = 1;
    std::vector<NewChannel> channels = {};
    std::optional<Chromaticities> chromaticities = {};
    Metadata metadata = {};
};

/// An OpenEXR file that is made of no other; whole under its name or not at all. Returns how many values half cannot hold:
/// they are written as its largest.
std::uint64_t write_new_exr(const std::filesystem::path &output, const NewPicture &picture);

}  // namespace brume::tool
