#include "gl/program_source.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>

#include "base/error.h"
#include "effects/shader_text.h"

namespace brume::gl {
namespace {

std::string_view without_leading_space(std::string_view text)
{
    return text.substr(std::min(text.find_first_not_of(" \t\r"), text.size()));
}

bool skip(std::string_view &text, std::string_view prefix)
{
    if (!text.starts_with(prefix))
        return false;
    text.remove_prefix(prefix.size());
    return true;
}

// What follows `#include` on a line that is one. By hand: std::regex recurses once per character of a line.
std::optional<std::string_view> include_argument(std::string_view line)
{
    line = without_leading_space(line);
    if (!skip(line, "#"))
        return {};
    line = without_leading_space(line);
    if (!skip(line, "include"))
        return {};
    return without_leading_space(line);
}

// x.glsl of `"x.glsl"`, with a comment after it or nothing.
std::optional<std::string_view> quoted_file(std::string_view argument)
{
    if (!skip(argument, "\""))
        return {};
    const size_t end = argument.find('"');
    if (end == std::string_view::npos)
        return {};
    const std::string_view rest = without_leading_space(argument.substr(end + 1));
    if (!rest.empty() && !rest.starts_with("//") && !rest.starts_with("/*"))
        return {};
    return argument.substr(0, end);
}

class Assembler {
public:
    ProgramSource take() { return std::move(result_); }

    void add_line(const std::string &text, const std::string &file, int line)
    {
        result_.text += text + '\n';
        result_.places.push_back({file, line});
    }

    void add(const std::string &file, std::string_view text)
    {
        std::istringstream lines{std::string(text)};
        std::string line;
        for (int number = 1; std::getline(lines, line); ++number) {
            if (const auto argument = include_argument(line))
                add_include(*argument, file + ":" + std::to_string(number));
            else
                add_line(line, file, number);
        }
    }

private:
    void add_include(std::string_view argument, const std::string &where)
    {
        const auto quoted = quoted_file(argument);
        if (!quoted)
            throw Error(BRUME_ERROR_GL, where + ": #include " + std::string(argument) + "; expected #include \"file.glsl\"");
        const std::string file(*quoted);
        const std::string_view text = shader_text(file);
        if (text.empty())
            throw Error(BRUME_ERROR_GL, where + ": there is no shader library file \"" + file + "\" to include");
        if (included_.insert(file).second)
            add(file, text);
    }

    ProgramSource result_;
    std::set<std::string> included_{"prelude.glsl"};
};

}  // namespace

ProgramSource assemble_program(const std::string &name, const std::string &source, const std::string &defines)
{
    const std::string_view prelude = shader_text("prelude.glsl");
    if (prelude.empty())
        throw Error(BRUME_ERROR_INTERNAL, "prelude.glsl is not embedded in the library");
    Assembler assembler;
    assembler.add_line("#version 450 core", name + " (version)", 1);
    assembler.add(name + " (defines)", defines);
    assembler.add("prelude.glsl", prelude);
    assembler.add(name, source);
    return assembler.take();
}

std::string with_file_names(const std::string &log, const ProgramSource &source)
{
    std::istringstream lines(log);
    std::string result, line;
    while (std::getline(lines, line)) {
        // Mesa "0:12(5): error", NVIDIA "0(12) : error", AMD and Intel "ERROR: 0:12: ".
        std::string_view rest = line;
        std::string severity;
        for (const char *word : {"ERROR: ", "WARNING: "})
            if (skip(rest, word))
                severity = word;
        size_t number = 0;
        if (skip(rest, "0:") || skip(rest, "0(")) {
            const char *end = std::from_chars(rest.data(), rest.data() + rest.size(), number).ptr;
            rest.remove_prefix(size_t(end - rest.data()));
            skip(rest, ")");
        }
        if (number >= 1 && number <= source.places.size()) {
            const ProgramSource::Place &place = source.places[number - 1];
            line = severity + place.file + ":" + std::to_string(place.line) + std::string(rest);
        }
        result += line + '\n';
    }
    while (result.ends_with('\n'))
        result.pop_back();
    return result;
}

}  // namespace brume::gl
