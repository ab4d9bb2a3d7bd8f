// Data images: arrays of texels, 1024 in a row (BRUME_DATA_WIDTH in brume_plugin.h).

PURE vec4 data_texel(sampler2D image, int i)
{
    return texelFetch(image, ivec2(i & 1023, i >> 10), 0);
}
