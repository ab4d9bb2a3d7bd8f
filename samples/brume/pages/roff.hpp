#pragma once

#include <string>
#include <string_view>

namespace brume::pages {

/// Text as man(7) takes it. `quoted` parts become bold.
std::string roff(std::string_view text);
std::string bold(std::string_view text);
std::string italic(std::string_view text);

/// The head of a page; `date` is ISO 8601's.
std::string head(const std::string &name, int section, const std::string &date, const std::string &summary);

}  // namespace brume::pages
