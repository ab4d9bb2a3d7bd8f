#include "media/document.hpp"

#include <cstring>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "support/error.hpp"
#include "support/pending_file.hpp"

namespace brume::tool {
namespace fs = std::filesystem;
namespace {

std::string read_text(const fs::path &file)
{
    std::ifstream in;
    if (fs::is_regular_file(file))  // others may have no end
        in.open(file, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    if (!in.is_open() || in.bad())
        throw RequestError(fmt::format("{}: cannot be opened for reading", file.string()));
    return text;
}

}  // namespace

Medium::Medium() : media_(create_context("cpu"))
{
    check(media_.status());
}

void Medium::replay(const fs::path &journal)
{
    check(media_.replay(read_text(journal), journal.string()));
}

void Medium::save(const fs::path &file) const
{
    if (media_.save(file.string()) != BRUME_OK)
        throw FrameError(media_.context().message());
}

std::string Medium::journal() const
{
    std::string text = media_.journal();
    if (text.empty())
        throw FrameError("the journal cannot be made: " + media_.context().message());
    return text;
}

bool same_gaussians(const std::vector<brume_gaussian> &a, const std::vector<brume_gaussian> &b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(brume_gaussian)) == 0;
}

fs::path Document::journal_of(const fs::path &file)
{
    return file.string() + ".journal";
}

Document::Document(fs::path file, Missing missing) : file_(std::move(file))
{
    const fs::path journal = journal_of(file_);
    const bool has_file = fs::exists(file_), has_journal = fs::exists(journal);
    if (!has_journal) {
        if (has_file || missing == kFails)
            check(media().load(file_.string()));
        return;
    }
    medium_.replay(journal);
    const auto replayed = media().gaussians();
    Medium from_file;
    if (has_file)
        from_file.check(from_file.media().load(file_.string()));
    const auto loaded = from_file.media().gaussians();
    if (!same_gaussians(replayed, loaded))
        throw RequestError(
            fmt::format("{}: is not what {} makes: it was changed by something else; remove the journal to go on "
                        "from the file, or `brume media replay` to get back what the journal makes",
                        file_.string(), journal.string()));
}

void Document::save() const
{
    const fs::path journal = journal_of(file_);
    PendingFile pending(journal);
    std::ofstream out(pending.path(), std::ios::binary);
    const std::string text = medium_.journal();
    if (!out.write(text.data(), std::streamsize(text.size())).flush())
        throw FrameError(fmt::format("{}: cannot be written", journal.string()));
    medium_.save(file_);
    pending.commit();
}

}  // namespace brume::tool
