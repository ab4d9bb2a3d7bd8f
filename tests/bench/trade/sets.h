#pragma once
// What the study measures: sets of pictures that one effect is judged by.
#include <functional>
#include <random>

#include <nlohmann/json.hpp>

#include "bench/sample.hpp"
#include "run/scene.hpp"

namespace trade {

using Json = nlohmann::json;

struct Case {
    brume::tool::SceneText scene;
    brume::tool::Sample sample;
};

struct Set {
    std::string name, effect;
    int reference_width = 0;  // at most; the same on every machine, so that errors can be compared
    std::vector<Case> pictures;
};

struct Options {
    bool quick = false;
    unsigned seed = 1;
    std::string shared;   // folder with truth/; may not exist
    std::string samples;  // the project's samples
};

brume::tool::SceneText scene_text(const std::string &name, const Json &scene);

// Path-traced scenes: with `single`, those in which light scatters at most once, lit by the spheres that they have.
std::vector<Case> truth_pictures(const Options &options, bool single);
// What stands beside a path-traced scene, by the name of its scene text.
Json truth_description(const Options &options, const std::string &name);
Json lights_of_description(const Json &description);

std::vector<Set> all_sets(const Options &options);

// Random slabs, planes or balls with lamps between them.
brume::tool::Sample random_sample(std::mt19937 &random, int width, int height);
// Fog for them, of an optical depth of .2 to 5 to the middle distance.
Json random_foggy_scene(std::mt19937 &random, const brume::tool::Sample &sample);

enum class Air { kHomogeneous, kGaussians, kAny };
// Lights in a medium that tier sun knows, that fogshop knows, or that neither does.
Json random_lit_scene(std::mt19937 &random, const brume::tool::Sample &sample, Air air);

}  // namespace trade
