#pragma once
#include <cstdint>

#include <glm/glm.hpp>

namespace brume::media {

// Random numbers of one stream of a seed. Only integer arithmetic and correctly rounded operations: the same bits on every
// machine, which the distributions of the standard library do not give.
class Random {
public:
    Random(uint32_t seed, uint64_t stream) : state_(mixed(mixed(uint64_t(seed) + step) + stream)) {}

    // From 0, below 1.
    double next()
    {
        state_ += step;
        return double(mixed(state_) >> 11) * 0x1p-53;
    }

    // Uniform in the open unit ball, or disc.
    glm::dvec3 in_ball() { return inside<glm::dvec3>(); }
    glm::dvec2 in_disc() { return inside<glm::dvec2>(); }

private:
    static constexpr uint64_t step = 0x9e3779b97f4a7c15u;

    // The finaliser of splitmix64 (Steele et al. 2014).
    static uint64_t mixed(uint64_t z)
    {
        z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
        z = (z ^ z >> 27) * 0x94d049bb133111ebu;
        return z ^ z >> 31;
    }

    template <class Vector> Vector inside()
    {
        for (;;) {
            Vector v;
            for (int i = 0; i < Vector::length(); ++i)
                v[i] = 2.0 * next() - 1.0;
            if (glm::dot(v, v) < 1.0)
                return v;
        }
    }

    uint64_t state_;
};

}  // namespace brume::media
