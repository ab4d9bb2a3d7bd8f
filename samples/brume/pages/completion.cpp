#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "pages/manual.hpp"

namespace brume::pages {
namespace {

std::string joined(const std::vector<std::string> &words, const char *between)
{
    return fmt::format("{}", fmt::join(words, between));
}

// What the word after an option is completed from: choices, files, or nothing that the shell knows.
std::string values_of(const CLI::App &app)
{
    std::vector<std::string> files, others;
    std::string cases;
    for (const CLI::Option *option : app.get_options()) {
        const std::vector<std::string> names = names_of(*option);
        const Value value = value_of(*option);
        if (names.empty() || !value.taken)
            continue;
        if (!value.choices.empty())
            cases +=
                fmt::format("        {}) takes=words words=\"{}\" ;;\n", joined(names, "|"), joined(value.choices, " "));
        else
            (value.is_file() ? files : others).insert((value.is_file() ? files : others).end(), names.begin(), names.end());
    }
    if (!files.empty())
        cases += fmt::format("        {}) takes=files ;;\n", joined(files, "|"));
    if (!others.empty())
        cases += fmt::format("        {}) takes=nothing ;;\n", joined(others, "|"));
    return cases.empty() ? "" : "      case $prev in\n" + cases + "      esac\n";
}

std::string case_of(const Command &command)
{
    std::vector<std::string> subcommands, options;
    for (const CLI::App *sub : subcommands_of(*command.app))
        subcommands.push_back(sub->get_name());
    bool takes_files = false;
    for (const CLI::Option *option : command.app->get_options()) {
        const std::vector<std::string> names = names_of(*option);
        options.insert(options.end(), names.begin(), names.end());
        // The one positional that is no file is the name of an effect.
        takes_files = takes_files || (option->get_positional() && option->get_name(true) != "NAME");
    }
    return fmt::format("    '{}')\n      subcommands=\"{}\" options=\"{}\" positional={}\n{}      ;;\n", command.name,
                       joined(subcommands, " "), joined(options, " "), takes_files ? "files" : "nothing",
                       values_of(*command.app));
}

}  // namespace

std::string bash_completion(const CLI::App &app)
{
    std::string cases;
    for (const Command &command : commands_of(app))
        cases += case_of(command);
    // "=" parts words, so the value of --option=value comes two words after its option.
    return R"(# bash completion of brume, made from its table of options.
_brume()
{
  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} path=brume at=1
  local subcommands options positional takes='' words=''
  if [ "$cur" = = ]; then
    cur=''
  elif [ "$prev" = = ] && [ "$COMP_CWORD" -ge 3 ]; then
    prev=${COMP_WORDS[COMP_CWORD-2]}
  fi
  while [ "$at" -lt "$COMP_CWORD" ]; do
    case ${COMP_WORDS[at]} in
      -*|=) break ;;
    esac
    _brume_knows "$path ${COMP_WORDS[at]}" || break
    path+=" ${COMP_WORDS[at]}"
    at=$((at + 1))
  done
  case $path in
)" + cases +
           R"(  esac
  if [ -z "$takes" ]; then
    if [ -n "$subcommands" ]; then
      takes=words words="$subcommands $options"
    elif [[ $cur == -* ]]; then
      takes=words words=$options
    else
      takes=$positional
    fi
  fi
  COMPREPLY=()
  case $takes in
    words) mapfile -t COMPREPLY < <(compgen -W "$words" -- "$cur") ;;
    files)
      mapfile -t COMPREPLY < <(compgen -f -- "$cur")
      compopt -o filenames 2>/dev/null ;;
  esac
}
_brume_knows()
{
  case $1 in
)" +
           [&] {
               std::string known;
               for (const Command &command : commands_of(app))
                   known += fmt::format("    '{}') return 0 ;;\n", command.name);
               return known;
           }() +
           R"(  esac
  return 1
}
complete -F _brume brume
)";
}

}  // namespace brume::pages
