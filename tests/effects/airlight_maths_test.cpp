// shaders/lib of the airlight against adaptive quadrature and closed forms in double, and float against double.
#include <random>

#include <gtest/gtest.h>

#include "airlight_world.h"

namespace f32 = brume::maths_float;
namespace f64 = brume::maths_double;

TEST(AirlightMaths, ErrorFunctionsAreFullySingle)
{
    double erf_wide = 0, erf_narrow = 0, erfc_wide = 0, erfc_narrow = 0;
    for (double x = 1e-6; x < 12; x *= 1.003) {
        const float xf = float(x);
        erf_wide = std::max(erf_wide, std::abs(f64::erf(x) / std::erf(x) - 1));
        erf_narrow = std::max(erf_narrow, std::abs(f32::erf(xf) / std::erf(double(xf)) - 1));
        const double scaled = x < 5 ? std::exp(x * x) * std::erfc(x) : double(std::exp((long double)x * x) * erfcl(x));
        erfc_wide = std::max(erfc_wide, std::abs(f64::scaled_erfc(x) / scaled - 1));
        erfc_narrow = std::max(erfc_narrow, std::abs(f32::scaled_erfc(xf) / f64::scaled_erfc(xf) - 1));
    }
    EXPECT_LT(erf_wide, 4e-8) << "the clamp at 3.9";
    EXPECT_LT(erf_narrow, 4e-7);
    EXPECT_LT(erfc_wide, 5e-9);
    EXPECT_LT(erfc_narrow, 4e-7);
    EXPECT_EQ(f32::erf(-1e30f), -f32::erf(1e30f));
}
