#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "image/limits.hpp"
#include "image/metadata.hpp"
#include "image/types.hpp"

namespace brume::tool {

/// Channels of one part as the file stores them.
class StoredPixels {
public:
    virtual ~StoredPixels() = default;
    /// Row by row, `stride` floats apart; only of channels at full resolution. Numbers as they are stored, integers too.
    virtual void to_floats(const std::string &channel, float *out, std::size_t stride) const = 0;
};

/// What one library reads of a file: headers at once, pixels later. Throws FrameError that names the file.
class PictureSource {
public:
    virtual ~PictureSource() = default;
    virtual std::unique_ptr<StoredPixels> read(int part, const std::vector<std::string> &channels) const = 0;
    virtual Metadata metadata(int /*part*/) const { return {}; }

    std::vector<PartInfo> parts;
    std::string default_view;
    /// Of the pixels, as the file says or its format has it; empty: scene-linear; none: they are integers of which nothing
    /// is said.
    std::optional<std::string> color_space = "";
    std::string color_note = "the file does not say";  ///< why there is none
    bool straight_alpha = false;                       ///< colour is not multiplied by alpha
    int orientation = 1;                               ///< that the file says, as EXIF counts them; pixels are given upright
    int bits = 0;                                      ///< that the file uses of an integer's; 0: all
    std::vector<std::string> notes = {};               ///< what a person should know of how it is read
};

/// A picture's file, whose headers have been read and found sane. Copies share it.
class ImageFile {
public:
    explicit ImageFile(std::filesystem::path path, const ReadLimits &limits = {});

    const std::filesystem::path &path() const { return path_; }
    const std::vector<PartInfo> &parts() const { return source_->parts; }
    const PartInfo &part(int index) const { return source_->parts[std::size_t(index)]; }
    const std::string &default_view() const { return source_->default_view; }
    const PictureSource &source() const { return *source_; }

private:
    std::filesystem::path path_;
    std::shared_ptr<const PictureSource> source_;
};

}  // namespace brume::tool
