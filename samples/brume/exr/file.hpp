#pragma once

#include <memory>

#include <ImathBox.h>
#include <ImfChromaticities.h>
#include <ImfCompression.h>
#include <ImfHeader.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPixelType.h>

#include "exr/precheck.hpp"
#include "image/file.hpp"

namespace brume::tool {

Imf::PixelType exr_type(SampleType type);
Imath::Box2i exr_window(const Window &window);
Imf::Chromaticities exr_chromaticities(const Chromaticities &c);

/// What a header says of its part.
PartInfo part_of(const Imf::Header &header, int index = 0);

/// Whether this channel loses something when it is stored with this compression. DWA goes by the channel's name.
bool is_lossy_for(Imf::Compression compression, const ChannelInfo &channel);

/// One channel as the file stores it, subsampling included.
struct Plane {
    ChannelInfo channel;
    std::unique_ptr<char[]> bytes;
    std::size_t sample_bytes = 0;
};

class ExrPixels : public StoredPixels {
public:
    explicit ExrPixels(Window window) : window_(window) {}
    void to_floats(const std::string &channel, float *out, std::size_t stride) const override;

    std::vector<Plane> planes;

private:
    Window window_;
};

/// An OpenEXR file whose headers have been read and found sane; pixels are read later.
class ExrSource : public PictureSource {
public:
    explicit ExrSource(std::filesystem::path path, const ReadLimits &limits = {});

    std::unique_ptr<StoredPixels> read(int part, const std::vector<std::string> &channels) const override;

    Metadata metadata(int part) const override;

    const Imf::Header &header(int part) const { return file_->header(part); }
    Imf::MultiPartInputFile &imf() const { return *file_; }

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
    std::unique_ptr<Imf::MultiPartInputFile> file_;
};

/// The file behind the interface; null where it is no OpenEXR file.
const ExrSource *exr_of(const ImageFile &file);

/// Threads that OpenEXR decodes and codes with.
void set_exr_threads(int threads);

}  // namespace brume::tool
