// Every condition for every effect and tier, on both backends: finite where the input is, within range, transmittance as in
// double, as far from the reference as is printed.
#include <map>
#include <optional>

#include <gtest/gtest.h>

#include "columns.h"

using namespace extremes;
using fog::Frame;
using fog::Picture;
using fog::Result;
using fog::Worst;

namespace {

// The worst of each column in each family.
class Figures {
public:
    explicit Figures(std::string title) : title_(std::move(title)) {}
    ~Figures()
    {
        for (const std::string &family : families_) {
            printf("%s, %s:", title_.c_str(), family.c_str());
            const Figure *most = nullptr;
            for (const auto &[column, figure] : worst_[family]) {
                printf(" %s %.1e;", column.c_str(), figure.error);
                most = !most || figure.error > most->error ? &figure : most;
            }
            printf(" most at %s\n", most->where.c_str());
        }
    }
    void add(const Condition &c, const std::string &column, double error)
    {
        if (!worst_.contains(c.family))
            families_.push_back(c.family);
        Figure &worst = worst_[c.family][column];
        if (error >= worst.error)
            worst = {error, c.name};
    }

private:
    struct Figure {
        double error = 0;
        std::string where;
    };

    std::string title_;
    std::vector<std::string> families_;
    std::map<std::string, std::map<std::string, Figure>> worst_;
};

const std::vector<Condition> &rows()
{
    static const std::vector<Condition> all = conditions();
    return all;
}

double along(const Picture &depth, int x, int y)
{
    const float d = depth.at(x, y)[0];
    return !std::isfinite(d) || d >= 1e9f ? brume::maths_double::far_away : std::max(double(d), 0.0);
}

// Finite and within range, at every pixel.
void check_range(const Condition &c, const Column &column, const Frame &frame, const Result &r)
{
    float brightest = c.medium.contains("emission") ? INFINITY : 1;
    bool negative = false;
    for (int y = 0; y < frame.color.height; ++y)
        for (int x = 0; x < frame.color.width; ++x)
            for (int k = 0; k < 3; ++k)
                if (const float in = frame.color.at(x, y)[k]; std::isfinite(in)) {
                    brightest = std::max(brightest, std::abs(in));
                    negative = negative || in < 0;
                }
    for (int y = 0; y < frame.color.height; ++y)
        for (int x = 0; x < frame.color.width; ++x) {
            SCOPED_TRACE("pixel " + std::to_string(x) + ", " + std::to_string(y));
            ASSERT_EQ(r.output.at(x, y)[3], frame.color.at(x, y)[3]) << "alpha";
            for (int k = 0; k < 3; ++k) {
                const float in = frame.color.at(x, y)[k], out = r.output.at(x, y)[k];
                const float t = r.transmittance.at(x, y)[k], tau = r.optical_depth.at(x, y)[k];
                ASSERT_TRUE(t >= 0 && t <= 1) << "transmittance " << t;
                ASSERT_TRUE(tau >= 0 && std::isfinite(tau)) << "optical depth " << tau;
                double added = 0;
                if (column.filters()) {
                    const float scattered = r.scattered.at(x, y)[k], blur = r.blur_radius.at(x, y)[0];
                    // Splats of unlike widths add up: a pixel may keep all of its own light and take as much again from
                    // others.
                    const double bound = brightest * (column.name == "paper's reference" ? 2.0001 : 1.0001);
                    ASSERT_TRUE(std::isfinite(scattered) && std::abs(scattered) <= bound) << "scattered " << scattered;
                    ASSERT_TRUE(negative || scattered >= 0) << "scattered " << scattered;
                    ASSERT_TRUE(blur >= 0 && std::isfinite(blur)) << "blur radius " << blur;
                    added += std::abs(scattered);
                }
                if (c.medium.contains("emission"))
                    added = INFINITY;
                if (column.lit()) {
                    const float l = r.airlight.at(x, y)[k], e = r.airlight_error.at(x, y)[k];
                    ASSERT_TRUE(l >= 0 && std::isfinite(l)) << "airlight " << l;
                    ASSERT_TRUE(e >= 0 && std::isfinite(e)) << "airlight error " << e;
                    added += l;
                }
                if (!std::isfinite(in)) {
                    ASSERT_TRUE(std::isnan(in) ? std::isnan(out) : in == out) << in << " came back as " << out;
                    continue;
                }
                ASSERT_TRUE(std::isfinite(out)) << out;
                ASSERT_TRUE(negative || out >= 0) << out;
                ASSERT_LE(std::abs(double(out)), (std::abs(double(in)) + added) * 1.0001) << "more light than there is";
            }
        }
}

// Of e^-tau to the same in double; invisible differences do not count.
double transmittance_error(const Condition &c, const Frame &frame, const Result &r)
{
    const fog::Exhaustive exact(fog::lit_scene(c.medium, Json::array()), frame.color.width, frame.color.height);
    double worst = 0;
    for (int y = 0; y < frame.color.height; ++y)
        for (int x = 0; x < frame.color.width; ++x) {
            const auto tau = exact.optical_depth({exact.ray(x, y, 1).direction, along(frame.depth, x, y)});
            for (int k = 0; k < 3; ++k) {
                const double t = std::exp(-tau[k]);
                worst = std::max(worst, std::abs(double(r.transmittance.at(x, y)[k]) - t) / std::max(t, 1e-2));
            }
        }
    return worst;
}

// Those that evaluate every pixel.
bool compares_with_reference(const Column &column)
{
    return column.lit() && !column.filters() && column.name != "reference tier" && column.name != "nodes, quarter";
}

// A hundredth of the brightest does not show beside it.
double visible(const Condition &c, const Picture &airlight)
{
    double most = c.dark ? 1e-7 : 1e-30;
    for (float v : airlight.data)
        most = std::max(most, double(v));
    return 0.01 * most;
}

class Table : public testing::TestWithParam<const char *> {
protected:
    const bool on_gl = std::string(GetParam()) == "gl";

    Result run(brume_context context, const Column &column, const Condition &c) const
    {
        const Frame frame = frame_of(column, c);
        return fog::run(context, column.scene(c), frame.color, frame.depth, options_of(column));
    }
};

INSTANTIATE_TEST_SUITE_P(Extremes, Table, testing::ValuesIn(fog::backend_names),
                         [](auto &info) { return std::string(info.param); });

}  // namespace

TEST_P(Table, EveryConditionForEveryEffectAndTier)
{
    Figures transmittance(std::string(GetParam()) + ", transmittance against double"),
        airlight(std::string(GetParam()) + ", airlight against the reference tier"), backends("gl against cpu");
    size_t cells = 0, conditions = 0;
    for (const Condition &c : rows()) {
        // A minute of software GL for all of them; neighbours differ by one value.
        if (on_gl && (&c - rows().data()) % 3 != 0)
            continue;
        ++conditions;
        const bool wants_reference = !on_gl || !c.about_lights();
        std::optional<Result> reference;
        for (const Column &column : columns()) {
            if ((on_gl && column.cpu_only) || !column.takes(c))
                continue;
            SCOPED_TRACE(column.name + ": " + c.describe());
            const Frame frame = frame_of(column, c);
            const Result r = run(fog::backend(GetParam()), column, c);
            check_range(c, column, frame, r);
            if (HasFatalFailure())
                return;
            ++cells;
            const double t = transmittance_error(c, frame, r);
            transmittance.add(c, column.name, t);
            EXPECT_LT(t, 1e-5) << "transmittance against double";
            if (wants_reference && compares_with_reference(column)) {
                if (!reference)
                    reference = run(fog::cpu(), extremes::column("reference tier"), c);
                const Worst worst =
                    fog::compare(r.airlight, reference->airlight, std::max(1e-12, visible(c, reference->airlight)));
                airlight.add(c, column.name, worst.error);
                if (column.name == "nodes" && !c.peaked() && !c.saturates) {
                    EXPECT_LT(worst.error, 1e-2) << "airlight " << worst.describe();
                }
            }
            if (!on_gl)
                continue;
            const Result expected = run(fog::cpu(), column, c);
            const Worst apart = fog::compare(r.transmittance, expected.transmittance, 1e-2);
            EXPECT_LT(apart.error, 1e-4) << "transmittance " << apart.describe();
            if (column.lit()) {
                const Worst worst = fog::compare(r.airlight, expected.airlight, visible(c, expected.airlight));
                // The published formula scales a difference of two table values by e^(+T).
                if (!c.peaked() && column.tier() == "nodes") {
                    EXPECT_LT(worst.error, 1e-2) << "airlight " << worst.describe();
                }
                backends.add(c, column.name, worst.error);
            } else {
                const Worst worst = fog::compare(r.output, expected.output, 0.05);
                EXPECT_LT(worst.error, 1e-2) << "output " << worst.describe();
                backends.add(c, column.name, worst.error);
            }
        }
    }
    printf("%zu of %zu conditions, %zu cells\n", conditions, rows().size(), cells);
}
