"""Models a night street and renders the raw passes of the demo frames with Blender's Cycles.

    blender -b -P render.py -- --raw RAW [--frames 1-20] [--size 640x360] [--samples 36]
                               [--threads 0] [--seed 1] [--blend FILE]
    python3 finish.py --raw RAW --out .

  --raw      folder for the raw passes (full float, a few hundred MB; finish.py turns them into frames)
  --frames   first-last, or a list such as 1,10,20; the sequence itself is always FRAMES long
  --size     picture size in pixels
  --samples  paths per pixel
  --threads  CPU threads, 0 for all
  --seed     of the sampling noise; the scene has a fixed seed of its own
  --blend    also save the scene, to look at it in Blender

Everything is modelled here, from no other file, and comes out the same on every run.  Units are
metres, z is up, the street runs along +y.  There is no fog: fog is what Brume adds.
Written for Blender 3.4; needs nothing but Blender.
"""
import argparse
import json
import math
import os
import random
import sys

import bpy
from mathutils import Matrix, Vector

FRAMES = 20
NEAR, FAR = 0.1, 1000.0

rng = random.Random(1897)

KERB = 4.0      # half width of the carriageway
WALL = 7.0      # half width between the facades
PAVE = 0.12     # height of the pavement
END = 186.0     # where the rows of houses end


def bend(p):
    """The street curves to the right, so the far facades and lamps are not all seen end on."""
    x, y, z = p
    return (x + 0.00042 * max(0.0, y - 30.0) ** 2, y, z)


# ---------------------------------------------------------------- geometry

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
panes = Mesh('panes')        # lit windows: seen and mirrored, but they light nothing (see shop_light)
glows = Mesh('glows')        # lamp heads, signs: seen by the camera only, a light stands for each
lights = []                  # (kind, position, colour, watts, options)


def light(kind, pos, colour, watts, **opt):
    lights.append((kind, pos, colour, watts, opt))


# ---------------------------------------------------------------- materials

class Nodes:
    """Shorthand for building a material's node tree."""

    def __init__(self, name):
        self.mat = bpy.data.materials.new(name)
        self.mat.use_nodes = True
        self.t = self.mat.node_tree
        self.t.nodes.clear()

    def n(self, kind, props=None, **inputs):
        node = self.t.nodes.new('ShaderNode' + kind)
        for k, v in (props or {}).items():
            setattr(node, k, v)
        for k, v in inputs.items():
            self.put(node.inputs[int(k[1:]) if k[0] == 'i' and k[1:].isdigit() else k.replace('_', ' ')], v)
        return node

    def put(self, socket, v):
        if isinstance(v, bpy.types.NodeSocket):
            self.t.links.new(v, socket)
        elif isinstance(v, bpy.types.Node):
            self.t.links.new(v.outputs[0], socket)
        else:
            socket.default_value = v

    def math(self, op, a, b=0.0, c=0.0, clamp=False):
        return self.n('Math', {'operation': op, 'use_clamp': clamp}, i0=a, i1=b, i2=c)

    def noise(self, scale, detail=2.0, rough=0.5, vec=None):
        vec = vec or self.n('NewGeometry').outputs['Position']
        return self.n('TexNoise', Vector=vec, Scale=scale, Detail=detail, Roughness=rough).outputs['Fac']

    def ramp(self, fac, lo, hi, a, b):
        """Value a below lo, b above hi, smooth between."""
        return self.n('MapRange', {'interpolation_type': 'SMOOTHSTEP'}, i0=fac, i1=lo, i2=hi, i3=a, i4=b).outputs[0]

    def mix(self, fac, a, b, blend='MIX'):
        return self.n('MixRGB', {'blend_type': blend}, Fac=fac, Color1=a, Color2=b).outputs[0]

    def out(self, shader):
        self.t.links.new(shader.outputs[0], self.n('OutputMaterial').inputs['Surface'])
        return self.mat


def rgb(r, g, b):
    return (r, g, b, 1.0)


def plain(name, colour, rough=0.6, spec=0.4, metallic=0.0, coat=0.0):
    m = Nodes(name)
    return m.out(m.n('BsdfPrincipled', Base_Color=rgb(*colour), Roughness=rough, Specular=spec,
                     Metallic=metallic, Clearcoat=coat, Clearcoat_Roughness=0.08))


def along_wall(m):
    """(distance along the wall, height, 0): walls face x or y, so x + y runs along either."""
    p = m.n('SeparateXYZ', Vector=m.n('NewGeometry').outputs['Position'])
    return m.n('CombineXYZ', X=m.math('ADD', p.outputs[0], p.outputs[1]), Y=p.outputs[2]).outputs[0]


def stains(m, colour):
    """Weathering: broad blotches, and dirt towards the ground."""
    z = m.n('SeparateXYZ', Vector=m.n('NewGeometry').outputs['Position']).outputs[2]
    c = m.mix(m.ramp(m.noise(0.7, 4, 0.6), 0.3, 0.7, 0.0, 0.35), colour, rgb(0.05, 0.045, 0.04))
    return m.mix(m.ramp(z, 0.0, 1.3, 0.45, 0.0), c, rgb(0.03, 0.03, 0.03))


def stucco(name, colour):
    m = Nodes(name)
    return m.out(m.n('BsdfPrincipled', Base_Color=stains(m, rgb(*colour)), Roughness=0.85, Specular=0.15))


def brick(name, a, b):
    m = Nodes(name)
    t = m.n('TexBrick', {'offset': 0.5}, Vector=along_wall(m), Color1=rgb(*a), Color2=rgb(*b),
            Mortar=rgb(0.16, 0.14, 0.12), Scale=1.0, Mortar_Size=0.008, Brick_Width=0.26, Row_Height=0.085)
    return m.out(m.n('BsdfPrincipled', Base_Color=stains(m, t.outputs[0]), Roughness=0.8, Specular=0.2))


def asphalt(name):
    """Wet after rain: puddles mirror the lamps, the rest stretches them into streaks."""
    m = Nodes(name)
    wet = m.ramp(m.noise(0.42, 3, 0.55), 0.5, 0.62, 0.0, 1.0)
    pos = m.n('NewGeometry').outputs['Position']
    # The grain fades with distance, where it would be noise smaller than a pixel.
    far = m.ramp(m.n('CameraData').outputs['View Distance'], 4.0, 22.0, 1.0, 0.0)
    bump = m.n('Bump', Strength=m.math('MULTIPLY', far, m.math('MULTIPLY_ADD', wet, -0.33, 0.35)), Distance=0.02,
               Height=m.noise(16.0, 2, 0.6, pos))
    colour = m.mix(m.noise(1.3, 4, 0.65), rgb(0.035, 0.036, 0.04), rgb(0.085, 0.083, 0.08))
    colour = m.mix(wet, colour, rgb(0.022, 0.023, 0.026))
    return m.out(m.n('BsdfPrincipled', Base_Color=colour, Specular=m.math('MULTIPLY_ADD', wet, 0.32, 0.16), Normal=bump,
                     Roughness=m.math('MULTIPLY_ADD', wet, -0.2, 0.34)))


def paving(name):
    m = Nodes(name)
    p = m.n('NewGeometry').outputs['Position']
    t = m.n('TexBrick', {'offset': 0.5}, Vector=p, Color1=rgb(0.17, 0.16, 0.15), Color2=rgb(0.12, 0.115, 0.11),
            Mortar=rgb(0.04, 0.04, 0.04), Scale=1.0, Mortar_Size=0.012, Brick_Width=0.75, Row_Height=0.5)
    wet = m.ramp(m.noise(0.6, 3, 0.6), 0.45, 0.65, 0.0, 1.0)
    colour = m.mix(m.math('MULTIPLY', wet, 0.5), t.outputs[0], rgb(0.03, 0.03, 0.03))
    return m.out(m.n('BsdfPrincipled', Base_Color=colour, Specular=0.4, Roughness=m.math('MULTIPLY_ADD', wet, -0.25, 0.6)))


def emitter(name, shape):
    """Light of the colour stored with each face, shaped by shape(m, u, v)."""
    m = Nodes(name)
    uv = m.n('SeparateXYZ', Vector=m.n('UVMap', {'uv_map': 'uv'}))
    e = m.n('Emission', Color=m.n('Attribute', {'attribute_name': 'glow'}).outputs['Color'],
            Strength=shape(m, uv.outputs[0], uv.outputs[1]))
    # Not sampled as a light: these are many, and the lights that stand for them are far less noisy.
    m.mat.cycles.sample_as_light = False
    return m.out(e)


def flat_shape(m, u, v):
    return 1.0


def room_shape(m, u, v):
    """Curtains drawn to the sides with folds in them, a ceiling lamp behind the upper half."""
    side = m.math('ABSOLUTE', m.math('SUBTRACT', u, 0.5))
    fold = m.math('MULTIPLY_ADD', m.math('SINE', m.math('MULTIPLY', u, 95.0)), 0.12, 0.42)
    open_ = m.ramp(side, 0.26, 0.32, 1.0, 0.0)
    height = m.ramp(v, 0.0, 1.0, 0.55, 1.15)
    body = m.math('ADD', m.math('MULTIPLY', open_, m.math('SUBTRACT', 1.0, fold)), fold)
    return m.math('MULTIPLY', body, height)


def blind_shape(m, u, v):
    return m.ramp(v, 0.0, 1.0, 0.75, 1.1)


def shop_shape(m, u, v):
    """Things on display: dark shapes low down, bright wall and lamps above."""
    cell = m.n('TexVoronoi', {'distance': 'CHEBYCHEV'}, Vector=along_wall(m), Scale=4.2).outputs['Color']
    cell = m.n('SeparateRGB', Image=cell).outputs[0]
    goods = m.ramp(m.math('SUBTRACT', v, m.math('MULTIPLY', cell, 0.32)), 0.0, 0.06, 0.35, 1.0)
    return m.math('MULTIPLY', goods, m.ramp(v, 0.1, 1.0, 0.55, 1.25))


def lantern_shape(m, u, v):
    """A frosted pane before a burner: 30 at the rim, 200 before the flame, times the stored colour."""
    du, dv = m.math('SUBTRACT', u, 0.5), m.math('SUBTRACT', v, 0.42)
    d2 = m.math('ADD', m.math('MULTIPLY', du, du), m.math('MULTIPLY', dv, dv))
    return m.math('MULTIPLY_ADD', m.math('EXPONENT', m.math('MULTIPLY', d2, -18.0)), 170.0, 30.0)


WALLS = ['ochre', 'cream', 'rose', 'grey', 'sage', 'redbrick', 'brownbrick']


def materials():
    return {
        'asphalt': asphalt('asphalt'), 'paving': paving('paving'),
        'kerb': plain('kerb', (0.2, 0.2, 0.19), 0.5), 'line': plain('line', (0.45, 0.45, 0.42), 0.35),
        'ochre': stucco('ochre', (0.42, 0.29, 0.14)), 'cream': stucco('cream', (0.5, 0.44, 0.34)),
        'rose': stucco('rose', (0.42, 0.24, 0.19)), 'grey': stucco('grey', (0.3, 0.31, 0.33)),
        'sage': stucco('sage', (0.27, 0.32, 0.25)),
        'redbrick': brick('redbrick', (0.3, 0.1, 0.06), (0.2, 0.07, 0.045)),
        'brownbrick': brick('brownbrick', (0.24, 0.15, 0.09), (0.17, 0.1, 0.065)),
        'stone': stucco('stone', (0.42, 0.4, 0.36)), 'frame': plain('frame', (0.35, 0.34, 0.31), 0.5),
        'dark': plain('dark', (0.03, 0.035, 0.035), 0.45), 'slate': plain('slate', (0.05, 0.055, 0.065), 0.55),
        'iron': plain('iron', (0.02, 0.024, 0.022), 0.35, 0.6), 'wood': plain('wood', (0.12, 0.06, 0.03), 0.5),
        'green': plain('green', (0.03, 0.09, 0.06), 0.4), 'wine': plain('wine', (0.13, 0.02, 0.025), 0.4),
        'blue': plain('blue', (0.03, 0.05, 0.12), 0.4), 'cloth': plain('cloth', (0.42, 0.4, 0.36), 0.8, 0.1),
        'red': plain('red', (0.3, 0.02, 0.02), 0.7, 0.1), 'bark': plain('bark', (0.07, 0.055, 0.045), 0.85, 0.2),
        'glass': plain('glass', (0.012, 0.014, 0.018), 0.12, 0.6), 'tyre': plain('tyre', (0.015, 0.015, 0.015), 0.8),
        'alloy': plain('alloy', (0.12, 0.12, 0.125), 0.4, metallic=0.6),
        'paint0': plain('paint0', (0.02, 0.028, 0.05), 0.35, coat=1.0), 'paint1': plain('paint1', (0.16, 0.015, 0.015), 0.35, coat=1.0),
        'paint2': plain('paint2', (0.25, 0.26, 0.27), 0.35, coat=1.0), 'paint3': plain('paint3', (0.02, 0.05, 0.04), 0.35, coat=1.0),
        'reflector': plain('reflector', (0.2, 0.01, 0.01), 0.2), 'plate': plain('plate', (0.5, 0.5, 0.45), 0.4),
        'room': emitter('room', room_shape), 'blind': emitter('blind', blind_shape),
        'shop': emitter('shop', shop_shape), 'lantern': emitter('lantern', lantern_shape),
        'flat': emitter('flat', flat_shape),
    }


# ---------------------------------------------------------------- houses

WARM = [(1.0, 0.55, 0.21), (1.0, 0.62, 0.29), (1.0, 0.7, 0.4), (1.0, 0.48, 0.16)]
COOL = [(0.75, 0.88, 1.0), (0.55, 0.75, 1.0)]


def scaled(c, s):
    return tuple(x * s for x in c)


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


def right(a, d, z):
    return (WALL - d, a, z)


def left(a, d, z):
    return (-WALL + d, a, z)


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


# ---------------------------------------------------------------- street

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


LAMP = (1.0, 0.67, 0.36)


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


def furniture():
    for k in range(10):
        lamp_post(-KERB - 0.5, 9.5 + 16.5 * k)
        lamp_post(KERB + 0.5, 17.5 + 16.5 * k)
    wall_lantern(left, 22.6, 2.7)
    wall_lantern(right, 8.6, 2.7)
    bench(-5.0, 13.2)
    tree(4.75, 12.6, 7.2, 5)
    tree(-4.9, 31.5, 7.6, 8)
    tree(4.9, 57.5, 7.4, 13)
    for k in range(9):
        bollard(-KERB - 0.45, 6.2 + 1.65 * k + (0.8 if k == 2 else 0))
    for y in (7.4, 9.6):
        cafe_table(-6.15, y)
    cafe_table(-6.15, 11.8)
    for y, p in ((10.2, 'paint0'), (15.6, 'paint2'), (21.4, 'paint1'), (46, 'paint3'), (51.6, 'paint2'), (63, 'paint0'), (80, 'paint1')):
        car(3.0, y, 1, p)
    for y, p in ((49, 'paint0'), (55, 'paint1'), (90, 'paint3'), (96, 'paint2')):
        car(-3.05, y, -1, p)
    car(0.75, 29.0, 1, 'paint3', lamps=True)
    car(-2.35, 74.0, -1, 'paint2', lamps=True)
    traffic_light(4.35, 32.2)
    neon('HOTEL', right, 27.0, 0.45, 4.6, 0.62, (26, 2.2, 1.6), 0.038, vertical=True, across=True)
    neon('CAFE', left, 17.2, 0.4, 3.25, 0.5, (16, 7.5, 1.5), 0.03, across=True, watts=40)
    neon('BAR', right, 46.0, 0.4, 5.4, 0.8, (2.0, 14, 22), 0.045, across=True, watts=25)
    pharmacy_cross(left, 28.0, 1.1, 4.9, 0.55, (1.0, 20, 4.0))
    solid.lathe(-KERB - 0.6, 24.6, [(0.22, 0), (0.25, 0.05), (0.25, 0.9), (0.27, 0.92), (0.2, 0.95)], 'green', 14, PAVE)


def make_lights():
    for i, (kind, pos, colour, watts, opt) in enumerate(lights):
        d = bpy.data.lights.new('%s%d' % (kind.lower(), i), kind)
        m = max(colour)
        d.color, d.energy = scaled(colour, 1 / m), watts
        if kind == 'AREA':
            d.shape, d.size, d.size_y = 'RECTANGLE', opt['size'], opt['size_y']
        else:
            d.shadow_soft_size = opt['radius']
        if kind == 'SPOT':
            d.spot_size, d.spot_blend = opt['spot'], 0.7
        ob = bpy.data.objects.new(d.name, d)
        ob.location = bend(pos)
        if 'target' in opt:
            ob.rotation_euler = (Vector(bend(opt['target'])) - ob.location).to_track_quat('-Z', 'Y').to_euler()
        ob.visible_camera = False
        bpy.context.scene.collection.objects.link(ob)


def sky():
    """Last light: deep blue overhead, a dull glow low down.  No geometry, so depth stays infinite."""
    w = bpy.data.worlds.new('sky')
    w.use_nodes = True
    t = w.node_tree
    geo, sep = t.nodes.new('ShaderNodeTexCoord'), t.nodes.new('ShaderNodeSeparateXYZ')
    ramp, bg = t.nodes.new('ShaderNodeValToRGB'), t.nodes['Background']
    t.links.new(geo.outputs['Generated'], sep.inputs[0])
    t.links.new(sep.outputs[2], ramp.inputs[0])
    t.links.new(ramp.outputs[0], bg.inputs[0])
    e = ramp.color_ramp
    e.interpolation = 'EASE'
    stops = [(0.0, (0.30, 0.20, 0.17)), (0.12, (0.17, 0.16, 0.22)), (0.35, (0.055, 0.085, 0.18)), (1.0, (0.016, 0.03, 0.085))]
    while len(e.elements) < len(stops):
        e.elements.new(0.5)
    for el, (p, c) in zip(e.elements, stops):
        el.position, el.color = p, rgb(*c)
    bg.inputs[1].default_value = 0.42
    w.cycles.sampling_method = 'NONE'     # smooth and dim: leave the light samples to the lamps
    bpy.context.scene.world = w


def camera_at(cam, frame):
    """Walking pace at eye height, turning slightly; frame from 1."""
    t = (frame - 1) / (FRAMES - 1)
    cam.location = (-1.75 + 0.25 * t, 3.0 * t, 1.7)
    yaw, pitch = math.radians(1.0 + 2.5 * t), math.radians(4.2)
    cam.rotation_euler = (math.pi / 2 + pitch, 0, -yaw)


def build(args):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    sc = bpy.context.scene
    sc.render.engine = 'CYCLES'
    rows()
    ground()
    furniture()
    mats = materials()
    solid.make(mats)
    ob = panes.make(mats)
    ob.visible_diffuse = False
    ob = glows.make(mats)
    ob.visible_diffuse = ob.visible_glossy = ob.visible_shadow = False
    make_lights()
    sky()
    cam = bpy.data.objects.new('camera', bpy.data.cameras.new('camera'))
    cam.data.sensor_width, cam.data.lens = 36.0, 27.0
    cam.data.clip_start, cam.data.clip_end = NEAR, FAR
    sc.collection.objects.link(cam)
    sc.camera = cam

    sc.render.resolution_x, sc.render.resolution_y = args.size
    sc.render.resolution_percentage = 100
    sc.render.image_settings.file_format = 'OPEN_EXR_MULTILAYER'
    sc.render.image_settings.color_depth = '32'
    sc.render.image_settings.exr_codec = 'ZIP'
    sc.render.use_persistent_data = True
    if args.threads:
        sc.render.threads_mode, sc.render.threads = 'FIXED', args.threads
    sc.view_settings.view_transform = 'Standard'
    c = sc.cycles
    c.device = 'CPU'
    c.max_bounces, c.diffuse_bounces, c.glossy_bounces = 1, 1, 1
    c.transmission_bounces = c.volume_bounces = c.transparent_max_bounces = 0
    c.sample_clamp_direct, c.sample_clamp_indirect = 0.0, 1.5
    c.caustics_reflective = c.caustics_refractive = False
    c.blur_glossy = 0.5
    c.use_denoising = False
    c.light_sampling_threshold = 0.03
    c.use_adaptive_sampling = False
    vl = sc.view_layers[0]
    vl.name = 'v'
    for p in ('z', 'normal', 'diffuse_direct', 'diffuse_indirect', 'diffuse_color',
              'glossy_direct', 'glossy_indirect', 'glossy_color', 'emit', 'environment'):
        setattr(vl, 'use_pass_' + p, True)
    return sc, cam


def main():
    ap = argparse.ArgumentParser(prog='render.py')
    ap.add_argument('--raw', required=True)
    ap.add_argument('--frames', default='1-%d' % FRAMES)
    ap.add_argument('--size', default='640x360', type=lambda s: tuple(map(int, s.split('x'))))
    ap.add_argument('--samples', default=36, type=int)
    ap.add_argument('--threads', default=0, type=int)
    ap.add_argument('--seed', default=1, type=int)
    ap.add_argument('--blend')
    args = ap.parse_args(sys.argv[sys.argv.index('--') + 1:] if '--' in sys.argv else [])
    if '-' in args.frames:
        a, b = map(int, args.frames.split('-'))
        frames = range(a, b + 1)
    else:
        frames = map(int, args.frames.split(','))
    os.makedirs(args.raw, exist_ok=True)
    sc, cam = build(args)
    if args.blend:
        bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath(args.blend))
    w, h = args.size
    for f in frames:
        camera_at(cam, f)
        bpy.context.view_layer.update()
        # Beauty, antialiased; then one exact ray through each pixel's centre, because depth must not be averaged.
        for name, spp, filt in (('beauty', args.samples, 1.5), ('centre', 1, 0.01)):
            sc.cycles.samples, sc.cycles.filter_width = spp, filt
            sc.cycles.seed = args.seed * 1000 + f
            sc.render.filepath = os.path.abspath(os.path.join(args.raw, '%s.%04d.exr' % (name, f)))
            bpy.ops.render.render(write_still=True)
        dg = bpy.context.evaluated_depsgraph_get()
        proj = cam.calc_matrix_camera(dg, x=w, y=h)
        view = cam.matrix_world.inverted()
        # Blender's matrices act on columns; EXR stores those that act on rows.
        info = {'worldToCamera': [x for col in view.transposed() for x in col],
                'worldToNDC': [x for col in (proj @ view).transposed() for x in col],
                'vfov': 2 * math.degrees(math.atan(cam.data.sensor_width * h / w / 2 / cam.data.lens)),
                'lamps': sorted({bend(p) for k, p, c, e, o in lights if c is LAMP}, key=lambda p: p[1])}
        with open(os.path.join(args.raw, 'camera.%04d.json' % f), 'w') as fh:
            json.dump(info, fh)


main()
