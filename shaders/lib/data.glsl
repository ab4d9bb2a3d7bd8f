// Data images: arrays of texels, 1024 in a row (BRUME_DATA_WIDTH in brume_plugin.h).

PURE vec4 data_texel(sampler2D image, int i)
{
    return texelFetch(image, ivec2(i & 1023, i >> 10), 0);
}

// Linear between `count` values from the texel `first` on.
PURE float data_between(sampler2D image, int first, int count, float place)
{
    int i = clamp(int(place), 0, count - 2);
    float f = clamp(place - float(i), R(0.0), R(1.0));
    return mix(data_texel(image, first + i).x, data_texel(image, first + i + 1).x, f);
}
