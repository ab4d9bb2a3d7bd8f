// Kernel `reference`: kernel `calibrated` without its pyramid.
//
// Each pixel's light goes straight to each other pixel, by the Monte Carlo's spread for the angle between them and the
// optical depth to the source, as far as it is scattered in front of what the receiver shows. Of what would fall outside the
// image half stays within, in proportion: beyond_edges of the pyramid.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "calibrated/passes.h"
#include "reference/reference.h"

namespace multiscatter {
namespace {

using namespace brume::maths_double;

constexpr int finer_places = 4;  // per octave of P; the pyramid's table has two
constexpr int places = 2 * (spread_places - 1) + 1;
constexpr int near_pixels = 4;  // offsets below it are integrated over the receiving pixel
constexpr int near_rows = near_pixels * near_pixels;
constexpr int rings = 8;  // per octave of the distance in pixels
constexpr double subsamples = 8;

class CalibratedSplatting : public Splatting {
public:
    explicit CalibratedSplatting(const State &state) : sources_(size_t(state.width) * size_t(state.height)) {}

    void find_sources(const ReferenceFrame &frame, int first, int last) override;
    void prepare(const ReferenceFrame &frame) override;
    void add_rows(const ReferenceFrame &frame, int first, int last, std::vector<vec3> &sum) const override;

private:
    struct Source {
        vec3 radiance, coverage;  // what arrives of its light, scattered, and the share that is
        vec3 shown;               // its light, but that of other effects
        double place;             // of P, in quarters of octaves
        double reach;
    };
    // A place between two rows of the tables below.
    struct Ring {
        int row;
        double above;
    };

    double spread(const Ring &ring, double place) const
    {
        const int q = std::min(int(place), places - 2);
        const double f = place - q, *below = &spread_[size_t(ring.row * places + q)], *above = below + places;
        return (1 - ring.above) * ((1 - f) * below[0] + f * below[1]) + ring.above * ((1 - f) * above[0] + f * above[1]);
    }
    double visible_behind(const Ring &ring, double ratio) const
    {
        const double place = ratio * (visible_places - 1);
        const int i = std::min(int(place), visible_places - 2);
        const double f = place - i, *below = &visible_[size_t(ring.row * visible_places + i)],
                     *above = below + visible_places;
        return (1 - ring.above) * ((1 - f) * below[0] + f * below[1]) + ring.above * ((1 - f) * above[0] + f * above[1]);
    }
    const Ring &ring(int dx, int dy) const { return rings_[size_t(std::abs(dy)) * width_ + size_t(std::abs(dx))]; }
    void tabulate(const ReferenceFrame &frame, const SpreadSource &source);
    vec3 around(const ReferenceFrame &frame, int x, int y, double density) const;

    size_t width_ = 0;
    std::vector<Source> sources_;
    std::vector<double> spread_;   // rows x places: light per pixel at an offset
    std::vector<double> visible_;  // rows x visible_places
    std::vector<Ring> rings_;      // by offset
    vec3 surroundings_{0};         // of the picture where there is no environment
    Data environment_{nullptr, 0, 4};
};

Calibrated in_double(const brume::maths_float::Calibrated &f)
{
    return {f.top,
            f.step,
            4,
            f.lights,
            f.all_orders,
            f.sky,
            double(f.first_sky),
            double(f.first_place),
            double(f.per_reach),
            vec3(f.detour)};
}

void CalibratedSplatting::find_sources(const ReferenceFrame &frame, int first, int last)
{
    const Calibrated f =
        in_double(calibrated_of(frame.state, frame.scene, source_of(frame.state, frame.scene), uint32_t(frame.light_count)));
    for (int y = first; y < last; ++y)
        for (int x = 0; x < frame.state.width; ++x) {
            const Pixel pixel = frame.pixel_at(x, y);
            const vec3 shown = shown_share(frame.lights.texture(), f.lights, f.all_orders, frame.medium, frame.camera,
                                           vec2(x + 0.5, y + 0.5), pixel) *
                               finite_or_zero(frame.color_at(x, y));
            const double octaves = octaves_of(pixel.density);
            const vec3 share = arrived_share(frame.medium, f, pixel.density, octaves, pixel.share);
            sources_[frame.index(x, y)] = {share * shown, share, shown, 2 * spread_place(f, octaves),
                                           reach_of(f, pixel.density)};
        }
}

void CalibratedSplatting::tabulate(const ReferenceFrame &frame, const SpreadSource &source)
{
    const int width = frame.state.width, height = frame.state.height;
    width_ = size_t(width);
    const int ring_rows = int(rings * (std::log2(std::hypot(width, height)) + 1)) + 2;
    const int rows = near_rows + ring_rows;
    spread_.assign(size_t(rows * places), 0);
    visible_.assign(size_t(rows * visible_places), 1);
    auto radius_of = [](int i) { return std::exp2(double(i) / rings - 1); };
    auto per_pixel = [&](double depth, double from, double to) {
        return light_between(source, depth, from / source.focal, to / source.focal) /
               (std::numbers::pi * (to * to - from * from));
    };
    for (int q = 0; q < places; ++q) {
        const double depth = first_depth * std::exp2(double(q) / finer_places);
        // Of rings a sixteenth of an octave to either side of their radius.
        std::vector<double> profile;
        for (int i = -4 * rings; i < ring_rows; ++i)
            profile.push_back(
                per_pixel(depth, radius_of(i) * std::exp2(-0.5 / rings), radius_of(i) * std::exp2(0.5 / rings)));
        auto at = [&](double radius) {
            const double place = std::clamp(rings * (std::log2(radius) + 5), 0.0, double(profile.size()) - 1.001);
            const size_t i = size_t(place);
            return profile[i] + (place - double(i)) * (profile[i + 1] - profile[i]);
        };
        for (int i = 0; i < ring_rows; ++i)
            spread_[size_t((near_rows + i) * places + q)] = profile[size_t(i + 4 * rings)];
        for (int dy = 0; dy < near_pixels; ++dy)
            for (int dx = 0; dx < near_pixels; ++dx) {
                double sum = 0;
                for (int j = 0; j < int(subsamples) && dx + dy > 0; ++j)
                    for (int i = 0; i < int(subsamples); ++i)
                        sum += at(std::hypot(dx + (i + 0.5) / subsamples - 0.5, dy + (j + 0.5) / subsamples - 0.5));
                // The source's own pixel, as a disc of its area: the spread has a pole there.
                spread_[size_t((dy * near_pixels + dx) * places + q)] =
                    dx + dy == 0 ? light_between(source, depth, 0, std::sqrt(1 / std::numbers::pi) / source.focal)
                                 : sum / (subsamples * subsamples);
            }
    }
    auto visible_row = [&](int row, double radius) {
        for (int i = 0; i < visible_places; ++i)
            visible_[size_t(row * visible_places + i)] =
                visible(source.asymmetry, std::min(radius / source.focal, 1.0), double(i) / (visible_places - 1));
    };
    for (int row = 1; row < rows; ++row)
        visible_row(row, row < near_rows ? std::hypot(row % near_pixels, row / near_pixels) : radius_of(row - near_rows));
    rings_.resize(size_t(width) * size_t(height));
    for (int dy = 0; dy < height; ++dy)
        for (int dx = 0; dx < width; ++dx) {
            const double place = rings * (std::log2(std::max(std::hypot(dx, dy), 0.5)) + 1);
            rings_[size_t(dy) * width_ + size_t(dx)] = dx < near_pixels && dy < near_pixels
                                                           ? Ring{dy * near_pixels + dx, 0}
                                                           : Ring{near_rows + int(place), place - int(place)};
        }
}

// The surroundings, and what of each source's light stays within the image.
void CalibratedSplatting::prepare(const ReferenceFrame &frame)
{
    const SpreadSource source = source_of(frame.state, frame.scene);
    tabulate(frame, source);
    environment_ = environment_of(frame.scene);
    const int width = frame.state.width, height = frame.state.height;
    vec4 surroundings(0);
    for (const Source &s : sources_)
        surroundings += ambient_source(s.radiance, s.coverage);
    const vec3 root = vec3(surroundings) / std::max(surroundings.w, 1e-30);
    surroundings_ = root * root * root * root;
    // Sums over rectangles from the source's pixel on, per place: what falls into the image lies in four of them.
    const size_t row = size_t(width) + 1;
    std::vector<double> sums(row * (size_t(height) + 1));
    std::vector<double> within(sources_.size(), 0.0), everywhere(sources_.size(), 0.0);
    for (int q = 0; q < places; ++q) {
        const double place = q,
                     total = light_between(source, first_depth * std::exp2(place / finer_places), 0, std::numbers::pi);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const size_t i = (size_t(y) + 1) * row + size_t(x) + 1;
                sums[i] = spread(ring(x, y), place) + sums[i - 1] + sums[i - row] - sums[i - row - 1];
            }
        auto sum = [&](int x, int y) { return sums[size_t(y) * row + size_t(x)]; };
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const double weight = 1 - std::abs(sources_[frame.index(x, y)].place - place);
                if (weight <= 0)
                    continue;
                double all = 0;
                const int right = width - x, left = x + 1, below = height - y, above = y + 1;
                for (int h : {right, left})
                    for (int v : {below, above})
                        all += sum(h, v);
                // The axes were counted twice.
                all -= sum(right, 1) + sum(left, 1) + sum(1, below) + sum(1, above) - sum(1, 1);
                within[frame.index(x, y)] += weight * all;
                everywhere[frame.index(x, y)] += weight * total;
            }
    }
    for (size_t i = 0; i < sources_.size(); ++i) {
        const double outside = std::max(everywhere[i] / within[i] - 1, 0.0);
        const double kept = (1 + beyond_edges * outside) / everywhere[i];
        sources_[i].radiance *= kept;
        sources_[i].coverage *= kept;
    }
}

vec3 CalibratedSplatting::around(const ReferenceFrame &frame, int x, int y, double density) const
{
    if (!frame.state.surrounded)
        return surroundings_;
    const int order = environment_order(frame.scene);
    const vec3 direction = in_world(frame.camera, normalize(ray_through(frame.camera, vec2(x + 0.5, y + 0.5))));
    return environment_around(frame.medium, environment_degrees(environment_.texture(), order, direction), order, density);
}

void CalibratedSplatting::add_rows(const ReferenceFrame &frame, int first, int last, std::vector<vec3> &sum) const
{
    const int width = frame.state.width, height = frame.state.height;
    for (int y = first; y < last; ++y)
        for (int x = 0; x < width; ++x) {
            const double reach = sources_[frame.index(x, y)].reach;
            vec3 light(0), coverage(0);
            for (int sy = 0; sy < height; ++sy)
                for (int sx = 0; sx < width; ++sx) {
                    const Source &s = sources_[frame.index(sx, sy)];
                    const Ring &between = ring(sx - x, sy - y);
                    double weight = spread(between, s.place);
                    if (reach < s.reach)
                        weight *= visible_behind(between, reach / s.reach);
                    light += weight * s.radiance;
                    coverage += weight * s.coverage;
                }
            const Pixel pixel = frame.pixel_at(x, y);
            const vec3 kept = min(pixel.share / max(coverage, vec3(1e-35)), vec3(1));
            const vec3 surroundings = around(frame, x, y, pixel.density);
            const vec3 least = kept * light + max(pixel.share - coverage, vec3(0)) * surroundings;
            sum[frame.index(x, y - first)] =
                least +
                min(32.0 * pixel.share, vec3(1)) * max(light + (pixel.share - coverage) * surroundings - least, vec3(0));
        }
}

}  // namespace

std::unique_ptr<Splatting> calibrated_splatting(const State &state)
{
    return std::make_unique<CalibratedSplatting>(state);
}

}  // namespace multiscatter
