#pragma once

#include "commands/commands.hpp"

namespace brume::tool {

// The subcommands of `brume media`, by file.
void add_media_brushes(CLI::App &media, Action &chosen);
void add_media_particles(CLI::App &media, Action &chosen);
void add_media_selection(CLI::App &media, Action &chosen);
void add_media_history(CLI::App &media, Action &chosen);
void add_media_files(CLI::App &media, Action &chosen);
void add_media_fit(CLI::App &media, Action &chosen);

}  // namespace brume::tool
