#include <algorithm>

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <half.h>

#include "image/oiio/metadata.hpp"
#include "image/oiio/picture.hpp"
#include "support/error.hpp"

namespace brume::tool {
namespace {

/// The most that a format packs into one byte, about: deflate's longest runs, and LZW's in TIFF.
std::uint64_t most_packed(const std::string &format)
{
    return format == "png" ? 1040 : 4096;
}

[[noreturn]] void fail(const std::filesystem::path &file, const std::string &what)
{
    throw FrameError(fmt::format("{}: {}", file.string(), what));
}

std::unique_ptr<OIIO::ImageInput> opened(const std::filesystem::path &file, const std::string &format, OIIO::ImageSpec &spec)
{
    auto input = OIIO::ImageInput::create(format);
    if (!input)
        fail(file, fmt::format("this build of OpenImageIO does not read {}: {}", format, OIIO::geterror()));
    OIIO::ImageSpec as_stored;
    as_stored.attribute("oiio:UnassociatedAlpha", 1);
    if (!input->open(file.string(), spec, as_stored)) {
        std::string why = input->geterror();
        std::replace(why.begin(), why.end(), '\n', ' ');
        fail(file, fmt::format("cannot be read as {}: {}", format, why.empty() ? "it is damaged or of another kind" : why));
    }
    // Of a DPX that lies on its side the library gives the size upright, but its pixels as they are stored.
    if (format == "dpx" && spec.get_int_attribute("Orientation", 1) >= 5)
        std::swap(spec.width, spec.height);
    return input;
}

SampleType type_of(const std::filesystem::path &file, const OIIO::TypeDesc &type)
{
    switch (type.basetype) {
    case OIIO::TypeDesc::UINT8:
        return SampleType::kUint8;
    case OIIO::TypeDesc::UINT16:
        return SampleType::kUint16;
    case OIIO::TypeDesc::HALF:
        return SampleType::kHalf;
    case OIIO::TypeDesc::FLOAT:
        return SampleType::kFloat;
    default:
        fail(file, fmt::format("channels of type {} (expected uint8, uint16, half or float)", type.c_str()));
    }
}

class RasterPixels : public StoredPixels {
public:
    RasterPixels(const PartInfo &part)
        : part_(part), count_(std::size_t(part.width()) * std::size_t(part.height())),
          bytes(std::make_unique_for_overwrite<char[]>(count_ * part.channels.size() * bytes_of(part.channels[0].type)))
    {
    }
    void to_floats(const std::string &channel, float *out, std::size_t stride) const override
    {
        const std::size_t channels = part_.channels.size(), c = std::size_t(part_.find(channel) - part_.channels.data());
        const auto convert = [&](const auto *in) {
            for (std::size_t i = 0; i < count_; ++i)
                out[i * stride] = float(in[i * channels + c]);
        };
        switch (part_.channels[0].type) {
        case SampleType::kUint8:
            return convert(reinterpret_cast<const std::uint8_t *>(bytes.get()));
        case SampleType::kUint16:
            return convert(reinterpret_cast<const std::uint16_t *>(bytes.get()));
        case SampleType::kHalf:
            return convert(reinterpret_cast<const half *>(bytes.get()));
        default:
            return convert(reinterpret_cast<const float *>(bytes.get()));
        }
    }

private:
    const PartInfo part_;
    const std::size_t count_;

public:
    const std::unique_ptr<char[]> bytes;
};

/// Pixels as the orientation wants them shown. ImageBufAlgo::reorient of OpenImageIO 2.4 takes 5 for 7 and 7 for 5.
void turn(int orientation, const OIIO::ImageSpec &spec, char *bytes)
{
    const bool aside = orientation >= 5,
               from_right = orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
    const bool from_below = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
    const int width = aside ? spec.height : spec.width, height = aside ? spec.width : spec.height;
    const std::size_t pixel = spec.pixel_bytes(), row = pixel * std::size_t(spec.width);
    const std::unique_ptr<char[]> stored = std::make_unique_for_overwrite<char[]>(row * std::size_t(spec.height));
    std::copy_n(bytes, row * std::size_t(spec.height), stored.get());
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x, bytes += pixel) {
            const int column = aside ? y : x, line = aside ? x : y;
            std::copy_n(stored.get() + row * std::size_t(from_below ? spec.height - 1 - line : line) +
                            pixel * std::size_t(from_right ? spec.width - 1 - column : column),
                        pixel, bytes);
        }
}

class RasterSource : public PictureSource {
public:
    RasterSource(std::filesystem::path file, std::string format, const ReadLimits &limits)
        : file_(std::move(file)), format_(std::move(format))
    {
        OIIO::ImageSpec spec;
        const auto input = opened(file_, format_, spec);
        check(spec, limits);
        if (input->seek_subimage(1, 0))
            notes.push_back("has several pictures: the first is read, and it alone is written");
        PartInfo part;
        part.data_window = {{spec.x, spec.y}, {spec.x + spec.width - 1, spec.y + spec.height - 1}};
        part.display_window = {{spec.full_x, spec.full_y},
                               {spec.full_x + spec.full_width - 1, spec.full_y + spec.full_height - 1}};
        part.pixel_aspect = aspect_of(spec);
        orientation = spec.get_int_attribute("Orientation", 1);
        metadata_ = metadata_of(spec);
        if (orientation != 1) {
            notes.push_back(
                fmt::format("is turned upright by its orientation {}: its depth must be upright too", orientation));
            part.data_window = part.display_window = {{0, 0}, {spec.width - 1, spec.height - 1}};
            if (lies_on_its_side()) {
                std::swap(part.data_window.max.x, part.data_window.max.y);
                part.display_window = part.data_window;
                part.pixel_aspect = 1 / part.pixel_aspect;
                for (Attribute &a : metadata_)
                    if (a.name == "XResolution" || a.name == "YResolution")
                        a.name[0] ^= 'X' ^ 'Y';
            }
        }
        if (spec.format == OIIO::TypeDesc::UINT16)
            bits = spec.get_int_attribute("oiio:BitsPerSample", 16) % 16;
        if (spec.nchannels == 1)
            spec.channelnames = {"Y"};  // a grey DPX has R
        for (const std::string &name : spec.channelnames) {
            ChannelInfo channel{name, "", "", name.substr(name.rfind('.') + 1)};
            channel.layer = name.substr(0, name.size() - channel.base.size() - (name.size() > channel.base.size()));
            channel.type = type_of(file_, spec.format);
            channel.lossy = format_ == "jpeg";
            part.channels.push_back(channel);
        }
        straight_alpha =
            spec.alpha_channel >= 0 && (format_ == "png" || spec.get_int_attribute("oiio:UnassociatedAlpha", 0) != 0);
        take_color_space(spec);
        parts = {part};
    }

    std::unique_ptr<StoredPixels> read(int, const std::vector<std::string> &) const override
    {
        OIIO::ImageSpec spec;
        const auto input = opened(file_, format_, spec);
        auto pixels = std::make_unique<RasterPixels>(parts.front());
        // It could have been replaced since its header was read.
        const PartInfo &part = parts.front();
        const int width = lies_on_its_side() ? part.height() : part.width();
        const int height = lies_on_its_side() ? part.width() : part.height();
        if (spec.width != width || spec.height != height || spec.get_int_attribute("Orientation", 1) != orientation ||
            std::size_t(spec.nchannels) != part.channels.size() || type_of(file_, spec.format) != part.channels.front().type)
            fail(file_, "has changed while it was read");
        if (!input->read_image(0, 0, 0, spec.nchannels, spec.format, pixels->bytes.get()) || input->has_error()) {
            std::string why = input->geterror();
            std::replace(why.begin(), why.end(), '\n', ' ');
            fail(file_, fmt::format("pixels cannot be read: {}", why.empty() ? "the file is damaged" : why));
        }
        if (orientation != 1)
            turn(orientation, spec, pixels->bytes.get());
        return pixels;
    }
    Metadata metadata(int) const override { return metadata_; }

private:
    bool lies_on_its_side() const { return orientation >= 5; }

    double aspect_of(const OIIO::ImageSpec &spec) const
    {
        const double aspect = double(spec.get_float_attribute("PixelAspectRatio", 1));
        if (!(aspect > 0))
            return 1;
        // The library takes a JPEG's for its inverse.
        return format_ == "jpeg" ? 1 / aspect : aspect;
    }

    void check(const OIIO::ImageSpec &spec, const ReadLimits &limits) const
    {
        if (spec.width < 1 || spec.height < 1 || spec.width > limits.side || spec.height > limits.side)
            fail(file_, fmt::format("{} x {} pixels (expected 1 to {} each way)", spec.width, spec.height, limits.side));
        if (spec.depth > 1 || spec.deep)
            fail(file_, "a volume or deep data (expected a flat picture)");
        if (spec.nchannels < 1 || spec.nchannels > limits.channels)
            fail(file_, fmt::format("{} channels (expected 1 to {})", spec.nchannels, limits.channels));
        const std::uint64_t bytes = std::uint64_t(spec.width) * std::uint64_t(spec.height) * spec.pixel_bytes(true);
        if (bytes > limits.part_bytes)
            fail(file_, fmt::format("{} x {} pixels of {} channels need {} MiB (limit {} MiB; run takes --mem)", spec.width,
                                    spec.height, spec.nchannels, bytes >> 20, limits.part_bytes >> 20));
        std::error_code error;
        const std::uint64_t size = std::filesystem::file_size(file_, error);
        if (!error && bytes / most_packed(format_) > size)
            fail(file_, fmt::format("claims {} x {} pixels of {} channels, but the file has only {} bytes", spec.width,
                                    spec.height, spec.nchannels, size));
        for (const char *name : {"jpeg:ColorSpace", "tiff:ColorSpace"})
            if (const std::string model = spec.get_string_attribute(name);
                !model.empty() && model != "RGB" && model != "YCbCr" && model != "YUV" && model != "GRAY")
                fail(file_, fmt::format("pixels are {} (expected RGB or grey)", model));
        if (const int photometric = spec.get_int_attribute("tiff:PhotometricInterpretation", 1);
            photometric == 5 || photometric == 8)
            fail(file_, fmt::format("pixels are {} (expected RGB or grey)", photometric == 5 ? "CMYK" : "CIELAB"));
        if (const int said = spec.get_int_attribute("Orientation", 1); said < 1 || said > 8)
            fail(file_, fmt::format("has the orientation {} (expected 1 to 8)", said));
    }

    void take_color_space(const OIIO::ImageSpec &spec)
    {
        if (spec.format.is_floating_point())
            return;
        const std::string said = spec.get_string_attribute("oiio:ColorSpace");
        if (const auto *profile = spec.find_attribute("ICCProfile")) {
            const auto *bytes = static_cast<const char *>(profile->data());
            const std::string_view text(bytes, profile->datasize());
            const std::string_view wide("s\0R\0G\0B", 7);
            if (text.find("sRGB") == text.npos && text.find(wide) == text.npos) {
                color_space = std::nullopt;
                color_note = "the file has a colour profile that is not sRGB's";
                return;
            }
            color_space = "sRGB";
        } else if (said == "sRGB") {
            color_space = "sRGB";
        } else if ((said == "Linear" || said == "linear" || said == "lin_srgb") && format_ == "png") {
            color_space = "";
        } else {
            color_space = std::nullopt;
            if (!said.empty())
                color_note = fmt::format("the file says '{}'", said);
        }
    }

    std::filesystem::path file_;
    std::string format_;
    Metadata metadata_;
};

}  // namespace

std::unique_ptr<PictureSource> open_picture(const std::filesystem::path &file, const std::string &format,
                                            const ReadLimits &limits)
try {
    return std::make_unique<RasterSource>(file, format, limits);
} catch (const std::bad_alloc &) {
    fail(file, "out of memory while reading its header");
}

}  // namespace brume::tool
