#include "pages/roff.hpp"

#include <algorithm>
#include <cctype>

#include <brume/brume.h>
#include <fmt/format.h>

namespace brume::pages {

std::string roff(std::string_view text)
{
    std::string out;
    bool quoted = false, starts_line = true;
    for (const char c : text) {
        // A control character at the start of a line would make a request of it.
        if (starts_line && (c == '.' || c == '\''))
            out += "\\&";
        starts_line = c == '\n';
        if (c == '`')
            out += (quoted = !quoted) ? "\\fB" : "\\fR";
        else if (c == '\\')
            out += "\\e";
        else if (c == '-')
            out += "\\-";
        else if (c == '\'')
            out += "\\(aq";
        else if (c == '^')
            out += "\\(ha";
        else if (c == '~')
            out += "\\(ti";
        else
            out += c;
    }
    return out;
}

std::string bold(std::string_view text)
{
    return "\\fB" + roff(text) + "\\fR";
}

std::string italic(std::string_view text)
{
    return "\\fI" + roff(text) + "\\fR";
}

std::string head(const std::string &name, int section, const std::string &date, const std::string &summary)
{
    std::string title = name;
    std::transform(title.begin(), title.end(), title.begin(), [](unsigned char c) { return char(std::toupper(c)); });
    return fmt::format(".TH {} {} {} \"Brume {}.{}.{}\"\n.SH NAME\n{} \\- {}\n", roff(title), section, date,
                       BRUME_VERSION_MAJOR, BRUME_VERSION_MINOR, BRUME_VERSION_PATCH, roff(name), roff(summary));
}

}  // namespace brume::pages
