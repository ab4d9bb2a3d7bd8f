#include <fmt/format.h>

#include "base/error.h"
#include "gaussians/gaussian_file.h"
#include "gaussians/gaussian_frames.h"
#include "scene_file/scene_file.h"
#include "scene/scene_numbers.h"

namespace brume {
namespace {

DensityTerm read_constant_term(const JsonNode &node)
{
    node.allow_only({"type", "value"});
    DensityTerm term;
    if (const auto value = node.find("value"))
        term.value = read_number(*value, ranges::not_negative);
    return term;
}

DensityTerm read_exponential_term(const JsonNode &node)
{
    node.allow_only({"type", "value", "falloff", "direction", "origin"});
    DensityTerm term;
    term.type = BRUME_DENSITY_EXPONENTIAL;
    if (const auto value = node.find("value"))
        term.value = read_number(*value, ranges::not_negative);
    if (const auto falloff = node.find("falloff"))
        term.falloff = read_number(*falloff, ranges::not_negative);
    if (const auto direction = node.find("direction"))
        term.direction = read_direction(*direction);
    if (const auto origin = node.find("origin"))
        term.origin = read_vector(*origin, ranges::any);
    return term;
}

GaussianTerm read_gaussian(const JsonNode &node)
{
    node.allow_only({"type", "center", "scale", "amplitude", "colour"});
    GaussianTerm term;
    term.center = read_vector(node.get("center"), ranges::any);
    term.scale = read_number(node.get("scale"), ranges::positive);
    if (const auto amplitude = node.find("amplitude"))
        term.amplitude = read_number(*amplitude, ranges::not_negative);
    if (const auto colour = node.find("colour"))
        term.color = read_rgb(*colour, ranges::fraction);
    return term;
}

GaussianSet read_gaussian_set(const JsonNode &node, const std::filesystem::path &folder)
{
    node.allow_only({"type", "file", "amplitude"});
    const JsonNode file = node.get("file");
    GaussianSet set;
    set.file = (folder / file.string("the name of a CSV or PLY file")).string();
    if (const auto amplitude = node.find("amplitude"))
        set.amplitude = read_number(*amplitude, ranges::not_negative);
    try {
        if (GaussianFrames::has_frame_number(set.file))
            set.frames = std::make_shared<const GaussianFrames>(set.file);
        else
            set.fixed = std::make_shared<const std::vector<Gaussian>>(read_gaussians(set.file));
    } catch (const Error &error) {
        file.fail(error.what());
    }
    return set;
}

void read_density(const JsonNode &node, const std::filesystem::path &folder, Medium &medium)
{
    const size_t count = node.array_size("an array of density terms");
    uint32_t exponential = 0;
    for (size_t i = 0; i < count; ++i) {
        const JsonNode term = node.item(i);
        const JsonNode type = term.get("type");
        const std::string what = "\"constant\", \"exponential\", \"gaussian\" or \"gaussians\"";
        const std::string &name = type.string(what);
        if (name == "constant")
            medium.density.push_back(read_constant_term(term));
        else if (name == "exponential")
            medium.density.push_back(read_exponential_term(term));
        else if (name == "gaussian")
            medium.gaussians.push_back(read_gaussian(term));
        else if (name == "gaussians")
            medium.gaussian_sets.push_back(read_gaussian_set(term, folder));
        else
            type.expected(what);
        if (name == "exponential" && ++exponential > BRUME_MAX_DENSITY_TERMS)
            term.fail(fmt::format("exponential term {}; expected at most {}", exponential, BRUME_MAX_DENSITY_TERMS));
    }
}

Noise read_noise(const JsonNode &node)
{
    node.allow_only({"strength", "scale", "offset", "seed"});
    Noise noise;
    noise.strength = read_number(node.get("strength"), ranges::noise_strength);
    if (const auto scale = node.find("scale"))
        noise.scale = read_number(*scale, ranges::noise_scale);
    if (const auto offset = node.find("offset"))
        noise.offset = read_vector(*offset, ranges::any);
    if (const auto seed = node.find("seed")) {
        const double value = read_constant(*seed, ranges::noise_seed);
        if (value != std::floor(value))
            seed->expected("a whole " + ranges::noise_seed.describe());
        noise.seed = uint32_t(value);
    }
    return noise;
}

}  // namespace

Medium read_medium(const JsonNode &node, const std::filesystem::path &folder)
{
    node.allow_only({"scattering", "absorption", "emission", "g", "visibility", "droplet_diameter", "density", "noise"});
    node.refuse_both("scattering", "visibility");
    node.refuse_both("g", "droplet_diameter");
    Medium medium;
    if (const auto scattering = node.find("scattering"))
        medium.scattering = read_rgb(*scattering, ranges::not_negative);
    if (const auto absorption = node.find("absorption"))
        medium.absorption = read_rgb(*absorption, ranges::not_negative);
    if (const auto emission = node.find("emission"))
        medium.emission = read_rgb(*emission, ranges::not_negative);
    if (const auto g = node.find("g"))
        medium.g = read_number(*g, ranges::asymmetry);
    if (const auto visibility = node.find("visibility"))
        medium.visibility = read_number(*visibility, ranges::positive);
    if (const auto diameter = node.find("droplet_diameter"))
        medium.droplet_diameter = read_number(*diameter, ranges::droplet_diameter);
    if (const auto density = node.find("density"))
        read_density(*density, folder, medium);
    if (const auto noise = node.find("noise"))
        medium.noise = read_noise(*noise);
    return medium;
}

}  // namespace brume
