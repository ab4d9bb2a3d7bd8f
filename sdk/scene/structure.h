#pragma once
#include <array>

#include "scene/format.h"
#include "scene/scene.h"

namespace brume {

// What of a scene and a format a plan is made for and frames may not change.
class Structure {
public:
    Structure() = default;
    Structure(const Scene &scene, const Format &format);

    // "medium.absorption[1]: was 0, is 0.1" of the first difference; empty where there is none.
    std::string difference(const Structure &other) const;

private:
    static constexpr int most = 32;
    struct Part {
        const char *name;
        double value;
    };

    void add(const char *name, double value) { parts_[size_t(count_++)] = {name, value}; }

    std::array<Part, most> parts_{};
    int count_ = 0;
};

}  // namespace brume
