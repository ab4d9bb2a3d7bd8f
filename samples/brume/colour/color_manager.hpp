#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <OpenColorIO/OpenColorIO.h>

#include "image/frame.hpp"
#include "metrics/metrics.hpp"

namespace brume::tool {

struct ColorRequest {
    std::string input_space;   ///< empty: the pixels are in the config's scene_linear
    std::string output_space;  ///< empty: what came in goes out
    bool display = false;      ///< to_display() is wanted
};

/// Colour spaces around the fog, by $OCIO or the built-in config. Const members may be called from several threads. Where
/// nothing is asked of a config that does not work, warning() says so and luminance is Rec. 709's.
class ColorManager {
public:
    explicit ColorManager(const ColorRequest &request = {});

    /// In place, interleaved RGB or RGBA. Alpha is not touched.
    void to_working(float *pixels, std::size_t count, int channels) const;
    void from_working(float *pixels, std::size_t count, int channels) const;

    /// The same where nobody asked: by what the frame's file says of its pixels; as they are where it says nothing. Throws
    /// FrameError.
    void file_to_working(Frame &frame) const;

    /// Whether pixels leave in another space than they came in, so that `chromaticities` no longer holds.
    bool changes_space() const { return changes_space_; }

    /// Whether pixels pass through any conversion, be it there and back.
    bool converts() const { return in_ || out_; }

    /// Of the space that pixels leave in, where they change theirs and it is known.
    const std::optional<Chromaticities> &new_chromaticities() const { return new_chromaticities_; }

    /// Of the space that the fog works in. Without --input-space the file's own `chromaticities` decide, where it has them
    /// and they are not degenerate, which is put to `warnings`.
    LuminanceWeights luminance_weights(const PartInfo &part, std::vector<std::string> *warnings = nullptr) const;

    /// From the working space through the default view of the default display; RGB, eight bits.
    std::vector<std::uint8_t> to_display(const float *pixels, std::size_t count, int channels) const;

    /// What files can say of the space that pixels leave in: "sRGB", "Linear" or nothing.
    const std::string &said_of_output() const { return said_of_output_; }

    std::string description() const;
    const std::string &warning() const { return warning_; }

private:
    void load(const ColorRequest &request);
    OCIO_NAMESPACE::ConstCPUProcessorRcPtr processor(const std::string &from, const std::string &to) const;
    std::string name_in_config(const std::string &space) const;

    OCIO_NAMESPACE::ConstConfigRcPtr config_;
    OCIO_NAMESPACE::ConstCPUProcessorRcPtr in_, out_, view_;
    LuminanceWeights weights_;
    bool changes_space_ = false, has_input_space_ = false;
    std::optional<Chromaticities> new_chromaticities_;
    std::string source_, warning_, said_of_output_;
};

}  // namespace brume::tool
