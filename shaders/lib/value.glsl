// One channel of the texel at whole numbers; of pixels side by side each its own.

PURE float value_at(sampler2D image, float x, float y)
{
    return texelFetch(image, ivec2(int(x), int(y)), 0).x;
}
