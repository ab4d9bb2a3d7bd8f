#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gaussians/gaussian.h"

namespace brume {

// The formats of gaussian_file.h, from and to a file's content. `name` stands before messages.
std::vector<Gaussian> parse_gaussian_csv(std::string_view content, const std::string &name);
std::vector<Gaussian> parse_gaussian_ply(std::string_view content, const std::string &name);
std::string gaussian_csv(std::span<const Gaussian> gaussians);
std::string gaussian_ply(std::span<const Gaussian> gaussians);

}  // namespace brume
