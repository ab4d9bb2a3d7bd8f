// From frame to frame: fog's light in a direction stays as it is while the camera turns, but for what leaves the image.
#include <gtest/gtest.h>

#include "moving_street.h"

using namespace fog;
using namespace moving_street;

namespace {

// By a uniform cubic B-spline, whose blur hardly depends on where between pixels it is asked.
double smooth_value(const Picture &p, double x, double y)
{
    auto weight = [](double t) {
        t = std::abs(t);
        return t < 1 ? (4 - 6 * t * t + 3 * t * t * t) / 6 : t < 2 ? (2 - t) * (2 - t) * (2 - t) / 6 : 0;
    };
    const int left = int(std::floor(x - 0.5)) - 1, top = int(std::floor(y - 0.5)) - 1;
    double sum = 0;
    for (int j = top; j < top + 4; ++j)
        for (int i = left; i < left + 4; ++i)
            sum += weight(x - 0.5 - i) * weight(y - 0.5 - j) * p.at(i, j)[1];
    return sum;
}

// Whether all that a pixel's surroundings show is about as far: at silhouettes a depth image says of one side only, and
// which one changes as they move.
bool without_silhouette(const Picture &depth, double x, double y)
{
    float nearest = INFINITY, farthest = 0;
    for (int j = int(y) - 3; j <= int(y) + 3; ++j)
        for (int i = int(x) - 3; i <= int(x) + 3; ++i) {
            const float d = std::min(depth.at(i, j)[0], 1e4f);
            nearest = std::min(nearest, d);
            farthest = std::max(farthest, d);
        }
    return farthest < 1.25f * nearest;
}

struct Case {
    const char *parameters;
    double worst_shift, mean_shift, worst_turn, mean_turn;
};

class Motion : public testing::TestWithParam<const char *> {
protected:
    brume_context context() { return backend(GetParam()); }
    int frames() const { return std::string(GetParam()) == "cpu" ? 25 : 7; }

    // What is reached, so that a change shows.
    static constexpr Case cases[] = {{"", 0.06, 0.006, 0.02, 0.003},
                                     {"\"resolution\":\"half\"", 0.25, 0.006, 0.02, 0.003},
                                     {"\"resolution\":\"quarter\"", 0.25, 0.008, 0.025, 0.004}};
};

}  // namespace

// The image as a window that moves over one wide view by a pixel a frame: all its pixels come back one further, and so
// should their fog.
TEST_P(Motion, AWindowThatMovesByWholePixels)
{
    for (const Case &c : cases) {
        const Plan plan(context(), foggy(c.parameters), width, height, {{}, {"scattered"}});
        Changes changes;
        Picture before;
        for (int frame = 0; frame < frames(); ++frame) {
            Shot s = shot();
            s.center_x += 16 - frame;
            Picture now = fog_light(plan, s, Street::render(s));
            const double mean = mean_of(now);
            for (int y = 0; y < height && frame > 0; ++y)
                for (int x = 0; x + 1 < width; ++x)
                    changes.add(before.at(x + 1, y)[1], now.at(x, y)[1], mean, x, y, frame);
            before = std::move(now);
        }
        changes.print(std::string("a pixel a frame, ") + c.parameters);
        EXPECT_LT(changes.worst, c.worst_shift) << c.parameters;
        EXPECT_LT(changes.mean(), c.mean_shift) << c.parameters;
    }
}

// The camera turns by .3 of a pixel a frame; directions that see no silhouette in any frame.
TEST_P(Motion, APan)
{
    const double step = 0.3;
    const int edge = 5 + int(step * frames());
    for (const Case &c : cases) {
        const Plan plan(context(), foggy(c.parameters), width, height, {{}, {"scattered"}});
        std::vector<std::vector<double>> light(size_t(width * height));
        double mean = 0;
        for (int frame = 0; frame < frames(); ++frame) {
            Shot s = shot();
            s.yaw = step / s.focal * (frame - 0.5 * (frames() - 1));
            const Frame seen = Street::render(s);
            const Picture now = fog_light(plan, s, seen);
            mean = mean_of(now);
            for (int y = 4; y < height - 4; ++y)
                for (int x = edge; x < width - edge; ++x) {
                    const auto [px, py] = s.pixel(shot().ray(x + 0.5, y + 0.5));
                    light[size_t(y * width + x)].push_back(without_silhouette(seen.depth, px, py) ? smooth_value(now, px, py)
                                                                                                  : NAN);
                }
        }
        Changes changes;
        for (int y = 4; y < height - 4; ++y)
            for (int x = edge; x < width - edge; ++x) {
                const std::vector<double> &l = light[size_t(y * width + x)];
                if (std::any_of(l.begin(), l.end(), [](double v) { return std::isnan(v); }))
                    continue;
                for (size_t frame = 1; frame < l.size(); ++frame)
                    changes.add(l[frame - 1], l[frame], mean, x, y, int(frame));
            }
        changes.print(std::string("a turning camera, ") + c.parameters);
        EXPECT_GT(changes.count, 2000 * size_t(frames()));
        EXPECT_LT(changes.worst, c.worst_turn) << c.parameters;
        EXPECT_LT(changes.mean(), c.mean_turn) << c.parameters;
    }
}

namespace {

// A display window among `margin` pixels of overscan, a wall with three lamps before it, and a fourth that leaves to the
// right.
struct Overscan {
    int margin;
    bool fading;  // of the overscan's colour toward its edge
    static constexpr double radius = 2;

    Plan plan(brume_context context) const
    {
        return Plan(context, foggy(""), width + 2 * margin, height + 2 * margin,
                    {[&](brume_format &f) {
                         f.display_x = f.display_y = margin;
                         f.display_width = width;
                         f.display_height = height;
                     },
                     {"scattered"}});
    }
    // What is displayed of fog's light while the lamp's centre is at x of the display window.
    Picture fog_light(const Plan &plan, double x) const
    {
        Frame f{Picture(width + 2 * margin, height + 2 * margin, 4, 0.05f),
                Picture(width + 2 * margin, height + 2 * margin, 1, 40)};
        for (auto [lamp_x, lamp_y] : {std::pair(20.0, 25.0), {60.0, 45.0}, {100.0, 25.0}, {x, 45.3}})
            add_lamp(f, lamp_x + margin, lamp_y + margin);
        if (fading)
            fade(f.color);
        const Picture all = plan.execute(f.color, f.depth, {{}, {"scattered"}}).scattered;
        Picture shown(width, height, 3);
        for (int j = 0; j < height; ++j)
            std::copy_n(all.at(margin, j + margin), 3 * width, shown.at(0, j));
        return shown;
    }

private:
    static void add_lamp(Frame &f, double x, double y)
    {
        const int n = 8;
        for (int j = int(y - radius) - 1; j <= int(y + radius) + 1; ++j)
            for (int i = int(x - radius) - 1; i <= std::min(int(x + radius) + 1, f.color.width - 1); ++i) {
                int covered = 0;
                for (int k = 0; k < n * n; ++k)
                    covered += std::hypot(i + (k % n + 0.5) / n - x, j + (k / n + 0.5) / n - y) < radius;
                for (int c = 0; c < 3 && covered; ++c) {
                    f.color.at(i, j)[c] += 60 * float(covered) / float(n * n);
                    f.depth.at(i, j)[0] = 20;
                }
            }
    }
    void fade(Picture &color) const
    {
        auto inward = [&](int i, int size) {
            const double t = std::min({1.0, (i + 0.5) / margin, (size - i - 0.5) / margin});
            return t * t * (3 - 2 * t);
        };
        for (int y = 0; y < color.height; ++y)
            for (int x = 0; x < color.width; ++x)
                for (int c = 0; c < 3; ++c)
                    color.at(x, y)[c] *= float(inward(x, color.width) * inward(y, color.height));
    }
};

}  // namespace

TEST(Overscan, ALampThatLeaves)
{
    struct {
        Overscan overscan;
        double step, worst_loss, mean_loss;  // what is reached
    } const cases[] = {{{16, false}, 0.03, 0.65, 0.075}, {{40, false}, 0.012, 0.26, 0.03}, {{40, true}, 0.01, 0.01, 0.002}};
    for (const auto &c : cases) {
        const Plan plan = c.overscan.plan(cpu());
        auto changes = [](const Picture &a, const Picture &b) {
            Changes sum;
            const double mean = mean_of(b);
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x)
                    sum.add(a.at(x, y)[1], b.at(x, y)[1], mean, x, y, 0);
            return sum;
        };
        const double edge = width + c.overscan.margin, within = edge - Overscan::radius, gone = edge + Overscan::radius + 1;
        double step = 0;
        Picture before = c.overscan.fog_light(plan, width + Overscan::radius);
        for (double x = width + Overscan::radius + 1; x <= gone; ++x) {
            Picture now = c.overscan.fog_light(plan, x);
            step = std::max(step, changes(before, now).mean());
            before = std::move(now);
        }
        const Changes loss = changes(c.overscan.fog_light(plan, within), before);
        const std::string what =
            std::to_string(100 * c.overscan.margin / width) + " % of overscan" + (c.overscan.fading ? " that fades" : "");
        printf("%s: a lamp outside the display changes it by %.2f %% each pixel at most; as it leaves the overscan, by %.1f "
               "%%, "
               "at (%d, %d) by %.1f %%\n",
               what.c_str(), 100 * step, 100 * loss.mean(), loss.x, loss.y, 100 * loss.worst);
        EXPECT_LT(step, c.step) << what;
        EXPECT_LT(loss.worst, c.worst_loss) << what;
        EXPECT_LT(loss.mean(), c.mean_loss) << what;
    }
}

INSTANTIATE_TEST_SUITE_P(All, Motion, testing::ValuesIn(fog::backend_names),
                         [](auto &info) { return std::string(info.param); });
