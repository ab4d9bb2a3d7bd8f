#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/context.h"
#include "core/offer.h"
#include "core/scene_images.h"
#include "core/view.h"
#include "core/scene.h"

namespace brume {

struct PlanEntry {
    bool runs = false;
    std::string effect, name, reason;
    uint64_t bytes = 0;
    uint64_t operations = 0;
    double predicted_ms = 0;
};

// One effect's part of a plan.
struct PlannedEffect {
    const Effect *effect = nullptr;
    std::vector<double> parameters{};
    void *state = nullptr;
    bool runs = false;
    std::vector<Offer> offers{};
};

// Rehearsals are planned for their entries and offers: they hold no images or programs and cannot be executed.
enum class Purpose { execution, rehearsal };

}  // namespace brume

// What must be done for one scene and one image format. It is also the host that effects talk to.
struct brume_host_t {
public:
    brume_host_t(std::shared_ptr<brume::Context> context, brume::Scene scene, const brume_format &format,
                 brume::Purpose purpose = brume::Purpose::execution);
    ~brume_host_t();
    brume_host_t(const brume_host_t &) = delete;
    brume_host_t &operator=(const brume_host_t &) = delete;

    void execute(const brume_frame &frame);

    const std::vector<brume::PlanEntry> &entries() const { return entries_; }
    const std::vector<brume::PlannedEffect> &effects() const { return effects_; }
    // By the offers that the parameters are; < 0 where an effect's are none.
    double predicted_error() const;
    bool does_nothing() const;
    uint32_t camera_needs() const { return camera_needs_; }
    const std::string &camera_reason() const { return camera_reason_; }
    uint64_t image_bytes() const { return image_bytes_; }
    // Of the last frame's half outputs; not_counted before one.
    int64_t clamped_values() const { return clamped_values_; }
    // Of the last frame per entry; empty before one.
    std::vector<double> measured_ms();

    // The services of brume_plugin.h; the names are the same there.
    brume_status fail(brume_status status, const char *message);
    void add_entry(const brume_plugin_entry &entry);
    void need_camera(uint32_t needs, const std::string &reason);
    brume_plugin_image create_image(int32_t width, int32_t height, int32_t channels);
    brume_program compile(const char *name, const char *source, const char *defines);
    void run(const brume_plugin_pass &pass);
    brume_status rows(const char *name, int32_t count, int32_t grain, brume_rows_function function, void *user);
    brume_plugin_pixels pixels(brume_plugin_image image);
    brume_plugin_image upload(uint32_t slot, int32_t channels, const float *values, uint64_t texels);

    // Logged as a warning where the device is Mesa's software GL, once per plan.
    void warn_on_software_gl(const std::string &message);

private:
    // A data image and, on the CPU, the memory that it wraps.
    struct Data {
        std::vector<float> values;
        std::shared_ptr<brume::Image> image;
    };

    void plan_content(const brume::View &view, brume_plugin_scene &scene);
    void evaluate_content(double frame, const brume::View &view, brume_plugin_scene &scene);
    void plan_effects();
    void destroy_states() noexcept;
    void plan_effect(brume::PlannedEffect &planned, const brume_plugin_scene &scene, bool attenuated);
    void take_offers(brume::PlannedEffect &planned, brume_plugin_request request);
    int64_t run_effects(const brume_frame &frame, const brume_plugin_scene &scene);
    void begin_extras(const brume_frame &frame, std::vector<std::shared_ptr<brume::Image>> &extras, brume_plugin_frame &seen);
    bool lights_scatter() const;
    int64_t copy_frame(const brume_frame &frame);
    void check_frame(const brume_frame &frame) const;
    int entry_index(const char *name) const;
    double share_before(int entry) const;  // of the frame's predicted time
    [[noreturn]] void effect_failed(const brume::Effect &effect, const char *callback, brume_status status) const;

    std::shared_ptr<brume::Context> context_;
    brume::Scene scene_;
    brume_format format_;
    std::vector<brume::PlannedEffect> effects_;
    std::vector<brume::PlanEntry> entries_;
    std::vector<std::shared_ptr<brume::Image>> images_;
    std::vector<std::shared_ptr<brume::Program>> programs_;
    std::shared_ptr<brume::Image> between_[2];  // what one effect hands to the next
    std::unique_ptr<brume::FrameTimer> timer_;
    uint32_t camera_needs_ = 0;
    std::string camera_reason_;
    uint64_t image_bytes_ = 0;
    std::vector<brume_plugin_light> lights_;  // of the current frame
    std::vector<brume_plugin_gaussian> gaussians_;
    std::vector<std::array<float, 3>> environment_;
    double content_frame_ = 0;  // that of `revision_`
    uint64_t revision_ = 0;
    brume::SceneImages scene_images_;
    std::map<std::pair<const brume::PlannedEffect *, uint32_t>, Data> data_;  // by effect (the host: null) and slot
    std::vector<brume_plugin_image> light_airlight_;
    const brume::PlannedEffect *current_ = nullptr;  // whose callback is running; null: the host's own passes
    const brume_plugin_scene *current_scene_ = nullptr;
    std::string failure_;
    bool warned_ = false;
    const bool rehearsal_;
    int64_t clamped_values_ = brume::not_counted;
};
