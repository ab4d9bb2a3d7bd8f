#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace brume::tool {

/// A number of the scene file that differs from sample to sample: PATH=LOW:HIGH, as PATH=xLOW:HIGH a factor to what the
/// scene has there, with :log at the end drawn evenly by its logarithm. A list is passed through whole, where the path has
/// no index.
class Variation {
public:
    /// Throws RequestError.
    static Variation parse(const std::string &text);

    const std::string &path() const { return path_; }

    /// The same for the same seed, sample and path, however many samples and variations there are.
    double value(std::uint64_t seed, std::uint64_t sample) const;

    /// Throws RequestError where the scene has no such place.
    void apply(nlohmann::ordered_json &scene, double value) const;

private:
    std::string path_;
    std::vector<std::string> keys_;
    double low_ = 0, high_ = 0;
    bool factor_ = false, logarithmic_ = false;
};

/// A number, a list of them, or what is keyed by frame, in place; false where it is none of these.
bool scale_numbers(nlohmann::ordered_json &node, double factor);

}  // namespace brume::tool
