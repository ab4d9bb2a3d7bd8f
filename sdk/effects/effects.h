#pragma once
#include <memory>
#include <string>
#include <vector>

#include <brume/brume_plugin.h>

#include "base/log.h"

namespace brume {

// One parameter of an effect's table, checked and copied so that a plugin's memory cannot surprise us.
struct Parameter {
    std::string name, alias, unit, help;
    uint32_t type = BRUME_PARAMETER_NUMBER;
    double minimum = 0, maximum = 0, default_value = 0;
    std::string choices_text;
    std::vector<std::string> choices;
};

// A layer of an effect's table, likewise.
struct Layer {
    std::string name, help;
    uint32_t flags = 0;  // BRUME_LAYER_...
    uint32_t channels = 3;
};

// A plugin that was taken, or (refusal not empty) why it was not.
struct Effect {
    std::string name, help, file, refusal;
    int32_t order = 0;
    uint32_t wanted = BRUME_WANTED_NEVER;
    std::vector<Parameter> parameters;
    std::vector<Layer> layers;
    std::vector<std::string> makes, uses;  // products
    std::vector<std::string> scenes;       // texts, to calibrate with
    const brume_effect *table = nullptr;
    decltype(brume_effect::offer) offer = nullptr;  // null in tables that are too short for it, as the next
    decltype(brume_effect::makes_with) makes_with = nullptr;
    decltype(brume_effect::settle) settle = nullptr;
    decltype(brume_effect::uses_with) uses_with = nullptr;
    std::shared_ptr<void> library;  // keeps the code loaded
};

// The effects of a context.
class EffectRegistry {
public:
    // Loads every plugin of these directories, in order of their file names; of two with one name the first is taken.
    void load(const std::vector<std::string> &directories, const Log &log);

    const std::vector<Effect> &all() const { return effects_; }
    // Throws Error(BRUME_ERROR_NOT_FOUND) naming the nearest effect, or the refusal of the plugin of that name.
    const Effect &find(const std::string &name) const;
    // Throws Error(BRUME_ERROR_NOT_FOUND) with the directories searched and every refusal, if none is wanted so
    // (BRUME_WANTED_...). part: of the scene, which wants it; renders: what it would.
    void expect_one(uint32_t wanted, const char *part, const char *renders) const;

private:
    std::vector<Effect> effects_;
    std::vector<std::string> directories_;
};

// Index of the parameter of that name or alias; throws Error(BRUME_ERROR_NOT_FOUND) naming the nearest.
size_t find_parameter(const Effect &effect, const std::string &name);

// A parameter's value from text or a number, checked against type and range; throws Error(BRUME_ERROR_ARGUMENT) with
// "effect.parameter: value; expected ...".
double parameter_from_text(const Effect &effect, const Parameter &parameter, const std::string &text);
double parameter_from_number(const Effect &effect, const Parameter &parameter, double value);

}  // namespace brume
