#include "media/fit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace brume::tool {
namespace {

constexpr double kReach = 3.5;        // in radii; beyond it a Gaussian is 5e-6 of its amplitude
constexpr double kLeastRadius = 0.6;  // [voxel]; finer ones fall between the samples
constexpr double kCellsPerRadius = 4;
constexpr int kSweeps = 6, kLastSweeps = 24;
constexpr double kProgress = 0.9999;  // a round that leaves more of the residual than this is the last
constexpr double kWorthwhile = 1e-3;  // share of the error that another sweep must take away

struct Box {
    std::array<int, 3> from, to;  // `to` is not inside
};

Box joined(const Box &a, const Box &b)
{
    Box box;
    for (std::size_t i = 0; i < 3; ++i) {
        box.from[i] = std::min(a.from[i], b.from[i]);
        box.to[i] = std::max(a.to[i], b.to[i]);
    }
    return box;
}

// A Gaussian over a box of the lattice, as the product of three lists.
class Samples {
public:
    Samples(const FittedGaussian &g, const Box &box) : box_(box)
    {
        for (std::size_t i = 0; i < 3; ++i)
            for (int x = box.from[i]; x < box.to[i]; ++x) {
                const double d = g.scale * (x - g.center[i]);
                list_[i].push_back(std::exp(-d * d));
            }
    }
    double across(int y, int z) const
    {
        return list_[1][std::size_t(y - box_.from[1])] * list_[2][std::size_t(z - box_.from[2])];
    }
    double along(int x) const { return list_[0][std::size_t(x - box_.from[0])]; }

private:
    Box box_;
    std::vector<double> list_[3];
};

// Solves the symmetric positive system a x = b in place by Cholesky's decomposition; false where it is not positive.
constexpr std::size_t kUnknowns = 5;
using Row = std::array<double, kUnknowns>;
using Matrix = std::array<Row, kUnknowns>;

bool solve(Matrix a, Row &x)
{
    for (std::size_t i = 0; i < kUnknowns; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            double sum = a[i][j];
            for (std::size_t k = 0; k < j; ++k)
                sum -= a[i][k] * a[j][k];
            if (i == j && !(sum > 0))
                return false;
            a[i][j] = i == j ? std::sqrt(sum) : sum / a[j][j];
        }
    }
    for (std::size_t i = 0; i < kUnknowns; ++i) {
        for (std::size_t k = 0; k < i; ++k)
            x[i] -= a[i][k] * x[k];
        x[i] /= a[i][i];
    }
    for (std::size_t i = kUnknowns; i-- > 0;) {
        for (std::size_t k = i + 1; k < kUnknowns; ++k)
            x[i] -= a[k][i] * x[k];
        x[i] /= a[i][i];
    }
    return true;
}

// A grid and its means over cells of 2^3, 4^3, ...; what does not fill a cell counts as empty.
class Pyramid {
public:
    explicit Pyramid(const DensityGrid &grid) : levels_{grid}
    {
        while (longest(levels_.back()) > 2) {
            DensityGrid half;
            for (std::size_t i = 0; i < 3; ++i)
                half.size[i] = (levels_.back().size[i] + 1) / 2;
            half.values.resize(half.index(0, 0, half.size[2]));
            levels_.push_back(std::move(half));
        }
        update({{0, 0, 0}, grid.size});
    }

    const std::vector<DensityGrid> &levels() const { return levels_; }

    // Visits the finest rows within the box, which may be changed.
    template <class Visit> void change(Box box, Visit visit)
    {
        DensityGrid &grid = levels_.front();
        for (int z = box.from[2]; z < box.to[2]; ++z)
            for (int y = box.from[1]; y < box.to[1]; ++y)
                visit(y, z, grid.values.data() + grid.index(0, y, z));
        update(box);
    }

private:
    static int longest(const DensityGrid &grid) { return *std::max_element(grid.size.begin(), grid.size.end()); }

    void update(Box box)
    {
        for (std::size_t level = 1; level < levels_.size(); ++level) {
            const DensityGrid &fine = levels_[level - 1];
            DensityGrid &coarse = levels_[level];
            for (std::size_t i = 0; i < 3; ++i) {
                box.from[i] /= 2;
                box.to[i] = (box.to[i] + 1) / 2;
            }
            for (int z = box.from[2]; z < box.to[2]; ++z)
                for (int y = box.from[1]; y < box.to[1]; ++y)
                    for (int x = box.from[0]; x < box.to[0]; ++x) {
                        float sum = 0;
                        for (int k = 2 * z; k < std::min(2 * z + 2, fine.size[2]); ++k)
                            for (int j = 2 * y; j < std::min(2 * y + 2, fine.size[1]); ++j)
                                for (int i = 2 * x; i < std::min(2 * x + 2, fine.size[0]); ++i)
                                    sum += fine.values[fine.index(i, j, k)];
                        coarse.values[coarse.index(x, y, z)] = sum / 8;
                    }
        }
    }

    std::vector<DensityGrid> levels_;
};

// In the lattice of a level, whose first point is the middle of the first 2^level of the finest.
FittedGaussian to_level(FittedGaussian g, std::size_t level)
{
    const double cell = double(std::size_t(1) << level);
    for (double &x : g.center)
        x = (x + 0.5) / cell - 0.5;
    g.scale *= cell;
    return g;
}

Box box_of(const FittedGaussian &g, const DensityGrid &grid)
{
    Box box;
    for (std::size_t i = 0; i < 3; ++i) {
        const double reach = kReach / g.scale;
        box.from[i] = int(std::clamp(std::ceil(g.center[i] - reach), 0.0, double(grid.size[i])));
        box.to[i] = int(std::clamp(std::floor(g.center[i] + reach) + 1, 0.0, double(grid.size[i])));
    }
    return box;
}

class Fitter {
public:
    explicit Fitter(const DensityGrid &grid) : rest_(grid), total_(error()) {}

    double error() const
    {
        double sum = 0;
        for (const float value : rest_.levels().front().values)
            sum += double(value) * value;
        return sum;
    }
    double residual() const { return total_ > 0 ? std::sqrt(error() / total_) : 0; }
    const std::vector<FittedGaussian> &gaussians() const { return gaussians_; }

    // Adds up to `most` where they explain the most of the rest.
    void place(std::size_t most);

    // Improves each in its turn until that is no longer worthwhile.
    void refine(int sweeps)
    {
        double before = error();
        for (int i = 0; i < sweeps; ++i) {
            for (FittedGaussian &g : gaussians_)
                improve(g);
            const double after = error();
            if (after > (1 - kWorthwhile) * before)
                break;
            before = after;
        }
        std::erase_if(gaussians_, [&](const FittedGaussian &g) {
            const Box box = box_of(g, rest_.levels().front());
            const bool outside = box.from[0] >= box.to[0] || box.from[1] >= box.to[1] || box.from[2] >= box.to[2];
            return g.amplitude <= 0 || outside;
        });
    }

private:
    void improve(FittedGaussian &g);
    bool try_step(FittedGaussian &g, const Row &step, std::size_t level);

    // The cells that are fine enough for this one: its steps cost the same whatever its size.
    std::size_t level_of(const FittedGaussian &g) const
    {
        std::size_t level = 0;
        while (level + 1 < rest_.levels().size() && double(std::size_t(2) << level) * kCellsPerRadius * g.scale <= 1)
            ++level;
        return level;
    }

    void replace(const FittedGaussian &from, const FittedGaussian &to)
    {
        const DensityGrid &grid = rest_.levels().front();
        const Box box = joined(box_of(from, grid), box_of(to, grid));
        const Samples was(from, box), is(to, box);
        rest_.change(box, [&](int y, int z, float *row) {
            const double a = from.amplitude * was.across(y, z), b = to.amplitude * is.across(y, z);
            for (int x = box.from[0]; x < box.to[0]; ++x)
                row[x] = float(row[x] + a * was.along(x) - b * is.along(x));
        });
    }

    Pyramid rest_;  // the grid less the Gaussians
    std::vector<FittedGaussian> gaussians_;
    double total_;
};

// One step of Levenberg and Marquardt in the centre, the logarithm of the scale, and the amplitude.
void Fitter::improve(FittedGaussian &g)
{
    const std::size_t level = level_of(g);
    const DensityGrid &grid = rest_.levels()[level];
    const FittedGaussian at_level = to_level(g, level);
    const Box box = box_of(at_level, grid);
    const Samples samples(at_level, box);
    Matrix normal{};
    Row gradient{};
    const double a2 = at_level.scale * at_level.scale;
    for (int z = box.from[2]; z < box.to[2]; ++z)
        for (int y = box.from[1]; y < box.to[1]; ++y) {
            const double across = samples.across(y, z), dy = y - at_level.center[1], dz = z - at_level.center[2];
            const float *row = grid.values.data() + grid.index(0, y, z);
            for (int x = box.from[0]; x < box.to[0]; ++x) {
                const double k = across * samples.along(x), dx = x - at_level.center[0];
                const double slope = 2 * a2 * g.amplitude * k;
                const Row j{slope * dx, slope * dy, slope * dz, -slope * (dx * dx + dy * dy + dz * dz), k};
                for (std::size_t m = 0; m < kUnknowns; ++m) {
                    gradient[m] += j[m] * row[x];
                    for (std::size_t n = 0; n <= m; ++n)
                        normal[m][n] += j[m] * j[n];
                }
            }
        }
    for (const double damping : {1e-3, 1e-1, 10.0}) {
        Matrix damped = normal;
        for (std::size_t m = 0; m < kUnknowns; ++m)
            damped[m][m] *= 1 + damping;
        Row step = gradient;
        if (solve(damped, step) && try_step(g, step, level))
            return;
    }
}

bool Fitter::try_step(FittedGaussian &g, const Row &step, std::size_t level)
{
    const double cell = double(std::size_t(1) << level), radius = 1 / g.scale;
    FittedGaussian next = g;
    for (std::size_t i = 0; i < 3; ++i)
        next.center[i] += std::clamp(cell * step[i], -0.5 * radius, 0.5 * radius);
    next.scale = std::min(g.scale * std::exp(std::clamp(step[3], -0.4, 0.4)), 1 / kLeastRadius);
    next.amplitude = std::max(0.0, g.amplitude + step[4]);

    // What the change does to the sum of squares: of a cell it needs the mean only.
    const DensityGrid &grid = rest_.levels()[level];
    const FittedGaussian from = to_level(g, level), to = to_level(next, level);
    const Box box = joined(box_of(from, grid), box_of(to, grid));
    const Samples was(from, box), is(to, box);
    double gain = 0;
    for (int z = box.from[2]; z < box.to[2]; ++z)
        for (int y = box.from[1]; y < box.to[1]; ++y) {
            const double a = from.amplitude * was.across(y, z), b = to.amplitude * is.across(y, z);
            const float *row = grid.values.data() + grid.index(0, y, z);
            for (int x = box.from[0]; x < box.to[0]; ++x) {
                const double change = a * was.along(x) - b * is.along(x);
                gain -= change * (2 * row[x] + change);
            }
        }
    if (!(gain > 0))
        return false;
    replace(g, next);
    g = next;
    return true;
}

struct Candidate {
    FittedGaussian gaussian;
    double gain;
};

// Gaussians of a cell's radius at the cells where they explain more than at the neighbours.
void find_candidates(const DensityGrid &level, double cell, std::vector<Candidate> &candidates)
{
    double weight[3][3][3], norm = 0;
    for (int z = 0; z < 3; ++z)
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < 3; ++x) {
                weight[z][y][x] = std::exp(-double((x - 1) * (x - 1) + (y - 1) * (y - 1) + (z - 1) * (z - 1)));
                norm += weight[z][y][x] * weight[z][y][x];
            }
    const auto [w, h, d] = level.size;
    DensityGrid match{level.size, std::vector<float>(level.values.size())};
    const auto neighbours = [&](int x, int y, int z, auto visit) {
        for (int k = std::max(z - 1, 0); k <= std::min(z + 1, d - 1); ++k)
            for (int j = std::max(y - 1, 0); j <= std::min(y + 1, h - 1); ++j)
                for (int i = std::max(x - 1, 0); i <= std::min(x + 1, w - 1); ++i)
                    visit(i, j, k, weight[k - z + 1][j - y + 1][i - x + 1]);
    };
    const auto for_cells = [&](auto visit) {
        for (int z = 0; z < d; ++z)
            for (int y = 0; y < h; ++y)
                for (int x = 0; x < w; ++x)
                    visit(x, y, z);
    };
    for_cells([&](int x, int y, int z) {
        double sum = 0;
        neighbours(x, y, z, [&](int i, int j, int k, double weight) { sum += weight * level.values[level.index(i, j, k)]; });
        match.values[match.index(x, y, z)] = float(sum / norm);
    });
    for_cells([&](int x, int y, int z) {
        const float here = match.values[match.index(x, y, z)];
        bool peak = here > 0;
        double mass = 0;
        std::array<double, 3> moment{};
        neighbours(x, y, z, [&](int i, int j, int k, double weight) {
            peak = peak && match.values[match.index(i, j, k)] <= here;
            const double share = weight * std::max(0.0f, level.values[level.index(i, j, k)]);
            mass += share;
            moment[0] += share * i;
            moment[1] += share * j;
            moment[2] += share * k;
        });
        if (!peak || mass <= 0)
            return;
        FittedGaussian g{{}, 1 / std::max(cell, kLeastRadius), here};
        // Of the cell's samples, which begin at its first corner.
        for (std::size_t i = 0; i < 3; ++i)
            g.center[i] = (moment[i] / mass + 0.5) * cell - 0.5;
        candidates.push_back({g, double(here) * here * norm * cell * cell * cell});
    });
}

void Fitter::place(std::size_t most)
{
    std::vector<Candidate> candidates;
    for (std::size_t level = 0; level < rest_.levels().size(); ++level)
        find_candidates(rest_.levels()[level], double(std::size_t(1) << level), candidates);
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate &a, const Candidate &b) { return a.gain > b.gain; });
    std::vector<FittedGaussian> placed;
    for (const Candidate &candidate : candidates) {
        if (placed.size() == most)
            break;
        // What a better one beside it explains is not there to be explained again.
        const FittedGaussian &g = candidate.gaussian;
        const bool taken = std::any_of(placed.begin(), placed.end(), [&](const FittedGaussian &other) {
            double square = 0;
            for (std::size_t i = 0; i < 3; ++i)
                square += (g.center[i] - other.center[i]) * (g.center[i] - other.center[i]);
            const double reach = std::max(1 / g.scale, 1 / other.scale);
            return square < reach * reach;
        });
        if (!taken)
            placed.push_back(g);
    }
    for (const FittedGaussian &g : placed) {
        FittedGaussian nothing = g;
        nothing.amplitude = 0;
        replace(nothing, g);
        gaussians_.push_back(g);
    }
}

}  // namespace

Fit fit_gaussians(const DensityGrid &grid, std::size_t most, double error)
{
    Fitter fitter(grid);
    double before = INFINITY;
    while (fitter.gaussians().size() < most && fitter.residual() > error && fitter.residual() < kProgress * before) {
        before = fitter.residual();
        const std::size_t count = fitter.gaussians().size();
        fitter.place(std::min(most - count, count / 2 + 1));
        fitter.refine(kSweeps);
    }
    fitter.refine(kLastSweeps);

    Fit fit{fitter.gaussians(), fitter.residual(), 0};
    double mass = 0, fitted = 0;
    for (const float value : grid.values)
        mass += value;
    for (const FittedGaussian &g : fit.gaussians)
        fitted += g.amplitude * std::pow(std::numbers::pi, 1.5) / (g.scale * g.scale * g.scale);
    fit.mass_error = mass > 0 ? fitted / mass - 1 : 0;
    return fit;
}

}  // namespace brume::tool
