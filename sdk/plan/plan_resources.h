#pragma once
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "effects/effects.h"
#include "plan/backend.h"
#include "plan/plan_memory.h"

namespace brume {

inline const std::string host_name = "brume";  // of the host's own entries

struct PlanEntry {
    bool runs = false;
    std::string effect, name, reason;
    uint64_t bytes = 0;
    uint64_t operations = 0;
    double predicted_ms = 0;
};

// Rehearsals are planned for their entries and offers: they hold no images or passes and cannot be executed. Waking: for
// whether each effect runs alone.
enum class Purpose { execution, rehearsal, waking };

// What a plan holds of its backend: images, passes, and data that effects upload.
class PlanResources {
public:
    PlanResources(Backend &backend, Purpose purpose) : backend_(backend), rehearsal_(purpose != Purpose::execution) {}

    // As the services of brume_plugin.h; owner: the effect that asks, null: the host.
    brume_plugin_image create_image(const char *label, int32_t width, int32_t height, int32_t channels);
    void drop_image(brume_plugin_image image);
    brume_pass create_pass(const brume_pass_desc &desc, const Effect *owner);
    brume_plugin_image upload(const Effect *owner, uint32_t slot, int32_t channels, const float *values, uint64_t texels);

    // Finds the entry that each pass's time counts to.
    void bind_passes(const std::vector<PlanEntry> &entries);
    void release() noexcept;

    // Of the images, in a rehearsal what they would take.
    const ImageMemory &memory() const { return memory_; }
    // With what was uploaded.
    uint64_t bytes() const { return memory_.bytes() + data_bytes_; }

private:
    // A data image and, on the CPU, the memory that it wraps.
    struct Data {
        std::vector<float> values;
        std::shared_ptr<Image> image;
    };

    Backend &backend_;
    const bool rehearsal_;
    std::vector<std::shared_ptr<Image>> images_;
    std::vector<std::shared_ptr<Pass>> passes_;
    std::vector<const Effect *> owners_;                        // of passes_
    std::map<std::pair<const Effect *, uint32_t>, Data> data_;  // by owner and slot
    ImageMemory memory_;
    uint64_t data_bytes_ = 0;
};

}  // namespace brume
