#include "run/sequence.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <memory>
#include <thread>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

#include "image/library.hpp"
#include "run/checks.hpp"
#include "run/interrupt.hpp"
#include "run/picture_io.hpp"
#include "run/progress.hpp"
#include "support/error.hpp"

namespace brume::tool {
namespace {

double ms_since(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

struct Job {
    std::size_t index = 0;
    std::optional<Frame> frame;
    std::vector<AddedLayer> layers;
    LuminanceWeights weights{};
    FrameStats stats;
    bool discarded = false;  ///< the run was interrupted before its fog
};
using JobPtr = std::shared_ptr<Job>;

ReadLimits limits_of(const SequenceOptions &options)
{
    ReadLimits limits;
    if (options.memory)
        limits.part_bytes = options.memory << 20;
    return limits;
}

class Sequence {
public:
    Sequence(const SequenceOptions &options, std::vector<FrameFile> files)
        : options_(options), limits_(limits_of(options)),
          io_({options.fog.picture, options.spaces, options.output, options.output_type, limits_}, files),
          fogger_(options.fog), preview_(options.preview), progress_(0, options.quiet)
    {
        for (FrameFile &f : files) {
            FrameStats stats;
            std::error_code error;
            if (options.skip_existing && std::filesystem::exists(f.output, error))
                stats.outcome = Outcome::kSkipped;
            else
                to_do_.push_back(run_.frames.size());
            stats.files = std::move(f);
            run_.frames.push_back(std::move(stats));
        }
    }

    int run()
    {
        preflight();
        if (!io_.colors().warning().empty())
            progress_.note("warning: " + io_.colors().warning());
        if (options_.frames.empty())
            for (const std::string &note : sequence_notes(FilePattern(options_.input)))
                progress_.note(note);
        for (const std::size_t i : to_do_)
            make_folder_of(run_.frames[i].files.output);
        if (!options_.preview.empty())
            make_folder_of(options_.preview);
        if (!options_.stats.empty() && !is_stream(options_.stats))
            make_folder_of(options_.stats);
        catch_interrupts();
        progress_ = Progress(to_do_.size(), options_.quiet);
        const auto start = std::chrono::steady_clock::now();
        pipeline();
        run_.wall_seconds = ms_since(start) / 1000;
        progress_.end();
        return finish();
    }

private:
    /// What is wrong with the request shows on the first frame that opens, before anything is written. Damaged frames are
    /// left for the run to report one by one.
    void preflight()
    {
        if (!options_.preview.empty())
            image_library();  // or it is not installed
        std::uint64_t bytes = 0, fogging = 0;
        for (const std::size_t i : to_do_) {
            try {
                const OpenFrame open = open_frame(run_.frames[i].files, options_.fog.picture, limits_);
                const int number = run_.frames[i].files.frame;
                fogger_.learn_roles(open.file, open.color, number);
                const std::vector<OpenInput> inputs = fogger_.open_inputs(open.file, open.color, number, limits_);
                fogger_.expect(open.file, open.color, open.depth_file ? *open.depth_file : open.file, open.depth, inputs,
                               number);
                const Plan &plan =
                    fogger_.plan_for(open.file, open.color, io_.colors().luminance_weights(open.file.part(open.color.part)),
                                     roles_of(inputs), number);
                // Once as read, once more as it is written, and the added layers as floats.
                bytes = 2 * frame_bytes(open.file, open.color);
                const PartInfo &part = open.file.parts()[open.color.part];
                const std::uint64_t pixels = std::uint64_t(part.width()) * std::uint64_t(part.height());
                bytes += pixels * 12 * (options_.fog.layers.size() + inputs.size());
                // One frame is fogged at a time: the plan's images, and colour, depth and output as the SDK holds them.
                fogging = plan.info().image_bytes + pixels * (36 + 16 * inputs.size());
                break;
            } catch (const FrameError &) {
            }
        }
        const unsigned threads = std::max(1u, std::thread::hardware_concurrency());
        const std::size_t jobs = options_.jobs > 0 ? std::size_t(options_.jobs) : threads + 1;
        const std::uint64_t left = limits_.part_bytes - std::min(limits_.part_bytes, fogging);
        run_.frames_in_flight = std::clamp<std::size_t>(bytes ? std::size_t(left / bytes) : jobs, 1, jobs);
        if (bytes > left)
            progress_.note(
                fmt::format("warning: one frame takes about {} MiB, more than the {} MiB of --mem; going on one at a time",
                            (bytes + fogging) >> 20, limits_.part_bytes >> 20));
        set_image_threads(int(threads));
    }

    void pipeline()
    {
        namespace tbb = oneapi::tbb;
        const auto serial = tbb::filter_mode::serial_in_order, parallel = tbb::filter_mode::parallel;
        tbb::parallel_pipeline(run_.frames_in_flight,
                               tbb::make_filter<void, JobPtr>(serial, [this](tbb::flow_control &control) {
                                   return next(control);
                               }) & tbb::make_filter<JobPtr, JobPtr>(parallel, [this](JobPtr job) {
                                   return stage(std::move(job), &Sequence::read);
                               }) & tbb::make_filter<JobPtr, JobPtr>(serial, [this](JobPtr job) {
                                   return stage(std::move(job), &Sequence::fog);
                               }) & tbb::make_filter<JobPtr, JobPtr>(parallel, [this](JobPtr job) {
                                   return stage(std::move(job), &Sequence::write);
                               }) & tbb::make_filter<JobPtr, void>(serial, [this](JobPtr job) { report(*job); }));
    }

    JobPtr next(oneapi::tbb::flow_control &control)
    {
        if (next_ == to_do_.size() || interrupted() || stop_) {
            control.stop();
            return nullptr;
        }
        auto job = std::make_shared<Job>();
        job->index = to_do_[next_++];
        job->stats = run_.frames[job->index];
        return job;
    }

    JobPtr stage(JobPtr job, void (Sequence::*work)(Job &))
    {
        if (job->stats.outcome == Outcome::kFailed || job->discarded)
            return job;
        try {
            (this->*work)(*job);
        } catch (const std::bad_alloc &) {
            fail(*job, fmt::format("{}: out of memory", job->stats.files.input.string()));
        } catch (const std::exception &e) {
            fail(*job, e.what());
        }
        return job;
    }

    void fail(Job &job, std::string why)
    {
        job.stats.outcome = Outcome::kFailed;
        job.stats.error = std::move(why);
        job.frame.reset();
        job.layers.clear();
        if (!options_.keep_going)
            stop_ = true;
    }

    void read(Job &job)
    {
        const auto start = std::chrono::steady_clock::now();
        job.frame.emplace(io_.read(fogger_, job.weights, job.stats));
        job.stats.read_ms = ms_since(start);
    }

    void fog(Job &job)
    {
        if (interrupted()) {
            job.frame.reset();
            job.discarded = true;
            return;
        }
        const auto start = std::chrono::steady_clock::now();
        // Without isolation this thread could pick up another frame's reading while it waits for the library.
        oneapi::tbb::this_task_arena::isolate(
            [&] { job.stats.fog = fogger_.fog(*job.frame, job.stats.files.frame, job.weights, job.layers); });
        for (const std::string &warning : job.stats.fog.warnings)
            job.stats.warnings.push_back(warning);
        job.stats.fog_ms = ms_since(start);
    }

    void write(Job &job)
    {
        const auto start = std::chrono::steady_clock::now();
        Frame &frame = *job.frame;
        const bool previewed = !options_.preview.empty() && (preview_.is_sequence() || job.index == to_do_.front());
        Display preview{frame.width, frame.height, {}};
        if (previewed)
            preview.rgb = io_.colors().to_display(frame.pixels.data(), job.stats.pixels, frame.channels);
        io_.write(frame, job.layers, job.weights, options_.provenance ? fogger_.provenance() : "", job.stats);
        if (previewed)
            write_display(preview, preview_.at(job.stats.files.frame));
        job.frame.reset();
        job.layers.clear();
        job.stats.outcome = Outcome::kDone;
        job.stats.write_ms = ms_since(start);
    }

    void report(Job &job)
    {
        if (job.discarded)
            return;
        FrameStats &stats = run_.frames[job.index] = std::move(job.stats);
        if (stats.outcome == Outcome::kFailed) {
            progress_.note("failed: " + stats.error);
            return;
        }
        for (const std::string &warning : stats.warnings) {
            // --stats has them all.
            if (warned_.is_new(warning))
                progress_.note(fmt::format("warning: {}: {}", stats.files.input.string(), warning));
        }
        progress_.done(stats.files.output.string(), (stats.read_ms + stats.fog_ms + stats.write_ms) / 1000);
    }

    int finish()
    {
        const brume_context_info info = fogger_.context().info();
        run_.backend = backend_name(info.backend);
        run_.device = info.device ? info.device : "";
        run_.scene = options_.fog.scene;
        run_.colors = io_.colors().description();
        if (!options_.stats.empty())
            write_stats(options_.stats, run_);

        const std::size_t done = run_.count(Outcome::kDone), failed = run_.count(Outcome::kFailed);
        const std::size_t skipped = run_.count(Outcome::kSkipped), left = run_.count(Outcome::kNotTried);
        if (!options_.quiet || failed + left > 0)
            progress_.note(fmt::format("{} done, {} failed, {} skipped, {} not tried in {:.2f} s on {}{}", done, failed,
                                       skipped, left, run_.wall_seconds, run_.device,
                                       interrupted() ? " (interrupted)" : ""));
        return failed + left > 0 ? kSomeFailed : kDone;
    }

    const SequenceOptions &options_;
    const ReadLimits limits_;
    const PictureIo io_;
    Fogger fogger_;
    FilePattern preview_;
    Progress progress_;
    RunStats run_;
    std::vector<std::size_t> to_do_;
    std::size_t next_ = 0;
    std::atomic<bool> stop_{false};
    WarningKinds warned_;
};

}  // namespace

int run_sequence(const SequenceOptions &options)
{
    std::vector<FrameFile> files = list_frames(FilePattern(options.input), FilePattern(options.output), options.frames);
    check_outputs(options, files);
    return Sequence(options, std::move(files)).run();
}

}  // namespace brume::tool
