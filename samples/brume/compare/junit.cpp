#include "compare/junit.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "support/pending_file.hpp"
#include "support/text.hpp"

namespace brume::tool {
namespace {

std::string case_of(const Comparison &c)
{
    const std::string open = fmt::format("    <testcase classname=\"brume.compare\" name=\"{}\"", escaped(c.files.name));
    if (c.settled())
        return open + "/>\n";
    const char *kind = c.compared() ? "failure" : "error";
    const std::string why = c.compared() ? fmt::format("{}", fmt::join(c.verdict.beyond, "; ")) : c.error;
    return fmt::format("{}>\n      <{} message=\"{}\">{} against {}</{}>\n    </testcase>\n", open, kind, escaped(why),
                       escaped(c.files.a), escaped(c.files.b), kind);
}

}  // namespace

std::string escaped(const std::string &text)
{
    using nlohmann::json;
    const std::string valid =
        json::parse(json(printable(text)).dump(-1, ' ', false, json::error_handler_t::replace)).get<std::string>();
    std::string out;
    for (const char c : valid)
        switch (c) {
        case '&':
            out += "&amp;";
            break;
        case '<':
            out += "&lt;";
            break;
        case '>':
            out += "&gt;";
            break;
        case '"':
            out += "&quot;";
            break;
        default:
            out += c;
        }
    return out;
}

void write_junit(const std::string &path, const std::vector<Comparison> &comparisons)
{
    const auto count = [&](auto is) { return std::count_if(comparisons.begin(), comparisons.end(), is); };
    const std::string totals = fmt::format("tests=\"{}\" failures=\"{}\" errors=\"{}\"", comparisons.size(),
                                           count([](const Comparison &c) { return c.compared() && !c.settled(); }),
                                           count([](const Comparison &c) { return !c.compared() && !c.settled(); }));
    std::string text = fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites {0}>\n"
                                   "  <testsuite name=\"brume compare\" {0}>\n",
                                   totals);
    for (const Comparison &c : comparisons)
        text += case_of(c);
    text += "  </testsuite>\n</testsuites>\n";
    write_text_file(path, text);
}

}  // namespace brume::tool
