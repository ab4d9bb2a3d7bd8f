#pragma once
// The tables of effect surface's methods as shaders/lib reads them, in double.
#include <vector>

#include "maths.hpp"
#include "surface/tables.h"

namespace surface_tables {

class Data {
public:
    Data(const std::vector<float> &values, int channels) : values_(values.begin(), values.end())
    {
        constexpr int width = 1024;  // of data_texel()
        texture = {values_.data(), width * channels, width, int(values_.size()) / width / channels + 1, channels};
    }
    Data(const Data &) = delete;
    brume::maths_double::Texture texture;

private:
    std::vector<double> values_;
};

inline const brume::maths_double::Texture &lobes()
{
    static const Data data(surface::lobe_table(), 1);
    return data.texture;
}

inline const brume::maths_double::Texture &degrees()
{
    static const Data data(surface::psf_table(), 4);
    return data.texture;
}

inline const brume::maths_double::Texture &of(int method)
{
    return method == brume::maths_double::method_psf ? degrees() : lobes();
}

}  // namespace surface_tables
