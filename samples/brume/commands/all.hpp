#pragma once

#include <memory>

#include "commands/commands.hpp"

namespace brume::tool {

/// The whole command line: what main() parses, and what the manual and the shell's completion are made of.
std::unique_ptr<CLI::App> make_command_line(Action &chosen);

}  // namespace brume::tool
