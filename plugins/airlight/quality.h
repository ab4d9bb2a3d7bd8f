#pragma once
// How finely the tier `nodes` integrates for the relative error that is asked of it; measured by airlight_accuracy.

namespace brume::airlight {

// Settings: AirlightSettings of either precision. max_error: .00001 to .5.
template <class Settings> void set_quality(Settings &settings, double max_error)
{
    using Real = decltype(settings.tolerance);
    settings.tolerance = Real(0.3 * max_error);
    settings.panels = max_error > 0.05 ? 4 : max_error >= 0.002 ? 24 : 64;
    // Cells come to .3 % in the mean and are the cheaper from two Gaussians on; what they cannot reach is left to parts.
    settings.dense_from = max_error >= 0.005 ? 1 : max_error >= 0.001 ? 8 : 64;
    settings.cells = max_error > 0.05 ? 16 : 32;
    settings.near_radii = 2;
    settings.spared = Real(0.1 * max_error);
}

}  // namespace brume::airlight
