#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "exr/file.hpp"
#include "exr/resolve.hpp"
#include "exr/resolve_input.hpp"

namespace brume::tool {

/// One channel as the file stores it, subsampling included.
struct Plane {
    ChannelInfo channel;
    std::unique_ptr<char[]> bytes;
    std::size_t sample_bytes = 0;
};

/// A layer that is given to the library, over the data window of the picture that it goes with. Where it has no sample there
/// is no medium: transmittance is 1 there, all else 0.
struct InputLayer {
    std::string role;
    int channels = 3;
    std::vector<float> pixels;  ///< interleaved
    std::uint64_t outside = 0;  ///< pixels without a sample
    std::uint32_t light = 0;    ///< as InputChoice has it
};

/// A picture ready for the library, and all that is needed to write it back without losing anything.
struct Frame {
    ExrFile file;
    ColorChoice color;
    std::vector<Plane> planes;  ///< every channel of the colour's part
    int width = 0, height = 0, channels = 3;
    std::vector<float> pixels;  ///< interleaved RGB or RGBA
    std::vector<float> depth;   ///< over the colour's data window; +inf where the depth has no sample; empty without depth
    std::uint64_t outside_depth_window = 0;
    std::vector<InputLayer> inputs = {};

    const PartInfo &part() const { return file.parts()[color.part]; }
};

/// Where depth lives when it is not in the picture's own file.
struct DepthSource {
    const ExrFile *file;  ///< null: the picture's own file
    DepthChoice choice;
};

/// Whether this channel loses something when it is stored with this compression. DWA goes by the channel's name.
bool is_lossy_for(Imf::Compression compression, const ChannelInfo &channel);

/// What read_frame will allocate, from the headers alone.
std::uint64_t frame_bytes(const ExrFile &file, const ColorChoice &color);

Frame read_frame(ExrFile file, const ColorChoice &color, const DepthSource *depth);

/// `planes`: those of the choice's part, where they have been read already.
InputLayer read_input(const ExrFile &file, const InputChoice &choice, const PartInfo &onto,
                      const std::vector<Plane> *planes = nullptr);

/// One channel of one part as floats, row by row over its data window.
std::vector<float> read_channel(const ExrFile &file, int part, const std::string &channel);

}  // namespace brume::tool
