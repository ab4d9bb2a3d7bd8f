#pragma once
#include <span>

#include <brume/brume_plugin.h>

namespace airlight {

enum class Tier { nodes, fogshop, sun, reference, maps, automatic };
// Zhou et al. and Sun et al. as published: they know neither shadows nor light that scatters twice.
constexpr bool is_published(Tier tier)
{
    return tier == Tier::fogshop || tier == Tier::sun;
}

enum class Orders { single, all, automatic };
enum class Ground { none, y, z, automatic };

struct Parameters {
    Tier tier;
    double max_error;  // relative, asked of tier nodes
    int reduction;     // side of the square of pixels that share one evaluation: 1, 2 or 4
    Orders orders;
    Ground ground;
    double ground_height;  // [m]
    double memory;         // of the grid of tier maps, at most [MB]
};

std::span<const brume_parameter_info> parameter_table();
Parameters read_parameters(const double *values);

// Sets those of a table's values.
void choose(double *values, Tier tier, double max_error, int reduction);

void settle_orders(double *values, Orders chosen);

}  // namespace airlight
