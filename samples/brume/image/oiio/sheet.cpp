#include <algorithm>

#include <OpenImageIO/imagebufalgo.h>

#include "image/oiio/picture.hpp"

namespace brume::tool {
namespace {

namespace algo = OIIO::ImageBufAlgo;

constexpr int kGap = 8, kTextSize = 14;
constexpr float kGround[] = {24 / 255.0f, 24 / 255.0f, 24 / 255.0f}, kText[] = {0.8f, 0.8f, 0.8f};
constexpr const char *kFont = "DejaVuSans";

OIIO::ImageBuf buffer_of(const Display &picture)
{
    // It is only read.
    return {OIIO::ImageSpec(picture.width, picture.height, 3, OIIO::TypeDesc::UINT8),
            const_cast<std::uint8_t *>(picture.rgb.data())};
}

}  // namespace

std::vector<float> shrink_picture(const float *pixels, int channels, int width, int height, int to_width, int to_height)
{
    const OIIO::ImageBuf whole(OIIO::ImageSpec(width, height, channels, OIIO::TypeDesc::FLOAT), const_cast<float *>(pixels));
    OIIO::ImageBuf finite, small;
    algo::fixNonFinite(finite, whole, algo::NONFINITE_BOX3);
    // A box averages all that a small pixel covers: lamps of one pixel stay visible.
    algo::resize(small, finite, "box", 0, OIIO::ROI(0, to_width, 0, to_height, 0, 1, 0, 3));
    std::vector<float> rgb(3 * std::size_t(to_width) * std::size_t(to_height));
    small.get_pixels(OIIO::ROI(0, to_width, 0, to_height, 0, 1, 0, 3), OIIO::TypeDesc::FLOAT, rgb.data());
    return rgb;
}

Display draw_sheet(const std::vector<Display> &cells, const std::vector<std::string> &labels)
{
    int width = 0, height = 0;
    for (const Display &cell : cells) {
        width = std::max(width, cell.width);
        height = std::max(height, cell.height);
    }
    const int columns = int(cells.size() / 2), text = labels.empty() ? 0 : kTextSize + kGap;
    Display sheet{columns * (width + kGap) + kGap, 2 * (height + kGap) + kGap + text, {}};
    sheet.rgb.resize(3 * std::size_t(sheet.width) * std::size_t(sheet.height));
    OIIO::ImageBuf drawn = buffer_of(sheet);
    algo::fill(drawn, kGround);
    for (int i = 0; i < int(cells.size()); ++i) {
        const Display &cell = cells[std::size_t(i)];
        const int left = kGap + i / 2 * (width + kGap) + (width - cell.width) / 2;
        const int top = kGap + i % 2 * (height + kGap) + (height - cell.height) / 2;
        algo::paste(drawn, left, top, 0, 0, buffer_of(cell));
    }
    // Where the font is missing there are no numbers.
    for (int i = 0; i < int(labels.size()); ++i)
        algo::render_text(drawn, kGap + i * (width + kGap), sheet.height - kGap, labels[std::size_t(i)], kTextSize, kFont,
                          kText);
    return sheet;
}

}  // namespace brume::tool
