#include "commands/media.hpp"

#include <CLI/CLI.hpp>

namespace brume::tool {

void add_media(CLI::App &app, Action &chosen)
{
    auto *media = app.add_subcommand("media", "Make media of Gaussians: CSV or PLY files that scenes refer to");
    media->require_subcommand(1);
    media->footer("Edits of FILE are kept in FILE.journal, beside it, which undo, redo and replay read.");
    add_media_brushes(*media, chosen);
    add_media_particles(*media, chosen);
    add_media_selection(*media, chosen);
    add_media_history(*media, chosen);
    add_media_files(*media, chosen);
    add_media_fit(*media, chosen);
}

}  // namespace brume::tool
