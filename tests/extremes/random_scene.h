#pragma once
// Random scene files: valid structures of which some values are extreme, some out of range and some nonsense, and mutations
// of their text.
#include <random>
#include <set>
#include <string>
#include <vector>

#include <brume/brume.h>
#include <nlohmann/json.hpp>

namespace extremes {

// An effect's parameter as the library describes it.
struct ParameterKind {
    std::string effect, name;
    uint32_t type;
    double minimum, maximum;
    std::vector<std::string> choices;
};

std::vector<ParameterKind> parameters_of(brume_context context);

class RandomScenes {
public:
    RandomScenes(uint64_t seed, std::vector<ParameterKind> parameters);

    // faults: the share of values that are no good, per value.
    nlohmann::ordered_json scene(double faults);
    std::string mutated(std::string text);

    bool chance(double p) { return uniform(0, 1) < p; }
    double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); }
    size_t below(size_t n) { return std::uniform_int_distribution<size_t>(0, n - 1)(random_); }
    // 0, or of any order of magnitude between these powers of ten.
    double magnitude(double low, double high);

private:
    using Json = nlohmann::ordered_json;

    Json value(double low, double high);  // within, mostly; of any magnitude
    Json keyed(double low, double high);  // or keys of it over frames
    Json rgb(double low, double high);
    Json vector(double extent);
    Json direction();
    Json pose();
    Json medium();
    Json light();
    Json effects();
    Json nonsense();

    std::mt19937_64 random_;
    std::vector<ParameterKind> parameters_;
    double faults_ = 0;
};

}  // namespace extremes
