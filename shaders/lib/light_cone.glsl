// Where rays are in a spot's cone. Needs light.glsl.

// The part [x, y] of the line apex-relative `foot + s direction` (foot perpendicular to direction) that lies in the cone
// about `axis` of half angle acos(c), 0 <= c <= 1; x >= y where it is empty.
PURE vec2 line_in_cone(vec3 foot, vec3 direction, vec3 axis, float c)
{
    const vec2 empty = vec2(R(1.0), -R(1.0));
    float along = dot(direction, axis);
    float off = dot(foot, axis);
    if (c < R(1e-6)) {
        // Half of space.
        if (abs(along) < R(1e-6))
            return off >= R(0.0) ? vec2(-far_away, far_away) : empty;
        return along > R(0.0) ? vec2(-off / along, far_away) : vec2(-far_away, -off / along);
    }
    float a = (along - c) * (along + c);
    if (abs(a) < R(1e-12))
        a = -R(1e-12);
    float square = dot(foot, foot);
    float discriminant = off * off + a * square;
    // Within the cone's angle of its axis (a > 0) every line meets it, be it at the apex alone, where all else is zero.
    if (a < R(0.0) && (discriminant <= R(0.0) || off <= R(0.0)))
        return empty;
    float s = along * off;
    float root = c * sqrt(max(discriminant, R(0.0)));
    float q = s < R(0.0) ? root - s : -root - s;
    float first = q / a;
    float second = abs(q) > R(1e-30) ? (off * off - c * c * square) / q : first;
    float near = min(first, second);
    float far = max(first, second);
    if (a < R(0.0))
        return vec2(near, far);
    // Of two nappes the front one takes the end of the line that runs along the axis.
    return along > R(0.0) ? vec2(far, far_away) : vec2(-far_away, near);
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
