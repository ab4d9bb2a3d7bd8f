// Gauss-Legendre quadrature of 16 nodes.
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace brume::airlight {

struct Node {
    double at, weight;  // of [0, 1]
};

inline const std::array<Node, 16> &gauss_legendre()
{
    static const std::array<Node, 16> nodes = [] {
        constexpr int order = 16;
        std::array<Node, order> made;
        for (int i = 0; i < order; ++i) {
            // Newton's method on the polynomial by its recurrence.
            double x = std::cos(std::numbers::pi * (i + 0.75) / (order + 0.5)), slope = 1;
            for (int round = 0; round < 8; ++round) {
                double before = 1, value = x;
                for (int k = 2; k <= order; ++k)
                    before = std::exchange(value, ((2 * k - 1) * x * value - (k - 1) * before) / k);
                slope = order * (x * value - before) / (x * x - 1);
                x -= value / slope;
            }
            made[std::size_t(i)] = {0.5 + 0.5 * x, 1 / ((1 - x * x) * slope * slope)};
        }
        return made;
    }();
    return nodes;
}

}  // namespace brume::airlight
