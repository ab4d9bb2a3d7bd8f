#include "gl/program_source.h"

#include <regex>
#include <set>
#include <sstream>
#include <string_view>

#include "core/error.h"
#include "core/shader_text.h"

namespace brume::gl {
namespace {

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
        static const std::regex include(R"(\s*#\s*include\b\s*(.*?)\s*)");
        std::istringstream lines{std::string(text)};
        std::string line;
        for (int number = 1; std::getline(lines, line); ++number) {
            std::smatch match;
            if (std::regex_match(line, match, include))
                add_include(match[1], file + ":" + std::to_string(number));
            else
                add_line(line, file, number);
        }
    }

private:
    void add_include(const std::string &argument, const std::string &where)
    {
        static const std::regex quoted(R"re("([^"]*)"\s*(//.*)?)re");
        std::smatch match;
        if (!std::regex_match(argument, match, quoted))
            throw Error(BRUME_ERROR_GL, where + ": #include " + argument + "; expected #include \"file.glsl\"");
        const std::string file = match[1];
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
    // Mesa "0:12(5): error", NVIDIA "0(12) : error", AMD and Intel "ERROR: 0:12: ".
    static const std::regex place(R"(^(ERROR: |WARNING: )?0[:(](\d{1,6})(.*)$)");
    std::istringstream lines(log);
    std::string result, line;
    while (std::getline(lines, line)) {
        std::smatch match;
        if (std::regex_match(line, match, place)) {
            const size_t number = std::stoul(match[2]);
            std::string rest = match[3];
            if (rest.starts_with(")"))
                rest.erase(0, 1);
            if (number >= 1 && number <= source.places.size())
                line = match[1].str() + source.places[number - 1].file + ":" +
                       std::to_string(source.places[number - 1].line) + rest;
        }
        result += line + '\n';
    }
    while (result.ends_with('\n'))
        result.pop_back();
    return result;
}

}  // namespace brume::gl
