#include "sets.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

namespace fs = std::filesystem;
using namespace brume::tool;

namespace trade {
namespace {

Case load(const std::string &name, const Json &scene, const fs::path &frame, const std::string &truth, int factor)
{
    const SceneText text = scene_text(name, scene);
    Sample sample = load_sample({frame_in_name(frame), frame, {}}, {}, CameraBlock::of_scene(text.text, text.name), truth);
    return {text, factor > 1 ? reduced(sample, factor) : sample};
}

std::vector<Case> street(const Options &options, const std::string &name, const Json &scene, int factor)
{
    std::vector<Case> all;
    for (const int frame : options.quick ? std::vector{1} : std::vector{1, 11})
        all.push_back(load(name, scene, fmt::format("{}/frames/street.{:04}.exr", options.samples, frame), "", factor));
    return all;
}

Json scene_of_description(const Json &description)
{
    Json medium = description["medium"];
    medium.erase("orders");
    return {{"brume", 1},
            {"camera",
             {{"horizontal_fov", description["camera"]["horizontal_fov_degrees"]},
              {"camera_to_world", description["camera"]["camera_to_world"]}}},
            {"medium", medium},
            {"effects", {{"multiscatter", Json::object()}}}};
}

// The sample's lamps in its thin fog. Its bank of Gaussians would take the reference hours.
Json lit_street(const Options &options)
{
    Json scene = Json::parse(std::ifstream(options.samples + "/media/street_fog.json"));
    Json terms = Json::array();
    for (const Json &term : scene["medium"]["density"])
        if (term["type"] != "gaussians")
            terms.push_back(term);
    scene["medium"]["density"] = terms;
    scene["medium"].erase("noise");
    scene["effects"] = {{"airlight", Json::object()}};
    return scene;
}

std::vector<Case> random_pictures(const Options &options, int count, int width, unsigned stream,
                                  const std::function<Json(std::mt19937 &, const Sample &)> &scene)
{
    std::vector<Case> all;
    for (int i = 0; i < (options.quick ? 1 : count); ++i) {
        std::seed_seq seeds{options.seed, stream, unsigned(i)};
        std::mt19937 random(seeds);
        Sample sample = random_sample(random, options.quick ? 64 : width, options.quick ? 36 : 9 * width / 16);
        sample.name = fmt::format("random {} of stream {}, seed {}", i, stream, options.seed);
        all.push_back({scene_text(sample.name, scene(random, sample)), sample});
    }
    return all;
}

}  // namespace

SceneText scene_text(const std::string &name, const Json &scene)
{
    return {scene.dump(), name, {}};
}

Json truth_description(const Options &options, const std::string &name)
{
    return Json::parse(std::ifstream(options.shared + "/truth/" + name + ".json"));
}

Json lights_of_description(const Json &description)
{
    Json lights = Json::array();
    for (const Json &emitter : description["emitters"])
        lights.push_back({{"type", "point"},
                          {"position", emitter["position"]},
                          {"radius", emitter["radius"]},
                          {"intensity", emitter["intensity"]}});
    return lights;
}

std::vector<Case> truth_pictures(const Options &options, bool single)
{
    std::vector<Case> all;
    std::error_code error;
    std::vector<fs::path> files;
    for (const auto &entry : fs::directory_iterator(options.shared + "/truth", error))
        if (entry.path().extension() == ".json")
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const fs::path &file : files) {
        const std::string name = file.stem();
        const Json description = truth_description(options, name);
        // Lamps that are listed light surfaces and have shadows, which ask for effects beside the one that is studied.
        if (!description.contains("emitters"))
            continue;
        if (single != (description["medium"].value("orders", "") == "single"))
            continue;
        Json scene = scene_of_description(description);
        if (single) {
            scene["lights"] = lights_of_description(description);
            scene["effects"] = {{"airlight", Json::object()}};
        }
        const fs::path clear = file.parent_path() / (name.substr(0, name.rfind('_')) + "_clear.exr");
        fs::path truth = file;
        const int factor = options.quick ? single ? 8 : 4 : single ? 4 : 1;
        all.push_back(load(name, scene, clear, truth.replace_extension(".exr"), factor));
        if (options.quick && all.size() == (single ? 1 : 2))
            break;
    }
    return all;
}

std::vector<Set> all_sets(const Options &options)
{
    const auto lit = [](Air air) {
        return [air](std::mt19937 &random, const Sample &sample) { return random_lit_scene(random, sample, air); };
    };
    const Json street_scene = Json::parse(std::ifstream(options.samples + "/frames/street.json"));
    // The airlight's reference is slow where a ray meets Gaussians.
    const int usual = options.quick ? 64 : 128, small = options.quick ? 32 : 64, smallest = 32;
    std::vector<Set> sets;
    sets.push_back({"path-traced scenes", "multiscatter", usual, truth_pictures(options, false)});
    sets.push_back(
        {"demo frames", "multiscatter", usual, street(options, "street.json", street_scene, options.quick ? 4 : 1)});
    sets.push_back({"random pictures", "multiscatter", usual, random_pictures(options, 12, 160, 1, random_foggy_scene)});
    sets.push_back({"random, homogeneous and isotropic", "airlight", usual,
                    random_pictures(options, 8, 128, 2, lit(Air::kHomogeneous))});
    sets.push_back({"random, isotropic with Gaussians", "airlight", smallest,
                    random_pictures(options, 4, 96, 3, lit(Air::kGaussians))});
    sets.push_back({"random, any medium", "airlight", smallest, random_pictures(options, 4, 96, 4, lit(Air::kAny))});
    sets.push_back({"path-traced scenes, one scattering", "airlight", small, truth_pictures(options, true)});
    sets.push_back(
        {"demo frames, lamps as lights", "airlight", small, street(options, "street_fog.json", lit_street(options), 8)});
    std::erase_if(sets, [](const Set &set) { return set.pictures.empty(); });
    return sets;
}

}  // namespace trade
