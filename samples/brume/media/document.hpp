#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "support/sdk.hpp"

#include <brume/brume_media.hpp>

namespace brume::tool {

/// A medium in the library, whose failures are RequestErrors with what the library says.
class Medium {
public:
    Medium();

    Media &media() { return media_; }
    void check(brume_status status) const { check_request(media_.context(), status, ""); }

    void replay(const std::filesystem::path &journal);
    /// Throws FrameError: nothing was wrong with the request.
    void save(const std::filesystem::path &file) const;
    std::string journal() const;

private:
    Media media_;
};

/// Bit for bit.
bool same_gaussians(const std::vector<brume_gaussian> &a, const std::vector<brume_gaussian> &b);

/// A media file that is edited, and the journal of its edits beside it: FILE.journal.
class Document {
public:
    enum Missing { kFails, kIsEmpty };
    /// What to do where there is no such file yet.
    Document(std::filesystem::path file, Missing missing);

    Media &media() { return medium_.media(); }
    void check(brume_status status) const { medium_.check(status); }

    /// Puts file and journal in place, each whole.
    void save() const;

    static std::filesystem::path journal_of(const std::filesystem::path &file);

private:
    std::filesystem::path file_;
    Medium medium_;
};

}  // namespace brume::tool
