#include "gaussians/gaussian_frames.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "base/error.h"
#include "gaussians/gaussian_file.h"
#include "base/scene_ranges.h"

namespace brume {
namespace {

struct FrameNumber {
    size_t at, length;
    int digits;
};

std::optional<FrameNumber> frame_number(const std::string &name, size_t from)
{
    const size_t at = name.find_first_of("%#", from);
    if (at == std::string::npos)
        return std::nullopt;
    if (name[at] == '#') {
        const size_t end = std::min(name.find_first_not_of('#', at), name.size());
        return FrameNumber{at, end - at, end - at == 1 ? 4 : int(end - at)};
    }
    int digits = 0;
    const size_t end = std::min(name.find_first_not_of("0123456789", at + 1), name.size());
    if (end == name.size() || name[end] != 'd' || end - at > 3)
        return frame_number(name, at + 1);
    std::from_chars(name.data() + at + 1, name.data() + end, digits);
    return FrameNumber{at, end + 1 - at, digits};
}

std::optional<FrameNumber> only_frame_number(const std::string &name)
{
    const auto found = frame_number(name, 0);
    if (found && frame_number(name, found->at + found->length))
        throw Error(BRUME_ERROR_ARGUMENT, fmt::format("{}: more than one frame number in the name; expected one", name));
    return found;
}

}  // namespace

GaussianFrames::GaussianFrames(std::string name)
{
    const FrameNumber number = only_frame_number(name).value();
    before_ = name.substr(0, number.at);
    after_ = name.substr(number.at + number.length);
    digits_ = number.digits;
}

bool GaussianFrames::has_frame_number(const std::string &name)
{
    return only_frame_number(name).has_value();
}

std::shared_ptr<const std::vector<Gaussian>> GaussianFrames::at(double frame) const
{
    if (!ranges::frame.contains(frame))
        throw Error(BRUME_ERROR_ARGUMENT, fmt::format("frame: {}; expected {}", frame, ranges::frame.describe()));
    const int number = int(std::floor(frame));
    {
        const std::lock_guard lock(mutex_);
        if (cached_ && cached_frame_ == number)
            return cached_;
    }
    std::shared_ptr<const std::vector<Gaussian>> read;
    try {
        read = std::make_shared<const std::vector<Gaussian>>(
            read_gaussians(fmt::format("{}{:0{}}{}", before_, number, digits_, after_)));
    } catch (const Error &error) {
        throw Error(BRUME_ERROR_ARGUMENT, fmt::format("Gaussians of frame {}: {}", number, error.what()));
    }
    const std::lock_guard lock(mutex_);
    cached_frame_ = number;
    return cached_ = std::move(read);
}

}  // namespace brume
