#pragma once

#include <memory>

#include "commands/commands.hpp"

namespace brume::tool {

/// The whole command line: what is parsed, and what the manual and the shell's completion are made of.
std::unique_ptr<CLI::App> make_command_line(Action &chosen);

/// main(); here, since CLI11's headers cost a compiler more than all of it.
int run_command_line(int argc, char **argv);

}  // namespace brume::tool
