// lamp_calibration [--quick]: shaders/lib/lamp_field.glsl and airlight_orders.glsl against Monte Carlo: how far off are the
// fluence and the mean cosine of a lamp's scattered light, the source that it makes toward a camera, and what a black plane
// leaves of it. Seeded; the same on every run.
#include <cstdio>
#include <cstring>

#include "lamp_tracer.h"
#include "maths.hpp"

namespace {

using namespace lamp_tracer;
namespace maths = brume::maths_double;

class Rms {
public:
    void add(double error)
    {
        square_ += error * error;
        worst_ = std::max(worst_, std::abs(error));
        ++count_;
    }
    double rms() const { return count_ ? std::sqrt(square_ / count_) : 0; }
    double worst() const { return worst_; }

private:
    double square_ = 0, worst_ = 0;
    int count_ = 0;
};

// Mean of turned_again over a bin's angles.
double mean_source(double g, double cosine, int bin)
{
    const double from = std::cos(angles[size_t(bin)] * pi / 180), to = std::cos(angles[size_t(bin) + 1] * pi / 180);
    double sum = 0;
    for (int i = 0; i < 64; ++i)
        sum += maths::turned_again(g, cosine, from + (to - from) * (i + 0.5) / 64) / 64;
    return sum;
}

void endless(int photons)
{
    printf("Endless medium, x = s' r from .02 to 6. Relative errors of r^2 fluence; of the source by angle, weighted by "
           "solid angle,\n"
           "relative to its mean; absolute of the mean cosine. Monte Carlo: its own deviation of the fluence.\n"
           "    g albedo  fluence rms  worst  cosine rms  source rms  Monte Carlo\n");
    for (double g : {0.0, 0.3, 0.5, 0.7, 0.85, 0.95}) {
        // As many flights for each g: paths are as much longer as light is less turned.
        const auto media = trace_endless(g, {1, 0.98, 0.95, 0.8, 0.5}, {.02, .04, .08, .16, .3, .5, .8, 1.2, 1.8, 2.7, 4, 6},
                                         int(photons * (1 - 0.9 * g)), 1);
        for (const Endless &m : media) {
            Rms fluence, cosine, source, noise;
            for (const Shell &s : m.shells) {
                const double absorption = 1 / m.albedo - 1, r = s.radius / (absorption + 1 - g);
                const maths::Rescattered model = maths::rescattered(r, absorption * r, g);
                fluence.add(model.fluence / (s.radius * s.radius * s.fluence) - 1);
                cosine.add(model.cosine - s.moments[0]);
                noise.add(s.deviation);
                double square = 0;
                for (int k = 0; k < bins; ++k) {
                    const double solid =
                        0.5 * (std::cos(angles[size_t(k)] * pi / 180) - std::cos(angles[size_t(k) + 1] * pi / 180));
                    square += solid * std::pow(4 * pi * (mean_source(g, model.cosine, k) - s.source[k]), 2);
                }
                source.add(std::sqrt(square));
            }
            printf("%5.2f %6.2f %12.3f %6.3f %11.3f %11.3f %12.3f\n", g, m.albedo, fluence.rms(), fluence.worst(),
                   cosine.rms(), source.rms(), noise.rms());
        }
    }
}

void over_ground(int photons)
{
    printf("\nOver a black plane, the lamp at s' h. Relative errors of the fluence of what has not touched the plane, where "
           "the Monte Carlo is\n"
           "better than 10 %%, with the plane and as if there were none.\n"
           "    g    s'h  points     rms   worst  without: rms\n");
    for (double g : {0.0, 0.5, 0.85})
        for (double h : {0.1, 0.3, 1.0}) {
            Rms with, without;
            int points = 0;
            for (const GroundCell &c : trace_over_ground(g, h, photons, 2)) {
                const double r = std::hypot(c.aside, c.height - h), extinction = r / (1 - g);
                if (c.deviation > 0.1)
                    continue;
                const maths::Rescattered model = maths::rescattered(extinction, 0, g);
                const double left = maths::left_by_plane(model, maths::beside_planes(model, extinction), r, h, c.height);
                with.add(model.fluence * left / (r * r * c.fluence) - 1);
                without.add(model.fluence / (r * r * c.fluence) - 1);
                ++points;
            }
            printf("%5.2f %6.2f %7d %7.3f %7.3f %13.3f\n", g, h, points, with.rms(), with.worst(), without.rms());
        }
}

void in_rooms(int photons)
{
    printf("\nBetween black walls, the nearest at s' h: relative errors of the fluence of what has touched none, where the "
           "Monte Carlo is "
           "better than 10 %%.\n"
           "room           g    s'h  points     rms   worst\n");
    for (const Room &room : rooms)
        for (double g : {0.0, 0.7})
            for (double h : {0.1, 0.3, 1.0}) {
                Rms errors;
                int points = 0;
                for (const RoomPoint &p : trace_in_room(room, g, h, photons, 3)) {
                    if (p.deviation > 0.1)
                        continue;
                    const double r = glm::length(p.way), extinction = r / (1 - g);
                    const maths::Rescattered model = maths::rescattered(extinction, 0, g);
                    maths::Surroundings around = maths::open_surroundings();
                    for (int axis = 0; axis < 3; ++axis) {
                        around.low_weight[axis] = std::isfinite(room.low[axis]);
                        around.high_weight[axis] = std::isfinite(room.high[axis]);
                        around.low[axis] = around.low_weight[axis] > 0 ? -h * room.low[axis] : 0;
                        around.high[axis] = around.high_weight[axis] > 0 ? h * room.high[axis] : 0;
                    }
                    const double left = maths::left_by_planes(model, extinction, r, around, p.way);
                    errors.add(model.fluence * left / (r * r * p.fluence) - 1);
                    ++points;
                }
                printf("%-10s %5.2f %6.2f %7d %7.3f %7.3f\n", room.name, g, h, points, errors.rms(), errors.worst());
            }
}

}  // namespace

int main(int argc, char **argv)
{
    const bool quick = argc > 1 && std::strcmp(argv[1], "--quick") == 0;
    if (argc > (quick ? 2 : 1)) {
        fprintf(stderr, "lamp_calibration: %s: expected --quick or nothing\n", argv[1]);
        return 2;
    }
    endless(quick ? 1000 : 30000);
    over_ground(quick ? 50000 : 1000000);
    in_rooms(quick ? 20000 : 500000);
}
