#pragma once

#include <limits>

#include "bench/sample.hpp"
#include "bench/settings.hpp"
#include "run/scene.hpp"

namespace brume::tool {

/// An effect's yardstick on a picture, reduced where it would take too long at full size.
struct Reference {
    std::string effect;
    Sample sample;  ///< as it was measured on
    Picture image;
    double ms = 0;
};

/// Where something is known to compare with.
struct Errors {
    std::optional<Metrics> reference, truth;
};

struct Row {
    Setting setting;
    std::string refusal;  ///< why it was not measured; empty where it was
    double ms = std::numeric_limits<double>::quiet_NaN();
    double copies = std::numeric_limits<double>::quiet_NaN();  ///< time over that of a plain copy of the image
    Errors errors;
    bool on_reference_front = false, on_truth_front = false;
};

struct Group {
    std::string effect;
    int reference_width = 0, reference_height = 0;
    double reference_ms = 0;
    std::optional<Metrics> reference_truth;  ///< of the reference itself, at its size
    Errors without_fog;                      ///< of the image as it came
    std::vector<Row> rows;
};

struct BenchOptions {
    int repeat = 5;
    double reference_seconds = 20;  ///< references are as large as this allows, about
    int reference_width = 0;        ///< or at most this wide [px]; 0: as time allows
};

/// Square root of relMSE.
double error_of(const Metrics &metrics);

/// Effects that do something here.
std::vector<std::string> effects_to_measure(const Context &context, const SceneText &scene, const Sample &sample);

/// Milliseconds of copying the image out of memory rather than out of a cache.
double copy_ms(const Sample &sample, int repeat);

/// Median over the picture of the optical depth, channels weighted by luminance.
double median_optical_depth(const Context &context, const SceneText &scene, const Sample &sample);

/// `cpu`: references run nowhere else.
Reference make_reference(const Context &cpu, const SceneText &scene, const Sample &sample, const std::string &effect,
                         const BenchOptions &options);

/// All settings of the reference's effect, other effects as the scene has them. Each is timed on `sample`, after one run
/// to warm up and in turn with the others, and its error taken against the reference at the reference's size and against
/// truth at the sample's.
Group measure_group(const Context &context, const SceneText &scene, const Sample &sample, const Reference &reference,
                    double copy, const BenchOptions &options);

/// Marks the rows that no other row beats, in time and either error.
void mark_fronts(std::vector<Row> &rows);

}  // namespace brume::tool
