#pragma once
#include "base/json_node.h"
#include "scene/scene.h"
#include "base/scene_ranges.h"

namespace brume {

// The numbers of a scene file, each in its range or JsonNode's error.
double read_constant(const JsonNode &node, const Range &range);
Number read_number(const JsonNode &node, const Range &range);
Number3 read_vector(const JsonNode &node, const Range &range);
Number3 read_direction(const JsonNode &node);
// A scalar stands for three equal channels.
Number3 read_rgb(const JsonNode &node, const Range &range);
// A rigid motion.
std::array<Number, 16> read_matrix(const JsonNode &node);
Number in_radians(Number degrees);

}  // namespace brume
