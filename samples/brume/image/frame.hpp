#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "image/file.hpp"
#include "image/resolve.hpp"
#include "image/resolve_input.hpp"

namespace brume::tool {

/// A layer that is given to the library, over the data window of the picture that it goes with. Where it has no sample there
/// is no medium: transmittance is 1 there, all else 0. A shadow map has its own size, and nothing where it has no sample.
struct InputLayer {
    std::string role;
    int width, height;
    int channels = 3;
    std::shared_ptr<const std::vector<float>> pixels;  ///< interleaved
    std::uint64_t outside = 0;                         ///< pixels without a sample
    std::uint32_t light = 0;                           ///< as InputChoice has it
};

/// A picture ready for the library, and all that is needed to write it back without losing anything.
struct Frame {
    ImageFile file;
    ColorChoice color;
    std::shared_ptr<const StoredPixels> stored;  ///< every channel of the colour's part
    int width = 0, height = 0, channels = 3;
    std::vector<float> pixels;  ///< interleaved RGB or RGBA
    std::vector<float> depth;   ///< over the colour's data window; +inf where the depth has no sample; empty without depth
    std::uint64_t outside_depth_window = 0;
    std::vector<InputLayer> inputs = {};

    const PartInfo &part() const { return file.parts()[color.part]; }
};

/// Where depth lives when it is not in the picture's own file.
struct DepthSource {
    const ImageFile *file;  ///< null: the picture's own file
    DepthChoice choice;
};

/// What read_frame will allocate, from the headers alone.
std::uint64_t frame_bytes(const ImageFile &file, const ColorChoice &color);

Frame read_frame(ImageFile file, const ColorChoice &color, const DepthSource *depth);

/// Colour times alpha, as fog needs it; and what it was before, where alpha is not 0.
void associate_alpha(Frame &frame);
void dissociate_alpha(Frame &frame);

/// `stored`: every channel of the choice's part, where they have been read already.
InputLayer read_input(const ImageFile &file, const InputChoice &choice, const PartInfo &onto,
                      const StoredPixels *stored = nullptr);

/// A light's shadow map over its display window.
InputLayer read_shadow(const ImageFile &file, const InputChoice &choice);

/// One channel of one part as floats, row by row over its data window: numbers as they are stored, integers too.
std::vector<float> read_channel(const ImageFile &file, int part, const std::string &channel);

/// The same, times the choice's scale.
std::vector<float> read_depth(const ImageFile &file, const DepthChoice &depth);

}  // namespace brume::tool
