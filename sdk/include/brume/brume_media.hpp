// Brume's media for C++17 and later: brume_media.h in the manner of brume.hpp, whose head says how failures are told.
//
//   brume::Media media(context);
//   brume_media_paint paint = BRUME_MEDIA_PAINT_INIT;
//   paint.stroke = &stroke;
//   media.apply(paint);
//   media.save("bank.ply");
#ifndef BRUME_BRUME_MEDIA_HPP
#define BRUME_BRUME_MEDIA_HPP

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "brume.hpp"
#include "brume_media.h"

namespace brume {

#ifdef BRUME_HPP_NO_EXCEPTIONS
inline namespace no_exceptions {
#endif

namespace detail {

struct DestroyMedia {
    void operator()(brume_media media) const { brume_media_destroy(media); }
};

}  // namespace detail

class Media {
public:
    explicit Media(const Context &context) : context_(context)
    {
        brume_media media = nullptr;
        status_ = brume_media_create(context_.get(), &media);
        context_.check(status_);
        handle_.reset(media);
    }

    brume_media get() const { return handle_.get(); }
    explicit operator bool() const { return handle_ != nullptr; }
    brume_status status() const { return status_; }
    const Context &context() const { return context_; }

    brume_media_info info() const
    {
        brume_media_info info = BRUME_MEDIA_INFO_INIT;
        context_.check(brume_media_get_info(get(), &info));
        return info;
    }
    std::vector<brume_gaussian> gaussians() const
    {
        std::vector<brume_gaussian> all(info().gaussian_count, brume_gaussian BRUME_GAUSSIAN_INIT);
        if (!all.empty())
            context_.check(brume_media_get_gaussians(get(), 0, detail::count(all), all.data()));
        return all;
    }
    // 1 for each of the Gaussians that is selected.
    std::vector<std::uint8_t> selection() const
    {
        std::vector<std::uint8_t> all(info().gaussian_count);
        if (!all.empty())
            context_.check(brume_media_get_selection(get(), 0, detail::count(all), all.data()));
        return all;
    }

    Result put(const std::vector<brume_gaussian> &gaussians)
    {
        return context_.check(brume_media_put(get(), gaussians.data(), detail::count(gaussians)));
    }
    Result load(const std::string &path) { return context_.check(brume_media_load(get(), path.c_str())); }
    Result save(const std::string &path) const { return context_.check(brume_media_save(get(), path.c_str())); }

    Result apply(const brume_media_paint &paint) { return context_.check(brume_media_apply_paint(get(), &paint)); }
    Result apply(const brume_media_erase &erase) { return context_.check(brume_media_apply_erase(get(), &erase)); }
    Result apply(const brume_media_airbrush &brush) { return context_.check(brume_media_apply_airbrush(get(), &brush)); }
    Result apply(const brume_media_emitter &emitter, double time)
    {
        return context_.check(brume_media_apply_emit(get(), &emitter, time));
    }

    Result select_rectangle(const brume_media_view &view, const std::array<double, 4> &rectangle,
                            std::uint32_t mode = BRUME_MEDIA_SELECT_REPLACE)
    {
        return context_.check(brume_media_select_rectangle(get(), &view, rectangle.data(), mode));
    }
    Result select_all() { return context_.check(brume_media_select_all(get())); }
    Result select_none() { return context_.check(brume_media_select_none(get())); }
    Result copy() { return context_.check(brume_media_copy(get())); }
    Result paste(const std::array<double, 3> &offset) { return context_.check(brume_media_paste(get(), offset.data())); }
    Result move(const std::array<double, 3> &offset) { return context_.check(brume_media_move(get(), offset.data())); }
    // `delete` is C++'s.
    Result remove() { return context_.check(brume_media_delete(get())); }

    Result undo() { return context_.check(brume_media_undo(get())); }
    Result redo() { return context_.check(brume_media_redo(get())); }
    std::string journal() const
    {
        std::string text =
            detail::copied_text([&](char *to, std::size_t size) { return brume_media_journal(get(), to, size); });
        if (text.empty())
            context_.check(BRUME_ERROR_MEMORY);
        return text;
    }
    Result replay(std::string_view text, const std::string &name = "journal")
    {
        return context_.check(brume_media_replay(get(), text.data(), text.size(), name.c_str()));
    }

private:
    Context context_;
    std::unique_ptr<brume_media_t, detail::DestroyMedia> handle_;
    brume_status status_ = BRUME_OK;
};

#ifdef BRUME_HPP_NO_EXCEPTIONS
}  // namespace no_exceptions
#endif
}  // namespace brume

#endif
