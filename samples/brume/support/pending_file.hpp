#pragma once

#include <filesystem>
#include <string>

namespace brume::tool {

/// A file that is written beside its place under a temporary name and takes its name only when it is whole. What is
/// not committed is removed: on errors by the destructor, on fatal signals by remove_pending_files().
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

/// Async-signal-safe.
void remove_pending_files();

}  // namespace brume::tool
