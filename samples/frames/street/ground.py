"""Carriageway, kerbs, pavements and the lines painted on them."""
from .layout import KERB, PAVE
from .mesh import solid


def ground():
    step = 2.0
    n0, n1 = -20, 240
    for i in range(int((n1 - n0) / step)):
        y0, y1 = n0 + i * step, n0 + (i + 1) * step

        def strip(x0, x1, z0, z1, m):
            solid.poly([(x0, y0, z0), (x1, y0, z1), (x1, y1, z1), (x0, y1, z0)], m)
        strip(-KERB, KERB, 0, 0, 'asphalt')
        for s in (-1, 1):
            strip(s * KERB, s * KERB, 0, PAVE, 'kerb')
            strip(s * KERB, s * (KERB + 0.25), PAVE, PAVE, 'kerb')
            strip(s * (KERB + 0.25), s * 40, PAVE, PAVE, 'paving')
    y = -3.0
    while y < 170:        # broken line between the lanes
        solid.poly([(-0.96, y, 0.004), (-0.84, y, 0.004), (-0.84, y + 1.8, 0.004), (-0.96, y + 1.8, 0.004)], 'line')
        y += 4.5
    for i in range(8):    # zebra crossing
        x = -3.55 + i * 0.95
        solid.poly([(x, 33, 0.005), (x + 0.5, 33, 0.005), (x + 0.5, 36.2, 0.005), (x, 36.2, 0.005)], 'line')
