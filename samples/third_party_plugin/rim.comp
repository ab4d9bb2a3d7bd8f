uniform Medium brume_medium;
uniform Camera brume_camera;
uniform float brume_output_limit;
uniform float strength;
uniform float sharpness;
uniform int world;
uniform int masked;
uniform sampler2D color;
uniform sampler2D normal;
uniform sampler2D mask;
uniform sampler2D density;
writeonly uniform image2D result;
writeonly uniform image2D light;

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (p.x >= brume_grid.x || p.y >= brume_grid.y)
        return;
    vec3 ray = normalize(ray_through(brume_camera, vec2(p) + 0.5));
    vec3 direction = world != 0 ? in_world(brume_camera, ray) : ray;
    vec3 rim = rim_light(brume_medium, texelFetch(normal, p, 0).rgb, direction, texelFetch(density, p, 0).r, strength, sharpness);
    if (masked != 0)
        rim *= texelFetch(mask, p, 0).r;
    vec4 source = texelFetch(color, p, 0);
    imageStore(result, p, vec4(compose_radiance(source.rgb, vec3(1.0), rim, brume_output_limit), source.a));
    imageStore(light, p, vec4(rim, 1.0));
}
