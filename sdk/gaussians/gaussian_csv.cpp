#include <algorithm>
#include <charconv>
#include <iterator>

#include <fmt/format.h>

#include "base/error.h"
#include "gaussians/gaussian_columns.h"
#include "gaussians/gaussian_formats.h"
#include "base/text.h"

namespace brume {
namespace {

constexpr size_t most_columns = 1024;

std::string_view trimmed(std::string_view text)
{
    constexpr std::string_view blank = " \t\r";
    const size_t first = text.find_first_not_of(blank);
    return first == std::string_view::npos ? "" : text.substr(first, text.find_last_not_of(blank) - first + 1);
}

class Lines {
public:
    explicit Lines(std::string_view text) : rest_(text)
    {
        if (rest_.starts_with("\xef\xbb\xbf"))
            rest_.remove_prefix(3);
    }

    // The next line that says something, without its comment.
    bool next(std::string_view &line)
    {
        while (!rest_.empty()) {
            const size_t end = std::min(rest_.find('\n'), rest_.size());
            line = rest_.substr(0, end);
            rest_.remove_prefix(std::min(end + 1, rest_.size()));
            ++number_;
            line = trimmed(line.substr(0, line.find('#')));
            if (!line.empty())
                return true;
        }
        return false;
    }
    size_t number() const { return number_; }

private:
    std::string_view rest_;
    size_t number_ = 0;
};

void split(std::string_view line, std::vector<std::string_view> &cells)
{
    cells.clear();
    for (;;) {
        const size_t comma = line.find(',');
        cells.push_back(trimmed(line.substr(0, comma)));
        if (comma == std::string_view::npos || cells.size() > most_columns)
            return;
        line.remove_prefix(comma + 1);
    }
}

std::string unquoted(std::string_view cell)
{
    if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"')
        cell = trimmed(cell.substr(1, cell.size() - 2));
    return std::string(cell);
}

bool parse_number(std::string_view cell, double &value)
{
    if (cell.starts_with('+'))
        cell.remove_prefix(1);
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    return error == std::errc() && end == cell.data() + cell.size();
}

}  // namespace

std::vector<Gaussian> parse_gaussian_csv(std::string_view content, const std::string &name)
{
    Lines lines(content);
    std::string_view line;
    std::vector<std::string_view> cells;
    auto place = [&] { return fmt::format("{}:{}", name, lines.number()); };

    if (!lines.next(line))
        throw Error(BRUME_ERROR_SCENE, name + ": empty; expected a line that names the columns");
    split(line, cells);
    std::vector<std::string> names;
    for (std::string_view cell : cells)
        names.push_back(unquoted(cell));
    const GaussianColumns columns(std::move(names), place());

    std::vector<Gaussian> gaussians;
    std::vector<double> values(columns.count());
    while (lines.next(line)) {
        split(line, cells);
        if (cells.size() != columns.count())
            throw Error(BRUME_ERROR_SCENE, fmt::format("{}: {} values; expected {}, one for each column", place(),
                                                       cells.size(), columns.count()));
        for (size_t i = 0; i < cells.size(); ++i)
            if (columns.means_something(i) && !parse_number(cells[i], values[i]))
                throw Error(BRUME_ERROR_SCENE,
                            fmt::format("{}: {}: {}; expected a number", place(), columns.name(i), in_quotes(cells[i])));
        if (gaussians.size() == BRUME_MAX_GAUSSIANS)
            throw Error(BRUME_ERROR_SCENE, fmt::format("{}: expected {} Gaussians at most", place(), BRUME_MAX_GAUSSIANS));
        gaussians.push_back(columns.read(values, place));
    }
    return gaussians;
}

std::string gaussian_csv(std::span<const Gaussian> gaussians)
{
    std::string text = "x,y,z,scale,amplitude,r,g,b\n";
    for (const Gaussian &gaussian : gaussians)
        fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{}\n", gaussian.center[0], gaussian.center[1],
                       gaussian.center[2], gaussian.scale, gaussian.amplitude, gaussian.color[0], gaussian.color[1],
                       gaussian.color[2]);
    return text;
}

}  // namespace brume
