#pragma once

#include "colour/color_manager.hpp"
#include "run/fogger.hpp"
#include "run/spaces.hpp"
#include "run/stats.hpp"

namespace brume::tool {

/// How the pictures of a run are read and written.
struct PictureRequest {
    PictureOptions picture;
    ColorRequest asked;
    std::string output, output_type;
    ReadLimits limits;
};

/// Pictures in the working space with their depth, as the library is given them; and back. Members may be called from
/// several threads.
class PictureIo {
public:
    PictureIo(PictureRequest request, const std::vector<FrameFile> &files)
        : request_(std::move(request)), spaces_(spaces_of(request_.asked, files, request_.output, request_.output_type,
                                                          request_.picture.layers, request_.limits)),
          colors_(spaces_)
    {
    }

    /// Throws FrameError and RequestError; what was resolved and what a person should know goes into `stats`.
    Frame read(const Fogger &fogger, LuminanceWeights &weights, FrameStats &stats) const;

    /// The frame's pixels are those of the file afterwards.
    void write(Frame &frame, const std::vector<AddedLayer> &layers, const LuminanceWeights &weights,
               const std::string &provenance, FrameStats &stats) const;

    const ColorManager &colors() const { return colors_; }
    const ReadLimits &limits() const { return request_.limits; }

private:
    const PictureRequest request_;
    const ColorRequest spaces_;
    const ColorManager colors_;
};

}  // namespace brume::tool
