"""Shadow maps of a shot's spots and suns, rendered in a copy of the scene: the user's own stays as it is."""
import contextlib
import math
import os
import tempfile

import bpy
import numpy as np
from mathutils import Vector

from . import export

KINDS = {"SPOT", "SUN"}
_CASTERS = {"MESH", "CURVE", "SURFACE", "META", "FONT"}


def without(scene):
    """Names of the lamps that light the fog and get no map."""
    return [thing.name for thing in scene.objects if thing.type == "LIGHT" and not thing.hide_render and thing.data.type not in KINDS]


def _points(thing):
    """Where the vertices of an evaluated object are: they may move though it does not."""
    if thing.type != "MESH":
        return b""
    places = np.empty(3 * len(thing.data.vertices), np.float32)
    thing.data.vertices.foreach_get("co", places)
    return places.tobytes()


class Frame:
    """What the maps of a frame are rendered by."""

    def __init__(self, scene, depsgraph):
        self.lamps, self.corners, state = {}, [], []
        for instance in depsgraph.object_instances:
            thing, placed = instance.object, instance.matrix_world.copy()
            if thing.type == "LIGHT" and not instance.is_instance and thing.data.type in KINDS:
                self.lamps[thing.name] = placed, (thing.data.spot_size if thing.data.type == "SPOT" else None)
            elif thing.type in _CASTERS and not thing.hide_render:
                self.corners += [placed @ Vector(corner) for corner in thing.bound_box]
                state.append((thing.name, tuple(map(tuple, placed)), tuple(map(tuple, thing.bound_box)), hash(_points(thing))))
        self.casters = hash(tuple(state))


def _view(placed, spot_size, corners):
    """Where the map of a lamp is taken from, of corners of all that is in its way: its entry in a scene file, and the clip distances."""
    turned, place = placed.to_quaternion().to_matrix(), placed.translation.copy()
    if spot_size is not None:
        # A little more than the cone: its rim is no texel's edge.
        angle = min(spot_size + math.radians(2), math.radians(170))
        found, farthest = {"vertical_fov": math.degrees(angle)}, max((corner - place).length for corner in corners)
    else:
        low, high = (Vector(pick(axis) for axis in zip(*(turned.transposed() @ corner for corner in corners))) for pick in (min, max))
        width = 1.02 * max(high.x - low.x, high.y - low.y, 1e-3 * (high.z - low.z))
        place = turned @ Vector(((low.x + high.x) / 2, (low.y + high.y) / 2, high.z + 0.01 * width))
        found, farthest = {"orthographic_width": width}, high.z - low.z + 0.02 * width
    found["camera_to_world"] = [[*turned[row], place[row]] for row in range(3)] + [[0.0, 0.0, 0.0, 1.0]]
    return found, (1e-4 * farthest, 1.1 * farthest)


@contextlib.contextmanager
def _studio(scene, size):
    """A copy of the scene that renders depth alone, and a camera in it; both are gone afterwards."""
    copy = scene.copy()
    camera = bpy.data.objects.new("brume shadow map", bpy.data.cameras.new("brume shadow map"))
    data = camera.data
    try:
        copy.collection.objects.link(camera)
        # Markers change the camera, and what is animated the settings.
        copy.timeline_markers.clear()
        copy.animation_data_clear()
        copy.camera, copy.world, copy.brume.enabled, copy.use_nodes = camera, None, False, False
        render, cycles, image = copy.render, copy.cycles, copy.render.image_settings
        render.engine = "CYCLES"
        # One ray through each pixel's middle.
        cycles.samples, cycles.use_denoising, cycles.use_adaptive_sampling = 1, False, False
        cycles.pixel_filter_type, cycles.filter_width = "BLACKMAN_HARRIS", 0.01
        render.resolution_x = render.resolution_y = size
        render.resolution_percentage, render.pixel_aspect_x, render.pixel_aspect_y = 100, 1, 1
        render.use_border = render.use_compositing = render.use_sequencer = render.use_motion_blur = render.use_multiview = False
        render.use_file_extension, render.use_overwrite = False, True
        image.file_format, image.color_depth, image.exr_codec = "OPEN_EXR_MULTILAYER", "32", "ZIP"
        for index, layer in enumerate(copy.view_layers):
            layer.use, layer.samples = index == 0, 0
            layer.use_pass_z = True
        yield copy, camera
    finally:
        bpy.data.objects.remove(camera)
        bpy.data.cameras.remove(data)
        bpy.data.scenes.remove(copy)


def _take(copy, camera, frame, entry, clip, path):
    camera.matrix_world = [*zip(*entry["camera_to_world"])]
    data = camera.data
    if "vertical_fov" in entry:
        data.type, data.angle = "PERSP", math.radians(entry["vertical_fov"])
    else:
        data.type, data.ortho_scale = "ORTHO", entry["orthographic_width"]
    data.clip_start, data.clip_end = clip
    # A still would show animated objects where the user's frame has them.
    copy.frame_start = copy.frame_end = frame
    copy.render.filepath = path + ".####"
    written = copy.render.frame_path(frame=frame)
    try:
        bpy.ops.render.render(animation=True, scene=copy.name)
    except RuntimeError as error:
        raise export.ExportError(f"{os.path.basename(path)}: the shadow map was not rendered: {error}".strip()) from None
    if not os.path.exists(written):
        raise export.ExportError(f"{os.path.basename(path)}: the shadow map was not rendered: it was cancelled")
    os.replace(written, path)


def _file_names(lamps):
    """Lamps' names as files have them, no two the same."""
    found = {}
    for lamp in lamps:
        name = base = bpy.path.clean_name(lamp)
        count = 1
        while name.lower() in (taken.lower() for taken in found.values()):
            count += 1
            name = f"{base}_{count}"
        found[lamp] = name
    return found


def add(scene, snapshots, frames, folder):
    """Renders the maps of all lamps in the snapshots by frame into the folder, and enters them there, relative to what is beside it.
    One map of a lamp where nothing has moved, else one for each frame. What is in the folder is replaced when all maps are whole."""
    lit = {name for snap in snapshots.values() for name in snap.get("lights", {})}
    lamps = [name for name in next(iter(frames.values())).lamps if name in lit] if frames else []
    corners = [corner for frame in frames.values() for corner in frame.corners]
    if not lamps or not corners:
        return
    os.makedirs(os.path.dirname(folder) or ".", exist_ok=True)
    with tempfile.TemporaryDirectory(dir=os.path.dirname(folder), prefix=".brume_shadows") as work, \
            _studio(scene, scene.brume.shadow_size) as (copy, camera):
        for lamp, name in _file_names(lamps).items():
            still = len({(frame.casters, str(frame.lamps[lamp])) for frame in frames.values()}) == 1
            file = f"{os.path.basename(folder)}/{name}.exr" if still else f"{os.path.basename(folder)}/{name}.####.exr"
            for index, (number, frame) in enumerate(frames.items()):
                entry, clip = _view(*frame.lamps[lamp], corners)
                if not still or index == 0:
                    digits = f"{'-' if number < 0 else ''}{abs(number):04}"
                    _take(copy, camera, number, entry, clip, os.path.join(work, os.path.basename(file).replace("####", digits)))
                if lamp in snapshots[number].get("lights", {}):
                    snapshots[number]["lights"][lamp]["shadow"] = {"file": file, **entry}
        os.makedirs(folder, exist_ok=True)
        for made in os.listdir(work):
            os.replace(os.path.join(work, made), os.path.join(folder, made))
