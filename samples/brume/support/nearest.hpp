#pragma once

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

namespace brume::tool {

/// The known word with the fewest letters inserted, left out or changed; "" where there is none.
inline std::string nearest(const std::string &word, const std::vector<std::string> &known)
{
    std::string best;
    std::size_t least = 0;
    for (const std::string &other : known) {
        std::vector<std::size_t> row(other.size() + 1);
        std::iota(row.begin(), row.end(), std::size_t(0));
        for (std::size_t i = 0; i < word.size(); ++i) {
            std::size_t corner = row[0]++;
            for (std::size_t j = 0; j < other.size(); ++j) {
                const std::size_t change = corner + (word[i] != other[j]);
                corner = row[j + 1];
                row[j + 1] = std::min({change, corner + 1, row[j] + 1});
            }
        }
        if (best.empty() || row.back() < least) {
            best = other;
            least = row.back();
        }
    }
    return best;
}

}  // namespace brume::tool
