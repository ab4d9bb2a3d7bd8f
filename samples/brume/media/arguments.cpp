#include "media/arguments.hpp"

#include <algorithm>
#include <charconv>
#include <sstream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "image/frame.hpp"
#include "run/shot.hpp"
#include "support/error.hpp"

namespace brume::tool {

std::vector<double> parse_numbers(const std::string &text, std::size_t count, const std::string &option)
{
    const auto refuse = [&] {
        throw RequestError(fmt::format("{} '{}': expected {} numbers with commas between", option, text, count));
    };
    std::vector<double> values;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t comma = std::min(text.find(',', at), text.size());
        double value = 0;
        const auto [end, error] = std::from_chars(text.data() + at, text.data() + comma, value);
        if (error != std::errc() || end != text.data() + comma || values.size() == count)
            refuse();
        values.push_back(value);
        at = comma + 1;
    }
    if (values.size() != count)
        refuse();
    return values;
}

void take_triple(const std::string &text, const std::string &option, double (&values)[3])
{
    if (text.empty())
        return;
    const auto parsed = parse_numbers(text, 3, option);
    std::copy(parsed.begin(), parsed.end(), values);
}

namespace {

std::vector<double> parse_points(const std::string &text, std::size_t dimensions, const std::string &option)
{
    std::vector<double> values;
    std::istringstream words(text);
    for (std::string word; words >> word;)
        for (const double value : parse_numbers(word, dimensions, option))
            values.push_back(value);
    return values;
}

PartInfo picture_of_size(const std::string &text)
{
    const auto x = text.find('x');
    int width = 0, height = 0;
    const auto number = [&](std::size_t from, std::size_t to, int &value) {
        const auto [end, error] = std::from_chars(text.data() + from, text.data() + to, value);
        return error == std::errc() && end == text.data() + to && value >= 1 && value <= 65536;
    };
    if (x == std::string::npos || !number(0, x, width) || !number(x + 1, text.size(), height))
        throw RequestError(fmt::format("--size '{}': expected WIDTHxHEIGHT, each from 1 to 65536", text));
    PartInfo picture;
    picture.data_window = picture.display_window = {{0, 0}, {width - 1, height - 1}};
    return picture;
}

}  // namespace

void ViewOptions::add_to(CLI::App &command, bool with_depth)
{
    with_depth_ = with_depth;
    auto *frame = command
                      .add_option("--frame", frame_,
                                  with_depth ? "Picture whose camera is meant, and whose depth is in the way"
                                             : "Picture whose camera is meant")
                      ->type_name("FILE.exr");
    if (!with_depth)
        command.add_option("--size", size_, "Size of the picture where there is no --frame")
            ->type_name("WIDTHxHEIGHT")
            ->excludes(frame);
    picture_.add_to(command);
}

ViewOptions::Loaded ViewOptions::load() const
{
    Loaded loaded;
    std::optional<ImageFile> file;
    if (!frame_.empty())
        file.emplace(frame_);
    if (with_depth_ && !picture_.depth_file().empty())
        throw RequestError("--depth: name the file that has the depth with --frame");
    DepthChoice depth = with_depth_ && file ? resolve_depth(*file, picture_.depth_request(), nullptr) : DepthChoice{};
    const PartInfo picture = file ? file->part(depth.part) : picture_of_size(size_);
    Camera camera = picture_.camera_asked(picture);
    camera.fill_from(file ? camera_from_metadata(*file, depth.part) : camera_from_metadata(picture));
    if (!camera.projection || !camera.pose)
        throw RequestError(fmt::format("no {} in --camera, --vfov or the metadata of --frame{}{}",
                                       camera.projection ? "camera pose" : "field of view", camera.notes.empty() ? "" : ": ",
                                       camera.notes_text()));
    loaded.camera_ = camera_of(camera, picture.display_window);
    loaded.format_ = format_of(picture.data_window, picture.display_window, picture_);
    if (!depth.channel.empty()) {
        picture_.take_depth_scale(depth, *file);
        loaded.depth_ = read_depth(*file, depth);
        picture_.depth_kind().convert(loaded.depth_);
    }
    return loaded;
}

const brume_media_view *ViewOptions::Loaded::get()
{
    view_.camera = &camera_;
    view_.format = &format_;
    if (!depth_.empty()) {
        image_.channels = 1;
        image_.width = format_.width;
        image_.height = format_.height;
        image_.data = depth_.data();
        view_.depth = &image_;
    }
    return &view_;
}

void StrokeOptions::add_to(CLI::App &command)
{
    auto *world = command.add_option("--stroke", points_, "Points of the stroke in scene units, with spaces between")
                      ->type_name("'X,Y,Z ...'");
    command
        .add_option("--screen-stroke", screen_points_,
                    "Points in pixels from the picture's top left corner; they are projected onto --plane")
        ->type_name("'X,Y ...'")
        ->excludes(world);
    command.add_option("--plane", plane_normal_, "Normal of a plane onto which the stroke is projected")->type_name("X,Y,Z");
    command.add_option("--plane-point", plane_point_, "A point of that plane (default: 0,0,0)")->type_name("X,Y,Z");
    view_.add_to(command, false);
}

StrokeOptions::Loaded StrokeOptions::load() const
{
    Loaded loaded;
    const bool screen = !screen_points_.empty();
    const std::size_t dimensions = screen ? 2 : 3;
    loaded.points_ = screen ? parse_points(screen_points_, 2, "--screen-stroke") : parse_points(points_, 3, "--stroke");
    loaded.stroke_.point_count = std::uint32_t(loaded.points_.size() / dimensions);
    if (loaded.points_.empty())
        throw RequestError("--stroke: no points; expected one at least, as 'X,Y,Z X,Y,Z'");
    take_triple(plane_normal_, "--plane", loaded.stroke_.plane_normal);
    take_triple(plane_point_, "--plane-point", loaded.stroke_.plane_point);
    if (screen) {
        if (!view_.given())
            throw RequestError("--screen-stroke: expected --frame, or --camera with --size, to say whose screen");
        loaded.view_ = view_.load();
    }
    return loaded;
}

const brume_media_stroke *StrokeOptions::Loaded::get()
{
    stroke_.points = points_.data();
    if (view_)
        stroke_.view = view_->get();
    return &stroke_;
}

void BrushOptions::add_to(CLI::App &command)
{
    auto *as_scale = command.add_option("--scale", scale, "Scale of the Gaussians: 1 / radius")->capture_default_str();
    command.add_option("--radius", radius, "Radius of the Gaussians, at which density has fallen to 1/e, in scene units")
        ->check(CLI::PositiveNumber)
        ->excludes(as_scale);
    command.add_option("--amplitude", amplitude, "Density at their centres, as a ratio to unit density")
        ->capture_default_str();
    command.add_option("--colour", color, "Share of the light met that they scatter (default: 1,1,1)")->type_name("R,G,B");
    command.add_option("--seed", seed, "Of all chance")->capture_default_str();
}

void BrushOptions::take(double &to_scale, double &to_amplitude, double (&to_colour)[3]) const
{
    to_scale = radius > 0 ? 1 / radius : scale;
    to_amplitude = amplitude;
    take_triple(color, "--colour", to_colour);
}

}  // namespace brume::tool
