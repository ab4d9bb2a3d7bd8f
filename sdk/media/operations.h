#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string_view>
#include <variant>
#include <vector>

#include <glm/glm.hpp>

#include "media/state.h"
#include "media/view.h"
#include "base/scene_ranges.h"

// The operations as values. fields() lists an operation's parameters with their ranges once, for the journal and for checks;
// apply() is a function of the state and these parameters only, or a replay would not give the same.
namespace brume::media {

using glm::dvec3;

namespace limits {

inline constexpr Range jitter{0.0, 1000.0};  // [radii]
inline constexpr Range rate{0.0, 1e9};       // [1/s]
inline constexpr Range time{0.0, 1e6};       // [s]
inline constexpr Range drag{0.0, 30.0};      // [1/s]

}  // namespace limits

struct Put {
    static constexpr const char *name = "put";
    std::vector<Gaussian> gaussians;

    template <class Self, class Fields> static void fields(Self &self, Fields &f) { f("gaussians", self.gaussians); }
    void apply(State &state) const;
};

struct Paint {
    static constexpr const char *name = "paint";
    uint32_t seed = 0;
    std::vector<dvec3> points;
    dvec3 normal{0.0};  // of the plane painted on: the plane of a single point's jitter is perpendicular to it
    double scale = 1, amplitude = 1;
    dvec3 color{1.0};
    double spacing = 0, jitter = 1;

    template <class Self, class Fields> static void fields(Self &self, Fields &f)
    {
        f("seed", self.seed);
        f("points", self.points, ranges::any);
        f("normal", self.normal, ranges::any);
        f("scale", self.scale, ranges::positive);
        f("amplitude", self.amplitude, ranges::not_negative);
        f("color", self.color, ranges::fraction);
        f("spacing", self.spacing, ranges::not_negative);
        f("jitter", self.jitter, limits::jitter);
    }
    void apply(State &state) const;
};

struct Erase {
    static constexpr const char *name = "erase";
    std::vector<dvec3> points;
    double radius = 1, strength = 1;

    template <class Self, class Fields> static void fields(Self &self, Fields &f)
    {
        f("points", self.points, ranges::any);
        f("radius", self.radius, ranges::positive);
        f("strength", self.strength, ranges::not_negative);
    }
    void apply(State &state) const;
};

struct Emit {
    static constexpr const char *name = "emit";
    uint32_t seed = 0;
    dvec3 position{0.0};
    double radius = 0;
    dvec3 velocity{0, 0, 1};
    double spread = 0;
    dvec3 acceleration{0.0};
    double rate = 100, duration = 1e6, lifetime = 1;
    std::array<double, 2> scale{1, 1}, amplitude{1, 0};
    dvec3 color{1.0};
    double time = 0;

    template <class Self, class Fields> static void fields(Self &self, Fields &f)
    {
        f("seed", self.seed);
        f("position", self.position, ranges::any);
        f("radius", self.radius, ranges::not_negative);
        f("velocity", self.velocity, ranges::any);
        f("spread", self.spread, ranges::not_negative);
        f("acceleration", self.acceleration, ranges::any);
        f("rate", self.rate, limits::rate);
        f("duration", self.duration, limits::time);
        f("lifetime", self.lifetime, limits::time);
        f("scale", self.scale, ranges::positive);
        f("amplitude", self.amplitude, ranges::not_negative);
        f("color", self.color, ranges::fraction);
        f("time", self.time, limits::time);
    }
    void apply(State &state) const;
};

struct Airbrush {
    static constexpr const char *name = "airbrush";
    uint32_t seed = 0;
    dvec3 position{0.0}, velocity{0.0};
    double spread = 1, drag = 1, diffusion = 0.1, rate = 100, duration = 1, scale = 1, amplitude = 1;
    dvec3 color{1.0};
    Lens lens;                              // read where there is depth
    std::shared_ptr<const DepthMap> depth;  // null: nothing is in the way

    template <class Self, class Fields> static void fields(Self &self, Fields &f)
    {
        f("seed", self.seed);
        f("position", self.position, ranges::any);
        f("velocity", self.velocity, ranges::any);
        f("spread", self.spread, ranges::not_negative);
        f("drag", self.drag, limits::drag);
        f("diffusion", self.diffusion, ranges::not_negative);
        f("rate", self.rate, limits::rate);
        f("duration", self.duration, limits::time);
        f("scale", self.scale, ranges::positive);
        f("amplitude", self.amplitude, ranges::not_negative);
        f("color", self.color, ranges::fraction);
        f("lens", self.lens);
        f("depth", self.depth);
    }
    void apply(State &state) const;
};

struct SelectRectangle {
    static constexpr const char *name = "select_rectangle";
    uint32_t mode = 0;  // BRUME_MEDIA_SELECT_...
    std::array<double, 4> rectangle{};
    Lens lens;

    template <class Self, class Fields> static void fields(Self &self, Fields &f)
    {
        f("mode", self.mode);
        f("rectangle", self.rectangle, ranges::any);
        f("lens", self.lens);
    }
    void apply(State &state) const;
};

struct SelectAll {
    static constexpr const char *name = "select_all";
    template <class Self, class Fields> static void fields(Self &, Fields &) {}
    void apply(State &state) const;
};

struct SelectNone {
    static constexpr const char *name = "select_none";
    template <class Self, class Fields> static void fields(Self &, Fields &) {}
    void apply(State &state) const;
};

struct Copy {
    static constexpr const char *name = "copy";
    template <class Self, class Fields> static void fields(Self &, Fields &) {}
    void apply(State &state) const;
};

struct Paste {
    static constexpr const char *name = "paste";
    dvec3 offset{0.0};

    template <class Self, class Fields> static void fields(Self &self, Fields &f) { f("offset", self.offset, ranges::any); }
    void apply(State &state) const;
};

struct Move {
    static constexpr const char *name = "move";
    dvec3 offset{0.0};

    template <class Self, class Fields> static void fields(Self &self, Fields &f) { f("offset", self.offset, ranges::any); }
    void apply(State &state) const;
};

struct Delete {
    static constexpr const char *name = "delete";
    template <class Self, class Fields> static void fields(Self &, Fields &) {}
    void apply(State &state) const;
};

using Operation =
    std::variant<Put, Paint, Erase, Emit, Airbrush, SelectRectangle, SelectAll, SelectNone, Copy, Paste, Move, Delete>;

// Throws Error(BRUME_ERROR_ARGUMENT) that names the parameter, its value and what was expected.
void check(const Operation &operation);

}  // namespace brume::media
