#include <algorithm>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "pages/manual.hpp"
#include "pages/roff.hpp"

namespace brume::pages {
namespace {

std::string sentence(std::string text)
{
    if (!text.empty() && !text.ends_with('.'))
        text += '.';
    return text;
}

std::string limits_text(const std::string &limits)
{
    // "INT in [1 - 64]"
    if (const auto from = limits.find(" in ["); from != std::string::npos) {
        std::string range = limits.substr(from + 5, limits.size() - from - 6);
        if (const auto dash = range.find(" - "); dash != std::string::npos)
            return range.replace(dash, 3, " to ");
    }
    return limits == "POSITIVE" ? "above 0" : limits == "NONNEGATIVE" ? "0 or more" : limits;
}

// What its description leaves to the table.
std::string rest_text(const CLI::Option &option)
{
    std::string rest;
    const Value value = value_of(option);
    if (!value.limits.empty())
        rest += " " + sentence("Expected: " + limits_text(value.limits));
    if (value.taken && !option.get_default_str().empty())
        rest += " " + sentence("Default: " + option.get_default_str());
    std::string excluded;
    for (const CLI::Option *other : option.get_excludes())
        excluded += (excluded.empty() ? "" : " or ") + ("`" + names_of(*other).back() + "`");
    if (!excluded.empty())
        rest += " Not together with " + excluded + ".";
    return rest;
}

std::string option_entry(const CLI::Option &option)
{
    std::string names;
    for (const std::string &name : names_of(option))
        names += (names.empty() ? "" : ", ") + bold(name);
    const Value value = value_of(option);
    std::string choices;
    for (const std::string &choice : value.choices)
        choices += (choices.empty() ? "" : "|") + bold(choice);
    if (!choices.empty())
        names += " " + choices;
    else if (!value.name.empty())
        names += " " + italic(value.name);
    return fmt::format(".TP\n{}\n{}\n", names, roff(sentence(option.get_description()) + rest_text(option)));
}

std::string synopsis(const Command &command)
{
    std::string text = ".SH SYNOPSIS\n" + bold(command.name);
    if (!subcommands_of(*command.app).empty())
        return text + " " + italic("COMMAND") + " ...\n";
    for (const CLI::Option *option : command.app->get_options())
        if (option->get_required() && !option->get_positional())
            text += " " + bold(names_of(*option).front()) + " " + italic(value_of(*option).name);
    text += " [" + italic("OPTION") + " ...]";
    for (const CLI::Option *option : command.app->get_options())
        if (option->get_positional()) {
            const std::string name = italic(option->get_name(true));
            const bool many = option->get_expected_max() >= CLI::detail::expected_max_vector_size;
            text += option->get_required() ? " " + name : " [" + name + "]";
            text += many ? " ..." : "";
        }
    return text + "\n";
}

std::string footer(const CLI::App &app)
{
    const std::string text = app.get_footer(), of_status = "Exit status: ";
    if (text.empty())
        return "";
    if (!text.starts_with(of_status))
        return ".SH NOTES\n" + roff(text) + "\n";
    std::string entries = ".SH EXIT STATUS\n";
    for (std::string rest = text.substr(of_status.size()); !rest.empty();) {
        const auto end = std::min(rest.find(';'), rest.size());
        std::string one = rest.substr(rest.find_first_not_of(" \n"), std::string::npos);
        one = one.substr(0, std::min(one.find(';'), one.size()));
        entries += fmt::format(".TP\n{}\n{}\n", bold(one.substr(0, 1)), roff(sentence(one.substr(2))));
        rest.erase(0, end + 1);
    }
    return entries;
}

std::string see_also(const Command &command)
{
    std::string pages;
    const auto parent = command.name.rfind(' ');
    if (parent != std::string::npos)
        pages = bold(page_name({command.name.substr(0, parent), nullptr})) + "(1),\n";
    return ".SH SEE ALSO\n" + pages + bold("brume-scene") + "(5)\n";
}

}  // namespace

std::string page_name(const Command &command)
{
    std::string name = command.name;
    std::replace(name.begin(), name.end(), ' ', '-');
    return name;
}

std::string command_page(const Command &command, const std::string &date)
{
    const CLI::App &app = *command.app;
    std::string summary = app.get_description();
    if (summary.ends_with('.'))
        summary.pop_back();
    std::string page = head(page_name(command), 1, date, summary) + synopsis(command);

    if (const auto subcommands = subcommands_of(app); !subcommands.empty()) {
        page += ".SH COMMANDS\n";
        for (const CLI::App *sub : subcommands)
            page += fmt::format(".TP\n{}(1)\n{}\n", bold(page_name(command) + "-" + sub->get_name()),
                                roff(sentence(sub->get_description())));
    }
    std::string arguments;
    for (const CLI::Option *option : app.get_options())
        if (option->get_positional())
            arguments += fmt::format(".TP\n{}\n{}\n", italic(option->get_name(true)),
                                     roff(sentence(option->get_description()) + rest_text(*option)));
    if (!arguments.empty())
        page += ".SH ARGUMENTS\n" + arguments;
    page += ".SH OPTIONS\n";
    for (const std::string &group : app.get_groups()) {
        std::string entries;
        for (const CLI::Option *option : app.get_options())
            if (option->get_group() == group && !option->get_positional())
                entries += option_entry(*option);
        if (!entries.empty())
            page += (group == "Options" ? "" : ".SS " + roff(group) + "\n") + entries;
    }
    return page + footer(app) + see_also(command);
}

}  // namespace brume::pages
