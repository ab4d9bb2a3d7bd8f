#pragma once

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

namespace brume::tool {

/// Keeps the candidates that fit, or all of them where none does; says whether any did.
template <class Candidate, class Keep> bool narrow(std::vector<Candidate> &candidates, Keep keep)
{
    std::vector<Candidate> kept;
    std::copy_if(candidates.begin(), candidates.end(), std::back_inserter(kept), keep);
    if (kept.empty())
        return false;
    candidates = std::move(kept);
    return true;
}

inline std::string lower(std::string s)
{
    std::transform(s.begin(), s.end(), s.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return s;
}

}  // namespace brume::tool
