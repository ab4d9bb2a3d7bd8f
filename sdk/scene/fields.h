#pragma once
// The fields of a scene, each once. Their parser and schema, the checks of what C brings and what counts as animated follow
// from these tables; defaults are those of the structs.
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <type_traits>
#include <variant>

#include "base/scene_ranges.h"
#include "scene/scene.h"

namespace brume {

inline constexpr double degree = 0.017453292519943295;

using Matrix = std::array<Number, 16>;

// What a field is beside its type: a bit for each kind of struct that has it, all where there is none, and these.
inline constexpr uint32_t kinds = 0xff, all_kinds = kinds, needed = 0x100;
inline constexpr uint32_t degrees = 0x200, color = 0x400, direction = 0x800;  // how files write it

template <class T> struct Field {
    const char *key;
    const char *help = "";
    // Nothing: the parser and the schema have code of their own for it. Text: the name of an image.
    std::variant<std::monostate, bool T::*, double T::*, uint32_t T::*, std::string T::*, Number T::*,
                 std::optional<Number> T::*, std::array<Number, 2> T::*, Number3 T::*, Matrix T::*,
                 std::optional<Matrix> T::*>
        member{};
    Range range{};  // as files have it
    uint32_t traits = 0;
    const char *instead_of = nullptr;  // the other way to say the same

    constexpr bool is(uint32_t these) const { return !(traits & kinds) || traits & these & kinds; }
    constexpr bool has(uint32_t trait) const { return traits & trait; }
};

template <class T> using Fields = std::type_identity_t<std::span<const Field<T>>>;

template <class T, class Visit> struct NumberVisitor {
    const T &value;
    const Field<T> &field;
    Visit &visit;

    template <class Member> void operator()(Member member) const
    {
        if constexpr (!std::is_same_v<Member, std::monostate>)
            each(value.*member);
    }

    void each(const Number &number) const { visit(field, number, -1); }
    void each(const std::string &) const {}
    template <size_t N> void each(const std::array<Number, N> &numbers) const
    {
        for (size_t i = 0; i < N; ++i)
            visit(field, numbers[i], int(i));
    }
    template <class Value> void each(const std::optional<Value> &given) const
    {
        if (given)
            each(*given);
    }
};

// Each number that a value of this kind has: visit(field, number, index in the member or -1).
template <class T, class Visit> void each_number(const T &value, Fields<T> fields, uint32_t kind, Visit visit)
{
    for (const Field<T> &field : fields)
        if (field.is(kind))
            std::visit(NumberVisitor<T, Visit>{value, field, visit}, field.member);
}

inline constexpr Field<Camera> camera_fields[] = {
    {"vertical_fov", "Of the display window's height [degrees]", &Camera::vertical_fov, ranges::field_of_view, degrees},
    {"horizontal_fov", "Of the display window's width [degrees]", &Camera::horizontal_fov, ranges::field_of_view, degrees,
     "vertical_fov"},
    {"camera_to_world", "Row-major, applied to column points; rigid; looks down -z, +y up", &Camera::camera_to_world},
    {"pixel_aspect", "Width of a pixel over its height", &Camera::pixel_aspect, ranges::pixel_aspect},
    {"center", "Principal point as a fraction of the display window, from its left and its top", &Camera::center,
     ranges::center},
};

inline constexpr Field<Noise> noise_fields[] = {
    {"strength", "In radii of each Gaussian", &Noise::strength, ranges::noise_strength, needed},
    {"scale", "Scene units", &Noise::scale, ranges::noise_scale},
    {"offset", "Scene units; keys animate it", &Noise::offset},
    {"seed", "", &Noise::seed, ranges::noise_seed},
};

inline constexpr Field<Medium> medium_fields[] = {
    {"scattering", "At unit density [1/m]", &Medium::scattering, ranges::not_negative, color},
    {"absorption", "At unit density [1/m]", &Medium::absorption, ranges::not_negative, color},
    {"emission", "Radiance per metre at unit density", &Medium::emission, ranges::not_negative, color},
    {"g", "Mean cosine of the phase function", &Medium::g, ranges::asymmetry},
    {"visibility", "[m]; instead of scattering: 3.912 / visibility - absorption", &Medium::visibility, ranges::positive, 0,
     "scattering"},
    {"droplet_diameter", "[um]; instead of g", &Medium::droplet_diameter, ranges::droplet_diameter, 0, "g"},
    {"density"},
    {"noise", "Shifts the view ray before it meets a Gaussian"},
};

inline constexpr uint32_t constant_term = 1u << BRUME_DENSITY_CONSTANT, exponential_term = 1u << BRUME_DENSITY_EXPONENTIAL;
inline constexpr Field<DensityTerm> density_fields[] = {
    {"type", "", {}, {}, needed},
    {"value", "Ratio to unit density", &DensityTerm::value, ranges::not_negative},
    {"falloff", "[1/m]", &DensityTerm::falloff, ranges::not_negative, exponential_term},
    {"direction", "The density falls along it", &DensityTerm::direction, {}, direction | exponential_term},
    {"origin", "Where the density has its value; scene units", &DensityTerm::origin, {}, exponential_term},
};

inline constexpr Field<GaussianTerm> gaussian_fields[] = {
    {"type", "", {}, {}, needed},
    {"center", "Scene units", &GaussianTerm::center, {}, needed},
    {"scale", "a of exp(-a^2 |x - center|^2) [1/scene unit]", &GaussianTerm::scale, ranges::positive, needed},
    {"amplitude", "Ratio to unit density", &GaussianTerm::amplitude, ranges::not_negative},
    {"colour", "Share of what it would scatter that is not absorbed", &GaussianTerm::color, ranges::fraction, color},
};

inline constexpr Field<GaussianSet> gaussian_set_fields[] = {
    {"type", "", {}, {}, needed},
    {"file", "CSV or PLY, relative to the scene file; one per frame with %04d or #### in its name", {}, {}, needed},
    {"amplitude", "Times each of theirs", &GaussianSet::amplitude, ranges::not_negative},
};

inline constexpr const char *light_names[] = {"point", "spot", "directional"};
inline constexpr uint32_t point_light = 1u << BRUME_LIGHT_POINT, spot_light = 1u << BRUME_LIGHT_SPOT,
                          directional_light = 1u << BRUME_LIGHT_DIRECTIONAL, placed_light = point_light | spot_light;
inline constexpr Field<Light> light_fields[] = {
    {"type", "", {}, {}, needed},
    {"intensity", "[radiance m^2]: pi r^2 times the radiance of a sphere of radius r", &Light::intensity,
     ranges::not_negative, color | needed | placed_light},
    {"intensity", "Irradiance on a surface that faces it", &Light::intensity, ranges::not_negative,
     color | needed | directional_light},
    {"position", "Scene units", &Light::position, {}, needed | placed_light},
    {"radius", "Scene units", &Light::radius, ranges::not_negative, placed_light},
    {"direction", "Where it shines to", &Light::direction, {}, direction | needed | spot_light | directional_light},
    {"angle", "Of the whole cone [degrees]", &Light::angle, ranges::spot_degrees, degrees | spot_light},
    {"penumbra", "Share of the half angle over which it falls off to nothing", &Light::penumbra, ranges::fraction,
     spot_light},
    {"distance", "That its light has come through the constant density; scene units", &Light::distance, ranges::not_negative,
     directional_light},
    {"shadow"},
    {"surfaces", "false: nothing of what surfaces show is this light's; true by default"},
    {"group", "Layer that has this light's share of the picture, as renderers' light groups do"},
};

// A light's shadow map as files tell it: LightShadow's range is made of the rest.
struct ShadowText : LightShadow {
    double near = 0.0, far = std::numeric_limits<double>::infinity();
    bool reversed = false;
};

inline constexpr uint32_t flat_map = 1, flat_buffer = 2, parallel_map = 4, parallel_buffer = 8, latlong_map = 16,
                          device_kinds = flat_buffer | parallel_buffer;
inline constexpr Field<ShadowText> shadow_fields[] = {
    {"file",
     "Depth picture, relative to the scene file; one per frame with %04d or #### in its name",
     &ShadowText::file,
     {},
     needed},
    {"camera_to_world",
     "Of the camera that took it; row-major; rigid; looks down -z, +y up",
     &ShadowText::to_world,
     {},
     needed},
    {"projection", "", {}, {}, flat_map | flat_buffer | parallel_map | parallel_buffer},
    {"projection", "", {}, {}, needed | latlong_map},
    {"depth", "planar by default; in scene units", {}, {}, flat_map | parallel_map},
    {"depth", "", {}, {}, latlong_map},
    {"depth", "A depth buffer of 0 to 1", {}, {}, needed | device_kinds},
    {"near", "Where it is 0; scene units", &ShadowText::near, ranges::positive, needed | flat_buffer},
    {"near", "Where it is 0; scene units", &ShadowText::near, {}, needed | parallel_buffer},
    {"far", "Where it is 1; scene units; infinite by default", &ShadowText::far, ranges::positive, flat_buffer},
    {"far", "Where it is 1; scene units", &ShadowText::far, {}, needed | parallel_buffer},
    {"reversed", "It is 1 at near and 0 at far", &ShadowText::reversed, {}, device_kinds},
    {"vertical_fov", "Of the map's height [degrees]", &ShadowText::extent, ranges::field_of_view,
     degrees | needed | flat_map | flat_buffer},
    {"orthographic_width", "Of the map; scene units", &ShadowText::extent, ranges::positive,
     needed | parallel_map | parallel_buffer},
};

inline constexpr uint32_t coefficients_kind = 1, picture_kind = 2;
inline constexpr Field<Environment> environment_fields[] = {
    {"sh", "RGB of real spherical harmonics in world axes: l = 0, 1, ..., m = -l to l", {}, {}, needed | coefficients_kind},
    {"file", "Lat-long image, relative to the scene file", &Environment::file, {}, needed | picture_kind, "sh"},
    {"up", "World axis of the image's top; y by default", {}, {}, picture_kind},
};

inline constexpr uint32_t preset_kind = 1, error_kind = 2, budget_kind = 4;
inline constexpr Field<Quality> quality_fields[] = {
    {"preset", "", {}, {}, needed | preset_kind},
    {"max_error", "Root of relMSE against the references", &Quality::max_error, ranges::max_error, needed | error_kind,
     "preset"},
    {"budget_ms", "Milliseconds a frame", &Quality::budget_ms, ranges::budget_ms, needed | budget_kind, "preset"},
    {"transmittance", "Mean of what frames show; 0: taken for dense", &Quality::transmittance, ranges::fraction},
    {"detail", "Of frames against themselves blurred 9 x 9; 0: taken for 5", &Quality::detail, ranges::detail},
};

}  // namespace brume
