#include "compare/update.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "support/error.hpp"
#include "support/pending_file.hpp"

namespace brume::tool {
namespace {

namespace fs = std::filesystem;

bool same_bytes(const fs::path &a, const fs::path &b)
{
    std::error_code none;
    if (!fs::exists(b, none) || fs::file_size(a, none) != fs::file_size(b, none))
        return false;
    std::ifstream in_a(a, std::ios::binary), in_b(b, std::ios::binary);
    const std::istreambuf_iterator<char> end;
    return std::equal(std::istreambuf_iterator<char>(in_a), end, std::istreambuf_iterator<char>(in_b), end);
}

}  // namespace

void update_reference(Comparison &comparison)
{
    const fs::path a = comparison.files.a, b = comparison.files.b;
    if (!comparison.a_is_whole || same_bytes(a, b))
        return;
    const bool is_new = !fs::exists(b);
    if (!b.parent_path().empty())
        fs::create_directories(b.parent_path());
    PendingFile pending(b);
    std::error_code error;
    fs::copy_file(a, pending.path(), fs::copy_options::overwrite_existing, error);
    if (error)
        throw FrameError(fmt::format("{}: cannot be copied to {}: {}", a.string(), b.string(), error.message()));
    pending.commit();
    if (is_new)
        comparison.error.clear();
    comparison.updated = fmt::format("{} {} {}", b.string(), is_new ? "is new: a copy of" : "is now a copy of", a.string());
}

}  // namespace brume::tool
