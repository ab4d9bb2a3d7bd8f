uniform Medium brume_medium;
uniform float brume_output_limit;
uniform float gain;
uniform float saturation;
uniform sampler2D color;
writeonly uniform image2D result;

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (p.x >= brume_grid.x || p.y >= brume_grid.y)
        return;
    imageStore(result, p, graded(brume_medium, texelFetch(color, p, 0), gain, saturation, brume_output_limit));
}
