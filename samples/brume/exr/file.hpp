#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <ImathBox.h>
#include <ImfCompression.h>
#include <ImfHeader.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPixelType.h>

#include "exr/precheck.hpp"

namespace brume::tool {

/// A channel's full name taken apart: "character.left.R" with a view "left" is layer "character", base "R".
struct ChannelInfo {
    std::string name, layer, view, base;
    Imf::PixelType type;
    Imath::V2i sampling;
};

struct PartInfo {
    int index = 0;
    std::string name, view;
    Imath::Box2i data_window;
    Imf::Compression compression;
    bool deep = false, tiled = false;
    std::vector<ChannelInfo> channels;

    int width() const { return data_window.max.x - data_window.min.x + 1; }
    int height() const { return data_window.max.y - data_window.min.y + 1; }
    const ChannelInfo *find(const std::string &channel_name) const;
    /// "part 2 (depth_left)", or nothing where the file has one nameless part.
    std::string label() const;
};

/// An OpenEXR file whose headers have been read and found sane; pixels are read later.
class ExrFile {
public:
    explicit ExrFile(std::filesystem::path path, const ReadLimits &limits = {});

    const std::filesystem::path &path() const { return path_; }
    const std::vector<PartInfo> &parts() const { return parts_; }
    const Imf::Header &header(int part) const { return file_->header(part); }
    Imf::MultiPartInputFile &imf() const { return *file_; }
    const std::string &default_view() const { return default_view_; }
    Imath::Box2i display_window() const { return header(0).displayWindow(); }

    /// Runs a call into OpenEXR and restates what it throws as a FrameError that names this file.
    template <class Call> auto guarded(const std::string &doing, Call &&call) const
    {
        try {
            return call();
        } catch (const std::exception &e) {
            rethrow(doing, e);
        }
    }

private:
    [[noreturn]] void rethrow(const std::string &doing, const std::exception &e) const;

    std::filesystem::path path_;
    std::shared_ptr<Imf::MultiPartInputFile> file_;
    std::vector<PartInfo> parts_;
    std::string default_view_;
};

}  // namespace brume::tool
