// Results of one evaluation per square of pixels, brought to every pixel (Fogshop sec. 5.4). Needs ray.glsl.

// The pixel that stands for the square of `reduction` pixels a side.
PURE ivec2 representative(ivec2 texel, int reduction, ivec2 size)
{
    return min(texel * reduction + reduction / 2, size - 1);
}

// Interpolated between the four representatives around a pixel, each weighted by how near its distance is to the pixel's:
// a representative of another surface has no say. If all four are of other surfaces, the one nearest in distance has.
PURE vec4 upsampled(sampler2D reduced, sampler2D distances, int reduction, ivec2 size, ivec2 pixel, float distance)
{
    ivec2 grid = (size + reduction - 1) / reduction;
    vec2 position = (vec2(pixel) - vec2(float(reduction / 2))) / float(reduction);
    ivec2 first = ivec2(floor(position));
    vec2 f = position - vec2(first);
    vec4 sum = vec4(R(0.0));
    float weights = R(0.0);
    vec4 nearest = vec4(R(0.0));
    float least = R(1e30);
    for (int i = 0; i < 4; ++i) {
        ivec2 corner = ivec2(i & 1, i >> 1);
        ivec2 texel = clamp(first + corner, ivec2(0), grid - 1);
        vec4 value = texelFetch(reduced, texel, 0);
        float ratio = log2(max(texelFetch(distances, texel, 0).x, R(1e-30)) / max(distance, R(1e-30)));
        float apart = abs(ratio);
        float weight = (corner.x == 1 ? f.x : R(1.0) - f.x) * (corner.y == 1 ? f.y : R(1.0) - f.y) *
                       exp(-min(ratio * ratio * R(150.0), R(80.0)));
        sum += weight * value;
        weights += weight;
        if (apart < least) {
            least = apart;
            nearest = value;
        }
    }
    return weights > R(1e-3) ? sum / weights : nearest;
}
