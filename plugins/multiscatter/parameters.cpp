#include "parameters.h"

#include "parameter_info.hpp"

namespace multiscatter {
namespace {

enum Index {
    method,
    kernel_size,
    fetch,
    levels,
    level_scale,
    masking,
    mask_width,
    density_blurring,
    placement,
    separation,
    separation_luminance,
    separation_luminance_width,
    separation_density,
    separation_density_width,
    separation_level,
    lobes,
    resolution,
    count
};

using namespace brume_parameters;

constexpr brume_parameter_info table[count] = {
    choice("method", "paper|reference|calibrated|paper_reference", 2,
           "calibrated: light spreads as Monte Carlo says it does; paper: the hierarchical filter of Iser 2018, which the "
           "other "
           "parameters but `levels` are of; reference, paper_reference: what these two approximate, pixel against pixel in "
           "double, CPU "
           "only, minutes for small frames",
           "kernel"),
    choice("kernel_size", "2x2|4x4|6x6", 1, "kernel between pyramid levels; larger is smoother and slower"),
    choice("fetch", "linear_bilinear|linear_bicubic|cubic_bicubic", 1,
           "interpolation across and within levels; linear_bilinear shows blocks in motion"),
    integer("levels", 0, 16, 0, "", "coarsest pyramid level K; 0: down to 1 x 1. Fewer are cheaper and cap the blur"),
    number("level_scale", 0.1, 10, 0.86, "", "c: blur deviation of level k is taken as c 2^k pixels"),
    boolean("masking", true,
            "keep light that spreads little out of coarse levels (loses about half of a uniform image's light)"),
    number("mask_width", 0, 100, 2, "", "epsilon: width of that mask as a multiple of its threshold"),
    boolean("density_blurring", true, "blur the deviation before choosing a level: no edges where depth jumps"),
    boolean("placement", false,
            "scale the blur by where along the ray the medium is (sqrt(3 M2)); the paper takes it for homogeneous"),
    boolean("separation", false, "filter bright pixels in thin fog apart from the rest"),
    number("separation_luminance", 0, 1e10, 1, "radiance", "luminance above which pixels are separated"),
    number("separation_luminance_width", 0, 1e10, 1, "radiance", "width of that threshold"),
    number("separation_density", 0, 1e10, 50, "m", "density integral below which pixels are separated"),
    number("separation_density_width", 0, 1e10, 25, "m", "width of that threshold"),
    number("separation_level", 0, 1, 0.7, "", "level, as a fraction of K, from which separated light takes its deviation"),
    choice(
        "lobes", "every|second|third", 1,
        "method calibrated: levels of the pyramid at which light stays; fewer are cheaper and follow the spread less well"),
    choice("resolution", "full|half|quarter", 0,
           "method calibrated: pixels each way at which light is scattered, brought to the others by their depth"),
};

}  // namespace

std::span<const brume_parameter_info> parameter_table()
{
    return table;
}

Parameters read_parameters(const double *values)
{
    Parameters p{};
    p.kernel = Kernel(int(values[method]));
    p.taps = 2 + 2 * int(values[kernel_size]);
    p.levels = int(values[levels]);
    p.step = 1 + int(values[lobes]);
    p.reduction = 1 << int(values[resolution]);
    p.separation_fraction = values[separation_level];
    p.filter.fetch = int(values[fetch]);
    p.filter.masking = int(values[masking]);
    p.filter.density_blurring = int(values[density_blurring]);
    p.filter.placement = int(values[placement]);
    p.filter.separation = int(values[separation]);
    p.filter.scale = float(values[level_scale]);
    p.filter.mask_width = float(values[mask_width]);
    p.filter.bright = float(values[separation_luminance]);
    p.filter.bright_width = float(values[separation_luminance_width]);
    p.filter.dense = float(values[separation_density]);
    p.filter.dense_width = float(values[separation_density_width]);
    return p;
}

void choose(double *values, Kernel chosen, int step, int reduction)
{
    values[method] = double(chosen);
    values[lobes] = step - 1;
    values[resolution] = reduction == 4 ? 2 : reduction - 1;
}

}  // namespace multiscatter
