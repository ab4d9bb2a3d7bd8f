// The environment around the image, as fog before it turns it toward the camera: environment_around() at sky_nodes times
// sky_nodes places of the image, corner to corner, for sky_depths density integrals, each twice the one before. It changes
// little from degree to degree, and is smooth between. Needs data.glsl, calibrated.glsl.

const int sky_nodes = 33;
const int sky_depths = 16;

PURE vec3 sky_node(sampler2D sky, int depth, int row, int column)
{
    return vec3(data_texel(sky, (depth * sky_nodes + row) * sky_nodes + column));
}

PURE vec3 sky_at_depth(sampler2D sky, int depth, ivec2 node, vec2 f)
{
    return mix(mix(sky_node(sky, depth, node.y, node.x), sky_node(sky, depth, node.y, node.x + 1), f.x),
               mix(sky_node(sky, depth, node.y + 1, node.x), sky_node(sky, depth, node.y + 1, node.x + 1), f.x), f.y);
}

// place: in the image, 0 to 1. p: the density integral.
PURE vec3 surrounding_sky(IN(Calibrated) f, sampler2D sky, vec2 place, float p)
{
    vec2 at = clamp(place, vec2(R(0.0)), vec2(R(1.0))) * float(sky_nodes - 1);
    ivec2 node = ivec2(min(int(at.x), sky_nodes - 2), min(int(at.y), sky_nodes - 2));
    vec2 within = at - vec2(node);
    float octaves = clamp(octaves_of(p) - f.first_sky, R(0.0), float(sky_depths - 1));
    int depth = min(int(octaves), sky_depths - 2);
    return mix(sky_at_depth(sky, depth, node, within), sky_at_depth(sky, depth + 1, node, within), octaves - float(depth));
}
