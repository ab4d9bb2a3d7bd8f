#include <memory>

#include <CLI/CLI.hpp>

#include "commands/media.hpp"
#include "media/arguments.hpp"
#include "media/document.hpp"
#include "support/error.hpp"

namespace brume::tool {
namespace {

struct PaintOptions {
    std::string file;
    StrokeOptions stroke;
    BrushOptions brush;
    double spacing = 0, jitter = 1;
};

int paint(const PaintOptions &options)
{
    auto stroke = options.stroke.load();
    brume_media_paint paint = BRUME_MEDIA_PAINT_INIT;
    paint.seed = options.brush.seed;
    paint.stroke = stroke.get();
    options.brush.take(paint.scale, paint.amplitude, paint.color);
    paint.spacing = options.spacing;
    paint.jitter = options.jitter;
    Document document(options.file, Document::kIsEmpty);
    document.check(document.media().apply(paint));
    document.save();
    return kDone;
}

struct EraseOptions {
    std::string file;
    StrokeOptions stroke;
    double radius = 1, strength = 1;
};

int erase(const EraseOptions &options)
{
    auto stroke = options.stroke.load();
    brume_media_erase erase = BRUME_MEDIA_ERASE_INIT;
    erase.stroke = stroke.get();
    erase.radius = options.radius;
    erase.strength = options.strength;
    Document document(options.file, Document::kFails);
    document.check(document.media().apply(erase));
    document.save();
    return kDone;
}

}  // namespace

void add_media_brushes(CLI::App &media, Action &chosen)
{
    auto *command = media.add_subcommand("paint", "Gaussians along a stroke");
    auto painting = std::make_shared<PaintOptions>();
    command->add_option("FILE", painting->file, "Media file; made where it is missing")->required();
    painting->stroke.add_to(*command);
    painting->brush.add_to(*command);
    command->add_option("--spacing", painting->spacing, "Distance between Gaussians along the stroke (default: 0.75 radii)");
    command->add_option("--jitter", painting->jitter, "Bound of each one's random offset across the stroke, in radii")
        ->capture_default_str();
    command->callback([&chosen, painting] { chosen = [painting] { return paint(*painting); }; });

    command = media.add_subcommand("erase", "Take density away along a stroke; what reaches zero is removed");
    auto erasing = std::make_shared<EraseOptions>();
    command->add_option("FILE", erasing->file, "Media file")->required();
    erasing->stroke.add_to(*command);
    command->add_option("--radius", erasing->radius, "Radius of the eraser, in scene units")->capture_default_str();
    command->add_option("--strength", erasing->strength, "Amplitude taken at its centre; less outwards, none at its radius")
        ->capture_default_str();
    command->callback([&chosen, erasing] { chosen = [erasing] { return erase(*erasing); }; });
}

}  // namespace brume::tool
