#pragma once
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <brume/brume.h>
#include <brume/brume_plugin.h>

#include "gaussians/gaussian.h"
#include "scene/number.h"

namespace brume {

class GaussianFrames;

using Number3 = std::array<Number, 3>;

struct DensityTerm {
    uint32_t type = BRUME_DENSITY_CONSTANT;
    Number value = 1.0;
    Number falloff = 0.0;  // [1/m]
    Number3 direction{Number(0.0), Number(1.0), Number(0.0)};
    Number3 origin{};  // scene units

    bool operator==(const DensityTerm &) const = default;
};

// A Gaussian density term of which some number may be keyed.
struct GaussianTerm {
    Number3 center{};
    Number scale = 1.0, amplitude = 1.0;
    Number3 color{Number(1.0), Number(1.0), Number(1.0)};
};

// Gaussians in bulk: from a file, one per frame if its name has a frame pattern, or from the C API. Plans share them.
struct GaussianSet {
    std::string file;  // as messages name them
    std::shared_ptr<const std::vector<Gaussian>> fixed;
    std::shared_ptr<const GaussianFrames> frames;  // instead of `fixed`: a file per frame
    Number amplitude = 1.0;                        // times each of theirs
};

// Perturbs the view ray before it meets a Gaussian (Zhou et al. 2007 sec. 5.5).
struct Noise {
    Number strength = 0.0;  // in radii of the Gaussian
    Number scale = 1.0;     // scene units
    Number3 offset{};       // scene units
    uint32_t seed = 0;

    bool operator==(const Noise &) const = default;
};

struct Medium {
    Number3 scattering{}, absorption{}, emission{};  // [1/m], [1/m], [radiance/m], at unit density
    Number g = 0.0;
    std::optional<Number> visibility;        // [m]
    std::optional<Number> droplet_diameter;  // [um]
    std::vector<DensityTerm> density;        // with neither these nor Gaussians: constant 1
    std::vector<GaussianTerm> gaussians;
    std::vector<GaussianSet> gaussian_sets;
    Noise noise;
};

// Where a light's shadow map looks.
struct LightShadow {
    uint32_t kind = BRUME_SHADOW_NONE;
    uint32_t depth = BRUME_DEPTH_PLANAR;
    Number extent = 0.0;  // as brume_light.shadow_extent
    std::array<Number, 16> to_world{};
    std::array<double, 2> range{};  // as brume_light.shadow_range
    std::string file;               // map named by the scene's text
};

struct Light {
    uint32_t type = BRUME_LIGHT_POINT;
    Number3 position{};  // scene units
    Number3 direction{Number(0.0), Number(0.0), Number(-1.0)};
    Number3 intensity{Number(1.0), Number(1.0), Number(1.0)};
    Number radius = 0.0;                // scene units
    Number angle = 0.7853981633974483;  // [rad], of the whole cone
    Number penumbra = 0.1;
    Number distance = 0.0;  // scene units
    LightShadow shadow{};
    uint32_t surfaces = BRUME_SURFACES_LIT;
    std::string group{};  // layer of the light's own share of pictures, named by the scene's text
};

// Distant light as real spherical harmonics in world axes.
struct Environment {
    std::vector<std::array<double, 3>> coefficients;
    std::string file;  // image named by the scene's text of which there are no coefficients yet
    uint32_t file_up = BRUME_UP_Y;
};

struct Camera {
    std::optional<Number> vertical_fov;    // [rad]
    std::optional<Number> horizontal_fov;  // [rad]; of the display window, used where vertical_fov is absent
    Number pixel_aspect = 1.0;
    std::array<Number, 2> center{Number(0.5), Number(0.5)};
    std::optional<std::array<Number, 16>> camera_to_world;  // row-major
};

// As brume_quality.
struct Quality {
    uint32_t preset = BRUME_PRESET_NONE;
    double max_error = 0, budget_ms = 0, transmittance = 0, detail = 0;

    bool operator==(const Quality &) const = default;
    bool asked() const { return preset != BRUME_PRESET_NONE || max_error > 0 || budget_ms > 0; }
};

struct EffectSettings {
    std::string name;
    std::map<std::string, double> parameters;  // only those set; choices by index
};

// What frames may show otherwise than a plan was made for.
struct SceneValues {
    double metres_per_unit = 1.0;
    std::array<double, 3> luminance{0.2126, 0.7152, 0.0722};
    std::optional<Medium> medium;
    Camera camera;
    std::vector<Light> lights;
    Environment environment;

    bool animated() const;
};

struct Scene : SceneValues {
    std::vector<EffectSettings> effects;  // those that the file or a call set
    Quality quality;
    bool effects_named = false;  // the file names its effects: what the content needs is not added to them
};

// From BRUME_PRESET_DRAFT on.
inline constexpr const char *preset_names[] = {"draft", "standard", "final", "reference"};

class EffectRegistry;

// Parses scene-file text; throws Error(BRUME_ERROR_SCENE) as "name:line:column: ...". `name` is the file's.
Scene parse_scene(const std::string &text, const std::string &name, const EffectRegistry &effects);

// JSON Schema of scene files with the parameters of these effects.
std::string scene_schema(const EffectRegistry &effects);

// Whether some density term depends on the position.
bool pose_matters(const Scene &scene);

// Whether some Gaussian has density in some frame. Files that are read at each frame count as if they had.
bool has_gaussians(const Scene &scene);

// Whether some are known only with the frame.
bool reads_gaussians_by_frame(const Scene &scene);

// Whether effects that dropped what they have to do with one scene have no reason to do it with the other, of the same
// structure: what they may go by (brume_effect.plan) is the same.
bool drops_alike(const SceneValues &a, const SceneValues &b);
// A scene of these values with which effects drop the same: with one of its Gaussians and one of each kind of its lights.
Scene least_to_drop_alike(const Scene &scene);

// The medium with the largest value that each of its keyed quantities takes: what is zero there is zero in every frame.
Scene with_peak_medium(Scene scene);

// Scene values at one frame, camera-relative, as effects see them. Throw Error(BRUME_ERROR_ARGUMENT) where values
// contradict each other.
void evaluate_medium(const Scene &scene, double frame, const std::array<double, 16> &camera_to_world,
                     brume_plugin_medium &out);

// Gaussians without density are left out.
void evaluate_lights(const Scene &scene, double frame, const std::array<double, 16> &camera_to_world,
                     std::vector<brume_plugin_light> &out);
void evaluate_gaussians(const Scene &scene, double frame, const std::array<double, 16> &camera_to_world,
                        std::vector<brume_plugin_gaussian> &out);

}  // namespace brume
