// Where rays are in a spot's cone. Needs light.glsl.

// The part [x, y] of the line apex-relative `foot + s direction` (foot perpendicular to direction) that lies in the cone
// about `axis` of half angle acos(c), 0 <= c <= 1; x >= y where it is empty.
PURE vec2 line_in_cone(vec3 foot, vec3 direction, vec3 axis, float c)
{
    float along = dot(direction, axis);
    float off = dot(foot, axis);
    float a = (along - c) * (along + c);
    a = choose(abs(a) < R(1e-12), -R(1e-12), a);
    float square = dot(foot, foot);
    float discriminant = off * off + a * square;
    float s = along * off;
    float root = c * sqrt(max(discriminant, R(0.0)));
    float q = choose(s < R(0.0), root - s, -root - s);
    float first = q / a;
    float second = choose(abs(q) > R(1e-30), (off * off - c * c * square) / q, first);
    float near = min(first, second);
    float far = max(first, second);
    // Of two nappes the front one takes the end of the line that runs along the axis.
    Bool both = a > R(0.0);
    Bool forward = along > R(0.0);
    vec2 part = vec2(choose(both, choose(forward, far, -far_away), near), choose(both, choose(forward, far_away, near), far));
    // Within the cone's angle of its axis every line meets it, be it at the apex alone, where all else is zero.
    Bool misses = a < R(0.0) && (discriminant <= R(0.0) || off <= R(0.0));
    if (some(c < R(1e-6))) {
        // Half of space.
        Bool wide = c < R(1e-6);
        Bool beside = abs(along) < R(1e-6);
        float edge = -off / along;
        part.x = choose(wide, choose(beside || !forward, -far_away, edge), part.x);
        part.y = choose(wide, choose(beside || forward, far_away, edge), part.y);
        misses = (wide && beside && off < R(0.0)) || (!wide && misses);
    }
    return vec2(choose(misses, R(1.0), part.x), choose(misses, -R(1.0), part.y));
}

// The part of the camera's ray that a light shines on, within [0, distance]; x >= y where that is nothing. c: cosine of the
// cone to be clipped at (cos_outer, or cos_inner for where a spot is at its full intensity).
PURE vec2 lit_interval(IN(Light) light, vec3 direction, float distance, float c)
{
    if (light.type != light_spot)
        return vec2(R(0.0), distance);
    float t0 = dot(light.position, direction);
    vec2 s = line_in_cone(t0 * direction - light.position, direction, light.direction, c);
    return vec2(clamp(t0 + s.x, R(0.0), distance), clamp(t0 + s.y, R(0.0), distance));
}
