#pragma once

#include <string>
#include <vector>

namespace brume::tool {

struct PairFiles {
    std::string name, a, b;  ///< the name is what the two share: a frame's number or a path below both folders
    int frame = 0;
};

/// What is to be compared: two files, two patterns, or two folders with their *.exr, subfolders included. Of patterns and
/// folders every frame or file counts that either has, so that a missing one shows. `may_make_b`: B need not exist.
/// Throws RequestError where the two are of different kinds or nothing is there.
std::vector<PairFiles> list_pairs(const std::string &a, const std::string &b, const std::string &frames, bool may_make_b);

}  // namespace brume::tool
