// What a plan does for its effects and for the host's own passes.
#include <algorithm>
#include <bit>

#include <fmt/format.h>

#include "base/error.h"
#include "plan/plan.h"

using namespace brume;

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

uint32_t brume_host_t::made(std::string_view product) const
{
    if (product == "density_rgb")
        return layers_.has_input("optical_depth") || layers_.has_input("transmittance") ? BRUME_MADE_EARLIER
                                                                                        : BRUME_MADE_NOWHERE;
    if (HostProducts::makes(product))
        return BRUME_MADE_EARLIER;
    bool passed = false;
    uint32_t made = BRUME_MADE_NOWHERE;
    for (const PlannedEffect &planned : effects_) {
        passed = passed || &planned == current_;
        if (!is_made_by(planned, product))
            continue;
        if (!passed && (planned.runs || settling_))
            return BRUME_MADE_EARLIER;
        if (passed)
            made = BRUME_MADE_LATER;
    }
    return made;
}

brume_status brume_host_t::fail(brume_status status, const char *message)
{
    failure_ = message ? message : "";
    return status;
}

void brume_host_t::add_entry(const brume_plugin_entry &entry)
{
    if (!entry.name || !entry.reason)
        throw Error(BRUME_ERROR_ARGUMENT, "add_entry: name or reason is NULL");
    entries_.push_back({entry.runs != 0, current_ ? current_->effect->name : host_name, entry.name, entry.reason,
                        entry.bytes, uint64_t(nanoseconds(entry)), 0});
}

double brume_host_t::nanoseconds(const brume_plugin_entry &entry) const
{
    return brume::nanoseconds(*context_->backend, {entry.operations, entry.alike, entry.turns});
}

void brume_host_t::need_camera(uint32_t needs, const std::string &reason)
{
    if ((needs & ~camera_needs_) == 0)
        return;
    camera_needs_ |= needs;
    camera_reason_ += (camera_reason_.empty() ? "" : "; ") + reason;
}

brume_plugin_image brume_host_t::create_image(const char *label, int32_t width, int32_t height, int32_t channels)
{
    int32_t largest = context_->backend->largest_size();
    if (width < 1 || height < 1 || width > largest || height > largest || (channels != 1 && channels != 2 && channels != 4))
        throw Error(BRUME_ERROR_ARGUMENT,
                    fmt::format("image {}: {} x {} x {}; expected sides from 1 to {} and 1, 2 or 4 channels",
                                label ? label : "?", width, height, channels, largest));
    if (rehearsal_) {
        memory_.add(label ? label : "?", width, height, channels);
        return image_of_rehearsal();
    }
    try {
        images_.push_back(context_->backend->create_image(width, height, channels, BRUME_PIXEL_F32));
    } catch (const Error &error) {
        throw Error(error.status(), fmt::format("image {}: {}", label ? label : "?", error.what()));
    }
    memory_.add(label ? label : "?", width, height, channels);
    return images_.back().get();
}

void brume_host_t::drop_image(brume_plugin_image image)
{
    const auto at = std::find_if(images_.begin(), images_.end(), [&](const auto &mine) { return mine.get() == image; });
    if (at == images_.end())
        return;
    memory_.take_away(uint64_t(image->width) * uint64_t(image->height) * uint64_t(image->channels) * 4);
    images_.erase(at);
}

brume_pass brume_host_t::create_pass(const brume_pass_desc &desc)
{
    PassLayout layout = layout_of(desc);
    if (rehearsal_)
        return pass_of_rehearsal();
    passes_.push_back(context_->backend->create_pass(desc, std::move(layout)));
    pass_owners_.push_back(current_ ? current_->effect : nullptr);
    return passes_.back().get();
}

double brume_host_t::share_before(int entry) const
{
    double before = 0, all = 0;
    for (size_t i = 0; i < entries_.size(); ++i) {
        before += int(i) < entry ? entries_[i].predicted_ms : 0;
        all += entries_[i].predicted_ms;
    }
    return all > 0 ? before / all : 0;
}

brume_status brume_host_t::run(brume_pass pass, const brume_plugin_image *images, const void *constants, int32_t width,
                               int32_t height, void *user)
{
    if (!pass || (!images && !pass->layout.slots.empty()) || (!constants && pass->layout.constant_size > 0))
        throw Error(BRUME_ERROR_ARGUMENT, fmt::format("run: {} is NULL", !pass ? "pass" : !images ? "images" : "constants"));
    if (width < 1 || height < 1)
        throw Error(BRUME_ERROR_ARGUMENT, fmt::format("pass \"{}\": its grid is {} x {}; expected at least 1 x 1",
                                                      pass->layout.name, width, height));
    timer_->mark(pass->entry);
    Watch watch{context_->progress, share_before(pass->entry), share_before(pass->entry + 1)};
    const brume_status status = context_->backend->run(*pass, images, constants, width, height, content_.scene(), user,
                                                       context_->progress.wanted() ? &watch : nullptr);
    context_->progress.throw_if_cancelled();
    return status;
}

void brume_host_t::publish(const char *product, const brume_plugin_image *images, uint32_t image_count, uint32_t count,
                           uint64_t revision)
{
    if (!product || (!images && image_count > 0))
        throw Error(BRUME_ERROR_ARGUMENT, fmt::format("publish: {} is NULL", product ? "images" : "product"));
    if (current_ && !is_made_by(*current_, product))
        throw Error(BRUME_ERROR_ARGUMENT,
                    fmt::format("publish: {} is not among what the effect's table says it makes", product));
    products_.publish(product, images, image_count, count, revision);
}

brume_plugin_image brume_host_t::upload(uint32_t slot, int32_t channels, const float *values, uint64_t texels)
{
    const uint64_t width = BRUME_DATA_WIDTH, most = width * uint64_t(context_->backend->largest_size());
    if (slot > 63 || (channels != 1 && channels != 4) || texels > most)
        throw Error(BRUME_ERROR_ARGUMENT, "upload: slot " + std::to_string(slot) + ", " + std::to_string(channels) +
                                              " channels, " + std::to_string(texels) +
                                              " texels; expected a slot from 0 to 63, 1 or 4 channels and at most " +
                                              std::to_string(most) + " texels");
    if (rehearsal_)
        return image_of_rehearsal();
    Data &data = data_[{current_, slot}];
    data.image.reset();
    // Powers of two, so that the pool serves the next frame's slightly longer list with the same image.
    const uint64_t rows = std::min<uint64_t>(std::bit_ceil(std::max<uint64_t>(1, (texels + width - 1) / width)),
                                             uint64_t(context_->backend->largest_size()));
    const uint64_t samples = data.values.size();
    data.values.assign(rows * width * uint64_t(channels), 0.0f);
    data_bytes_ += (data.values.size() - samples) * sizeof(float);
    std::copy_n(values, texels * uint64_t(channels), data.values.begin());
    brume_image image = BRUME_IMAGE_INIT;
    image.channels = uint32_t(channels);
    image.width = int32_t(width);
    image.height = int32_t(rows);
    image.data = data.values.data();
    data.image = context_->backend->import(image, channels);
    return data.image.get();
}
