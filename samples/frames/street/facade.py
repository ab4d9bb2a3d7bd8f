"""Parts of a facade: windows, doors, shop fronts.  P(along, outward, up) is the frame of the wall they are in."""
from .layout import rng
from .lights import light, scaled
from .mesh import panes, solid

WARM = [(1.0, 0.55, 0.21), (1.0, 0.62, 0.29), (1.0, 0.7, 0.4), (1.0, 0.48, 0.16)]
COOL = [(0.75, 0.88, 1.0), (0.55, 0.75, 1.0)]


def hole(P, a0, a1, z0, z1, b0, b1, w0, w1, wall, deep, trim):
    """A wall cell [a0,a1] x [z0,z1] around an opening [b0,b1] x [w0,w1] with reveals."""
    for q in ((a0, b0, z0, z1), (b1, a1, z0, z1), (b0, b1, z0, w0), (b0, b1, w1, z1)):
        if q[1] - q[0] > 1e-6 and q[3] - q[2] > 1e-6:
            solid.poly([P(q[0], 0, q[2]), P(q[1], 0, q[2]), P(q[1], 0, q[3]), P(q[0], 0, q[3])], wall)
    c = [(b0, w0), (b1, w0), (b1, w1), (b0, w1)]
    for i in range(4):
        (s, t), (u, v) = c[i], c[(i + 1) % 4]
        solid.poly([P(s, 0, t), P(u, 0, v), P(u, -deep, v), P(s, -deep, t)], trim)


def pane(P, b0, b1, w0, w1, deep, kind, glow=(0, 0, 0)):
    pts = [P(b0, -deep, w0), P(b1, -deep, w0), P(b1, -deep, w1), P(b0, -deep, w1)]
    if kind == 'glass':
        solid.poly(pts, 'glass')
    else:
        panes.poly(pts, kind, [(0, 0), (1, 0), (1, 1), (0, 1)], glow)


def window(P, b0, b1, w0, w1, lit, deep=0.2):
    """Pane, crossbars and sill."""
    if lit:
        c = rng.choice(WARM) if rng.random() < 0.87 else rng.choice(COOL)
        glow = scaled(c, 0.4 * 4.0 ** rng.random())
        if rng.random() < 0.3:      # a blind half drawn
            m = w1 - (w1 - w0) * rng.choice((0.35, 0.5, 0.65))
            pane(P, b0, b1, m, w1, deep, 'blind', scaled(glow, 0.55))
            pane(P, b0, b1, w0, m, deep, 'room', glow)
        else:
            pane(P, b0, b1, w0, w1, deep, 'room', glow)
    else:
        pane(P, b0, b1, w0, w1, deep, 'glass')
    f, d0, d1 = 0.05, -deep - 0.01, -deep + 0.05
    mid, top = (b0 + b1) / 2, w0 + (w1 - w0) * 0.68
    for a, b, s, t in ((b0, b0 + f, w0, w1), (b1 - f, b1, w0, w1), (b0, b1, w0, w0 + f), (b0, b1, w1 - f, w1),
                       (mid - f * 0.6, mid + f * 0.6, w0, w1), (b0, b1, top - f * 0.5, top + f * 0.5)):
        solid.box((a, d0, s), (b, d1, t), 'frame', P=P)
    solid.box((b0 - 0.08, -0.05, w0 - 0.1), (b1 + 0.08, 0.09, w0), 'stone', P=P)


def awning(P, a0, a1, z, colour):
    n = max(3, round((a1 - a0) / 0.35))
    for i in range(n):
        s, t = a0 + (a1 - a0) * i / n, a0 + (a1 - a0) * (i + 1) / n
        m = colour if i % 2 else 'cloth'
        solid.poly([P(s, 0.02, z), P(t, 0.02, z), P(t, 1.3, z - 0.55), P(s, 1.3, z - 0.55)], m)
        solid.poly([P(s, 1.3, z - 0.55), P(t, 1.3, z - 0.55), P(t, 1.3, z - 0.78), P(s, 1.3, z - 0.78)], m)


def shop(P, a0, a1, z1, colour, glow, canopy=None, open_=True):
    """Ground floor shop: painted front, large panes, a door in the middle, a fascia above."""
    top = z1 - 0.75
    da = (a0 + a1) / 2
    cells = [(a0 + 0.25, da - 0.6, 0.55), (da - 0.48, da + 0.48, 0.14), (da + 0.6, a1 - 0.25, 0.55)]
    edges = [a0, da - 0.54, da + 0.54, a1]
    for (b0, b1, w0), e0, e1 in zip(cells, edges, edges[1:]):
        hole(P, e0, e1, 0, z1, b0, b1, w0, top, colour, 0.22, colour)
        k = 'shop' if open_ else 'glass'
        pane(P, b0, b1, w0, top, 0.22, k, glow)
        bars = 1 if b1 - b0 < 1.2 else max(2, round((b1 - b0) / 1.1))
        for i in range(bars + 1):
            a = b0 + (b1 - b0) * i / bars
            solid.box((a - 0.035, -0.23, w0), (a + 0.035, -0.15, top), colour, P=P)
        solid.box((b0, -0.23, top - 0.55), (b1, -0.16, top - 0.49), colour, P=P)
    solid.box((a0 + 0.1, 0, top + 0.12), (a1 - 0.1, 0.1, z1 - 0.12), colour, P=P)      # fascia
    solid.box((a0, 0, z1 - 0.12), (a1, 0.2, z1), 'stone', P=P)
    if canopy:
        awning(P, a0 + 0.2, a1 - 0.2, top + 0.15, canopy)
    if open_:
        # One soft light outside the panes stands for what falls through them onto the pavement.
        c, d = P((a0 + a1) / 2, 0.06, 1.6), P((a0 + a1) / 2, 1.0, 1.15)
        light('AREA', c, glow, 24.0 * (a1 - a0) / 6, size=a1 - a0 - 0.6, size_y=1.6, target=d)


def door(P, a0, a1, z1, wall):
    m = (a0 + a1) / 2
    hole(P, a0, a1, 0, z1, m - 0.55, m + 0.55, 0.14, 2.75, wall, 0.3, 'stone')
    solid.box((m - 0.55, -0.32, 0.14), (m + 0.55, -0.26, 2.25), rng.choice(('green', 'wine', 'blue', 'wood')), P=P)
    pane(P, m - 0.55, m + 0.55, 2.25, 2.75, 0.29, 'blind', scaled(rng.choice(WARM), 1.6))
    solid.box((m - 0.7, 0, 0), (m + 0.7, 0.3, 0.13), 'stone', P=P)
    for a in (m - 0.72, m + 0.55):
        solid.box((a, 0, 0.13), (a + 0.17, 0.06, 2.8), 'stone', P=P)
    solid.box((m - 0.78, 0, 2.75), (m + 0.78, 0.16, 2.92), 'stone', P=P)
