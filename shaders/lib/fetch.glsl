// Bilinear fetch at a texel position, where texel i has its centre at i.
vec4 fetch_linear(sampler2D image, vec2 position)
{
    return textureLod(image, (position + 0.5) / vec2(textureSize(image, 0)), 0.0);
}
