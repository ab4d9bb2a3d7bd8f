// Bilinear reads of a part of an image, by texel position within it; its edge repeats. C++: fetch.hpp, lanes_fetch.inc.

vec4 grid_fetch(sampler2D image, ivec2 corner, ivec2 size, vec2 position)
{
    vec2 p = clamp(position, vec2(0.0), vec2(size - 1)) + vec2(corner) + 0.5;
    return textureLod(image, p / vec2(textureSize(image, 0)), 0.0);
}
