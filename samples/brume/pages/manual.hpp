#pragma once

#include <string>

#include "pages/table.hpp"

namespace brume::pages {

/// "brume-media-paint"
std::string page_name(const Command &command);
std::string command_page(const Command &command, const std::string &date);

/// brume-scene(5), of what `brume schema` prints.
std::string scene_page(const std::string &schema, const std::string &date);

std::string bash_completion(const CLI::App &app);

}  // namespace brume::pages
