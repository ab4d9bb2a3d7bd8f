// Ways to keep what a light's ray has come through, at equal bytes for each texel of an attenuation map: how far off the
// transmittance is, for which medium, and what building and fetching take on one thread.
//
//   map_bases [VALUES]...   values of 32 bits for each texel; 16 and 64
#include <cstdlib>
#include <ctime>
#include <random>

#include <fmt/format.h>

#include "map_bases.h"

namespace {

using namespace map_bases;

// Density along a ray: an even part within [from, to], and puffs.
struct Line {
    struct Puff {
        float middle, radius, depth;
    };
    float from = 0, to = 1, even = 0;  // depth of the even part
    std::vector<Puff> puffs;

    float tau(float z) const
    {
        float sum = even * std::clamp((z - from) / (to - from), 0.0f, 1.0f);
        for (const Puff &p : puffs)
            sum += 0.5f * p.depth * (std::erf((z - p.middle) / p.radius) - std::erf(-p.middle / p.radius));
        return sum;
    }
    float density(float z) const
    {
        float sum = z >= from && z <= to ? even / (to - from) : 0;
        for (const Puff &p : puffs) {
            const float x = (z - p.middle) / p.radius;
            sum += p.depth / (1.7724539f * p.radius) * std::exp(-x * x);
        }
        return sum;
    }
};

using Random = std::mt19937;

float uniform(Random &random, float a, float b)
{
    return a + (b - a) * float(random() % 65536u) / 65536.0f;
}

Line even(Random &random, float width, float depth)
{
    Line line;
    line.from = uniform(random, 0, 1 - width);
    line.to = line.from + width;
    line.even = depth;
    return line;
}

Line puffs(Random &random, int count, float least, float most, float depth)
{
    Line line;
    for (int i = 0; i < count; ++i)
        line.puffs.push_back(
            {uniform(random, 0.2f, 0.9f), uniform(random, least, most), depth / float(count) * uniform(random, 0.5f, 1.5f)});
    return line;
}

struct Medium {
    const char *name;
    Line (*draw)(Random &);
};
constexpr Medium media[] = {{"homogeneous", [](Random &r) { return even(r, 1, 2); }},
                            {"slab", [](Random &r) { return even(r, 0.3f, 2); }},
                            {"thin sheet", [](Random &r) { return puffs(r, 1, 0.005f, 0.01f, 1.5f); }},
                            {"few puffs", [](Random &r) { return puffs(r, 3, 0.02f, 0.1f, 2); }},
                            {"many puffs", [](Random &r) { return puffs(r, 30, 0.03f, 0.1f, 2); }},
                            {"dense", [](Random &r) { return puffs(r, 30, 0.03f, 0.1f, 10); }}};

constexpr int rays = 100, places = 1000;

// Of this process: other work on the machine does not count.
double nanoseconds()
{
    return 1e9 * double(std::clock()) / CLOCKS_PER_SEC;
}

void measure(const Basis &basis, int values)
{
    std::string errors;
    double build = 0, fetch = 0;
    float kept = 0;
    for (const Medium &medium : media) {
        Random random(1);
        std::vector<Line> lines;
        for (int ray = 0; ray < rays; ++ray)
            lines.push_back(medium.draw(random));
        std::vector<Values> texels;
        double start = nanoseconds();
        for (const Line &line : lines)
            texels.push_back(basis.build(
                values, [&](float z) { return line.tau(z); }, [&](float z) { return line.density(z); }));
        build += (nanoseconds() - start) / (rays * std::size(media));
        start = nanoseconds();
        for (const Values &v : texels)
            for (int i = 0; i < places; ++i)
                kept += basis.transmittance(v, (float((i * 619) % places) + 0.5f) / places);
        fetch += (nanoseconds() - start) / (double(rays) * places * std::size(media));
        double square = 0;
        float most = 0;
        for (size_t ray = 0; ray < texels.size(); ++ray)
            for (int i = 0; i < places; ++i) {
                const float z = (float(i) + 0.5f) / places,
                            error = std::abs(basis.transmittance(texels[ray], z) - std::exp(-lines[ray].tau(z)));
                square += double(error) * error / (rays * places);
                most = std::max(most, error);
            }
        errors += fmt::format(" | {:.4f}, {:.3f}", std::sqrt(square), most);
    }
    volatile float used = kept;
    static_cast<void>(used);
    fmt::print("| {} | {}{} | {:.0f} | {:.0f} |\n", 4 * values, basis.name, errors, fetch, build / 1000);
}

}  // namespace

int main(int argc, char **argv)
{
    std::string head, rule;
    for (const Medium &medium : media) {
        head += fmt::format(" {} |", medium.name);
        rule += " --- |";
    }
    fmt::print("| bytes | basis |{} fetch ns | build us |\n| ---: | --- |{} ---: | ---: |\n", head, rule);
    std::vector<int> sizes;
    for (int i = 1; i < argc; ++i)
        sizes.push_back(std::max(std::atoi(argv[i]), 6));
    if (sizes.empty())
        sizes = {16, 64};
    for (int values : sizes)
        for (const Basis &basis : all())
            measure(basis, values);
}
