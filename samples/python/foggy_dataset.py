# %% [markdown]
# # Pairs of clear and foggy pictures
#
# A data set for training: from one picture with depth, as many in fog as one likes, each with the visibility that it shows and the
# transmittance of every pixel. Run it cell by cell in an editor that knows `# %%`, or whole:
#
#     PYTHONPATH=build/release/python python3 samples/python/foggy_dataset.py OUT

# %%
import json
import os
import sys

import numpy as np

import brume
from brume.testing import write_png

out = sys.argv[1] if len(sys.argv) > 1 else "foggy"
os.makedirs(out, exist_ok=True)
random = np.random.default_rng(7)

# %% [markdown]
# ## A clear picture
# Yours comes from a renderer or a camera with depth: `float32`, linear, distances in metres. Here it is a road with posts and a lamp.

# %%
height, width, fov = 108, 192, 50
y, x = np.mgrid[0:height, 0:width].astype(np.float32)
tan_y = np.tan(np.radians(fov / 2)) * (1 - 2 * (y + 0.5) / height)
with np.errstate(divide="ignore"):
    depth = np.where(tan_y < 0, 1.6 / -tan_y, np.inf).astype(np.float32)  # a ground 1.6 m below the camera
road = 0.25 + 0.15 * (np.floor(np.where(np.isfinite(depth), depth, 0) / 2) % 2)
color = np.where(np.isfinite(depth)[:, :, None], road[:, :, None], [0.35, 0.45, 0.6]).astype(np.float32)
for distance in (8, 16, 32, 64):
    tall, wide = (int(round(size / distance * height / (2 * np.tan(np.radians(fov / 2))))) for size in (4, 0.5))
    foot = int(height / 2 * (1 + 1.6 / distance / np.tan(np.radians(fov / 2))))
    left = int(width / 2 + (1.5 - wide / 2) * tall / 2)
    post = np.s_[max(foot - tall, 0):foot, left:left + max(wide, 1)]
    color[post], depth[post] = (0.5, 0.2, 0.1), distance
color[40:43, 60:63], depth[40:43, 60:63] = (60, 45, 25), 30

# %% [markdown]
# ## What would be done
# A plan is made once; `print` says what it does and why.

# %%


def weather(visibility: float) -> dict:
    """A scene: fog of droplets that thins with height, seen as far as `visibility` metres."""
    return {"camera": {"vertical_fov": fov, "camera_to_world": np.eye(4)},
            "medium": {"visibility": visibility, "droplet_diameter": 8,
                       "density": [{"type": "exponential", "falloff": 0.02, "origin": [0, -1.6, 0]}]}}


context = brume.Context("cpu")
plan = brume.Plan(brume.Scene(weather(100), context=context), height, width, layers=["transmittance"])
print(plan)

# %% [markdown]
# ## The set
# Only the medium's values change, so that the plan stays. Sensors add noise after the fog, not before it.

# %%
labels = []
for number, visibility in enumerate(np.geomspace(20, 500, 6)):
    plan.update(weather(visibility))
    foggy, layers = plan(color, depth, layers=["transmittance"])
    noisy = foggy + random.normal(0, 0.003, foggy.shape).astype(np.float32)
    np.savez_compressed(os.path.join(out, f"{number:04}.npz"), clear=color, foggy=noisy, transmittance=layers["transmittance"])
    labels.append({"file": f"{number:04}.npz", "visibility": float(visibility), "transmittance": float(layers["transmittance"].mean())})
with open(os.path.join(out, "labels.json"), "w", encoding="utf-8") as file:
    json.dump(labels, file, indent=1)

# %% [markdown]
# ## A look at it
# The clear picture above, the fogs below, from thick to thin.

# %%
rows = [color] + [np.load(os.path.join(out, label["file"]))["foggy"] for label in labels]
write_png(os.path.join(out, "sheet.png"), np.rint(255 * np.clip(np.concatenate(rows), 0, 1) ** (1 / 2.2)).astype(np.uint8))
for label in labels:
    print(f"{label['file']}  seen as far as {label['visibility']:5.0f} m  {100 * label['transmittance']:5.1f} % arrives straight")
context.close()
