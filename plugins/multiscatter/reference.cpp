#include "reference.h"

#include <utility>

namespace multiscatter {

using namespace brume::maths_double;

vec3 ReferenceFrame::color_at(int x, int y) const
{
    const float *v = color.data + y * color.row_stride + int64_t(x) * 4;
    return vec3(v[0], v[1], v[2]);
}

double ReferenceFrame::depth_at(int x, int y) const
{
    return depth.data[y * depth.row_stride + x];
}

Pixel ReferenceFrame::pixel_at(int x, int y) const
{
    const brume_plugin_pixels &g = gaussian_density;
    vec2 gaussians(0);
    if (const float *v = g.data ? g.data + y * g.row_stride + int64_t(x) * g.channels : nullptr)
        gaussians = vec2(v[0], v[1]);
    return placed_pixel(medium, camera, filter, vec2(x + 0.5, y + 0.5), depth_at(x, y), gaussians);
}

namespace {

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

void compose_rows(const ReferenceFrame &frame, const Splatting &splatting, int first, int last)
{
    std::vector<vec3> sum(size_t(frame.state.width) * size_t(last - first), vec3(0));
    splatting.add_rows(frame, first, last, sum);
    for (int y = first; y < last; ++y)
        for (int x = 0; x < frame.state.width; ++x) {
            const Pixel pixel = frame.pixel_at(x, y);
            const vec3 added = pixel.emitted + sum[frame.index(x, y - first)];
            const float *in = frame.color.data + y * frame.color.row_stride + int64_t(x) * 4;
            store(frame.output, x, y,
                  compose_radiance(frame.color_at(x, y), pixel.transmittance, added, frame.scene.output_limit), in[3]);
            store(frame.transmittance, x, y, pixel.transmittance, 1);
            store(frame.optical_depth, x, y, optical_depth(frame.medium, pixel.density), 1);
            store(frame.scattered, x, y, added, 1);
            store(frame.blur_radius, x, y, vec3(pixel.spread), 1);
        }
}

}  // namespace

brume_status execute_reference(const brume_services &services, brume_host host, const State &state,
                               const brume_plugin_frame &frame)
{
    ReferenceFrame seen{.state = state,
                        .scene = *frame.scene,
                        .medium = medium_of(*frame.scene),
                        .camera = camera_of(*frame.scene),
                        .lights = lights_of(*frame.scene)};
    seen.filter.placement = state.parameters.filter.placement;
    const std::pair<brume_plugin_image, brume_plugin_pixels *> images[] = {
        {frame.color, &seen.color},
        {frame.depth, &seen.depth},
        {frame.gaussian_density, &seen.gaussian_density},
        {frame.output, &seen.output},
        {frame.transmittance, &seen.transmittance},
        {frame.optical_depth, &seen.optical_depth},
        {frame.scattered, &seen.scattered},
        {frame.blur_radius, &seen.blur_radius},
    };
    for (auto &[image, pixels] : images)
        if (image)
            if (brume_status s = services.pixels(host, image, pixels))
                return s;
    const std::unique_ptr<Splatting> splatting =
        (state.parameters.kernel == Kernel::reference ? calibrated_splatting : paper_splatting)(state);
    auto rows = [&](auto function) {
        return services.rows(
            host, "reference", state.height, 8,
            [](void *user, int32_t first, int32_t last) {
                (*static_cast<decltype(function) *>(user))(first, last);
                return brume_status(BRUME_OK);
            },
            &function);
    };
    if (brume_status s = rows([&](int first, int last) { splatting->find_sources(seen, first, last); }))
        return s;
    splatting->prepare(seen);
    return rows([&](int first, int last) { compose_rows(seen, *splatting, first, last); });
}

}  // namespace multiscatter
