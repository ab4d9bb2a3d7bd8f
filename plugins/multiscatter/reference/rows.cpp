#include "reference/reference.h"

#include "pass_tables.hpp"
#include "pixels.hpp"

namespace multiscatter {

using namespace brume::maths_double;
using brume_pixels::at;

vec3 ReferenceFrame::color_at(int x, int y) const
{
    const float *v = at(slots[reference_pass::color], x, y);
    return vec3(v[0], v[1], v[2]);
}

Pixel ReferenceFrame::pixel_at(int x, int y) const
{
    const float *texel = at(slots[reference_pass::density], x, y);
    const vec2 density(texel[0], texel[1]);
    const brume_plugin_pixels &rgb = slots[reference_pass::density_rgb],
                              &gaussians = slots[reference_pass::gaussian_density];
    const float *each = rgb.data ? at(rgb, x, y) : nullptr;
    const Pixel pixel = each ? pixel_in_layer(medium, camera, density, vec3(each[0], each[1], each[2]))
                             : pixel_in_medium(medium, camera, density);
    return placed_pixel(pixel, medium, camera, filter, vec2(x + 0.5, y + 0.5), density,
                        gaussians.data ? double(at(gaussians, x, y)[1]) : 0);
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
    using namespace reference_pass;
    std::vector<vec3> sum(size_t(frame.state.width) * size_t(last - first), vec3(0));
    splatting.add_rows(frame, first, last, sum);
    for (int y = first; y < last; ++y)
        for (int x = 0; x < frame.state.width; ++x) {
            const Pixel pixel = frame.pixel_at(x, y);
            const vec3 added = pixel.emitted + sum[frame.index(x, y - first)];
            const float *in = at(frame.slots[color], x, y),
                        *rgb = frame.slots[density_rgb].data ? at(frame.slots[density_rgb], x, y) : nullptr;
            store(frame.slots[result], x, y,
                  compose_radiance(frame.color_at(x, y), pixel.transmittance, added, frame.scene.output_limit), in[3]);
            store(frame.slots[transmittance_out], x, y, pixel.transmittance, 1);
            store(frame.slots[optical_depth_out], x, y,
                  rgb ? optical_depth(frame.medium, vec3(rgb[0], rgb[1], rgb[2]))
                      : optical_depth(frame.medium, pixel.density),
                  1);
            store(frame.slots[scattered_out], x, y, added, 1);
            store(frame.slots[blur_radius_out], x, y, vec3(pixel.spread), 1);
        }
}

// Both passes' user.
struct Job {
    ReferenceFrame frame;
    std::unique_ptr<Splatting> splatting;
};

ReferenceFrame frame_of(const Job &job, const brume_plugin_rows &call)
{
    ReferenceFrame frame = job.frame;
    frame.slots = call.slots;
    return frame;
}

}  // namespace

brume_status plan_reference_passes(const brume_services &services, brume_host host, State &state)
{
    using namespace brume_passes;
    static constexpr brume_slot slots[] = {
        fetch("color"),         fetch("density"),        fetch("density_rgb"),       fetch("gaussian_density"),
        fetch("lights"),        write("result"),         write("transmittance_out"), write("optical_depth_out"),
        write("scattered_out"), write("blur_radius_out")};
    brume_pass_desc desc{};
    desc.struct_size = sizeof desc;
    desc.name = "reference";
    desc.slots = slots;
    desc.slot_count = uint32_t(std::size(slots));
    desc.grain = 8;
    desc.rows = [](const brume_plugin_rows *call, int32_t first, int32_t last) {
        const Job &job = *static_cast<const Job *>(call->user);
        job.splatting->find_sources(frame_of(job, *call), first, last);
        return brume_status(BRUME_OK);
    };
    if (brume_status s = services.create_pass(host, &desc, &state.find_sources))
        return s;
    desc.rows = [](const brume_plugin_rows *call, int32_t first, int32_t last) {
        const Job &job = *static_cast<const Job *>(call->user);
        compose_rows(frame_of(job, *call), *job.splatting, first, last);
        return brume_status(BRUME_OK);
    };
    return services.create_pass(host, &desc, &state.compose);
}

brume_status execute_reference(const brume_services &services, brume_host host, const State &state,
                               const brume_plugin_frame &frame)
{
    std::vector<float> spheres;
    for (const brume_plugin_light &light : brume::lights_in(*frame.scene))
        if (light.radius > 0)
            spheres.insert(spheres.end(), {light.position[0], light.position[1], light.position[2], light.radius});
    const ReferenceFrame seen{.state = state,
                              .scene = *frame.scene,
                              .medium = medium_of(*frame.scene),
                              .camera = camera_of(*frame.scene),
                              .lights = Data(spheres.data(), spheres.size() / 4, 4),
                              .light_count = int(spheres.size() / 4)};
    Job job{seen, (state.parameters.kernel == Kernel::reference ? calibrated_splatting : paper_splatting)(state)};
    job.frame.filter.placement = state.parameters.filter.placement;
    const brume_plugin_image images[] = {frame.color,
                                         image_of(frame, use_density),
                                         image_of(frame, use_density_rgb),
                                         image_of(frame, use_gaussian_density),
                                         image_of(frame, use_visible_lights),
                                         frame.output,
                                         frame.layers[layer_transmittance].image,
                                         frame.layers[layer_optical_depth].image,
                                         frame.layers[layer_scattered].image,
                                         frame.layers[layer_blur_radius].image};
    if (brume_status s = services.run(host, state.find_sources, images, nullptr, state.width, state.height, &job))
        return s;
    job.splatting->prepare(job.frame);
    return services.run(host, state.compose, images, nullptr, state.width, state.height, &job);
}

}  // namespace multiscatter
