"""Signs that shine: neon writing, the pharmacy's cross, the traffic light."""
import math

from .layout import PAVE, left, right
from .lights import light, scaled
from .mesh import glows, solid


# Letters as strokes on a 2 x 4 grid, drawn as bent glass tubes.
STROKES = {
    'A': [[(0, 0), (1, 4), (2, 0)], [(0.45, 1.5), (1.55, 1.5)]],
    'B': [[(0, 0), (0, 4), (1.3, 4), (1.9, 3.5), (1.9, 2.6), (1.3, 2.1), (0, 2.1)], [(1.3, 2.1), (2, 1.6), (2, 0.6), (1.4, 0), (0, 0)]],
    'C': [[(2, 3.3), (1.5, 4), (0.5, 4), (0, 3.3), (0, 0.7), (0.5, 0), (1.5, 0), (2, 0.7)]],
    'E': [[(2, 0), (0, 0), (0, 4), (2, 4)], [(0, 2), (1.6, 2)]],
    'F': [[(0, 0), (0, 4), (2, 4)], [(0, 2), (1.6, 2)]],
    'H': [[(0, 0), (0, 4)], [(2, 0), (2, 4)], [(0, 2), (2, 2)]],
    'L': [[(0, 4), (0, 0), (2, 0)]],
    'O': [[(0.5, 0), (0, 0.7), (0, 3.3), (0.5, 4), (1.5, 4), (2, 3.3), (2, 0.7), (1.5, 0), (0.5, 0)]],
    'R': [[(0, 0), (0, 4), (1.4, 4), (2, 3.4), (2, 2.6), (1.4, 2), (0, 2)], [(1.1, 2), (2, 0)]],
    'T': [[(1, 0), (1, 4)], [(0, 4), (2, 4)]],
}


def neon(text, P, a, d, z, height, colour, radius, vertical=False, across=False, watts=60.0, board='dark'):
    """A sign of tubes.  across: stands out from the wall and faces the camera, else lies on it."""
    k = height / 4
    w, gap = 2 * k, 1.1 * k
    n = len(text)
    W = w if vertical else n * w + (n - 1) * gap
    H = n * height + (n - 1) * gap * 1.3 if vertical else height

    def S(u, v, t):       # u along the writing, v up, t towards the reader
        return P(a - t, d + u, z + v) if across else P(a + u, d + t, z + v)

    # Written to be read from the camera's side; out from the right wall, left on the sign is farther out.
    def T(u, v, t):
        if across:
            return S(W - u if P is right else u, v, t)
        return S(u if P is left else W - u, v, t)
    for i, ch in enumerate(text):
        u0 = 0 if vertical else i * (w + gap)
        v0 = H - (i + 1) * height - i * gap * 1.3 if vertical else 0
        for s in STROKES[ch]:
            glows.tube([T(u0 + p * k, v0 + q * k, 0.06) for p, q in s], radius, 'flat', 8, colour)
    m = 0.8 * k
    c = [T(-m, -m, 0), T(W + m, H + m, -0.08)]
    solid.box(tuple(map(min, *c)), tuple(map(max, *c)), board)
    if across:            # brackets to the wall
        for v in (0.1 * H, 0.9 * H):
            solid.tube([P(a + 0.04, 0, z + v), P(a + 0.04, d, z + v)], 0.025, 'iron', 6)
    p, q = T(W / 2, H / 2, 0.14), T(W / 2, H / 2, 1.0)
    light('AREA', p, scaled(colour, 1 / max(colour)), watts, size=W, size_y=H, target=q)


def pharmacy_cross(P, a, d, z, s, colour):
    for k in range(2):
        e = s * (1 - 0.42 * k)
        w = e * 0.34
        pts = [(-w, -e), (w, -e), (w, -w), (e, -w), (e, w), (w, w), (w, e), (-w, e), (-w, w), (-e, w), (-e, -w), (-w, -w), (-w, -e)]
        glows.tube([P(a - 0.07, d + u, z + v) for u, v in pts], 0.03, 'flat', 8, colour)
    solid.box(P(a - 0.04, d - s * 1.15, z - s * 1.15), P(a + 0.04, d + s * 1.15, z + s * 1.15), 'dark')
    solid.tube([P(a, 0, z), P(a, d, z)], 0.03, 'iron', 6)
    light('AREA', P(a - 0.15, d, z), scaled(colour, 1 / max(colour)), 14.0, size=2 * s, size_y=2 * s, target=P(a - 1, d, z))


def traffic_light(x, y):
    solid.tube([(x, y, PAVE), (x, y, 3.3)], 0.055, 'iron', 10)
    solid.box((x - 0.16, y - 0.14, 2.35), (x + 0.16, y + 0.1, 3.3), 'dark')
    for k, c in enumerate(((0.02, 0.06, 0.04), (0.06, 0.05, 0.02), (60.0, 3.0, 1.2))):
        z = 2.51 + 0.31 * k
        ring = [(x + 0.105 * math.cos(t), y - 0.15, z + 0.105 * math.sin(t)) for t in (2 * math.pi * j / 20 for j in range(20))]
        glows.poly(ring, 'flat', glow=c)
        hood = [[(x + 0.125 * math.cos(t), yy, z + 0.125 * math.sin(t)) for t in (math.pi * j / 12 for j in range(13))]
                for yy in (y - 0.14, y - 0.34)]
        solid.loft(hood, 'dark', closed=False, caps=False)
    light('AREA', (x, y - 0.17, 3.13), (1.0, 0.06, 0.02), 30.0, size=0.2, size_y=0.2, target=(x, y - 2, 2.9))
