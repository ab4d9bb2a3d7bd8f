"""Lanterns, on posts and on walls."""
import math

from .layout import PAVE, bend, rng
from .lights import light, lights
from .mesh import glows, solid

LAMP = (1.0, 0.67, 0.36)      # marks the lights of lanterns among all others, see positions


def lantern(x, y, z, size=1.0, watts=720.0, turn=math.pi / 4):
    """Four-sided glazed lantern; z is the foot of the glass."""
    s = size
    lo, hi, h = 0.13 * s * 1.414, 0.24 * s * 1.414, 0.5 * s

    def corner(r, t, zz):
        return (x + r * math.cos(t), y + r * math.sin(t), zz)
    for k in range(4):
        t0, t1 = turn + k * math.pi / 2, turn + (k + 1) * math.pi / 2
        q = [corner(lo, t0, z), corner(lo, t1, z), corner(hi, t1, z + h), corner(hi, t0, z + h)]
        glows.poly(q, 'lantern', [(0, 0), (1, 0), (1, 1), (0, 1)], LAMP)
        for a, b in ((q[0], q[3]), (q[0], q[1]), (q[3], q[2])):
            solid.tube([a, b], 0.017 * s, 'iron', 6)
    solid.lathe(x, y, [(0.31 * s * 1.1, h), (0.3 * s, h + 0.04 * s), (0.16 * s, h + 0.17 * s), (0.12 * s, h + 0.19 * s),
                       (0.12 * s, h + 0.25 * s), (0.05 * s, h + 0.3 * s), (0.02 * s, h + 0.42 * s)], 'iron', 12, z)
    solid.lathe(x, y, [(0.05 * s, -0.14 * s), (0.09 * s, -0.06 * s), (0.17 * s, -0.01 * s), (0.17 * s, 0.0)], 'iron', 12, z)
    # Inside the glass, which casts no shadow; the foot and roof of the lantern do.
    # Cycles 3.4 picks a light at random, each as likely as the next.  The near lamps light most of the
    # picture, so they are made of several lights each, to be picked more often; the hair's breadth
    # between them keeps a mirrored ray from finding only one.
    n, watts = 4 if y < 32 else 2 if y < 60 else 1, watts * rng.uniform(0.9, 1.1)
    for k in range(n):
        light('POINT', (x, y + 0.004 * k, z + 0.22 * s + 0.004 * k), LAMP, watts / n, radius=0.13 * s)


def lamp_post(x, y):
    solid.lathe(x, y, [(0.2, 0), (0.2, 0.12), (0.15, 0.18), (0.15, 0.62), (0.17, 0.66), (0.1, 0.74), (0.075, 0.95),
                       (0.06, 2.6), (0.09, 2.63), (0.09, 2.68), (0.055, 2.72), (0.045, 3.3)], 'iron', 12, PAVE)
    solid.tube([(x - 0.36, y, 3.0), (x + 0.36, y, 3.0)], 0.018, 'iron', 6)
    lantern(x, y, 3.52)


def wall_lantern(P, a, z):
    b, c = P(a, 0, z + 0.75), P(a, 0.55, z + 0.95)
    solid.tube([b, P(a, 0.3, z + 1.0), c, (c[0], c[1], z + 0.55)], 0.02, 'iron', 6)
    lantern(c[0], c[1], z, 0.8, 240.0)


def positions():
    """Where the lanterns are, along the street."""
    return sorted({bend(p) for k, p, c, e, o in lights if c is LAMP}, key=lambda p: p[1])
