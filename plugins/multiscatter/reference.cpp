// Kernel `reference`: exact splatting (Iser 2018 sec. 4.2 and Fig. 5f, as gathering), in double, on the CPU.
//
// Each pixel's L_sc spreads by a Gaussian of its own W around its centre, integrated over the receiving pixels. The part
// that falls outside the image is lost, as light of sources outside is never seen. No pyramid, no masking: what the
// hierarchical kernels approximate.
#include <algorithm>
#include <cmath>
#include <vector>

#include "state.h"

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

struct Job {
    const State &state;
    Medium medium;
    Camera camera;
    Filter filter;
    double output_limit;
    brume_plugin_pixels color{}, depth{}, gaussian_density{}, output{}, transmittance{}, optical_depth{}, scattered{}, blur_radius{};
    Data lights;
    int light_count = 0;
    std::vector<vec4> sources{};  // RGB: L_sc, A: W
};

vec3 color_at(const Job &job, int x, int y)
{
    const float *v = job.color.data + y * job.color.row_stride + int64_t(x) * 4;
    return vec3(v[0], v[1], v[2]);
}

double depth_at(const Job &job, int x, int y)
{
    return job.depth.data[y * job.depth.row_stride + x];
}

Pixel pixel_at(const Job &job, int x, int y)
{
    const brume_plugin_pixels &g = job.gaussian_density;
    vec2 gaussians(0);
    if (const float *v = g.data ? g.data + y * g.row_stride + int64_t(x) * g.channels : nullptr)
        gaussians = vec2(v[0], v[1]);
    return pixel_in_medium(job.medium, job.camera, job.filter, vec2(x + 0.5, y + 0.5), depth_at(job, x, y), gaussians);
}

void store(const brume_plugin_pixels &p, int x, int y, vec3 v, double alpha)
{
    if (!p.data)
        return;
    float *to = p.data + y * p.row_stride + int64_t(x) * p.channels;
    to[0] = float(v.x);
    if (p.channels == 4) {
        to[1] = float(v.y);
        to[2] = float(v.z);
        to[3] = float(alpha);
    }
}

void find_sources(Job &job, int first, int last)
{
    for (int y = first; y < last; ++y)
        for (int x = 0; x < job.state.width; ++x) {
            Pixel pixel = pixel_at(job, x, y);
            if (job.state.beside_lights)
                pixel.share = share_beside_lights(job.lights.texture(), job.light_count, job.medium, job.camera,
                                                  vec2(x + 0.5, y + 0.5), depth_at(job, x, y), pixel);
            job.sources[size_t(y) * size_t(job.state.width) + size_t(x)] =
                vec4(pixel.share * finite_or_zero(color_at(job, x, y)), pixel.spread);
        }
}

// One block of receiving rows takes from every source in the same order, so blocks may run on any thread.
void splat_rows(const Job &job, int first, int last)
{
    const int width = job.state.width, height = job.state.height;
    std::vector<vec3> sum(size_t(width) * size_t(last - first), vec3(0));
    std::vector<double> across(static_cast<size_t>(width));
    for (int sy = 0; sy < height; ++sy)
        for (int sx = 0; sx < width; ++sx) {
            const vec4 &source = job.sources[size_t(sy) * size_t(width) + size_t(sx)];
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
    for (int y = first; y < last; ++y)
        for (int x = 0; x < width; ++x) {
            Pixel pixel = pixel_at(job, x, y);
            vec3 added = pixel.emitted + sum[size_t(y - first) * size_t(width) + size_t(x)];
            const float *in = job.color.data + y * job.color.row_stride + int64_t(x) * 4;
            store(job.output, x, y, compose_radiance(color_at(job, x, y), pixel.transmittance, added, job.output_limit),
                  in[3]);
            store(job.transmittance, x, y, pixel.transmittance, 1);
            store(job.optical_depth, x, y, optical_depth(job.medium, pixel.density), 1);
            store(job.scattered, x, y, added, 1);
            store(job.blur_radius, x, y, vec3(pixel.spread), 1);
        }
}

}  // namespace

brume_status execute_reference(const brume_services &services, brume_host host, const State &state,
                               const brume_plugin_frame &frame)
{
    Job job{.state = state,
            .medium = medium_of(*frame.scene),
            .camera = camera_of(*frame.scene),
            .filter = {},
            .output_limit = frame.scene->output_limit,
            .lights = lights_of(*frame.scene),
            .light_count = int(frame.scene->light_count)};
    job.filter.placement = state.parameters.filter.placement;
    const std::pair<brume_plugin_image, brume_plugin_pixels *> images[] = {
        {frame.color, &job.color},
        {frame.depth, &job.depth},
        {frame.gaussian_density, &job.gaussian_density},
        {frame.output, &job.output},
        {frame.transmittance, &job.transmittance},
        {frame.optical_depth, &job.optical_depth},
        {frame.scattered, &job.scattered},
        {frame.blur_radius, &job.blur_radius},
    };
    for (auto &[image, pixels] : images)
        if (image)
            if (brume_status s = services.pixels(host, image, pixels))
                return s;
    job.sources.resize(size_t(state.width) * size_t(state.height));
    auto rows = [&](auto function) {
        struct Call {
            Job &job;
            decltype(function) f;
        } call{job, function};
        return services.rows(
            host, "reference", state.height, 8,
            [](void *user, int32_t first, int32_t last) {
                auto *c = static_cast<Call *>(user);
                c->f(c->job, first, last);
                return brume_status(BRUME_OK);
            },
            &call);
    };
    if (brume_status s = rows(find_sources))
        return s;
    return rows(splat_rows);
}

}  // namespace multiscatter
