// Kernel `calibrated` on the CPU.
#include <algorithm>
#include <cstring>
#include <memory>
#include <utility>

#include "calibrated.h"
#include "calibrated_rows.h"
#include "common/pixels.hpp"
#include "lanes.hpp"

namespace multiscatter {
namespace {

namespace maths_float = brume::maths_float;

namespace generic {
using namespace brume::lanes_generic;
#include "calibrated_rows.inc"
}  // namespace generic

#ifdef BRUME_AVX2
BRUME_BEGIN_AVX2
namespace avx2 {
using namespace brume::lanes_avx2;
#include "calibrated_rows.inc"
}  // namespace avx2
BRUME_END_AVX2
#endif

const CalibratedRows &rows_of_this_machine()
{
#ifdef BRUME_AVX2
    if (brume::runs_avx2())
        return avx2::calibrated_rows;
#endif
    return generic::calibrated_rows;
}

class CpuPasses : public CalibratedPasses {
public:
    CpuPasses(const brume_services &services, brume_host host, const State &state, const brume_plugin_frame &frame)
        : services_(services), host_(host), state_(state),
          rows_(rows_of_this_machine()), frame_{state, *frame.scene, calibrated_of(state, *frame.scene, state.tabled),
                                                maths_float::medium_of(*frame.scene), maths_float::camera_of(*frame.scene)}
    {
    }

    brume_status map(const brume_plugin_frame &frame);

    brume_status spread() override
    {
        return run("scatter", state_.base().y, [&](int first, int last) { rows_.spread(frame_, first, last); });
    }
    brume_status share(int level) override
    {
        return run("downsample", level_at(state_, level).size.y,
                   [&](int first, int last) { rows_.share(frame_, level, first, last); });
    }
    brume_status smooth(int level) override
    {
        return run("smooth", level_at(state_, level).size.y,
                   [&](int first, int last) { rows_.smooth(frame_, level, first, last); });
    }
    brume_status collect() override
    {
        return run("collect", state_.base().y, [&](int first, int last) { rows_.collect(frame_, first, last); });
    }
    brume_status compose() override
    {
        return run("compose", state_.height, [&](int first, int last) { rows_.compose(frame_, first, last); });
    }

private:
    template <class Function> brume_status run(const char *pass, int rows, Function function)
    {
        return brume_pixels::for_ranges(services_, host_, pass, rows, 8, function);
    }

    const brume_services &services_;
    brume_host host_;
    const State &state_;
    const CalibratedRows &rows_;
    CalibratedFrame frame_;
};

brume_status CpuPasses::map(const brume_plugin_frame &frame)
{
    const std::pair<brume_plugin_image, brume_plugin_pixels *> images[] = {
        {frame.color, &frame_.color},
        {frame.depth, &frame_.depth},
        {frame.gaussian_density, &frame_.gaussian_density},
        {frame.lights, &frame_.lights},
        {frame.output, &frame_.output},
        {state_.radiance, &frame_.radiance},
        {state_.radiance_stack, &frame_.radiance_stack},
        {state_.coverage, &frame_.coverage},
        {state_.coverage_stack, &frame_.coverage_stack},
        {state_.smooth_radiance, &frame_.smooth_radiance},
        {state_.smooth_coverage, &frame_.smooth_coverage},
        {state_.ambient_stack, &frame_.ambient_stack},
        {state_.table, &frame_.table},
        {frame.transmittance, &frame_.transmittance},
        {frame.optical_depth, &frame_.optical_depth},
        {frame.scattered, &frame_.scattered},
        {frame.blur_radius, &frame_.blur_radius},
    };
    for (auto &[image, pixels] : images)
        if (image)
            if (brume_status s = services_.pixels(host_, image, pixels))
                return s;
    return BRUME_OK;
}

}  // namespace

std::unique_ptr<CalibratedPasses> calibrated_on_cpu(const brume_services &services, brume_host host, const State &state,
                                                    const brume_plugin_frame &frame, brume_status &status)
{
    auto passes = std::make_unique<CpuPasses>(services, host, state, frame);
    status = passes->map(frame);
    return passes;
}

}  // namespace multiscatter
