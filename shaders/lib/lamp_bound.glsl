// What a light sends to any ray of a tile of the screen, at most: a sum over parts of the rays, each in the medium's own terms.
// Needs lit.glsl.

// The rays of a tile.
struct TileRays {
    vec3 axis;       // unit
    float cosine;    // of the angle between the axis and the ray farthest from it
    float sine;
    float spread;    // |direction - axis| of that ray
    float distance;  // that a pixel shows at most, 0 to quadrature_limit
};

// A part of them.
struct RayPiece {
    float from;
    float to;
    float mass;                           // int rho e^(-extinction P) dt at most
    float logarithm[max_density_terms];   // of each exponential term at least
    float density[max_density_terms];
};

// Of the colours that scatter, the one that goes farthest.
PURE float least_extinction(IN(Medium) medium)
{
    vec3 s = medium.scattering;
    vec3 extinction = s + medium.absorption;
    return min(choose(s.x > R(0.0), extinction.x, density_limit),
               min(choose(s.y > R(0.0), extinction.y, density_limit), choose(s.z > R(0.0), extinction.z, density_limit)));
}

PURE RayPiece ray_piece(IN(Medium) medium, IN(TileRays) rays, float from, float to)
{
    RayPiece piece;
    piece.from = from;
    piece.to = to;
    float before = min(medium.constant * from, density_limit);
    float within = min(medium.constant * (to - from), density_limit);
    for (int i = 0; i < medium.term_count; ++i) {
        vec3 fall = vec3(medium.terms[i].x, medium.terms[i].y, medium.terms[i].z);
        float slope = dot(fall, rays.axis);
        float turn = length(fall) * rays.spread;
        float least = slope + turn;
        float most = slope - turn;
        float here = medium.terms[i].w;
        vec3 along = vec3(R(1.0), R(0.0), R(0.0));
        before += min(exponential_density_integral(vec4(least, R(0.0), R(0.0), here), along, from), density_limit);
        within += min(exponential_density_integral(vec4(most, R(0.0), R(0.0), here - most * from), along, to - from), density_limit);
        piece.logarithm[i] = here - max(least * from, least * to);
        piece.density[i] = exp(min(piece.logarithm[i], R(69.0)));
    }
    float extinction = least_extinction(medium);
    float mass = min(within * mean_exponential(min(extinction * within, R(80.0))), R(1.0) / extinction);
    piece.mass = exp(-min(extinction * before, R(1e30))) * mass;
    return piece;
}

// A light as a tile's rays see it.
struct LampSight {
    float distance;
    vec2 nearest;                        // cosine and sine of the least angle between it and a ray
    vec2 farthest;                       // of the greatest
    float logarithm[max_density_terms];  // of the exponential terms there
    float density[max_density_terms];
};

PURE LampSight lamp_sight(IN(Medium) medium, IN(TileRays) rays, IN(Light) light)
{
    LampSight lamp;
    vec3 way = light.position;
    if (light.type == light_directional)
        way = -light.direction;
    lamp.distance = length(way);
    float cosine = dot(rays.axis, way) / max(lamp.distance, R(1e-20));
    float sine = length(cross(rays.axis, way)) / max(lamp.distance, R(1e-20));
    float turned = sine * rays.cosine - cosine * rays.sine;
    Bool beside = turned > R(0.0);
    lamp.nearest = vec2(choose(beside, min(cosine * rays.cosine + sine * rays.sine, R(1.0)), R(1.0)), max(turned, R(0.0)));
    turned = sine * rays.cosine + cosine * rays.sine;
    beside = turned > R(0.0);
    lamp.farthest = vec2(choose(beside, max(cosine * rays.cosine - sine * rays.sine, -R(1.0)), -R(1.0)), max(turned, R(0.0)));
    for (int i = 0; i < medium.term_count; ++i) {
        lamp.logarithm[i] = moved_term(medium.terms[i], light.position).w;
        lamp.density[i] = exp(min(lamp.logarithm[i], R(69.0)));
    }
    return lamp;
}

// Cosine of the angle by which a light's rays are turned at t toward the camera.
PURE float turn_cosine(IN(LampSight) lamp, vec2 angle, float t)
{
    float x = lamp.distance * angle.x - t;
    float y = lamp.distance * angle.y;
    return x / max(sqrt(x * x + y * y), R(1e-20));
}

// The phase function at most, of angles whose cosines lie between these. Henyey and Greenstein's is monotonous.
PURE float most_phase(IN(Medium) medium, float least, float most)
{
    least = max(least - R(1e-6), -R(1.0));
    most = min(most + R(1e-6), R(1.0));
    float p = max(henyey_greenstein(medium.phase.x, least), henyey_greenstein(medium.phase.x, most));
    if (some(medium.phase.w > R(0.0)))
        p = mix(p, max(henyey_greenstein(medium.phase.y, least), henyey_greenstein(medium.phase.y, most)) *
                       (R(1.0) + medium.phase.z * max(least * least, most * most)) /
                       (R(1.0) + medium.phase.z * (R(1.0) + R(2.0) * medium.phase.y * medium.phase.y) / R(3.0)),
                medium.phase.w);
    return p;
}

// What a light of intensity 1 sends from a piece of any of the rays, at most.
PURE float most_of_piece(IN(Medium) medium, IN(Light) light, IN(LampSight) lamp, IN(RayPiece) piece)
{
    if (light.type == light_directional)
        return piece.mass * most_phase(medium, lamp.farthest.x, lamp.nearest.x);
    float foot = lamp.distance * lamp.nearest.x;
    float height = lamp.distance * lamp.nearest.y;
    float x = clamp(foot, piece.from, piece.to) - foot;
    float d = max(sqrt(x * x + height * height), max(smallest_light, smallest_light_angle * lamp.distance));
    // Light is turned most at the far end, least at the near one; beyond the light, by the ray that passes it at a right angle.
    float least = min(turn_cosine(lamp, lamp.nearest, piece.to), turn_cosine(lamp, lamp.farthest, piece.to));
    float most = max(turn_cosine(lamp, lamp.nearest, piece.from), turn_cosine(lamp, lamp.farthest, piece.from));
    float beyond = lamp.distance / max(piece.from, R(1e-20));
    Bool right_angle = beyond < lamp.nearest.x && beyond > lamp.farthest.x;
    most = choose(right_angle, max(most, -sqrt(max(R(1.0) - beyond * beyond, R(0.0)))), most);
    // Of the ways from the light none is shorter, and none meets less than what is least at its end.
    float depth = medium.constant;
    for (int i = 0; i < medium.term_count; ++i)
        depth += mean_between(piece.density[i], lamp.density[i], abs(piece.logarithm[i] - lamp.logarithm[i]));
    float way = R(0.999) * sqrt(x * x + height * height);
    return piece.mass * most_phase(medium, least, most) * fluence(d, light.radius) * exp(-min(least_extinction(medium) * way * depth, R(1e30)));
}

// Of the colour that has most.
PURE float lamp_bound(IN(Medium) medium, IN(Light) light, float of_pieces)
{
    vec3 each = medium.scattering * light.intensity;
    float bound = R(1.001) * max(max(each.x, each.y), each.z) * of_pieces;
    return choose(bound < radiance_limit, bound, radiance_limit);
}
