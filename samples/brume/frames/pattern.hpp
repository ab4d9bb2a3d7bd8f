#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace brume::tool {

/// A file name with a frame number in it: %04d, %d, #### (one digit each; a lone # is four, as in oiiotool) or @@@.
/// A name without any of these is one file.
class FilePattern {
public:
    explicit FilePattern(std::string text);

    bool is_sequence() const { return width_ >= 0; }
    const std::string &text() const { return text_; }
    std::filesystem::path at(int frame) const;

    /// Frames for which a file exists, in increasing order.
    std::vector<int> existing() const;

private:
    std::optional<int> frame_of(const std::string &file_name) const;

    std::string text_, before_, after_;
    int width_ = -1;  ///< least number of digits; -1 where there is no frame number
};

struct FrameFile {
    int frame = 0;
    std::filesystem::path input, output;
};

/// Pairs inputs with outputs. `range` empty: every frame that exists. Throws RequestError where nothing would be done or
/// several frames would be written to one file.
std::vector<FrameFile> list_frames(const FilePattern &input, const FilePattern &output, const std::string &range);

/// The frame number in the name of a single file ("shot.0042.exr" is 42), for keyed scenes; 0 where there is none.
int frame_in_name(const std::filesystem::path &file);

}  // namespace brume::tool
