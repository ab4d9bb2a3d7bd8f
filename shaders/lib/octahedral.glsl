// The sphere onto the unit square: Cigolle et al. 2014, "A survey of efficient representations for independent unit vectors".

PURE vec2 folded(vec2 p)
{
    return vec2((R(1.0) - abs(p.y)) * choose(p.x >= R(0.0), R(1.0), -R(1.0)),
                (R(1.0) - abs(p.x)) * choose(p.y >= R(0.0), R(1.0), -R(1.0)));
}

// d need not be of unit length.
PURE vec2 octahedral(vec3 d)
{
    vec3 n = d / max(abs(d.x) + abs(d.y) + abs(d.z), R(1e-30));
    vec2 p = vec2(n.x, n.y);
    vec2 q = folded(p);
    Bool below = n.z < R(0.0);
    return vec2(R(0.5) * choose(below, q.x, p.x) + R(0.5), R(0.5) * choose(below, q.y, p.y) + R(0.5));
}

PURE vec3 octahedral_direction(vec2 square)
{
    vec2 p = vec2(R(2.0) * square.x - R(1.0), R(2.0) * square.y - R(1.0));
    vec2 q = folded(p);
    float z = R(1.0) - abs(p.x) - abs(p.y);
    Bool below = z < R(0.0);
    vec3 d = vec3(choose(below, q.x, p.x), choose(below, q.y, p.y), z);
    return d / length(d);
}
