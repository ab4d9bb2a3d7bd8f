// Kernel `paper_reference`: exact splatting (Iser 2018 sec. 4.2 and Fig. 5f, as gathering).
//
// Each pixel's L_sc spreads by a Gaussian of its own W around its centre, integrated over the receiving pixels. The part
// that falls outside the image is lost, as light of sources outside is never seen. No pyramid, no masking.
#include <algorithm>
#include <cmath>

#include "reference/reference.h"

namespace multiscatter {
namespace {

using namespace brume::maths_double;

// Integral of the unit Gaussian around the centre of pixel `from` over pixel `to`.
double pixel_share(int from, int to, double deviation)
{
    if (deviation < 1e-3)
        return from == to ? 1.0 : 0.0;
    double scale = 1 / (std::sqrt(2.0) * deviation), d = to - from;
    return 0.5 * (std::erf((d + 0.5) * scale) - std::erf((d - 0.5) * scale));
}

// Beyond six deviations lie 2e-9 of a Gaussian.
int reach(double deviation, int limit)
{
    return int(std::min(std::ceil(6 * deviation + 0.5), double(limit)));
}

class PaperSplatting : public Splatting {
public:
    explicit PaperSplatting(const State &state) : sources_(size_t(state.width) * size_t(state.height)) {}

    void find_sources(const ReferenceFrame &frame, int first, int last) override
    {
        for (int y = first; y < last; ++y)
            for (int x = 0; x < frame.state.width; ++x) {
                Pixel pixel = frame.pixel_at(x, y);
                if (frame.state.beside_lights)
                    pixel.share =
                        share_beside_lights(frame.lights.texture(), frame.light_count, frame.state.beside_all_orders,
                                            frame.medium, frame.camera, vec2(x + 0.5, y + 0.5), pixel);
                sources_[frame.index(x, y)] = vec4(pixel.share * finite_or_zero(frame.color_at(x, y)), pixel.spread);
            }
    }

    void prepare(const ReferenceFrame &) override {}

    void add_rows(const ReferenceFrame &frame, int first, int last, std::vector<vec3> &sum) const override
    {
        const int width = frame.state.width, height = frame.state.height;
        std::vector<double> across(static_cast<size_t>(width));
        for (int sy = 0; sy < height; ++sy)
            for (int sx = 0; sx < width; ++sx) {
                const vec4 &source = sources_[frame.index(sx, sy)];
                int r = reach(source.w, std::max(width, height));
                int y0 = std::max(first, sy - r), y1 = std::min(last, sy + r + 1);
                if (y0 >= y1 || (source.x == 0 && source.y == 0 && source.z == 0))
                    continue;
                int x0 = std::max(0, sx - r), x1 = std::min(width, sx + r + 1);
                for (int x = x0; x < x1; ++x)
                    across[size_t(x)] = pixel_share(sx, x, source.w);
                for (int y = y0; y < y1; ++y) {
                    vec3 row = vec3(source) * pixel_share(sy, y, source.w);
                    vec3 *to = sum.data() + size_t(y - first) * size_t(width);
                    for (int x = x0; x < x1; ++x)
                        to[x] += row * across[size_t(x)];
                }
            }
    }

private:
    std::vector<vec4> sources_;  // RGB: L_sc, A: W
};

}  // namespace

std::unique_ptr<Splatting> paper_splatting(const State &state)
{
    return std::make_unique<PaperSplatting>(state);
}

}  // namespace multiscatter
