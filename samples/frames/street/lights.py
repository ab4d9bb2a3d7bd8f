"""Collects the lights, and makes them once all are known."""
import bpy
from mathutils import Vector

from .layout import bend

lights = []      # (kind, position, colour, watts, options)


def light(kind, pos, colour, watts, **opt):
    lights.append((kind, pos, colour, watts, opt))


def scaled(c, s):
    return tuple(x * s for x in c)


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
