#include "base/names.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "base/text.h"

namespace brume {
namespace {

size_t edit_distance(const std::string &a, const std::string &b)
{
    std::vector<size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), size_t(0));
    for (size_t i = 0; i < a.size(); ++i) {
        size_t diagonal = row[0];
        row[0] = i + 1;
        for (size_t j = 0; j < b.size(); ++j) {
            const size_t replaced = diagonal + (a[i] != b[j]);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
        }
    }
    return row.back();
}

}  // namespace

std::string nearest_name(const std::string &word, const std::vector<std::string> &names)
{
    std::string nearest;
    size_t least = std::string::npos;
    for (const std::string &name : names) {
        const size_t length = std::max(word.size(), name.size());
        const size_t limit = std::max<size_t>(1, length / 3);
        if (length - std::min(word.size(), name.size()) > limit)
            continue;
        const size_t distance = edit_distance(word, name);
        if (distance <= limit && distance < least) {
            least = distance;
            nearest = name;
        }
    }
    return nearest;
}

std::string did_you_mean(const std::string &word, const std::vector<std::string> &names)
{
    const std::string nearest = nearest_name(word, names);
    if (!nearest.empty())
        return fmt::format("; did you mean {}?", in_quotes(nearest));
    return names.empty() ? "" : fmt::format("; expected one of {}", fmt::join(names, ", "));
}

}  // namespace brume
