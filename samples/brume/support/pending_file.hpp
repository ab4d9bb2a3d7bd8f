#pragma once

#include <filesystem>
#include <string>

namespace brume::tool {

/// A file that is written beside its place under a temporary name and takes its name only when it is whole. What is
/// not committed is removed: on errors by the destructor, on fatal signals by remove_pending_files(). A symbolic link stays,
/// and what it points to is replaced; a device or a pipe is refused.
class PendingFile {
public:
    explicit PendingFile(std::filesystem::path final_path);
    ~PendingFile();
    PendingFile(const PendingFile &) = delete;
    PendingFile &operator=(const PendingFile &) = delete;

    const std::filesystem::path &path() const { return temporary_; }
    void commit();

private:
    std::filesystem::path final_, temporary_;
    int slot_ = -1;
    bool committed_ = false;
};

/// The file with this text, whole or not at all. Throws FrameError.
void write_text_file(const std::filesystem::path &path, const std::string &text);

/// What would be replaced by an output of this name: the file itself, or the end of the links that it is. Where that is
/// something that must not be replaced, `why_not` says what.
std::filesystem::path place_of(const std::filesystem::path &output, std::string &why_not);

/// Async-signal-safe.
void remove_pending_files();

}  // namespace brume::tool
