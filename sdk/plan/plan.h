#pragma once
#include <memory>
#include <string>
#include <vector>

#include "scene/content.h"
#include "plan/context.h"
#include "scene/format.h"
#include "plan/host_products.h"
#include "plan/layers.h"
#include "plan/plan_resources.h"
#include "effects/offer.h"
#include "plan/products.h"
#include "scene/scene.h"
#include "scene/structure.h"

namespace brume {

// One effect's part of a plan.
struct PlannedEffect {
    const Effect *effect = nullptr;
    bool named = false;                // by the scene
    std::vector<double> parameters{};  // as asked
    std::vector<double> settled{};     // with what the scene decides
    void *state = nullptr;
    bool runs = false;
    std::vector<Offer> offers{};

    // Of its table's layers, their places among the format's; of its `uses`, the products.
    std::vector<int> layer_places{};
    std::vector<const Products::Product *> uses{};
    // As they are in the frame at hand.
    std::vector<brume_plugin_layer> layers{};
    std::vector<brume_plugin_product> products{};
};

}  // namespace brume

// What must be done for one scene and one image format. It is also the host that effects talk to: planning, services and
// frames work on the same effects, entries and products, and a class for each would hand all of these around.
struct brume_host_t {
public:
    brume_host_t(std::shared_ptr<brume::Context> context, brume::Scene scene, const brume::Format &format,
                 brume::Purpose purpose = brume::Purpose::execution);
    ~brume_host_t();
    brume_host_t(const brume_host_t &) = delete;
    brume_host_t &operator=(const brume_host_t &) = delete;

    // Another scene of the same structure from the next frame on; throws Error(BRUME_ERROR_FORMAT) where it has another.
    void update(const brume::Scene &scene, const brume::Format *format);
    // The effects as the scene had them before some were set for the quality that it asks.
    void set_given_effects(std::vector<brume::EffectSettings> effects) { given_effects_ = std::move(effects); }
    void execute(const brume_frame &frame);

    const std::vector<brume::PlanEntry> &entries() const { return entries_; }
    const std::vector<brume::PlannedEffect> &effects() const { return effects_; }
    // By the offers that the parameters are; < 0 where an effect's are none.
    double predicted_error() const;
    bool does_nothing() const { return running_.empty(); }
    uint32_t camera_needs() const { return camera_needs_; }
    const std::string &camera_reason() const { return camera_reason_; }
    // In a rehearsal, what the plan's would be.
    const brume::ImageMemory &image_memory() const { return resources_.memory(); }
    // Those, and since the first frame what it uploads and what callers' images are converted to.
    uint64_t image_bytes() const { return resources_.bytes() + frame_bytes_; }
    // Of the last frame's half outputs; not_counted before one.
    int64_t clamped_values() const { return clamped_values_; }
    // Of the last frame per entry; empty before one.
    std::vector<double> measured_ms();

    // The services of brume_plugin.h; the names are the same there.
    brume_status fail(brume_status status, const char *message);
    void add_entry(const brume_plugin_entry &entry);
    double nanoseconds(const brume_plugin_entry &entry) const;
    void need_camera(uint32_t needs, const std::string &reason);
    brume_plugin_image create_image(const char *label, int32_t width, int32_t height, int32_t channels)
    {
        return resources_.create_image(label, width, height, channels);
    }
    void drop_image(brume_plugin_image image) { resources_.drop_image(image); }
    int32_t largest_size() const { return context_->backend->largest_size(); }
    uint32_t backend_kind() const { return context_->backend->kind(); }
    brume_pass create_pass(const brume_pass_desc &desc) { return resources_.create_pass(desc, caller()); }
    uint32_t made(std::string_view product) const;
    brume_status run(brume_pass pass, const brume_plugin_image *images, const void *constants, int32_t width, int32_t height,
                     void *user);
    brume_plugin_image upload(uint32_t slot, int32_t channels, const float *values, uint64_t texels)
    {
        return resources_.upload(caller(), slot, channels, values, texels);
    }
    void publish(const char *product, const brume_plugin_image *images, uint32_t image_count, uint32_t count,
                 uint64_t revision);

    // Logged as a warning where the device is Mesa's software GL, once per plan.
    void warn_on_software_gl(const std::string &message);

private:
    std::string wakes(const brume::Scene &scene, const brume::Format &format) const;
    void take(const brume::SceneValues &values);
    void expect_shadow_maps() const;
    void choose_effects();
    void order_effects();
    void set_parameters();
    void plan_effects();
    brume_plugin_request request_of(const brume::PlannedEffect &planned, const std::vector<uint32_t> &layers,
                                    const brume_plugin_scene &scene) const;
    template <class Callback> void call(brume::PlannedEffect &planned, const char *name, const Callback &callback);
    void settle(brume::PlannedEffect &planned, const brume_plugin_scene &scene);
    bool lacks_layer(brume::PlannedEffect &planned);
    void plan_effect(brume::PlannedEffect &planned, const brume_plugin_scene &scene);
    void take_offers(brume::PlannedEffect &planned, brume_plugin_request request);
    void plan_host_products(const brume_plugin_scene &scene);
    void check_outputs() const;
    void release() noexcept;
    void destroy_states() noexcept;
    const brume::Effect *caller() const { return current_ ? current_->effect : nullptr; }
    double share_before(int entry) const;  // of the frame's predicted time
    bool is_made_by(const brume::PlannedEffect &planned, std::string_view product) const;
    bool uses_product(const brume::PlannedEffect &planned, std::string_view product) const;

    int64_t run_effects(const brume_frame &frame);
    void run_effect(brume::PlannedEffect &planned, brume_plugin_frame &seen);
    int64_t copy_frame(const brume_frame &frame);
    void check_frame(const brume_frame &frame) const;
    [[noreturn]] void effect_failed(const brume::Effect &effect, const char *callback, brume_status status) const;

    std::shared_ptr<brume::Context> context_;
    brume::Scene scene_;
    brume::SceneValues spare_;                          // whose memory the next update takes
    std::vector<brume::EffectSettings> given_effects_;  // without what was chosen for the quality asked
    brume::Format format_;
    brume::Structure structure_;
    std::vector<brume::PlannedEffect> effects_;
    std::vector<brume::PlannedEffect *> running_;
    std::vector<brume::PlanEntry> entries_;
    brume::PlanResources resources_;
    brume_plugin_image between_[2] = {};  // what one effect hands to the next
    std::unique_ptr<brume::FrameTimer> timer_;
    uint32_t camera_needs_ = 0;
    std::string camera_reason_;
    uint64_t frame_bytes_ = 0;
    brume::Content content_;
    brume::FrameLayers layers_;
    brume::Products products_;
    brume::HostProducts host_products_;
    bool settling_ = false;                          // what the scene decides of the effects' parameters
    const brume::PlannedEffect *current_ = nullptr;  // whose callback is running; null: the host's own passes
    std::string failure_;
    bool warned_ = false;
    const bool waking_;
    int64_t clamped_values_ = brume::not_counted;
};
