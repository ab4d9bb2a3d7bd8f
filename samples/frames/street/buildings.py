"""Houses, the rows they stand in, and the clock tower at the end."""
import math

from .facade import WARM, door, hole, pane, shop, window
from .layout import END, left, right, rng
from .lights import scaled
from .materials import WALLS
from .mesh import panes, solid


def house(P, a0, a1, floors, wall, ground='home', lit=0.44, **kw):
    """A terraced house on the facade frame P(along, outward, up)."""
    g, h = 3.7, 3.15
    n = max(2, round((a1 - a0) / 2.35))
    bw = (a1 - a0) / n
    if ground == 'shop':
        shop(P, a0, a1, g, **kw)
    else:
        at = rng.randrange(n)
        for i in range(n):
            b0, b1 = a0 + i * bw, a0 + (i + 1) * bw
            if i == at:
                door(P, b0, b1, g, wall)
            else:
                c = (b0 + b1) / 2
                hole(P, b0, b1, 0, g, c - 0.55, c + 0.55, 1.05, 2.85, wall, 0.2, 'stone')
                window(P, c - 0.55, c + 0.55, 1.05, 2.85, rng.random() < lit)
        solid.box((a0, 0, 0), (a1, 0.05, 0.5), 'stone', P=P)
    for k in range(floors - 1):
        z = g + k * h
        for i in range(n):
            b0, b1 = a0 + i * bw, a0 + (i + 1) * bw
            c, w = (b0 + b1) / 2, 0.54
            hole(P, b0, b1, z, z + h, c - w, c + w, z + 0.75, z + 2.6, wall, 0.2, 'stone')
            window(P, c - w, c + w, z + 0.75, z + 2.6, rng.random() < lit)
            if wall in ('redbrick', 'brownbrick', 'grey'):
                solid.box((c - w - 0.1, 0, z + 2.6), (c + w + 0.1, 0.05, z + 2.82), 'stone', P=P)
        if k or ground != 'shop':
            solid.box((a0, 0, z - 0.09), (a1, 0.08, z + 0.09), 'stone', P=P)
    top = g + (floors - 1) * h
    solid.box((a0, -0.1, top), (a1, 0.3, top + 0.22), 'stone', P=P)
    solid.box((a0, -0.1, top - 0.22), (a1, 0.16, top), 'stone', P=P)
    # Steep slate roof, chimneys, and the plain sides and back.
    r = 2.3 + rng.random()
    A = [P(a0, 0, top + 0.2), P(a1, 0, top + 0.2), P(a1, -1.6, top + r), P(a0, -1.6, top + r)]
    B = [P(a0, -9, top + r), P(a1, -9, top + r)]
    solid.poly(A, 'slate')
    solid.poly([A[3], A[2], B[1], B[0]], 'slate')
    for a, i in ((a0, (0, 3, 0)), (a1, (1, 2, 1))):
        solid.poly([P(a, 0, 0), A[i[0]], A[i[1]], B[i[2]], P(a, -9, 0)], wall)
    solid.poly([P(a0, -9, 0), P(a1, -9, 0), B[1], B[0]], wall)
    for i in range(n):
        if rng.random() < 0.55:     # dormer
            c = a0 + (i + 0.5) * bw
            solid.box((c - 0.6, -1.6, top + 0.3), (c + 0.6, -0.35, top + 1.95), 'slate', P=P)
            on = rng.random() < lit * 0.8
            pane(P, c - 0.42, c + 0.42, top + 0.6, top + 1.7, 0.34, 'room' if on else 'glass', scaled(rng.choice(WARM), 0.6 + rng.random()))
            for a in (c - 0.42, c, c + 0.38):
                solid.box((a, -0.35, top + 0.6), (a + 0.04, -0.31, top + 1.7), 'frame', P=P)
    for a in (a0 + 0.1, a1 - 1.2):
        if rng.random() < 0.6:
            z = top + r
            solid.box((a, -3.2, top + 0.5), (a + 1.1, -2.4, z + 1.3), 'brownbrick', P=P)
            for j in range(3):
                p = P(a + 0.25 + 0.3 * j, -2.8, 0)
                solid.lathe(p[0], p[1], [(0.1, z + 1.3), (0.09, z + 1.75)], 'rose', 8)


def rows():
    shops = {
        # (side, index): front colour, glow of the panes, awning
        ('l', 1): ('green', (1.61, 0.88, 0.36), 'red'), ('l', 3): ('blue', (1.05, 0.83, 0.6), None),
        ('r', 1): ('wine', (1.49, 0.74, 0.28), None), ('r', 2): ('dark', (0.55, 0.94, 1.14), None),
        ('r', 4): ('green', (1.24, 0.77, 0.35), 'blue'), ('l', 6): ('wine', (1.36, 0.72, 0.28), 'blue'),
        ('r', 7): ('blue', (1.24, 0.83, 0.45), None), ('l', 9): ('dark', (0.6, 0.88, 1.14), None),
        ('r', 9): ('wood', (1.36, 0.77, 0.3), 'red'),
    }
    for side, P in (('l', left), ('r', right)):
        y, i, last = -16.0, 0, None
        while y < END:
            w = rng.choice((7.2, 9.4, 9.4, 11.8))
            if side == 'l' and 60 < y < 66:
                y += 8.5            # a side street
            if i == 0:
                w = 18.0 + (0 if side == 'l' else 6)      # beside and behind the camera
            wall = rng.choice([m for m in WALLS if m != last])
            last = wall
            floors = rng.choice((3, 4, 4, 5)) if y > 10 else 4
            s = shops.get((side, i))
            if s:
                house(P, y, y + w, floors, wall, 'shop', colour=s[0], glow=s[1], canopy=s[2])
            else:
                house(P, y, y + w, floors, wall)
            y += w
            i += 1
    # The square at the far end, and a house at the back of the side street.
    house(lambda a, d, z: (a, 226 - d, z), -30, -9, 4, 'cream')
    house(lambda a, d, z: (a, 226 - d, z), -9, 7, 3, 'redbrick')
    house(lambda a, d, z: (a, 226 - d, z), 7, 30, 4, 'grey')
    house(lambda a, d, z: (-34 + d, a, z), 48, 80, 4, 'rose')
    tower(-1.0, 246.0)


def tower(x, y):
    solid.box((x - 4, y - 4, 0), (x + 4, y + 4, 34), 'stone')
    solid.box((x - 4.3, y - 4.3, 34), (x + 4.3, y + 4.3, 34.8), 'stone')
    solid.lathe(x, y, [(5.6, 34.8), (0.05, 54)], 'slate', 4, turn=math.pi / 4, smooth=False)
    ring = [(x + 2.3 * math.cos(t), y - 4.05, 29.5 + 2.3 * math.sin(t)) for t in (2 * math.pi * j / 24 for j in range(24))]
    panes.poly(ring, 'flat', glow=(2.4, 1.9, 1.1))
    for t, l in ((0.35, 1.3), (2.5, 1.9)):      # clock hands
        solid.tube([(x, y - 4.1, 29.5), (x + l * math.cos(t), y - 4.1, 29.5 + l * math.sin(t))], 0.14, 'iron', 6)
