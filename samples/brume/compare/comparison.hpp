#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "colour/color_manager.hpp"
#include "compare/pairs.hpp"
#include "image/resolve.hpp"
#include "metrics/limits.hpp"

namespace brume::tool {

struct CompareRequest {
    LayerRequest layers;
    Limits limits;
    std::string mask;
    bool header = false, flip = false;
};

struct Comparison {
    PairFiles files;
    std::string error;  ///< why it could not be compared at all
    bool a_is_whole = false, measured = false;
    Metrics metrics;
    Verdict verdict;
    bool same_window = true;
    std::optional<double> flip;
    std::vector<std::string> notes;   ///< what is no limit but ought to be known
    std::vector<std::string> header;  ///< what differs beside the pixels
    std::string updated;              ///< what --update did

    bool compared() const { return measured && error.empty(); }
    bool within() const { return compared() && verdict.beyond.empty(); }
    bool settled() const { return within() || !updated.empty(); }
};

/// What of the two pictures was compared: the same window.
using UsePictures = std::function<void(const Picture &a, const Picture &reference, Comparison &comparison)>;

/// Throws RequestError where the first pair that opens lacks the layers asked for.
void check_layers(const std::vector<PairFiles> &pairs, const CompareRequest &request);

/// Reads, measures and judges one pair. What fails is in the result, RequestError too: other pairs may do.
Comparison compare_pair(const PairFiles &files, const CompareRequest &request, const ColorManager &colors,
                        const UsePictures &use);

}  // namespace brume::tool
