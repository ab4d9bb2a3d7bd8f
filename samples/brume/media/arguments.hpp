#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

#include <brume/brume_media.h>

#include "run/options.hpp"

namespace brume::tool {

/// "1,-2,.5" as `count` numbers; throws RequestError that names the option.
std::vector<double> parse_numbers(const std::string &text, std::size_t count, const std::string &option);

/// Writes a triple given as text into `values`; leaves them as they are where the text is empty.
void take_triple(const std::string &text, const std::string &option, double (&values)[3]);

/// --frame, --size and all that says how a picture's camera and depth are to be read.
class ViewOptions {
public:
    void add_to(CLI::App &command, bool with_depth);
    bool given() const { return !frame_.empty() || !size_.empty(); }

    /// What was asked for, ready for the library; pictures are read here. Throws RequestError where the camera is not known.
    class Loaded;
    Loaded load() const;

private:
    PictureOptions picture_;
    std::string frame_, size_;
    bool with_depth_ = false;
};

class ViewOptions::Loaded {
public:
    /// Lives as long as this.
    const brume_media_view *get();

private:
    friend class ViewOptions;
    brume_camera camera_ = BRUME_CAMERA_INIT;
    brume_format format_ = BRUME_FORMAT_INIT;
    brume_image image_ = BRUME_IMAGE_INIT;
    brume_media_view view_ = BRUME_MEDIA_VIEW_INIT;
    std::vector<float> depth_;
};

/// --stroke, --screen-stroke and --plane.
class StrokeOptions {
public:
    void add_to(CLI::App &command);

    class Loaded;
    Loaded load() const;

private:
    std::string points_, screen_points_, plane_point_, plane_normal_;
    ViewOptions view_;
};

class StrokeOptions::Loaded {
public:
    /// Lives as long as this.
    const brume_media_stroke *get();

private:
    friend class StrokeOptions;
    std::vector<double> points_;
    std::optional<ViewOptions::Loaded> view_;
    brume_media_stroke stroke_ = BRUME_MEDIA_STROKE_INIT;
};

/// What the Gaussians of a brush are like.
struct BrushOptions {
    double scale = 1, radius = 0, amplitude = 1;
    std::string color;
    std::uint32_t seed = 0;

    void add_to(CLI::App &command);
    void take(double &to_scale, double &to_amplitude, double (&to_colour)[3]) const;
};

}  // namespace brume::tool
