#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>
#endif

#include "cpu/threads.h"
#include "plan/backend.h"
#include "base/error.h"
#include "base/memory_limit.h"
#include "plan/idle_images.h"
#include "base/pixels.h"
#include "base/text.h"

namespace brume {
namespace {

struct CpuImage : Image {
    float *data = nullptr;
    int64_t row_stride = 0;  // in floats
    std::vector<float> owned;
    uint64_t idle_since = 0;
};

#if defined(__x86_64__) && defined(__GNUC__)
// Not within the function: whoever comes to a static there after the first comes after it for the thread sanitizer, too.
const bool has_wide_registers = __builtin_cpu_supports("avx");
#endif

// Row functions made for AVX may return with the upper halves of its registers in use (GCC leaves them so after calls that
// return vectors). Whatever comes next on the thread without AVX, the host's own code too, would be up to ten times slower.
void rest_wide_registers()
{
#if defined(__x86_64__) && defined(__GNUC__)
    if (has_wide_registers)
        asm volatile("vzeroupper");
#endif
}

class Pool : public std::enable_shared_from_this<Pool> {
public:
    std::shared_ptr<CpuImage> take(int32_t width, int32_t height, int32_t channels)
    {
        // What the system has to bring and clear takes longer than all else of a plan; engines that change the resolution
        // with the frame take what the last size left.
        const size_t samples = size_t(width) * size_t(height) * size_t(channels);
        std::unique_ptr<CpuImage> image = idle_.take([&](const CpuImage &one) { return one.owned.size() == samples; });
        if (!image)
            image = idle_.take(
                [&](const CpuImage &one) { return one.owned.size() > samples && one.owned.size() / 2 <= samples; });
        if (!image) {
            image = allocate(width, height, channels);
            idle_.add(*image);
        }
        image->width = width;
        image->height = height;
        image->channels = channels;
        image->row_stride = int64_t(width) * channels;
        return {image.release(),
                [pool = shared_from_this()](CpuImage *back) { pool->idle_.put_back(std::unique_ptr<CpuImage>(back)); },
                RecyclingAllocator<CpuImage>()};
    }

    void age() { idle_.age(); }
    void trim() { idle_.trim(); }
    uint64_t bytes() const { return idle_.bytes(); }

private:
    std::unique_ptr<CpuImage> allocate(int32_t width, int32_t height, int32_t channels)
    {
        auto image = std::make_unique<CpuImage>();
        const size_t samples = size_t(width) * size_t(height) * size_t(channels);
        image->bytes = samples * sizeof(float);
        if (!resize(image->owned, samples)) {
            idle_.trim();
            if (!resize(image->owned, samples))
                throw Error(BRUME_ERROR_MEMORY,
                            image_text(width, height, channels, "float", image->bytes) + ": out of memory");
        }
        image->data = image->owned.data();
        return image;
    }

    static bool resize(std::vector<float> &values, size_t count)
    try {
        values.resize(count);
        return true;
    } catch (const std::bad_alloc &) {
        return false;
    } catch (const std::length_error &) {
        return false;
    }

    IdleImages<CpuImage> idle_;
};

struct CpuPass : Pass {
    brume_rows_function function = nullptr;
    int32_t grain = 1;
    std::vector<brume_plugin_pixels> pixels;  // of the run at hand
};

class CpuTimer : public FrameTimer {
public:
    void begin() override { marks_.clear(); }
    void mark(int entry) override { marks_.emplace_back(entry, Clock::now()); }
    void end() override { marks_.emplace_back(-1, Clock::now()); }
    std::vector<double> milliseconds(int entries) override
    {
        if (marks_.empty() || marks_.back().first != -1)
            return {};
        std::vector<double> sums(size_t(entries), 0.0);
        for (size_t i = 0; i + 1 < marks_.size(); ++i)
            if (marks_[i].first >= 0)
                sums[size_t(marks_[i].first)] +=
                    std::chrono::duration<double, std::milli>(marks_[i + 1].second - marks_[i].second).count();
        return sums;
    }

private:
    using Clock = std::chrono::steady_clock;
    std::vector<std::pair<int, Clock::time_point>> marks_;
};

/// For the thread sanitizer, which does not see into TBB: what was done before give() is done for whoever takes. Two that
/// give to the same object come in no order by that.
class Handover {
public:
#ifdef __SANITIZE_THREAD__
    void give()
    {
        __tsan_release(this);
    }
    void take()
    {
        __tsan_acquire(this);
    }
#else
    void give() {}
    void take() {}
#endif

private:
    char address_ = 0;  // of its own
};

/// Blocks come after what the caller did, and the caller goes on after them, whatever they throw; they come in no order
/// among themselves.
template <class Function> class Blocks {
public:
    explicit Blocks(Function &function) : function_(function) { begun_.give(); }
    ~Blocks() { done_.take(); }
    Blocks(const Blocks &) = delete;

    static void run(void *blocks, int block)
    {
        auto &self = *static_cast<Blocks *>(blocks);
        self.begun_.take();
        struct Given {
            Handover &done;
            ~Given() { done.give(); }
        } given{self.done_};
        self.function_(block);
    }

private:
    Function &function_;
    Handover begun_, done_;
};

class CpuBackend : public Backend {
public:
    explicit CpuBackend(uint32_t threads)
        : count_(threads ? std::min(threads, Threads::most()) : Threads::most()), threads_(count_)
    {
    }

    uint32_t kind() const override { return BRUME_BACKEND_CPU; }
    std::string device() const override { return "CPU"; }
    uint32_t threads() const override { return count_; }
    uint64_t host_bytes() const override { return pool_->bytes(); }
    uint64_t device_bytes() const override { return 0; }
    void invoke(const std::function<void()> &work) override { work(); }
    uint64_t memory_limit() const override { return brume::memory_limit(); }
    int32_t largest_size() const override { return 65536; }

    std::shared_ptr<Image> create_image(int32_t width, int32_t height, int32_t channels, uint32_t) override
    {
        return pool_->take(width, height, channels);
    }

    std::shared_ptr<Pass> create_pass(const brume_pass_desc &desc, PassLayout layout) override
    {
        if (!desc.rows)
            throw Error(BRUME_ERROR_UNSUPPORTED,
                        "pass \"" + layout.name +
                            "\" has no function for rows; the CPU backend needs one, OpenGL runs its shader");
        auto pass = std::make_shared<CpuPass>();
        pass->layout = std::move(layout);
        pass->function = desc.rows;
        pass->grain = desc.grain;
        pass->pixels.resize(pass->layout.slots.size());
        return pass;
    }

    std::unique_ptr<FrameTimer> create_timer() override
    {
        pool_->age();
        return std::make_unique<CpuTimer>();
    }

    void check(const brume_image &image, const char *what, bool) override
    {
        if (image.kind != BRUME_IMAGE_HOST)
            throw Error(BRUME_ERROR_UNSUPPORTED,
                        std::string(what) + ": a GL texture was given to a CPU context; expected host memory");
    }

    // Floats always: finish_output() rounds them, clamps them and counts what it clamped.
    uint32_t pixel(const brume_image &) override { return BRUME_PIXEL_F32; }

    std::shared_ptr<Image> import(const brume_image &image, int32_t channels) override
    {
        HostPixels host(image);
        if (host.packed_float(channels))
            return wrap(image, host);
        auto to = pool_->take(image.width, image.height, channels);
        for_rows(image.height, [&](int y) {
            float *row = to->data + y * to->row_stride;
            channels == 1 ? load_row_scalar(host, y, row) : load_row_rgba(host, y, row);
        });
        return to;
    }

    std::shared_ptr<Image> import_depth(const brume_image &image, int32_t width, int32_t height) override
    {
        if (image.width == width && image.height == height)
            return import(image, 1);
        HostPixels host(image);
        auto to = pool_->take(width, height, 1);
        for_rows(height, [&](int y) {
            const int32_t from = nearest_pixel(y, height, host.height);
            for (int32_t x = 0; x < width; ++x)
                to->data[y * to->row_stride + x] =
                    load_sample(host.at(nearest_pixel(x, width, host.width), from), host.pixel);
        });
        return to;
    }

    std::shared_ptr<Image> begin_output(const brume_image &image, int32_t channels, bool direct) override
    {
        HostPixels host(image);
        if (direct && host.packed_float(channels))
            return wrap(image, host);
        return pool_->take(image.width, image.height, channels);
    }

    int64_t finish_output(const brume_image &image, Image &written) override
    {
        auto &from = static_cast<CpuImage &>(written);
        HostPixels host(image);
        if (from.data == reinterpret_cast<float *>(host.data))
            return 0;
        std::atomic<int64_t> saturated = 0;
        for_rows(image.height, [&](int y) {
            const float *row = from.data + y * from.row_stride;
            if (int64_t n = from.channels == 1 ? store_row_scalar(row, host, y) : store_row_rgba(row, host, y))
                saturated.fetch_add(n, std::memory_order_relaxed);
        });
        return saturated;
    }

    int64_t copy(const brume_image &from, const brume_image &to) override
    {
        HostPixels a(from), b(to);
        if (a.data == b.data)
            return 0;
        if (a.pixel == b.pixel && a.channels == b.channels) {
            const int parts = a.interleaved() && b.interleaved() ? 1 : a.channels;
            const auto bytes = size_t(a.sample_size) * size_t(a.channels / parts);
            for_rows(from.height, [&](int y) {
                for (int x = 0; x < a.width; ++x)
                    for (int c = 0; c < parts; ++c)
                        std::memcpy(b.at(x, y, c), a.at(x, y, c), bytes);
            });
            return 0;
        }
        auto image = import(from, 4);
        return finish_output(to, *image);
    }

    void flush() override { pool_->age(); }
    void trim() override { pool_->trim(); }

    brume_status run(Pass &described, const brume_plugin_image *images, const void *constants, int32_t width, int32_t height,
                     const brume_plugin_scene &scene, void *user, const Watch *watch) override
    {
        auto &pass = static_cast<CpuPass &>(described);
        for (size_t i = 0; i < pass.pixels.size(); ++i)
            pass.pixels[i] = images[i] ? pixels(*images[i]) : brume_plugin_pixels{};
        const brume_plugin_rows call{sizeof call,        width,     height, uint32_t(pass.pixels.size()),
                                     pass.pixels.data(), constants, &scene, user};
        // Blocks are fixed by grain alone and never by the number of threads, so an effect that sums over its block
        // gives the same bits on any machine.
        // Relaxed: blocks are in no order, and what one does that races with another is to be found.
        constexpr auto relaxed = std::memory_order_relaxed;
        std::atomic<brume_status> status = BRUME_OK;
        std::atomic<int32_t> done = 0;
        const std::thread::id caller = std::this_thread::get_id();
        const int32_t grain = std::min(pass.grain, height);
        const int32_t blocks = height / grain + (height % grain != 0);
        for_blocks(blocks, [&](int32_t block) {
            if (status.load(relaxed) != BRUME_OK)
                return;
            const auto last = int32_t(std::min<int64_t>(height, (int64_t(block) + 1) * grain));
            brume_status result = pass.function(&call, block * grain, last);
            rest_wide_registers();
            // Only the thread of the API call may report, between the blocks that it takes itself.
            const int32_t here = last - block * grain, rows = done.fetch_add(here, relaxed) + here;
            if (watch && std::this_thread::get_id() == caller &&
                !watch->progress.report(watch->from + (watch->to - watch->from) * rows / height))
                result = BRUME_ERROR_CANCELLED;
            brume_status none = BRUME_OK;
            if (result != BRUME_OK)
                status.compare_exchange_strong(none, result, relaxed);
        });
        return status;
    }

private:
    static brume_plugin_pixels pixels(Image &image)
    {
        auto &cpu = static_cast<CpuImage &>(image);
        return {cpu.data, cpu.row_stride, cpu.width, cpu.height, cpu.channels, 0};
    }

    template <class Function> void for_rows(int height, Function function)
    {
        constexpr int together = 16;
        for_blocks((height + together - 1) / together, [&](int block) {
            for (int y = block * together; y < std::min(height, (block + 1) * together); ++y)
                function(y);
        });
    }

    template <class Function> void for_blocks(int count, Function function)
    {
        Blocks<Function> blocks(function);
        threads_.run(count, &Blocks<Function>::run, &blocks);
    }

    static std::shared_ptr<CpuImage> wrap(const brume_image &image, const HostPixels &host)
    {
        auto wrapped = std::allocate_shared<CpuImage>(RecyclingAllocator<CpuImage>());
        wrapped->width = image.width;
        wrapped->height = image.height;
        wrapped->channels = host.channels;
        wrapped->data = reinterpret_cast<float *>(host.data);
        wrapped->row_stride = host.row_stride / 4;
        return wrapped;
    }

    uint32_t count_;
    Threads threads_;
    std::shared_ptr<Pool> pool_ = std::make_shared<Pool>();
};

}  // namespace

std::unique_ptr<Backend> make_cpu_backend(uint32_t threads)
{
    return std::make_unique<CpuBackend>(threads);
}

}  // namespace brume
