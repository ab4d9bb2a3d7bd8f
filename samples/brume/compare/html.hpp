#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "compare/comparison.hpp"

namespace brume::tool {

/// A page of its own for one pair that needs no other file: both pictures and their difference, in half floats, so that
/// the exposure may be chosen in the browser.
void write_pair_page(const std::filesystem::path &file, const Picture &a, const Picture &reference,
                     const Comparison &comparison);

/// index.html: a row a pair, linked to its page where there is one.
void write_index_page(const std::filesystem::path &folder, const std::vector<Comparison> &comparisons);

/// The name of a pair's page; pairs with unlike names have unlike pages.
std::string page_of(const PairFiles &files);

}  // namespace brume::tool
