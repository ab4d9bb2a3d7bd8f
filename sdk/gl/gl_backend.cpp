#include <array>
#include <map>
#include <tuple>
#include <utility>

#include <epoxy/gl.h>

#include "base/error.h"
#include "base/half.h"
#include "base/pixels.h"
#include "gl/convert.h"
#include "gl/device.h"
#include "gl/gl_backend.h"
#include "gl/host_texture.h"
#include "gl/image.h"
#include "gl/pass.h"
#include "gl/program.h"
#include "gl/timer.h"
#include "gl/transfer.h"

namespace brume {
namespace gl {
namespace {

constexpr size_t most_remembered = 256;  // textures

uint32_t pixel_of(GLenum format)
{
    return is_half(format) ? BRUME_PIXEL_F16 : BRUME_PIXEL_F32;
}

bool is_texture(const brume_image &image)
{
    return image.kind != BRUME_IMAGE_HOST;
}

Rectangle rectangle_of(const brume_image &image)
{
    return {image.x, image.y, image.width, image.height};
}

const char *name_of(int32_t channels)
{
    return channels == 1 ? "depth" : "color";
}

class GlBackend : public Backend {
public:
    GlBackend(const GlOptions &options, const Log &log);
    ~GlBackend() override;

    uint32_t kind() const override { return BRUME_BACKEND_GL; }
    std::string device() const override { return device_.renderer(); }
    uint32_t threads() const override { return 1; }
    uint64_t host_bytes() const override { return 0; }
    uint64_t device_bytes() const override { return pool_->bytes(); }
    void invoke(const std::function<void()> &work) override;
    int32_t largest_size() const override { return pool_->largest_size(); }

    std::shared_ptr<Image> create_image(int32_t width, int32_t height, int32_t channels, uint32_t pixel) override;
    std::shared_ptr<Pass> create_pass(const brume_pass_desc &desc, PassLayout layout) override;
    std::unique_ptr<FrameTimer> create_timer() override;

    void check(const brume_image &image, const char *what, bool writable) override;
    uint32_t pixel(const brume_image &image) override;
    std::shared_ptr<Image> import(const brume_image &image, int32_t channels) override;
    std::shared_ptr<Image> import_depth(const brume_image &image, int32_t width, int32_t height) override;
    std::shared_ptr<Image> begin_output(const brume_image &image, int32_t channels, bool direct) override;
    int64_t finish_output(const brume_image &image, Image &written) override;
    int64_t copy(const brume_image &from, const brume_image &to) override;
    void trim() override;
    void flush() override;

    brume_status run(Pass &pass, const brume_plugin_image *images, const void *constants, int32_t width, int32_t height,
                     const brume_plugin_scene &scene, void *user, const Watch *watch) override;

private:
    struct Seen {
        HostTexture texture;
        uint64_t work;          // the invoke() that looked at it last
        bool complete = false;  // as far as was asked
        bool stays_complete = false;
    };

    // copied: the texture itself is written or copied, not sampled.
    HostTexture look_at(const brume_image &image, const std::string &what, bool copied);
    bool look_again(const brume_image &image, const std::string &what, Seen &seen);
    bool stores_round_to_nearest();
    std::shared_ptr<GlImage> readable(const brume_image &image, int32_t channels);
    std::shared_ptr<GlImage> uploaded(const brume_image &image, int32_t channels);
    void bring(const GlImage &from, const Rectangle &source, const GlImage &to, const Rectangle &target);
    int64_t clamped(const brume_image &written);

    const Log log_;
    Device device_;
    std::shared_ptr<Disposal> disposal_;
    std::shared_ptr<ImagePool> pool_;
    std::map<std::tuple<std::string, std::string, std::string>, std::shared_ptr<GlProgram>> programs_;
    std::optional<Converter> converter_;
    Samplers samplers_;
    std::map<GLuint, Seen> seen_;
    uint64_t work_ = 0;
    bool direct_half_stores_ = false;
};

GlBackend::GlBackend(const GlOptions &options, const Log &log)
    : log_(log), device_(options, log), disposal_(std::make_shared<Disposal>(device_.borrowed_context()))
{
    device_.invoke([&] {
        pool_ = std::make_shared<ImagePool>(disposal_);
        samplers_.create();
        converter_.emplace(disposal_);
        direct_half_stores_ = stores_round_to_nearest();
    });
    log_(BRUME_LOG_INFO, "OpenGL on " + device_.renderer() +
                             (direct_half_stores_ ? "" : "; its half stores do not round to nearest: a pass rounds for it"));
}

GlBackend::~GlBackend()
{
    try {
        device_.invoke([&] {
            programs_.clear();
            converter_.reset();
            samplers_.destroy();
            pool_->close();
            disposal_->close();
        });
    } catch (const std::exception &error) {
        log_(BRUME_LOG_WARNING, std::string("OpenGL objects of a brume context are left behind: ") + error.what());
    }
}

void GlBackend::invoke(const std::function<void()> &work)
{
    device_.invoke([&] {
        ++work_;
        if (seen_.size() > most_remembered)
            seen_.clear();
        work();
        disposal_->collect();
    });
}

// A plan is being made; where plans are made and destroyed without a frame, their images must not pile up either.
std::unique_ptr<FrameTimer> GlBackend::create_timer()
{
    pool_->age();
    return std::make_unique<GlTimer>(disposal_);
}

// Each question to the driver may wait for its thread, so a frame looks at each texture once, and asks of one that it knows
// only what may have changed.
HostTexture GlBackend::look_at(const brume_image &image, const std::string &what, bool copied)
{
    if (image.kind == BRUME_IMAGE_GL_TEXTURE_TRUSTED)
        return trusted(image, what);
    auto found = seen_.find(image.gl_texture);
    if (found != seen_.end() && found->second.work != work_ && !look_again(image, what, found->second))
        seen_.erase(std::exchange(found, seen_.end()));
    if (found == seen_.end())
        found = seen_.emplace(image.gl_texture, Seen{inspect(image.gl_texture, what, device_.guard()), work_}).first;
    Seen &seen = found->second;
    require_size(seen.texture, image, what);
    if (copied && !seen.complete) {
        seen.stays_complete = require_complete(seen.texture, what);
        seen.complete = true;
    }
    return seen.texture;
}

// Whether it is the texture of earlier frames, as far as that can be told. In a context that nobody else uses nobody changes
// its parameters either.
bool GlBackend::look_again(const brume_image &image, const std::string &what, Seen &seen)
{
    const brume_image whole = whole_of(image);
    if (seen.texture.width != whole.width || seen.texture.height != whole.height || !has_format(seen.texture))
        return false;
    if (device_.shared()) {
        if (!has_size(seen.texture))
            return false;
        require_plain_sampling(seen.texture, what);
        seen.complete = seen.stays_complete;
    }
    seen.work = work_;
    return true;
}

std::shared_ptr<Image> GlBackend::create_image(int32_t width, int32_t height, int32_t channels, uint32_t pixel)
{
    device_.guard();
    auto image = pool_->take(width, height, channels, pixel);
    // What another plan left here must not come back through a fetch of weight 0: 0 times NaN is NaN.
    glClearTexImage(image->texture, 0, GL_RGBA, GL_FLOAT, nullptr);
    return image;
}

std::shared_ptr<Pass> GlBackend::create_pass(const brume_pass_desc &desc, PassLayout layout)
{
    if (!desc.source)
        throw Error(BRUME_ERROR_UNSUPPORTED, "pass \"" + layout.name + "\" has no shader; it runs on the CPU backend only");
    device_.guard();
    const std::string name = desc.source_name ? desc.source_name : desc.name;
    std::shared_ptr<GlProgram> &program = programs_[{name, desc.source, desc.defines ? desc.defines : ""}];
    if (!program)
        program = std::make_shared<GlProgram>(name, desc.source, desc.defines ? desc.defines : "", disposal_);
    return std::make_shared<GlPass>(program, std::move(layout));
}

void GlBackend::check(const brume_image &image, const char *what, bool writable)
{
    const std::string label = what;
    if (image.width > largest_size() || image.height > largest_size())
        throw Error(BRUME_ERROR_UNSUPPORTED, label + ": " + std::to_string(image.width) + " x " +
                                                 std::to_string(image.height) + "; this device's textures have at most " +
                                                 std::to_string(largest_size()) + " pixels a side");
    if (image.kind == BRUME_IMAGE_HOST) {
        if (!image.data)
            throw Error(BRUME_ERROR_ARGUMENT, label + ".data: NULL");
        return;
    }
    if (!device_.borrowed())
        throw Error(BRUME_ERROR_UNSUPPORTED, label +
                                                 ": a GL texture was given to a context of BRUME_GL_OWNED; expected host "
                                                 "memory, or a context of BRUME_GL_BORROWED");
    const HostTexture texture = look_at(image, label, writable || is_part(image));
    if (writable)
        require_writable(texture, int32_t(image.channels), label);
}

uint32_t GlBackend::pixel(const brume_image &image)
{
    return is_texture(image) ? pixel_of(look_at(image, "output", true).format) : image.pixel;
}

// A texture of the host's as it is, of which the image may be a part.
std::shared_ptr<GlImage> GlBackend::readable(const brume_image &image, int32_t channels)
{
    const HostTexture texture = look_at(image, name_of(channels), is_part(image));
    require_readable(texture, channels, name_of(channels));
    auto wrapped = wrap(texture);
    if (image.kind == BRUME_IMAGE_GL_TEXTURE_TRUSTED)
        wrapped->format = GL_NONE;  // the host says what outputs are only
    return wrapped;
}

std::shared_ptr<GlImage> GlBackend::uploaded(const brume_image &image, int32_t channels)
{
    auto to = pool_->take(image.width, image.height, channels, image.pixel);
    upload(image, *to, device_.guard());
    return to;
}

// Passes know no rectangles: what is a part of a texture they see as a copy.
std::shared_ptr<Image> GlBackend::import(const brume_image &image, int32_t channels)
{
    device_.guard();
    if (!is_texture(image))
        return uploaded(image, channels);
    auto texture = readable(image, channels);
    if (!is_part(image))
        return texture;
    auto part = pool_->take(image.width, image.height, channels, pixel_of(texture->format));
    bring(*texture, rectangle_of(image), *part, all_of(*part));
    return part;
}

std::shared_ptr<Image> GlBackend::import_depth(const brume_image &image, int32_t width, int32_t height)
{
    if (image.width == width && image.height == height)
        return import(image, 1);
    StateGuard &guard = device_.guard();
    const auto from = is_texture(image) ? readable(image, 1) : uploaded(image, 1);
    auto to = pool_->take(width, height, 1, BRUME_PIXEL_F32);
    converter_->convert(*from, is_texture(image) ? rectangle_of(image) : all_of(*from), *to, all_of(*to), samplers_, guard);
    return to;
}

// Passes that write a caller's half texture leave the conversion to the driver's stores, if those round to nearest even as
// the CPU backend does. Else, and wherever an image stands between, they write floats and finish_output() rounds them.
std::shared_ptr<Image> GlBackend::begin_output(const brume_image &image, int32_t channels, bool direct)
{
    device_.guard();
    if (is_texture(image)) {
        const HostTexture texture = look_at(image, "output", true);
        require_writable(texture, channels, "output");
        auto wrapped = wrap(texture);
        const uint32_t pixel = pixel_of(texture.format);
        if (direct && !is_part(image) && wrapped->channels == channels && !is_packed(texture.format) &&
            (pixel == BRUME_PIXEL_F32 || direct_half_stores_))
            return wrapped;
    }
    return pool_->take(image.width, image.height, channels, BRUME_PIXEL_F32);
}

// Halves are clamped by the passes and by the converter; a count of them would have to be waited for.
int64_t GlBackend::finish_output(const brume_image &image, Image &written)
{
    StateGuard &guard = device_.guard();
    const auto &from = static_cast<const GlImage &>(written);
    if (is_texture(image)) {
        if (from.texture != image.gl_texture)
            bring(from, all_of(from), *wrap(look_at(image, "output", true)), rectangle_of(image));
    } else if (from.format == image_format(from.channels, image.pixel)) {
        download(from, image, guard);
    } else {
        auto converted = pool_->take(from.width, from.height, from.channels, image.pixel);
        converter_->convert(from, all_of(from), *converted, all_of(*converted), samplers_, guard);
        download(*converted, image, guard);
    }
    return clamped(image);
}

int64_t GlBackend::clamped(const brume_image &written)
{
    const bool clamps = is_texture(written) && is_packed(look_at(written, "output", true).format);
    return clamps || pixel(written) == BRUME_PIXEL_F16 ? not_counted : 0;
}

int64_t GlBackend::copy(const brume_image &from, const brume_image &to)
{
    device_.guard();
    if (!is_texture(from) || !is_texture(to))
        return finish_output(to, *import(from, 4));
    look_at(from, name_of(4), true);
    bring(*readable(from, 4), rectangle_of(from), *wrap(look_at(to, "output", true)), rectangle_of(to));
    return clamped(to);
}

void GlBackend::bring(const GlImage &from, const Rectangle &source, const GlImage &to, const Rectangle &target)
{
    if (from.format == to.format)
        glCopyImageSubData(from.texture, GL_TEXTURE_2D, 0, source.x, source.y, 0, to.texture, GL_TEXTURE_2D, 0, target.x,
                           target.y, 0, source.width, source.height, 1);
    else
        converter_->convert(from, source, to, target, samplers_, device_.guard());
}

void GlBackend::trim()
{
    seen_.clear();
    pool_->trim();
    disposal_->collect();
}

void GlBackend::flush()
{
    device_.guard();
    if (device_.borrowed())
        glMemoryBarrier(GL_ALL_BARRIER_BITS);
    pool_->age();
}

brume_status GlBackend::run(Pass &pass, const brume_plugin_image *images, const void *constants, int32_t width,
                            int32_t height, const brume_plugin_scene &scene, void *, const Watch *)
{
    static_cast<GlPass &>(pass).run(images, constants, width, height, scene, samplers_, device_.guard());
    return BRUME_OK;
}

// Asks the driver by storing floats between halves: ties both ways, the largest, and subnormals.
bool GlBackend::stores_round_to_nearest()
{
    const std::array<float, 8> values = {1.0f + 0x1p-11f, 1.0f + 0x3p-11f, -1.0f - 0x1.8p-11f, 65519.0f,
                                         65504.0f,        0x1p-25f,        0x3p-25f,           0x1.8p-24f + 0x1p-40f};
    std::array<uint16_t, 8> stored{};
    brume_image image = BRUME_IMAGE_INIT;
    image.width = 2;
    image.height = 1;
    image.data = const_cast<float *>(values.data());
    const auto floats = pool_->take(2, 1, 4, BRUME_PIXEL_F32);
    const auto halves = pool_->take(2, 1, 4, BRUME_PIXEL_F16);
    upload(image, *floats, device_.guard());
    converter_->store(*floats, *halves, samplers_, device_.guard());
    image.pixel = BRUME_PIXEL_F16;
    image.data = stored.data();
    download(*halves, image, device_.guard());
    for (size_t i = 0; i < values.size(); ++i)
        if (stored[i] != float_to_half(values[i]))
            return false;
    return true;
}

}  // namespace
}  // namespace gl

std::unique_ptr<Backend> make_gl_backend(const GlOptions &options, const Log &log)
{
    return std::make_unique<gl::GlBackend>(options, log);
}

}  // namespace brume
