"""Scenes to render, as small as they can be."""
import math

import bpy


def empty(width=16, height=9):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.preferences.addon_enable(module="brume_fog")
    scene = bpy.context.scene
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0, 0, 0, 1)
    scene.render.engine = "CYCLES"
    scene.cycles.device, scene.cycles.samples, scene.cycles.use_denoising = "CPU", 4, False
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    scene.render.image_settings.color_depth, scene.render.image_settings.exr_codec = "32", "NONE"
    scene.view_layers[0].use_pass_z = True
    scene.frame_end = 2
    return scene


def camera(scene, location=(0, 0, 5), rotation=(0, 0, 0)):
    made = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    made.location, made.rotation_euler = location, rotation
    scene.collection.objects.link(made)
    scene.camera = made
    return made


def plane(scene, strength=None, size=200, location=(0, 0, 0)):
    """White and matt or, with a strength, shining."""
    mesh = bpy.data.meshes.new("plane")
    half = size / 2
    mesh.from_pydata([(-half, -half, 0), (half, -half, 0), (half, half, 0), (-half, half, 0)], [], [(0, 1, 2, 3)])
    made = bpy.data.objects.new("plane", mesh)
    made.location = location
    material = bpy.data.materials.new("white")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    shader = tree.nodes.new("ShaderNodeBsdfDiffuse" if strength is None else "ShaderNodeEmission")
    shader.inputs["Color"].default_value = (1, 1, 1, 1)
    if strength is not None:
        shader.inputs["Strength"].default_value = strength
    tree.links.new(shader.outputs[0], tree.nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    mesh.materials.append(material)
    scene.collection.objects.link(made)
    return made


def lamp(scene, kind, watts, location=(0, 0, 4), rotation=(0, 0, 0), name="lamp"):
    made = bpy.data.objects.new(name, bpy.data.lights.new(name, kind))
    made.data.energy, made.location, made.rotation_euler = watts, location, rotation
    scene.collection.objects.link(made)
    return made


def street(scene):
    """A ground with a wall, a lamp that moves and a camera that walks."""
    plane(scene)
    wall = plane(scene, size=3, location=(2.5, 14, 1))
    wall.rotation_euler = (math.radians(90), 0, 0)
    walker = camera(scene, (0, 0, 1.7), (math.radians(88), 0, 0))
    light = lamp(scene, "POINT", 40, (-2, 10, 2.6))
    lamp(scene, "SPOT", 100, (3, 9, 4), name="spot").data.color = (1, 0.5, 0.2)
    for frame, y in ((1, 0.0), (2, 1.0)):
        walker.location.y, light.location.x = y, -2 + 2 * y
        walker.keyframe_insert("location", frame=frame)
        light.keyframe_insert("location", frame=frame)
    scene.cycles.samples = 8
    return walker, light
