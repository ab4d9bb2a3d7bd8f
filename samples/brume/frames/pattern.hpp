#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace brume::tool {

/// A file name with a frame number in it: %04d, %d, #### (one digit each; a lone # is four, as in oiiotool) or @@@.
/// A name without any of these is one file. Folders' names are taken as they are, and so is a lone @ inside a word
/// ("plate@2x.exr").
class FilePattern {
public:
    explicit FilePattern(std::string text);

    bool is_sequence() const { return width_ >= 0; }
    const std::string &text() const { return text_; }
    std::filesystem::path at(int frame) const;
    /// The file of this frame, of either way to write negative numbers: -002 (as printf does) or -0002 (as Blender does).
    std::filesystem::path existing_at(int frame) const;
    /// A name that is written as `like`, a file of another pattern, writes the number.
    std::filesystem::path at(int frame, const FilePattern &other, const std::filesystem::path &like) const;

    /// Frames for which a file exists, in increasing order, and names that differ from the pattern's in the number of digits
    /// only.
    struct Listing {
        std::vector<int> frames;
        std::vector<std::string> near_misses;
    };
    Listing listing() const;
    std::vector<int> existing() const { return listing().frames; }

private:
    struct Number {
        int frame = 0;
        bool fits = false;  ///< written as this pattern writes it
    };
    std::optional<Number> number_in(const std::string &file_name) const;
    std::filesystem::path sign_first(int frame) const;

    std::string text_, before_, after_;
    int width_ = -1;  ///< least number of digits; -1 where there is no frame number
};

struct FrameFile {
    int frame = 0;
    std::filesystem::path input, output;
};

/// What a person should know of a pattern without --frames: gaps, and files that are left out. One line each.
std::vector<std::string> sequence_notes(const FilePattern &input);

/// Pairs inputs with outputs. `range` empty: every frame that exists. Throws RequestError where nothing would be done or
/// several frames would be written to one file.
std::vector<FrameFile> list_frames(const FilePattern &input, const FilePattern &output, const std::string &range);

/// The frame number in the name of a single file ("shot.0042.exr" is 42, "shot.-005.exr" is -5), for keyed scenes; 0 where
/// there is none.
int frame_in_name(const std::filesystem::path &file);

}  // namespace brume::tool
