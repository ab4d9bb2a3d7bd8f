"""Renders the shadow maps of one spot or sun lamp, and prints what a scene file says of them.

    blender -b SHOT.blend -P shadow_map.py -- LAMP OUTPUT.####.exr [SIZE]

One map for each frame of the scene; SIZE is its width and height, 1024 without. The lamp's object must not move: a scene file has one place for all maps of a light."""
import json
import math
import sys

import bpy
from mathutils import Vector


def bounds(depsgraph):
    """Corners of everything that is rendered, in world space."""
    return [instance.matrix_world @ Vector(corner) for instance in depsgraph.object_instances
            if instance.object.type in {"MESH", "CURVE", "SURFACE", "META", "FONT"} for corner in instance.object.bound_box]


def place_camera(scene, lamp):
    """A camera that sees what the lamp shines on; the map's entry in a scene file."""
    camera = bpy.data.objects.new("brume shadow map", bpy.data.cameras.new("brume shadow map"))
    scene.collection.objects.link(camera)
    turned = lamp.matrix_world.to_quaternion().to_matrix()
    place = lamp.matrix_world.translation.copy()
    found = {}
    if lamp.data.type == "SPOT":
        # A little more than the cone: its rim is no texel's edge.
        angle = min(lamp.data.spot_size + math.radians(2), math.radians(170))
        camera.data.angle = angle
        found["vertical_fov"] = math.degrees(angle)
        farthest = max([(corner - place).length for corner in bounds(bpy.context.evaluated_depsgraph_get())], default=100.0)
    else:
        seen = [turned.transposed() @ corner for corner in bounds(bpy.context.evaluated_depsgraph_get())]
        if not seen:
            sys.exit("shadow_map.py: nothing casts a shadow: the scene has no surfaces")
        low, high = (Vector(pick(axis) for axis in zip(*seen)) for pick in (min, max))
        width = 1.02 * max(high.x - low.x, high.y - low.y)
        place = turned @ Vector(((low.x + high.x) / 2, (low.y + high.y) / 2, high.z + 0.01 * width))
        camera.data.type, camera.data.ortho_scale = "ORTHO", width
        found["orthographic_width"] = width
        farthest = high.z - low.z + 0.02 * width
    camera.matrix_world = turned.to_4x4()
    camera.matrix_world.translation = place
    camera.data.clip_start, camera.data.clip_end = 1e-4 * farthest, 1.1 * farthest
    found["camera_to_world"] = [[*turned[row], place[row]] for row in range(3)] + [[0.0, 0.0, 0.0, 1.0]]
    scene.camera = camera
    return found


def render(scene, output, size):
    scene.render.engine = "CYCLES"
    # One ray through each pixel's middle.
    scene.cycles.samples, scene.cycles.use_denoising, scene.cycles.use_adaptive_sampling = 1, False, False
    scene.cycles.pixel_filter_type, scene.cycles.filter_width = "BLACKMAN_HARRIS", 0.01
    scene.render.resolution_x = scene.render.resolution_y = size
    scene.render.resolution_percentage = 100
    scene.render.pixel_aspect_x = scene.render.pixel_aspect_y = 1
    scene.render.use_border = scene.render.use_compositing = scene.render.use_sequencer = False
    for layer in scene.view_layers:
        layer.use_pass_z = True
    settings = scene.render.image_settings
    settings.file_format, settings.color_depth, settings.exr_codec = "OPEN_EXR_MULTILAYER", "32", "ZIP"
    scene.render.filepath = output
    scene.render.use_file_extension = False
    bpy.ops.render.render(animation=True)


def main(arguments):
    if not 2 <= len(arguments) <= 3:
        sys.exit(__doc__)
    name, output, size = arguments[0], arguments[1], int(arguments[2]) if len(arguments) > 2 else 1024
    scene, lamp = bpy.context.scene, bpy.data.objects.get(name)
    if lamp is None or lamp.type != "LIGHT" or lamp.data.type not in {"SPOT", "SUN"}:
        kind = "no such object" if lamp is None else (lamp.data.type if lamp.type == "LIGHT" else lamp.type).lower()
        sys.exit(f"shadow_map.py: {name}: {kind}; expected the name of a spot or a sun")
    if "#" not in output:
        sys.exit(f"shadow_map.py: {output}: expected the frame's number as ####, such as lamp.####.exr")
    entry = place_camera(scene, lamp)
    render(scene, bpy.path.abspath(output), size)
    print("shadow " + json.dumps({"file": output, **entry}))


if __name__ == "__main__":
    main(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else [])
