#include "parameters.h"

#include "common/parameter_info.hpp"

namespace airlight {
namespace {

using namespace brume_parameters;

enum Index { tier, max_error, resolution, count };

constexpr brume_parameter_info table[count] = {
    choice("tier", "nodes|fogshop|sun|reference", 0,
           "nodes: Gauss-Legendre along the ray, any medium; fogshop: Zhou et al. 2007 as published; sun: Sun et al. 2005, "
           "homogeneous and isotropic only; reference: adaptive quadrature in double, CPU only, very slow"),
    number("max_error", 1e-5, 0.5, 0.01, "", "relative error asked of tier nodes: sets its node counts"),
    choice("resolution", "full|half|quarter", 0,
           "evaluate at every pixel, every second or every fourth; the rest is interpolated between pixels of like distance"),
};

}  // namespace

std::span<const brume_parameter_info> parameter_table()
{
    return table;
}

Parameters read_parameters(const double *values)
{
    return {Tier(int(values[tier])), values[max_error], 1 << int(values[resolution])};
}

void choose(double *values, Tier chosen, double error, int reduction)
{
    values[tier] = double(chosen);
    values[max_error] = error;
    values[resolution] = reduction == 4 ? 2 : reduction - 1;
}

}  // namespace airlight
