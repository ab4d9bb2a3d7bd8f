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

Medium::Medium() : context_(create_context("cpu"))
{
    brume_media media = nullptr;
    check_request(context_.get(), brume_media_create(context_.get(), &media), "");
    media_.reset(media);
}

brume_media_info Medium::info() const
{
    brume_media_info info = BRUME_MEDIA_INFO_INIT;
    check(brume_media_get_info(get(), &info));
    return info;
}

std::vector<brume_gaussian> Medium::gaussians() const
{
    std::vector<brume_gaussian> all(info().gaussian_count, brume_gaussian BRUME_GAUSSIAN_INIT);
    check(brume_media_get_gaussians(get(), 0, std::uint32_t(all.size()), all.data()));
    return all;
}

std::string Medium::journal() const
{
    std::string text(brume_media_journal(get(), nullptr, 0), '\0');
    if (text.empty())
        throw FrameError("the journal cannot be made: " + sdk_message(context_.get(), BRUME_ERROR_MEMORY));
    brume_media_journal(get(), text.data(), text.size());
    text.pop_back();
    return text;
}

void Medium::replay(const fs::path &journal)
{
    const std::string text = read_text(journal);
    check(brume_media_replay(get(), text.data(), text.size(), journal.c_str()));
}

void Medium::save(const fs::path &file) const
{
    if (const brume_status status = brume_media_save(get(), file.c_str()); status != BRUME_OK)
        throw FrameError(sdk_message(context_.get(), status));
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
            check(brume_media_load(get(), file_.c_str()));
        return;
    }
    medium_.replay(journal);
    const auto replayed = medium_.gaussians();
    Medium from_file;
    if (has_file)
        from_file.check(brume_media_load(from_file.get(), file_.c_str()));
    const auto loaded = from_file.gaussians();
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
