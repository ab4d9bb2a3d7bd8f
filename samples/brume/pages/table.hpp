#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace brume::pages {

struct Command {
    std::string name;  ///< "brume media paint"
    const CLI::App *app;
};

/// The command itself and all below it, parents first.
std::vector<Command> commands_of(const CLI::App &app);

std::vector<const CLI::App *> subcommands_of(const CLI::App &app);

struct Value {
    bool taken = false;
    std::string name;                  ///< "FILE"
    std::vector<std::string> choices;  ///< in place of a name
    std::string limits;                ///< as the check that holds them says it: "INT in [1 - 64]"
    bool is_file() const;
};

Value value_of(const CLI::Option &option);

/// As they are typed: "-o", "--output".
std::vector<std::string> names_of(const CLI::Option &option);

}  // namespace brume::pages
