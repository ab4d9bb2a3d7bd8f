#pragma once
#include <string>
#include <vector>

namespace brume {

// The nearest of `names` to a misspelt word, empty if none is near.
std::string nearest_name(const std::string &word, const std::vector<std::string> &names);

// The end of a message about an unknown name: "; did you mean ...?" or "; expected one of ...".
std::string did_you_mean(const std::string &word, const std::vector<std::string> &names);

}  // namespace brume
