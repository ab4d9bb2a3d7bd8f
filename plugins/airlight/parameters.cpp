#include "parameters.h"

#include "parameter_info.hpp"

namespace airlight {
namespace {

using namespace brume_parameters;

enum Index { method, max_error, resolution, orders, ground, ground_height, memory, count };

constexpr brume_parameter_info table[count] = {
    choice("method", "nodes|fogshop|sun|reference|maps|auto", 5,
           "auto: maps where it costs less than nodes; nodes: Gauss-Legendre along the ray, any medium; maps: attenuation "
           "maps of "
           "the lights (Gautron et al.) and a grid along the view, for many Gaussians; fogshop: Zhou et al. 2007 as "
           "published; sun: Sun et al. 2005, "
           "homogeneous and isotropic only; reference: adaptive quadrature in double, CPU only, very slow",
           "tier"),
    number("max_error", 1e-5, 0.5, 0.01, "", "relative error asked of methods nodes and maps: sets how fine they are"),
    choice(
        "resolution", "full|half|quarter", 0,
        "evaluate at every pixel, every second or every fourth; the rest is interpolated between pixels of like distance"),
    choice("orders", "single|all|auto", 2,
           "single: what lights scatter once toward the camera; all: any number of times, by methods nodes, maps and "
           "reference; auto: all beside an effect that scatters the picture's light, where what scatters again is more than "
           "max_error "
           "of the lights', else single"),
    choice("ground", "none|y|z|auto", 3,
           "what takes of the fog's light that falls on it, with orders all. y, z: a plane below the lamps, from which this "
           "world "
           "axis points up; auto: what the picture shows of surfaces around each lamp; none: nothing, endless fog"),
    number("ground_height", -1e6, 1e6, 0, "m", "where the plane of ground y or z lies on its axis"),
    number("memory", 8, 16384, 256, "MB", "what the grid of method maps may take; its cells grow until it does"),
};

}  // namespace

std::span<const brume_parameter_info> parameter_table()
{
    return table;
}

Parameters read_parameters(const double *values)
{
    return {Tier(int(values[method])),
            values[max_error],
            1 << int(values[resolution]),
            Orders(int(values[orders])),
            Ground(int(values[ground])),
            values[ground_height],
            values[memory]};
}

void choose(double *values, Tier chosen, double error, int reduction)
{
    values[method] = double(chosen);
    values[max_error] = error;
    values[resolution] = reduction == 4 ? 2 : reduction - 1;
}

void settle_orders(double *values, Orders chosen)
{
    values[orders] = double(chosen);
}

}  // namespace airlight
