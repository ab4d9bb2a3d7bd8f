#include <algorithm>
#include <cmath>
#include <cstring>

#include <brume/brume_media.h>
#include <fmt/format.h>

#include "api/handles.h"
#include "api/structs.h"
#include "gaussians/gaussian_file.h"
#include "scene/view.h"

using namespace brume;
using namespace brume::api;
using media::dvec3;

namespace {

template <class Function> brume_status with_media(brume_media media, Function function)
{
    if (!media)
        return barrier(nullptr, [] { expect(false, "media: NULL"); });
    return barrier(media->context.get(), [&] { function(media->history); });
}

dvec3 vector(const double (&values)[3])
{
    return {values[0], values[1], values[2]};
}

dvec3 offset_of(const double *offset)
{
    expect(offset, "offset: NULL");
    return {offset[0], offset[1], offset[2]};
}

struct Screen {
    media::Lens lens;
    std::shared_ptr<const media::DepthMap> depth;
};

Screen read_view(const brume_media_view *given, bool with_depth)
{
    brume_media_view view = BRUME_MEDIA_VIEW_INIT;
    view = read_struct(given, view, "brume_media_view", &brume_media_view::camera, &brume_media_view::format,
                       &brume_media_view::depth, &brume_media_view::reserved);
    expect(view.reserved == 0, "brume_media_view.reserved", view.reserved, "0");
    const brume_camera camera = read_camera(view.camera, "brume_media_view.camera");
    check_camera(camera);
    expect(camera.given == (BRUME_CAMERA_FIELD_OF_VIEW | BRUME_CAMERA_POSE), "brume_media_view.camera.given", camera.given,
           "a field of view and a pose");
    const brume_format format = read_format(view.format);
    Screen result{media::make_lens(camera, format), nullptr};
    if (with_depth && view.depth)
        result.depth = media::make_depth_map(format, camera, read_image(view.depth, "brume_media_view.depth"));
    return result;
}

struct Stroke {
    std::vector<dvec3> points;
    dvec3 normal{0.0};
};

Stroke read_stroke(const brume_media_stroke *given)
{
    brume_media_stroke stroke = BRUME_MEDIA_STROKE_INIT;
    stroke = read_struct(given, stroke, "brume_media_stroke", &brume_media_stroke::point_count, &brume_media_stroke::points,
                         &brume_media_stroke::view, &brume_media_stroke::plane_point, &brume_media_stroke::plane_normal);
    if (stroke.point_count < 1 || stroke.point_count > BRUME_MEDIA_MAX_STROKE_POINTS)
        throw Error(BRUME_ERROR_ARGUMENT, fmt::format("brume_media_stroke.point_count: {}; expected 1 to {}",
                                                      stroke.point_count, BRUME_MEDIA_MAX_STROKE_POINTS));
    expect(stroke.points, "brume_media_stroke.points: NULL");
    Stroke result;
    const dvec3 on_plane = vector(stroke.plane_point);
    const double size = glm::length(vector(stroke.plane_normal));
    if (size > 0)
        result.normal = vector(stroke.plane_normal) / size;
    expect(size > 0 || !stroke.view,
           "brume_media_stroke.plane_normal: 0, 0, 0; expected a plane for the points of a view to lie on");
    Screen view;
    if (stroke.view)
        view = read_view(stroke.view, false);
    for (uint32_t i = 0; i < stroke.point_count; ++i) {
        const double *p = stroke.points + (stroke.view ? 2 : 3) * size_t(i);
        if (!stroke.view) {
            const dvec3 point(p[0], p[1], p[2]);
            result.points.push_back(point - glm::dot(point - on_plane, result.normal) * result.normal);
            continue;
        }
        const dvec3 along = view.lens.direction({p[0], p[1]});
        const double t = glm::dot(on_plane - view.lens.eye, result.normal) / glm::dot(along, result.normal);
        if (!(t > 0 && std::isfinite(t)))
            throw Error(BRUME_ERROR_ARGUMENT,
                        fmt::format("brume_media_stroke.points[{}]: {}, {}; expected a pixel whose ray "
                                    "meets the plane before the camera",
                                    i, p[0], p[1]));
        result.points.push_back(view.lens.eye + t * along);
    }
    return result;
}

// Frames that a host hands over again and again are kept once.
std::shared_ptr<const media::DepthMap> shared_depth(const media::History &history,
                                                    std::shared_ptr<const media::DepthMap> depth)
{
    for (size_t i = history.undo_count(); depth && i-- > 0;)
        if (const auto *before = std::get_if<media::Airbrush>(&history.operation(i)))
            if (before->depth && *before->depth == *depth)
                return before->depth;
    return depth;
}

void check_span(const media::History &history, uint32_t first, uint32_t count, const void *out)
{
    const size_t size = history.state().gaussians.size();
    if (uint64_t(first) + count > size)
        throw Error(BRUME_ERROR_ARGUMENT, fmt::format("first, count: {}, {}; there are {} Gaussians", first, count, size));
    expect(out || count == 0, "out: NULL");
}

}  // namespace

extern "C" {

brume_status brume_media_create(brume_context context, brume_media *out)
{
    if (out)
        *out = nullptr;
    if (!context)
        return barrier(nullptr, [] { expect(false, "context: NULL"); });
    return barrier(context->context.get(), [&] {
        expect(out, "out: NULL");
        *out = new brume_media_t{context->context, {}};
    });
}

void brume_media_destroy(brume_media media)
{
    delete media;
}

brume_status brume_media_get_info(brume_media handle, brume_media_info *info)
{
    return with_media(handle, [&](media::History &history) {
        const media::State &state = history.state();
        const auto selected = std::count(state.selected.begin(), state.selected.end(), uint8_t(1));
        write_struct(info,
                     {0, uint32_t(state.gaussians.size()), uint32_t(selected), uint32_t(state.clipboard.size()),
                      uint32_t(history.undo_count()), uint32_t(history.redo_count())},
                     "brume_media_info");
    });
}

brume_status brume_media_get_gaussians(brume_media handle, uint32_t first, uint32_t count, brume_gaussian *out)
{
    return with_media(handle, [&](media::History &history) {
        check_span(history, first, count, out);
        const uint32_t stride = count ? checked_size(out, "out[0]") : 0;
        auto bytes = reinterpret_cast<unsigned char *>(out);
        for (uint32_t i = 0; i < count; ++i, bytes += stride) {
            const Gaussian &g = history.state().gaussians[first + i];
            const brume_gaussian gaussian{stride,  0,           {g.center[0], g.center[1], g.center[2]},
                                          g.scale, g.amplitude, {g.color[0], g.color[1], g.color[2]}};
            std::memcpy(bytes, &gaussian, std::min<size_t>(stride, sizeof gaussian));
        }
    });
}

brume_status brume_media_get_selection(brume_media handle, uint32_t first, uint32_t count, uint8_t *out)
{
    return with_media(handle, [&](media::History &history) {
        check_span(history, first, count, out);
        std::copy_n(history.state().selected.begin() + first, count, out);
    });
}

brume_status brume_media_put(brume_media handle, const brume_gaussian *gaussians, uint32_t count)
{
    return with_media(handle, [&](media::History &history) {
        history.apply(media::Put{read_gaussians(gaussians, count, "gaussians", "count")});
    });
}

brume_status brume_media_load(brume_media handle, const char *path)
{
    return with_media(handle, [&](media::History &history) {
        expect(path, "path: NULL");
        history.apply(media::Put{brume::read_gaussians(path)});
    });
}

brume_status brume_media_save(brume_media handle, const char *path)
{
    return with_media(handle, [&](media::History &history) {
        expect(path, "path: NULL");
        write_gaussians(path, history.state().gaussians);
    });
}

brume_status brume_media_apply_paint(brume_media handle, const brume_media_paint *given)
{
    return with_media(handle, [&](media::History &history) {
        brume_media_paint paint = BRUME_MEDIA_PAINT_INIT;
        paint = read_struct(given, paint, "brume_media_paint", &brume_media_paint::seed, &brume_media_paint::stroke,
                            &brume_media_paint::scale, &brume_media_paint::amplitude, &brume_media_paint::color,
                            &brume_media_paint::spacing, &brume_media_paint::jitter);
        Stroke stroke = read_stroke(paint.stroke);
        history.apply(media::Paint{paint.seed, std::move(stroke.points), stroke.normal, paint.scale, paint.amplitude,
                                   vector(paint.color), paint.spacing, paint.jitter});
    });
}

brume_status brume_media_apply_erase(brume_media handle, const brume_media_erase *given)
{
    return with_media(handle, [&](media::History &history) {
        brume_media_erase erase = BRUME_MEDIA_ERASE_INIT;
        erase = read_struct(given, erase, "brume_media_erase", &brume_media_erase::stroke, &brume_media_erase::radius,
                            &brume_media_erase::strength, &brume_media_erase::reserved);
        expect(erase.reserved == 0, "brume_media_erase.reserved", erase.reserved, "0");
        history.apply(media::Erase{read_stroke(erase.stroke).points, erase.radius, erase.strength});
    });
}

brume_status brume_media_apply_emit(brume_media handle, const brume_media_emitter *given, double time)
{
    return with_media(handle, [&](media::History &history) {
        brume_media_emitter e = BRUME_MEDIA_EMITTER_INIT;
        e = read_struct(given, e, "brume_media_emitter", &brume_media_emitter::seed, &brume_media_emitter::position,
                        &brume_media_emitter::radius, &brume_media_emitter::velocity, &brume_media_emitter::spread,
                        &brume_media_emitter::acceleration, &brume_media_emitter::rate, &brume_media_emitter::duration,
                        &brume_media_emitter::lifetime, &brume_media_emitter::scale, &brume_media_emitter::amplitude,
                        &brume_media_emitter::color);
        history.apply(media::Emit{e.seed,
                                  vector(e.position),
                                  e.radius,
                                  vector(e.velocity),
                                  e.spread,
                                  vector(e.acceleration),
                                  e.rate,
                                  e.duration,
                                  e.lifetime,
                                  {e.scale[0], e.scale[1]},
                                  {e.amplitude[0], e.amplitude[1]},
                                  vector(e.color),
                                  time});
    });
}

brume_status brume_media_apply_airbrush(brume_media handle, const brume_media_airbrush *given)
{
    return with_media(handle, [&](media::History &history) {
        brume_media_airbrush a = BRUME_MEDIA_AIRBRUSH_INIT;
        a = read_struct(given, a, "brume_media_airbrush", &brume_media_airbrush::seed, &brume_media_airbrush::view,
                        &brume_media_airbrush::position, &brume_media_airbrush::velocity, &brume_media_airbrush::spread,
                        &brume_media_airbrush::drag, &brume_media_airbrush::diffusion, &brume_media_airbrush::rate,
                        &brume_media_airbrush::duration, &brume_media_airbrush::scale, &brume_media_airbrush::amplitude,
                        &brume_media_airbrush::color);
        Screen view;
        if (a.view)
            view = read_view(a.view, true);
        history.apply(media::Airbrush{a.seed, vector(a.position), vector(a.velocity), a.spread, a.drag, a.diffusion, a.rate,
                                      a.duration, a.scale, a.amplitude, vector(a.color), view.lens,
                                      shared_depth(history, view.depth)});
    });
}

brume_status brume_media_select_rectangle(brume_media handle, const brume_media_view *view, const double rectangle[4],
                                          uint32_t mode)
{
    return with_media(handle, [&](media::History &history) {
        expect(rectangle, "rectangle: NULL");
        media::SelectRectangle select{mode, {}, read_view(view, false).lens};
        std::copy_n(rectangle, 4, select.rectangle.begin());
        history.apply(select);
    });
}

brume_status brume_media_select_all(brume_media handle)
{
    return with_media(handle, [](media::History &history) { history.apply(media::SelectAll{}); });
}

brume_status brume_media_select_none(brume_media handle)
{
    return with_media(handle, [](media::History &history) { history.apply(media::SelectNone{}); });
}

brume_status brume_media_copy(brume_media handle)
{
    return with_media(handle, [](media::History &history) { history.apply(media::Copy{}); });
}

brume_status brume_media_paste(brume_media handle, const double offset[3])
{
    return with_media(handle, [&](media::History &history) { history.apply(media::Paste{offset_of(offset)}); });
}

brume_status brume_media_move(brume_media handle, const double offset[3])
{
    return with_media(handle, [&](media::History &history) { history.apply(media::Move{offset_of(offset)}); });
}

brume_status brume_media_delete(brume_media handle)
{
    return with_media(handle, [](media::History &history) { history.apply(media::Delete{}); });
}

brume_status brume_media_undo(brume_media handle)
{
    return with_media(handle, [](media::History &history) { history.undo(); });
}

brume_status brume_media_redo(brume_media handle)
{
    return with_media(handle, [](media::History &history) { history.redo(); });
}

size_t brume_media_journal(brume_media handle, char *buffer, size_t capacity)
{
    size_t size = 0;
    with_media(handle, [&](media::History &history) { size = copy_text(media::journal_of(history), buffer, capacity); });
    return size;
}

brume_status brume_media_replay(brume_media handle, const char *text, size_t length, const char *name)
{
    return with_media(handle, [&](media::History &history) {
        expect(text || length == 0, "text: NULL");
        media::replay(history, std::string_view(text, length), name ? name : "journal");
    });
}

}  // extern "C"
