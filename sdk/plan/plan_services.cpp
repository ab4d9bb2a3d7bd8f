// What a plan does for its effects and for the host's own passes.
#include <fmt/format.h>

#include "base/error.h"
#include "plan/plan.h"

using namespace brume;

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
