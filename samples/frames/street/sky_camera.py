"""The sky, and the camera's walk."""
import math

import bpy

from .nodes import rgb

FRAMES = 20
NEAR, FAR = 0.1, 1000.0


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


def add_camera(sc):
    cam = bpy.data.objects.new('camera', bpy.data.cameras.new('camera'))
    cam.data.sensor_width, cam.data.lens = 36.0, 27.0
    cam.data.clip_start, cam.data.clip_end = NEAR, FAR
    sc.collection.objects.link(cam)
    sc.camera = cam
    return cam


def camera_at(cam, frame):
    """Walking pace at eye height, turning slightly; frame from 1."""
    t = (frame - 1) / (FRAMES - 1)
    cam.location = (-1.75 + 0.25 * t, 3.0 * t, 1.7)
    yaw, pitch = math.radians(1.0 + 2.5 * t), math.radians(4.2)
    cam.rotation_euler = (math.pi / 2 + pitch, 0, -yaw)
