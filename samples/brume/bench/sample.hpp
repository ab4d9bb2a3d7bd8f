#pragma once

#include <optional>
#include <string>
#include <vector>

#include "frames/pattern.hpp"
#include "metrics/metrics.hpp"
#include "run/inputs.hpp"
#include "run/shot.hpp"

namespace brume::tool {

class Fogger;

/// A picture to be fogged with its depth, and what a path tracer made of it where that is known.
struct Sample {
    std::string name;
    brume_format format = BRUME_FORMAT_INIT;
    brume_camera camera = BRUME_CAMERA_INIT;
    double frame = 0;
    LuminanceWeights weights = kRec709Luminance;
    int channels = 3;
    std::vector<float> color, depth;
    std::vector<InputLayer> inputs;
    std::optional<Picture> truth;

    int width() const { return format.width; }
    int height() const { return format.height; }
};

/// The first frame of a pattern, or a file. `truth` empty: none. `fogger` finds the layers that its scene is given; null:
/// none. Throws RequestError and FrameError.
Sample load_sample(const FrameFile &file, const PictureOptions &options, const CameraBlock &scene_camera,
                   const std::string &truth, Fogger *fogger = nullptr);

/// Colour and what of it is one light's averaged over squares of `factor` pixels; depth and other layers taken from the
/// middle of each: distances and directions are not to be averaged. What is over at the right and at the bottom is cut off.
Sample reduced(const Sample &sample, int factor);

/// RGB of interleaved pixels.
Picture picture_of(const std::vector<float> &pixels, int width, int height, int channels);

}  // namespace brume::tool
