#include <fmt/format.h>

#include "base/error.h"
#include "gaussians/gaussian_file.h"
#include "gaussians/gaussian_frames.h"
#include "scene_file/scene_file.h"

namespace brume {
namespace {

GaussianSet read_gaussian_set(const JsonNode &node, const std::filesystem::path &folder)
{
    GaussianSet set;
    read_fields<GaussianSet>(node, folder, gaussian_set_fields, ~0u, set, [&](std::string_view key, const JsonNode &file) {
        if (key != "file")
            return;
        const std::string &name = file.string("the name of a CSV or PLY file");
        if (name.empty())
            file.expected("the name of a CSV or PLY file");
        set.file = (folder / name).string();
        try {
            if (GaussianFrames::has_frame_number(set.file))
                set.frames = std::make_shared<const GaussianFrames>(set.file);
            else
                set.fixed = std::make_shared<const std::vector<Gaussian>>(read_gaussians(set.file));
        } catch (const Error &error) {
            file.fail(error.what());
        }
    });
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
        if (name == "constant" || name == "exponential") {
            DensityTerm &to = medium.density.emplace_back();
            to.type = name == "constant" ? BRUME_DENSITY_CONSTANT : BRUME_DENSITY_EXPONENTIAL;
            read_fields<DensityTerm>(term, folder, density_fields, 1u << to.type, to, nothing_more);
        } else if (name == "gaussian")
            read_fields<GaussianTerm>(term, folder, gaussian_fields, ~0u, medium.gaussians.emplace_back(), nothing_more);
        else if (name == "gaussians")
            medium.gaussian_sets.push_back(read_gaussian_set(term, folder));
        else
            type.expected(what);
        if (name == "exponential" && ++exponential > BRUME_MAX_DENSITY_TERMS)
            term.fail(fmt::format("exponential term {}; expected at most {}", exponential, BRUME_MAX_DENSITY_TERMS));
    }
}

}  // namespace

Medium read_medium(const JsonNode &node, const std::filesystem::path &folder)
{
    Medium medium;
    read_fields<Medium>(node, folder, medium_fields, ~0u, medium, [&](std::string_view key, const JsonNode &value) {
        if (key == "density")
            read_density(value, folder, medium);
        else
            read_fields<Noise>(value, folder, noise_fields, ~0u, medium.noise, nothing_more);
    });
    return medium;
}

}  // namespace brume
