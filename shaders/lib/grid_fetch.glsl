// Bilinear reads of a part of an image, by texel position within it; its edge repeats. C++: fetch.hpp, lanes_fetch.inc.

vec4 grid_fetch(sampler2D image, ivec2 corner, ivec2 size, vec2 position)
{
    vec2 p = clamp(position, vec2(0.0), vec2(size - 1)) + vec2(corner) + 0.5;
    return textureLod(image, p / vec2(textureSize(image, 0)), 0.0);
}

// The same; w what the four texels around have in it where they agree, else `otherwise`.
vec4 grid_fetch_agreed(sampler2D image, ivec2 corner, ivec2 size, vec2 position, float otherwise)
{
    vec2 p = (clamp(position, vec2(0.0), vec2(size - 1)) + vec2(corner) + 0.5) / vec2(textureSize(image, 0));
    vec4 around = textureGather(image, p, 3);
    bool agree = all(equal(around, vec4(around.x)));
    return vec4(textureLod(image, p, 0.0).xyz, agree ? around.x : otherwise);
}
