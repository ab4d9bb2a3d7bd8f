#pragma once
// Media of Gaussians for tests, and one operation of each kind.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include <brume/brume_media.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "media/history.h"

namespace brume::media {

inline dvec3 center(const Gaussian &gaussian)
{
    return {gaussian.center[0], gaussian.center[1], gaussian.center[2]};
}

template <class Call> inline std::string failure(Call call, brume_status status = BRUME_ERROR_ARGUMENT)
{
    try {
        call();
    } catch (const Error &error) {
        EXPECT_EQ(error.status(), status) << error.what();
        return error.what();
    }
    return "accepted";
}

inline bool same_bits(const std::vector<Gaussian> &a, const std::vector<Gaussian> &b)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Gaussian &x, const Gaussian &y) {
        return std::memcmp(&x.center, &y.center, sizeof x.center) == 0 && x.scale == y.scale && x.amplitude == y.amplitude &&
               std::memcmp(&x.color, &y.color, sizeof x.color) == 0;
    });
}

inline void expect_same(const State &a, const State &b)
{
    EXPECT_TRUE(same_bits(a.gaussians, b.gaussians));
    EXPECT_TRUE(same_bits(a.clipboard, b.clipboard));
    EXPECT_EQ(a.selected, b.selected);
}

// A camera at the origin that looks down -z over a picture of 64 x 48; the half width of what it sees is 1 at depth 1.
inline Lens lens()
{
    Lens lens;
    lens.center = {32, 24};
    lens.tangent_scale = {1 / 32.0, -1 / 32.0};
    return lens;
}

// A back wall at depth 8 with a block in the middle at depth 3, and sky above.
inline std::shared_ptr<const DepthMap> room()
{
    auto map = std::make_shared<DepthMap>();
    map->width = 64;
    map->height = 48;
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x)
            map->depth.push_back(y < 8                                    ? std::numeric_limits<float>::infinity()
                                 : x >= 24 && x < 40 && y >= 16 && y < 40 ? 3.0f
                                                                          : 8.0f);
    return map;
}

inline Paint stroke(std::vector<dvec3> points)
{
    Paint paint;
    paint.seed = 5;
    paint.points = std::move(points);
    paint.scale = 2;
    paint.amplitude = 0.7;
    paint.color = {1, 0.5, 0.25};
    return paint;
}

inline Airbrush airbrush()
{
    Airbrush brush;
    brush.seed = 9;
    brush.position = {0, 0, -2};
    brush.velocity = {0, 0, -3};
    brush.spread = 2;
    brush.drag = 0.5;
    brush.diffusion = 0.4;
    brush.rate = 60;
    brush.duration = 4;
    brush.scale = 5;
    brush.lens = lens();
    brush.depth = room();
    return brush;
}

inline Emit steam()
{
    Emit emit;
    emit.seed = 11;
    emit.position = {1, 2, 3};
    emit.velocity = {0, 0, 2};
    emit.acceleration = {0.5, 0, -1};
    emit.rate = 50;
    emit.lifetime = 3;
    emit.scale = {8, 2};
    emit.amplitude = {1, 0};
    return emit;
}

inline Put grid()
{
    Put put;
    for (int y = -3; y <= 3; ++y)
        for (int x = -3; x <= 3; ++x)
            put.gaussians.push_back({{x * 1.0, y * 1.0, -4}, 1, 1, {1, 1, 1}});
    put.gaussians.push_back({{0, 0, 4}, 1, 1, {1, 1, 1}});  // behind the camera
    return put;
}

}  // namespace brume::media
