"""Collects the geometry.  Metres, z up, the street runs along +y; bent only when the objects are made."""
import math

import bpy
from mathutils import Vector

from .layout import bend


class Mesh:
    """Collects polygons; one object per kind of ray visibility, many materials in each."""

    def __init__(self, name):
        self.name, self.v, self.f, self.m, self.s, self.uv, self.glow = name, [], [], [], [], [], []
        self.mats = []

    def poly(self, pts, mat, uv=None, glow=(0, 0, 0), smooth=False):
        n = len(self.v)
        self.v += [tuple(p) for p in pts]
        self.f.append(tuple(range(n, n + len(pts))))
        self._face(mat, smooth, uv or [(0, 0)] * len(pts), glow)

    def _face(self, mat, smooth, uv, glow):
        if mat not in self.mats:
            self.mats.append(mat)
        self.m.append(self.mats.index(mat))
        self.s.append(smooth)
        self.uv += uv
        self.glow += [glow] * len(uv)

    def box(self, a, b, mat, glow=(0, 0, 0), P=lambda *p: p):
        """Box between two corners, given in the coordinates of P."""
        (x0, y0, z0), (x1, y1, z1) = a, b
        c = [P(x, y, z) for z in (z0, z1) for y in (y0, y1) for x in (x0, x1)]
        for q in ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)):
            self.poly([c[i] for i in q], mat, glow=glow)

    def loft(self, rings, mat, closed=True, caps=True, smooth=True, glow=(0, 0, 0)):
        """Skin over rings of equally many points, with shared vertices so that it shades smoothly."""
        n0, k = len(self.v), len(rings[0])
        for r in rings:
            self.v += [tuple(p) for p in r]
        for i in range(len(rings) - 1):
            for j in range(k if closed else k - 1):
                a, b = n0 + i * k + j, n0 + i * k + (j + 1) % k
                self.f.append((a, b, b + k, a + k))
                self._face(mat, smooth, [(0, 0)] * 4, glow)
        if caps:
            for r in (rings[0][::-1], rings[-1]):
                self.poly(r, mat, glow=glow)

    def tube(self, pts, radii, mat, n=8, glow=(0, 0, 0), caps=True):
        """Round bar along a line of points."""
        pts = [Vector(p) for p in pts]
        if not hasattr(radii, '__len__'):
            radii = [radii] * len(pts)
        rings = []
        for i, p in enumerate(pts):
            d = (pts[min(i + 1, len(pts) - 1)] - pts[max(i - 1, 0)]).normalized()
            u = d.cross(Vector((0.3, 0.2, 1) if abs(d.z) < 0.9 else (1, 0.1, 0))).normalized()
            w = d.cross(u)
            rings.append([p + radii[i] * (math.cos(t) * u + math.sin(t) * w)
                          for t in (2 * math.pi * j / n for j in range(n))])
        self.loft(rings, mat, caps=caps, glow=glow)

    def lathe(self, x, y, profile, mat, n=12, z=0.0, turn=0.0, smooth=True, glow=(0, 0, 0)):
        """Turned shape on a vertical axis; profile is (radius, height)."""
        self.loft([[(x + r * math.cos(t + turn), y + r * math.sin(t + turn), z + h)
                    for t in (2 * math.pi * j / n for j in range(n))] for r, h in profile],
                  mat, smooth=smooth, glow=glow)

    def make(self, materials):
        me = bpy.data.meshes.new(self.name)
        me.from_pydata([bend(p) for p in self.v], [], self.f)
        for m in self.mats:
            me.materials.append(materials[m])
        me.polygons.foreach_set('material_index', self.m)
        me.polygons.foreach_set('use_smooth', self.s)
        me.uv_layers.new(name='uv').data.foreach_set('uv', [c for t in self.uv for c in t])
        a = me.attributes.new('glow', 'FLOAT_COLOR', 'CORNER')
        a.data.foreach_set('color', [c for g in self.glow for c in (*g, 1.0)])
        me.use_auto_smooth, me.auto_smooth_angle = True, math.radians(42)
        me.update()
        ob = bpy.data.objects.new(self.name, me)
        bpy.context.scene.collection.objects.link(ob)
        return ob


solid = Mesh('solid')        # everything that is lit
panes = Mesh('panes')        # lit windows: seen and mirrored, but they light nothing (see facade.shop)
glows = Mesh('glows')        # lamp heads, signs: seen by the camera only, a light stands for each
