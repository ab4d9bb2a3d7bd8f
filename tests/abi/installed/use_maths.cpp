/* The installed maths, as an effect of a stranger's uses them: a formula of shaders/lib in both precisions. */
#include <cmath>
#include <cstdio>

#include <brume/maths/maths.hpp>
#include <brume/maths/scene_maths.hpp>

int main()
{
    const double g = 0.6, cosine = 0.3, pi = 3.14159265358979323846;
    const double expected = (1 - g * g) / (4 * pi * std::pow(1 + g * g - 2 * g * cosine, 1.5));
    const float single = brume::maths_float::henyey_greenstein(float(g), float(cosine));
    const double twice = brume::maths_double::henyey_greenstein(g, cosine);
    brume_plugin_medium medium{};
    medium.scattering[1] = 0.25f;
    brume_plugin_scene scene{};
    scene.medium = &medium;
    const float scattering = brume::maths_float::medium_of(scene).scattering.y;
    if (std::abs(single - expected) < 1e-6 && std::abs(twice - expected) < 1e-13 && scattering == 0.25f)
        return 0;
    std::printf("henyey_greenstein(%g, %g): %.9g in float, %.17g in double, expected %.17g; scattering %g, expected 0.25\n",
                g, cosine, double(single), twice, expected, double(scattering));
    return 1;
}
