// Reads of one level at a texel position, repeating its edge. Needs pyramid.glsl. fetch.hpp is the C++ counterpart: the
// same values but for the rounding, and for the 8 bits that GPUs give the fraction of a bilinear fetch.

vec4 fetch_linear(sampler2D image, Region region, vec2 position)
{
    vec2 p = clamp(position, vec2(0.0), vec2(region.size - 1));
    return textureLod(image, (vec2(p.x, p.y + float(region.row)) + 0.5) / vec2(textureSize(image, 0)), 0.0);
}

float fetch_linear_channel(sampler2D image, Region region, vec2 position, int channel)
{
    return fetch_linear(image, region, position)[channel];
}

// Sigg and Hadwiger 2005: the four weights as two linear fetches, at offsets xy from the sample left of the point, with
// weights zw.
vec4 cubic_taps(float f)
{
    vec4 w = cubic_weights(f);
    float left = w.x + w.y;
    float right = w.z + w.w;
    return vec4(w.y / left - 1.0, 1.0 + w.w / right, left, right);
}

// Bicubic (B-spline) by four bilinear fetches.
vec4 fetch_bicubic(sampler2D image, Region region, vec2 position)
{
    vec2 origin = floor(position);
    vec4 x = cubic_taps(position.x - origin.x);
    vec4 y = cubic_taps(position.y - origin.y);
    return (fetch_linear(image, region, origin + vec2(x.x, y.x)) * x.z +
            fetch_linear(image, region, origin + vec2(x.y, y.x)) * x.w) * y.z +
           (fetch_linear(image, region, origin + vec2(x.x, y.y)) * x.z +
            fetch_linear(image, region, origin + vec2(x.y, y.y)) * x.w) * y.w;
}

float fetch_bicubic_channel(sampler2D image, Region region, vec2 position, int channel)
{
    return fetch_bicubic(image, region, position)[channel];
}
