#include "pages/table.hpp"

#include <CLI/CLI.hpp>

#include "support/text.hpp"

namespace brume::pages {
namespace {

void append(std::vector<Command> &commands, const std::string &name, const CLI::App &app)
{
    commands.push_back({name, &app});
    for (const CLI::App *sub : subcommands_of(app))
        append(commands, name + " " + sub->get_name(), *sub);
}

std::string limits_of(const CLI::Option &option)
{
    std::string limits;
    try {
        // It has no const form, and says by an exception that there are no more.
        for (int i = 0;; ++i) {
            const std::string one = const_cast<CLI::Option &>(option).get_validator(i)->get_description();
            limits.append(":").append(one);
        }
    } catch (const CLI::OptionNotFound &) {
    }
    return limits;
}

}  // namespace

std::vector<Command> commands_of(const CLI::App &app)
{
    std::vector<Command> commands;
    append(commands, app.get_name(), app);
    return commands;
}

std::vector<const CLI::App *> subcommands_of(const CLI::App &app)
{
    return app.get_subcommands([](const CLI::App *sub) { return !sub->get_name().empty() && !sub->get_group().empty(); });
}

bool Value::is_file() const
{
    return name.starts_with("FILE") || name == "DIR" || name == "OUTPUT";
}

Value value_of(const CLI::Option &option)
{
    Value value;
    if (option.get_items_expected_max() == 0)
        return value;
    value.taken = true;
    value.name = option.get_type_name();
    if (const std::string limits = limits_of(option); limits.size() > 1 && value.name.ends_with(limits)) {
        value.name.resize(value.name.size() - limits.size());
        value.limits = limits.substr(1);
    }
    for (std::string *text : {&value.name, &value.limits})
        if (text->starts_with('{') && text->ends_with('}')) {
            value.choices = tool::split(text->substr(1, text->size() - 2), ',');
            text->clear();
        }
    return value;
}

std::vector<std::string> names_of(const CLI::Option &option)
{
    std::vector<std::string> names;
    for (const std::string &name : option.get_snames())
        names.push_back("-" + name);
    for (const std::string &name : option.get_lnames())
        names.push_back("--" + name);
    return names;
}

}  // namespace brume::pages
