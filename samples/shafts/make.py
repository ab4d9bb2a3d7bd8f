#!/usr/bin/env python3
"""A hall with a lamp behind a grating and puffs of steam that drift: pictures in clear air, depth, the lamp's shadow map, scene.

    python3 make.py FOLDER [FRAMES]

Writes NPY pictures, one CSV of Gaussians a frame, and shafts.json into FOLDER; README.md says how they are fogged."""
import json
import pathlib
import sys

import numpy as np

WIDTH, HEIGHT, FIELD_OF_VIEW = 480, 270, 55.0  # [degrees], vertical
EYE = np.array([0.0, 1.7, 0.0])  # looks down -z
BACK, SIDE, CEILING = -15.0, 7.0, 7.0  # of the hall, whose floor is y = 0 [m]
LAMP, AIM = np.array([3.2, 6.2, -12.5]), np.array([-1.0, 0.0, -5.5])
INTENSITY = np.array([420.0, 380.0, 300.0])
MAP_SIZE, MAP_ANGLE = 512, 60.0  # of the lamp's cone and its map
GRATING = 0.8  # before the lamp [m]
BAR, PITCH = 0.045, 0.16  # [m]


def axes_toward(forward):
    """Right, up and back of a camera that looks there."""
    back = -forward / np.linalg.norm(forward)
    right = np.cross([0.0, 1.0, 0.0], back)
    right /= np.linalg.norm(right)
    return right, np.cross(back, right), back


def rays(width, height, angle):
    """Of a camera's pixels, as (x, y, -1)."""
    tangent = np.tan(np.radians(angle) / 2)
    x = (np.arange(width) + 0.5 - width / 2) / (height / 2) * tangent
    y = -(np.arange(height) + 0.5 - height / 2) / (height / 2) * tangent
    return np.stack([*np.meshgrid(x, y), np.full((height, width), -1.0)], axis=-1)


def hall(origin, directions):
    """Where rays meet the hall from inside: distance in units of the direction, and the normal."""
    nearest = np.full(directions.shape[:2], np.inf)
    normals = np.zeros_like(directions)
    for axis, place, side in ((1, 0.0, 1), (1, CEILING, -1), (2, BACK, 1), (0, -SIDE, 1), (0, SIDE, -1)):
        with np.errstate(divide="ignore", invalid="ignore"):
            t = (place - origin[axis]) / directions[..., axis]
        hit = (t > 0) & (t < nearest)
        nearest[hit] = t[hit]
        normals[hit] = side * np.eye(3)[axis]
    return nearest, normals


def barred(x, y):
    """Whether the grating has a bar there, in tangents from the lamp."""
    u, v = x * GRATING / PITCH, y * GRATING / PITCH
    width = BAR / PITCH
    return (np.abs(u - np.round(u)) < width) | (np.abs(v - np.round(v)) < width)


def picture(lamp_axes):
    """The hall as the lamp lights it through the grating in clear air, and its planar depth."""
    directions = rays(WIDTH, HEIGHT, FIELD_OF_VIEW)
    depth, normals = hall(EYE, directions)
    points = EYE + depth[..., None] * directions
    to_lamp = LAMP - points
    distance = np.linalg.norm(to_lamp, axis=-1)
    cosine = np.clip(np.sum(to_lamp * normals, axis=-1) / distance, 0, None)
    seen = np.stack([-to_lamp @ axis for axis in lamp_axes], axis=-1)
    away = np.maximum(-seen[..., 2], 1e-6)
    x, y = seen[..., 0] / away, seen[..., 1] / away
    cone = (np.hypot(x, y) < np.tan(np.radians(MAP_ANGLE) / 2)) & (seen[..., 2] < 0)
    lit = cosine / distance**2 * (cone & ~barred(x, y))
    tiles = 0.35 + 0.15 * ((np.floor(points[..., 0]) + np.floor(points[..., 1] + 0.5) + np.floor(points[..., 2])) % 2)
    albedo = tiles[..., None] * np.array([0.9, 0.95, 1.0])
    return (albedo / np.pi * (lit[..., None] * INTENSITY + 0.02)).astype(np.float32), depth.astype(np.float32)


def shadow_map(lamp_axes):
    """The lamp's planar depth: of the grating, and of the hall behind it."""
    directions = rays(MAP_SIZE, MAP_SIZE, MAP_ANGLE)
    depth, _ = hall(LAMP, directions @ np.array(lamp_axes))
    return np.where(barred(directions[..., 0], directions[..., 1]), GRATING, depth).astype(np.float32)


def puffs(frame):
    """Gaussians that rise and drift, by the columns of docs/media.md: x, y, z, radius, amplitude."""
    random = np.random.default_rng(7)
    start = random.uniform([-4.5, 0.2, -11.0], [3.5, 3.0, -4.5], (60, 3))
    width = random.uniform(0.35, 0.9, 60)
    start += (frame - 1) * np.stack([0.05 * np.sin(np.arange(60.0)), random.uniform(0.02, 0.06, 60), np.full(60, 0.04)], axis=-1)
    return np.column_stack([start, width, random.uniform(0.5, 1.6, 60)])


def main(folder, frames):
    folder.mkdir(parents=True, exist_ok=True)
    right, up, back = lamp_axes = axes_toward(AIM - LAMP)
    color, depth = picture(lamp_axes)
    for frame in range(1, frames + 1):
        np.save(folder / f"hall.{frame:04}.npy", color)
        np.savetxt(folder / f"puffs.{frame:04}.csv", puffs(frame), delimiter=",", fmt="%.5f", comments="",
                   header="x,y,z,radius,amplitude")
    np.save(folder / "depth.npy", depth)
    np.save(folder / "lamp.npy", shadow_map(lamp_axes))
    to_world = np.eye(4)
    to_world[:3, :3], to_world[:3, 3] = np.column_stack([right, up, back]), LAMP
    scene = {
        "brume": 1,
        "camera": {"vertical_fov": FIELD_OF_VIEW, "camera_to_world": [[1, 0, 0, 0], [0, 1, 0, EYE[1]], [0, 0, 1, 0], [0, 0, 0, 1]]},
        "medium": {"scattering": 0.12, "g": 0.3, "density": [{"type": "constant", "value": 0.12},
                                                            {"type": "gaussians", "file": "puffs.####.csv"}]},
        "lights": [{"type": "spot", "position": LAMP.tolist(), "direction": (AIM - LAMP).tolist(), "angle": MAP_ANGLE,
                    "penumbra": 0, "radius": 0.02, "intensity": INTENSITY.tolist(),
                    "shadow": {"file": "lamp.npy", "vertical_fov": MAP_ANGLE, "camera_to_world": to_world.tolist()}}],
        "effects": {"surface": {}, "multiscatter": {}, "airlight": {}},
    }
    (folder / "shafts.json").write_text(json.dumps(scene, indent=1) + "\n")


if __name__ == "__main__":
    if not 2 <= len(sys.argv) <= 3 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 8)
