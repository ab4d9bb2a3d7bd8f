"""Trees, and what else stands on the pavement without giving light."""
import math
import random

from mathutils import Matrix, Vector

from .layout import PAVE
from .mesh import solid


def tree(x, y, height, seed):
    """A bare winter tree; twigs stop at a thickness that the picture can still hold."""
    r_ = random.Random(seed)

    def branch(p, d, length, r, level):
        pts, rad = [p], [r]
        steps = 4 if level == 0 else 3
        for i in range(steps):
            d = (d + Vector((r_.gauss(0, 1), r_.gauss(0, 1), r_.gauss(0.25, 0.5))) * (0.03 if level == 0 else 0.14)).normalized()
            p = p + d * (length / steps)
            pts.append(p)
            rad.append(r * (1 - 0.35 * (i + 1) / steps))
        solid.tube(pts, rad, 'bark', 8 if r > 0.03 else 5)
        if r < 0.022:
            return
        kids = 3 if level < 3 else 2
        phase = r_.uniform(0, 6.28)
        side = d.orthogonal().normalized()
        for k in range(kids):
            s = Matrix.Rotation(phase + 6.28 * k / kids + r_.uniform(-0.5, 0.5), 3, d) @ side
            lean = r_.uniform(0.4, 0.75)
            branch(p, (d * math.cos(lean) + s * math.sin(lean)).normalized(), length * r_.uniform(0.62, 0.84), r * r_.uniform(0.52, 0.64), level + 1)
    branch(Vector((x, y, 0.0)), Vector((0, 0, 1)), 0.36 * height, 0.022 * height, 0)
    solid.lathe(x, y, [(0.62, PAVE), (0.62, PAVE + 0.015)], 'iron', 16)


def bench(x, y):
    """Facing the street from the left pavement."""
    for s in (-0.75, 0.75):
        solid.box((x - 0.25, y + s - 0.03, PAVE), (x - 0.2, y + s + 0.03, 0.95), 'iron')
        solid.box((x + 0.2, y + s - 0.03, PAVE), (x + 0.25, y + s + 0.03, 0.56), 'iron')
        solid.box((x - 0.25, y + s - 0.03, 0.5), (x + 0.25, y + s + 0.03, 0.55), 'iron')
    for k in range(4):
        solid.box((x - 0.2 + k * 0.115, y - 0.9, 0.555), (x - 0.11 + k * 0.115, y + 0.9, 0.585), 'wood')
    for k in range(3):
        solid.box((x - 0.2, y - 0.9, 0.66 + k * 0.11), (x - 0.17, y + 0.9, 0.74 + k * 0.11), 'wood')


def bollard(x, y):
    solid.lathe(x, y, [(0.1, 0), (0.1, 0.06), (0.06, 0.1), (0.05, 0.75), (0.075, 0.78), (0.075, 0.84), (0.055, 0.9), (0.0001, 0.95)],
                'iron', 10, PAVE)


def cafe_table(x, y):
    solid.lathe(x, y, [(0.22, 0), (0.22, 0.02), (0.025, 0.04), (0.025, 0.7), (0.35, 0.72), (0.35, 0.745)], 'iron', 16, PAVE)
    for s in (-1, 1):
        yc = y + s * 0.62
        for a in (-0.18, 0.18):
            for b in (-0.18, 0.18):
                solid.tube([(x + a, yc + b, PAVE), (x + a * 0.9, yc + b * 0.9, PAVE + 0.46)], 0.013, 'iron', 6)
        solid.lathe(x, yc, [(0.21, 0.45), (0.21, 0.48)], 'wood', 14, PAVE)
        for a in (-0.17, 0.17):
            solid.tube([(x + a, yc + s * 0.17, PAVE + 0.46), (x + a, yc + s * 0.22, PAVE + 0.88)], 0.013, 'iron', 6)
        solid.box((x - 0.19, yc + s * 0.21 - 0.015, PAVE + 0.7), (x + 0.19, yc + s * 0.21 + 0.015, PAVE + 0.9), 'wood')
