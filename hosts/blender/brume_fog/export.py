"""A shot as a scene file: of one frame, or keyed frame by frame."""
import math

from mathutils import Vector

from . import medium

_DOWN = Vector((0, 0, -1))  # where lamps look


class ExportError(Exception):
    pass


def _rows(matrix):
    """Rigid: Blender's cameras and lamps ignore the scale of their objects."""
    place, turned = matrix.to_translation(), matrix.to_quaternion().to_matrix()
    return [[*turned[row], place[row]] for row in range(3)] + [[0.0, 0.0, 0.0, 1.0]]


def _window(render):
    """Size of the picture in pixels, and the part of it that is written: left, right, bottom, top as fractions."""
    width = max(1, render.resolution_x * render.resolution_percentage // 100)
    height = max(1, render.resolution_y * render.resolution_percentage // 100)
    part = (0.0, 1.0, 0.0, 1.0)
    if render.use_border and render.use_crop_to_border:
        part = tuple(int(at * size) / size for at, size in ((render.border_min_x, width), (render.border_max_x, width),
                                                            (render.border_min_y, height), (render.border_max_y, height)))
    return width, height, part


def camera(scene, depsgraph):
    if scene.camera is None:
        raise ExportError("the scene has no camera")
    placed = scene.camera.evaluated_get(depsgraph)
    if placed.type != "CAMERA" or placed.data.type != "PERSP":
        kind = placed.data.type if placed.type == "CAMERA" else placed.type
        raise ExportError(f"camera {placed.name}: {kind.lower()}; expected a perspective camera")
    render = scene.render
    width, height, (left, right, bottom, top) = _window(render)
    # Knows sensor fit, shift, and pixels' aspect.
    projection = placed.calc_matrix_camera(depsgraph, x=width, y=height, scale_x=render.pixel_aspect_x,
                                           scale_y=render.pixel_aspect_y)
    # Where the axis meets the whole picture, from its left and its bottom.
    across, up = (1 - projection[0][2]) / 2, (1 - projection[1][2]) / 2
    return {"vertical_fov": math.degrees(2 * math.atan((top - bottom) / projection[1][1])),
            "pixel_aspect": render.pixel_aspect_x / render.pixel_aspect_y,
            "center": [(across - left) / (right - left), (top - up) / (top - bottom)],
            "camera_to_world": _rows(placed.matrix_world)}


def _emission(light):
    """Colour times strength, of the lamp and of its node, where that is a plain one."""
    color, strength = tuple(light.color), 1.0
    if light.use_nodes and light.node_tree:
        output = light.node_tree.get_output_node("ALL")
        link = next(iter(output.inputs["Surface"].links), None) if output else None
        if link and link.from_node.bl_idname == "ShaderNodeEmission":
            inputs = link.from_node.inputs
            if not inputs["Color"].is_linked:
                color = tuple(a * b for a, b in zip(color, inputs["Color"].default_value))
            if not inputs["Strength"].is_linked:
                strength = inputs["Strength"].default_value
    return [light.energy * strength * c for c in color]


def _cone(light):
    """Cycles' spots fall off as the cosine from their axis, times a smooth step to the rim. Brume's are a smooth step: the one
    of the same flux, and the same on the axis."""
    rim = math.cos(light.spot_size / 2)
    step = (1 - rim) * light.spot_blend
    flux = step * (rim / 2 + 0.35 * step) + (1 - (rim + step) ** 2) / 2
    inner = rim + 2 * (1 - rim - flux)
    if inner > 1:
        rim, inner = 1 - 2 * flux, 1.0
    half = math.acos(rim)
    return {"angle": math.degrees(2 * half), "penumbra": 1 - math.acos(inner) / half}


def _lamp(placed, fog, metres):
    """A lamp's light in Brume's units. Blender's watts are taken for lengths in its units, whatever the scene's scale."""
    light, watts = placed.data, _emission(placed.data)
    axis = placed.matrix_world.to_quaternion().to_matrix() @ _DOWN
    if light.type == "SUN":
        return {"type": "directional", "direction": list(axis), "intensity": watts, "distance": fog.sun_distance}
    # W / sr: of a sphere all around, of an area P / 4 along its axis.
    share = 1 / 4 if light.type == "AREA" else 1 / (4 * math.pi)
    found = {"type": "point" if light.type == "POINT" else "spot", "position": list(placed.matrix_world.translation),
             "intensity": [value * share * metres * metres for value in watts]}
    if light.type == "AREA":
        area = light.size * (light.size_y if light.shape in ("RECTANGLE", "ELLIPSE") else light.size)
        if light.shape in ("DISK", "ELLIPSE"):
            area *= math.pi / 4
        # A half space whose falloff has the flux of a cosine's.
        found.update(radius=math.sqrt(area / math.pi), direction=list(axis), angle=180.0, penumbra=1.0)
    else:
        found["radius"] = light.shadow_soft_size
    if light.type == "SPOT":
        found.update(direction=list(axis), **_cone(light))
    return found


def lamps(scene, depsgraph):
    """Lights by the names of their objects."""
    found, metres = {}, scene.unit_settings.scale_length
    for instance in depsgraph.object_instances:
        placed = instance.object
        if placed.type != "LIGHT" or placed.hide_render or instance.is_instance:
            continue
        made = _lamp(placed, scene.brume, metres)
        if not any(made["intensity"]):
            continue
        group = getattr(placed.original, "lightgroup", "")
        if group:
            made["group"] = f"{scene.view_layers[0].name}.Combined_{group}"
        found[placed.name] = made
    return found


def snapshot(scene, depsgraph):
    """What a scene file says of the frame that a depsgraph is at; lights by name."""
    found = {"camera": camera(scene, depsgraph), "medium": medium.block(scene.brume)}
    if scene.brume.use_lights:
        found["lights"] = lamps(scene, depsgraph)
    return found


def _dark(lamp):
    return {**lamp, "intensity": [0.0, 0.0, 0.0]}


def _merged(values):
    """One value of those of all frames: itself where it stands still, else keyed."""
    frames, first = list(values), next(iter(values.values()))
    if all(value == first for value in values.values()):
        return first
    if isinstance(first, dict):
        return {key: _merged({frame: values[frame][key] for frame in frames}) for key in first}
    if isinstance(first, list):
        return [_merged({frame: values[frame][index] for frame in frames}) for index in range(len(first))]
    return {"keys": [[frame, values[frame]] for frame in frames]}


def scene_file(scene, snapshots):
    """A scene file, of snapshots by frame."""
    if not snapshots:
        raise ExportError("there is no frame")
    kept = {name: lamp for snap in snapshots.values() for name, lamp in snap.get("lights", {}).items()}
    whole = {}
    for frame, snap in snapshots.items():
        # A lamp that is hidden in some frames is dark in them: the number of lights is the same in all.
        lights = [snap.get("lights", {}).get(name) or _dark(lamp) for name, lamp in kept.items()]
        whole[frame] = {**snap, "lights": lights}
    # A density that falls in some frames only is flat in the others.
    falls = any("density" in snap["medium"] for snap in snapshots.values())
    for snap in whole.values():
        if falls and "density" not in snap["medium"]:
            snap["medium"] = {**snap["medium"], "density": [{"type": "exponential", "value": 1.0, "falloff": 0.0,
                                                             "direction": [0, 0, 1], "origin": [0, 0, scene.brume.ground]}]}
    made = {"brume": 1, "metres_per_unit": scene.unit_settings.scale_length, **_merged(whole)}
    if not made["lights"]:
        del made["lights"]
    if scene.brume.quality != "NONE":
        made["quality"] = scene.brume.quality.lower()
    return made
