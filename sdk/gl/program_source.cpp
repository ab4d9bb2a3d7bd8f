#include "gl/program_source.h"

#include <algorithm>
#include <regex>
#include <sstream>
#include <string_view>

#include "core/error.h"
#include "core/shader_text.h"

namespace brume::gl {
namespace {

class Assembler {
public:
    ProgramSource take() { return std::move(result_); }

    void add(const std::string &file, std::string_view text)
    {
        const size_t number = result_.files.size();
        result_.files.push_back(file);
        line_directive(1, number);
        std::istringstream lines{std::string(text)};
        std::string line;
        for (int at = 1; std::getline(lines, line); ++at) {
            static const std::regex include(R"(\s*#\s*include\b\s*(.*?)\s*)");
            std::smatch match;
            if (!std::regex_match(line, match, include)) {
                result_.text += line + '\n';
                continue;
            }
            add_include(match[1], file + ":" + std::to_string(at));
            line_directive(at + 1, number);
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
        if (std::find(result_.files.begin() + 1, result_.files.end(), file) != result_.files.end())
            return;
        const std::string_view text = shader_text(file);
        if (text.empty())
            throw Error(BRUME_ERROR_GL, where + ": there is no shader library file \"" + file + "\" to include");
        add(file, text);
    }

    void line_directive(int line, size_t number)
    {
        result_.text += "#line " + std::to_string(line) + " " + std::to_string(number) + "\n";
    }

    ProgramSource result_{"#version 450 core\n", {}};
};

}  // namespace

ProgramSource assemble_program(const std::string &name, const std::string &source, const std::string &defines)
{
    const std::string_view prelude = shader_text("prelude.glsl");
    if (prelude.empty())
        throw Error(BRUME_ERROR_INTERNAL, "prelude.glsl is not embedded in the library");
    Assembler assembler;
    assembler.add(name + " (defines)", defines);
    assembler.add("prelude.glsl", prelude);
    assembler.add(name, source);
    return assembler.take();
}

std::string with_file_names(const std::string &log, const std::vector<std::string> &files)
{
    // Mesa "0:12(5): error", NVIDIA "0(12) : error", AMD and Intel "ERROR: 0:12: ".
    static const std::regex place(R"(^(ERROR: |WARNING: )?(\d+)([:(]\d+.*)$)");
    std::istringstream lines(log);
    std::string result, line;
    while (std::getline(lines, line)) {
        std::smatch match;
        if (std::regex_match(line, match, place)) {
            const size_t number = match[2].length() < 6 ? std::stoul(match[2]) : files.size();
            if (number < files.size())
                line = match[1].str() + files[number] + match[3].str();
        }
        result += line + '\n';
    }
    while (!result.empty() && (result.back() == '\n' || result.back() == '\0'))
        result.pop_back();
    return result;
}

}  // namespace brume::gl
