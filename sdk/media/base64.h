#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace brume::media {

// RFC 4648, padded.
std::string base64_of(std::string_view bytes);
// Nothing where the text is not base64.
std::optional<std::string> bytes_of_base64(std::string_view text);

}  // namespace brume::media
