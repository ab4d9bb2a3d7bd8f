#include "colour/builtin_config.hpp"

#include <cmath>

#include <half.h>

namespace brume::tool {
namespace {

namespace ocio = OCIO_NAMESPACE;

constexpr const char *kLinear = "Linear Rec.709";

ocio::TransformRcPtr matrix(const double (&rows)[9])
{
    double m44[16] = {};
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            m44[4 * r + c] = rows[3 * r + c];
    m44[15] = 1;
    auto transform = ocio::MatrixTransform::Create();
    transform->setMatrix(m44);
    return transform;
}

ocio::TransformRcPtr srgb_encoding()
{
    auto curve = ocio::ExponentWithLinearTransform::Create();
    const double gamma[4] = {2.4, 2.4, 2.4, 1}, offset[4] = {0.055, 0.055, 0.055, 0};
    curve->setGamma(gamma);
    curve->setOffset(offset);
    curve->setDirection(ocio::TRANSFORM_DIR_INVERSE);
    return curve;
}

ocio::TransformRcPtr builtin(const char *style, ocio::TransformDirection direction = ocio::TRANSFORM_DIR_FORWARD)
{
    auto transform = ocio::BuiltinTransform::Create();
    transform->setStyle(style);
    transform->setDirection(direction);
    return transform;
}

/// y = v^n / (v^n + s^n) leaves middle grey where it is and reaches white only at infinity, as a photographic shoulder does.
ocio::TransformRcPtr tone_curve()
{
    constexpr double n = 1.25, grey = 0.18;
    const double s_to_n = std::pow(grey, n) * (1 - grey) / grey;
    constexpr unsigned long kHalfValues = 65536;
    auto lut = ocio::Lut1DTransform::Create(kHalfValues, true);
    for (unsigned long bits = 0; bits < kHalfValues; ++bits) {
        half h;
        h.setBits(static_cast<unsigned short>(bits));
        const double v = h.isNan() || h < 0 ? 0 : double(float(h));
        const float y = h.isInfinity() && !h.isNegative() ? 1.0f : float(std::pow(v, n) / (std::pow(v, n) + s_to_n));
        lut->setValue(bits, y, y, y);
    }
    return lut;
}

/// Mixes each channel a little with the luminance, so that very bright saturated lights go to white instead of clipping to
/// a pure primary.
ocio::TransformRcPtr desaturate(double amount)
{
    const double l[3] = {0.2126 * amount, 0.7152 * amount, 0.0722 * amount}, k = 1 - amount;
    return matrix({k + l[0], l[1], l[2], l[0], k + l[1], l[2], l[0], l[1], k + l[2]});
}

ocio::TransformRcPtr group(std::initializer_list<ocio::TransformRcPtr> transforms)
{
    auto all = ocio::GroupTransform::Create();
    for (const auto &t : transforms)
        all->appendTransform(t);
    return all;
}

void add_space(ocio::Config &config, const char *name, const char *encoding, ocio::ConstTransformRcPtr from_linear,
               std::initializer_list<const char *> aliases)
{
    auto space = ocio::ColorSpace::Create();
    space->setName(name);
    space->setEncoding(encoding);
    space->setBitDepth(ocio::BIT_DEPTH_F32);
    for (const char *alias : aliases)
        space->addAlias(alias);
    if (from_linear)
        space->setTransform(from_linear, ocio::COLORSPACE_DIR_FROM_REFERENCE);
    config.addColorSpace(space);
}

}  // namespace

ocio::ConstConfigRcPtr builtin_config()
{
    auto config = ocio::Config::Create();
    config->setVersion(2, 0);
    config->setName("brume-builtin");
    const double luma[3] = {0.2126, 0.7152, 0.0722};
    config->setDefaultLumaCoefs(luma);

    add_space(*config, kLinear, "scene-linear", nullptr, {"lin_rec709", "lin_srgb", "linear"});
    const auto to_acescg = builtin("UTILITY - ACES-AP1_to_LINEAR-REC709_BFD", ocio::TRANSFORM_DIR_INVERSE);
    add_space(*config, "ACEScg", "scene-linear", to_acescg, {"lin_ap1"});
    add_space(*config, "ACES2065-1", "scene-linear", group({to_acescg, builtin("ACEScg_to_ACES2065-1")}), {"lin_ap0"});
    add_space(*config, "sRGB", "sdr-video", srgb_encoding(), {"srgb_texture", "sRGB - Texture"});
    add_space(*config, "sRGB - Filmic", "sdr-video", group({desaturate(0.12), tone_curve(), srgb_encoding()}), {});

    for (const char *role : {ocio::ROLE_SCENE_LINEAR, ocio::ROLE_DEFAULT, ocio::ROLE_RENDERING})
        config->setRole(role, kLinear);
    config->setRole("aces_interchange", "ACES2065-1");
    config->setRole(ocio::ROLE_TEXTURE_PAINT, "sRGB");
    config->addDisplayView("sRGB", "Filmic", "sRGB - Filmic", "");
    config->addDisplayView("sRGB", "Standard", "sRGB", "");
    return config;
}

}  // namespace brume::tool
