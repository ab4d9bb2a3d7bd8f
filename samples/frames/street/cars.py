"""Cars, parked and driving."""
import math

from .lights import light
from .mesh import glows, solid


def car(x, y, heading, paint, lamps=False):
    """A saloon; heading +1 drives away from the camera.  Two lofts, pillars as bars, round wheels."""
    def Q(u, s, z):
        return (x + u * heading, y + s * heading, z)
    # s, half width, sill, belt
    hull = [(-2.16, 0.66, 0.42, 0.78), (-2.1, 0.8, 0.3, 0.88), (-1.75, 0.87, 0.22, 0.95), (-1.0, 0.9, 0.2, 0.95), (0.4, 0.9, 0.2, 0.93),
            (1.1, 0.89, 0.2, 0.9), (1.75, 0.85, 0.22, 0.8), (2.1, 0.76, 0.3, 0.68), (2.18, 0.6, 0.42, 0.6)]
    rings = []
    for s, w, a, b in hull:
        m = a + (b - a) * 0.55
        half = [(w * 0.9, a), (w * 0.985, a + 0.1 * (b - a)), (w, m), (w * 0.96, b - 0.09 * (b - a)), (w * 0.86, b), (w * 0.4, b + 0.025)]
        rings.append([Q(u, s, z) for u, z in half] + [Q(-u, s, z) for u, z in half[::-1]])
    solid.loft(rings, paint)
    base = [(-0.76, -1.72, 0.93), (0.76, -1.72, 0.93), (0.78, 1.05, 0.9), (-0.78, 1.05, 0.9)]
    roof = [(-0.58, -1.12, 1.38), (0.58, -1.12, 1.38), (0.6, 0.2, 1.42), (-0.6, 0.2, 1.42)]
    B, R = [Q(*p) for p in base], [Q(*p) for p in roof]
    for i in range(4):
        solid.poly([B[i], B[(i + 1) % 4], R[(i + 1) % 4], R[i]], 'glass')
        solid.tube([B[i], R[i]], 0.045, paint, 8)
        solid.tube([R[i], R[(i + 1) % 4]], 0.045, paint, 8)
    solid.loft([[Q(u * 1.04, s * 1.02 - 0.01, z - 0.01) for u, s, z in roof], [Q(u, s, z + 0.035) for u, s, z in roof],
                [Q(u * 0.6, s * 0.6 - 0.1, z + 0.06) for u, s, z in roof]], paint)
    for u in (-1, 1):         # middle pillars, mirrors
        solid.tube([Q(u * 0.785, -0.35, 0.92), Q(u * 0.605, -0.4, 1.4)], 0.04, paint, 8)
        solid.box((u * 0.82, 0.72, 0.92), (u * 1.02, 0.84, 1.06), paint, P=Q)
    for s in (-1.32, 1.36):
        for u in (-1, 1):
            n, w0, w1 = 20, u * 0.7, u * 0.915
            def ring(r, w):
                return [Q(w, s + r * math.cos(t), 0.31 + r * math.sin(t)) for t in (2 * math.pi * j / n for j in range(n))]
            solid.loft([ring(0.31, w0), ring(0.31, w1 - u * 0.03), ring(0.28, w1), ring(0.2, w1)], 'tyre')
            solid.poly(ring(0.17, w1 + u * 0.004), 'alloy')
            solid.loft([ring(0.39, u * 0.82), ring(0.39, u * 0.903), ring(0.3, u * 0.903)], 'dark', caps=False)      # wheel arch
    solid.box((-0.26, -2.19, 0.5), (0.26, -2.17, 0.61), 'plate', P=Q)
    solid.box((-0.72, -2.2, 0.3), (0.72, -2.05, 0.44), 'dark', P=Q)
    for u in (-1, 1):
        tail, head = ((u * 0.42, -2.185, 0.66), (u * 0.7, -2.12, 0.79)), ((u * 0.42, 2.1, 0.52), (u * 0.66, 2.2, 0.64))
        if lamps:
            glows.box(*tail, 'flat', (34, 1.6, 0.7), P=Q)
            glows.box(*head, 'flat', (150, 140, 118), P=Q)
            light('POINT', Q(u * 0.56, -2.3, 0.72), (1.0, 0.05, 0.02), 34.0, radius=0.1)
            light('SPOT', Q(u * 0.54, 2.26, 0.58), (1.0, 0.93, 0.8), 1500.0, radius=0.06, target=Q(u * 0.5, 14, -0.1), spot=1.0)
        else:
            solid.box(*tail, 'reflector', P=Q)
            solid.box(*head, 'alloy', P=Q)
