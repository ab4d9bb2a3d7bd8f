#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <brume/brume_media.h>

#include "support/sdk.hpp"

namespace brume::tool {

struct DestroyMedia {
    void operator()(brume_media m) const { brume_media_destroy(m); }
};
using MediaHandle = std::unique_ptr<brume_media_t, DestroyMedia>;

/// A medium in the library. `check` throws RequestError with what the library says of a failure.
class Medium {
public:
    Medium();

    brume_media get() const { return media_.get(); }
    void check(brume_status status) const { check_request(context_.get(), status, ""); }

    brume_media_info info() const;
    std::vector<brume_gaussian> gaussians() const;
    std::string journal() const;
    void replay(const std::filesystem::path &journal);
    /// Throws FrameError: nothing was wrong with the request.
    void save(const std::filesystem::path &file) const;

private:
    ContextHandle context_;
    MediaHandle media_;
};

/// Bit for bit.
bool same_gaussians(const std::vector<brume_gaussian> &a, const std::vector<brume_gaussian> &b);

/// A media file that is edited, and the journal of its edits beside it: FILE.journal.
class Document {
public:
    enum Missing { kFails, kIsEmpty };
    /// What to do where there is no such file yet.
    Document(std::filesystem::path file, Missing missing);

    const Medium &medium() const { return medium_; }
    brume_media get() const { return medium_.get(); }
    void check(brume_status status) const { medium_.check(status); }

    /// Puts file and journal in place, each whole.
    void save() const;

    static std::filesystem::path journal_of(const std::filesystem::path &file);

private:
    std::filesystem::path file_;
    Medium medium_;
};

}  // namespace brume::tool
