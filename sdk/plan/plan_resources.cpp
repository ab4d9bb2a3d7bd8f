#include "plan/plan_resources.h"

#include <algorithm>
#include <bit>

#include <fmt/format.h>

#include "base/error.h"

namespace brume {
namespace {

// What a rehearsal hands out in place of images and passes.
Image *image_of_rehearsal()
{
    static Image image;
    return &image;
}
Pass *pass_of_rehearsal()
{
    static Pass pass;
    return &pass;
}

}  // namespace

brume_plugin_image PlanResources::create_image(const char *label, int32_t width, int32_t height, int32_t channels)
{
    int32_t largest = backend_.largest_size();
    if (width < 1 || height < 1 || width > largest || height > largest || (channels != 1 && channels != 2 && channels != 4))
        throw Error(BRUME_ERROR_ARGUMENT,
                    fmt::format("image {}: {} x {} x {}; expected sides from 1 to {} and 1, 2 or 4 channels",
                                label ? label : "?", width, height, channels, largest));
    if (rehearsal_) {
        memory_.add(label ? label : "?", width, height, channels);
        return image_of_rehearsal();
    }
    try {
        images_.push_back(backend_.create_image(width, height, channels, BRUME_PIXEL_F32));
    } catch (const Error &error) {
        throw Error(error.status(), fmt::format("image {}: {}", label ? label : "?", error.what()));
    }
    memory_.add(label ? label : "?", width, height, channels);
    return images_.back().get();
}

void PlanResources::drop_image(brume_plugin_image image)
{
    const auto at = std::find_if(images_.begin(), images_.end(), [&](const auto &mine) { return mine.get() == image; });
    if (at == images_.end())
        return;
    memory_.take_away(uint64_t(image->width) * uint64_t(image->height) * uint64_t(image->channels) * 4);
    images_.erase(at);
}

brume_pass PlanResources::create_pass(const brume_pass_desc &desc, const Effect *owner)
{
    PassLayout layout = layout_of(desc);
    if (rehearsal_)
        return pass_of_rehearsal();
    passes_.push_back(backend_.create_pass(desc, std::move(layout)));
    owners_.push_back(owner);
    return passes_.back().get();
}

brume_plugin_image PlanResources::upload(const Effect *owner, uint32_t slot, int32_t channels, const float *values,
                                         uint64_t texels)
{
    const uint64_t width = BRUME_DATA_WIDTH, most = width * uint64_t(backend_.largest_size());
    if (slot > 63 || (channels != 1 && channels != 4) || texels > most)
        throw Error(BRUME_ERROR_ARGUMENT, "upload: slot " + std::to_string(slot) + ", " + std::to_string(channels) +
                                              " channels, " + std::to_string(texels) +
                                              " texels; expected a slot from 0 to 63, 1 or 4 channels and at most " +
                                              std::to_string(most) + " texels");
    if (rehearsal_)
        return image_of_rehearsal();
    Data &data = data_[{owner, slot}];
    data.image.reset();
    // Powers of two, so that the pool serves the next frame's slightly longer list with the same image.
    const uint64_t rows = std::min<uint64_t>(std::bit_ceil(std::max<uint64_t>(1, (texels + width - 1) / width)),
                                             uint64_t(backend_.largest_size()));
    const uint64_t samples = data.values.size();
    data.values.assign(rows * width * uint64_t(channels), 0.0f);
    data_bytes_ += (data.values.size() - samples) * sizeof(float);
    std::copy_n(values, texels * uint64_t(channels), data.values.begin());
    brume_image image = BRUME_IMAGE_INIT;
    image.channels = uint32_t(channels);
    image.width = int32_t(width);
    image.height = int32_t(rows);
    image.data = data.values.data();
    data.image = backend_.import(image, channels);
    return data.image.get();
}

void PlanResources::bind_passes(const std::vector<PlanEntry> &entries)
{
    for (size_t i = 0; i < passes_.size(); ++i) {
        Pass &pass = *passes_[i];
        const std::string &owner = owners_[i] ? owners_[i]->name : host_name;
        const auto found = std::find_if(entries.begin(), entries.end(), [&](const PlanEntry &entry) {
            return entry.runs && entry.effect == owner && entry.name == pass.layout.name;
        });
        if (found == entries.end())
            throw Error(BRUME_ERROR_PLUGIN, fmt::format("{}: pass \"{}\" is not among the running entries of the plan",
                                                        owner, pass.layout.name));
        pass.entry = int(found - entries.begin());
    }
}

void PlanResources::release() noexcept
{
    data_.clear();
    images_.clear();
    passes_.clear();
}

}  // namespace brume
