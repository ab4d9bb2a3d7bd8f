"""hosts/blender/shadow_map.py in a real Blender: shadow_map_test.py BLENDER TOOL SCRIPT WORK"""
import json
import pathlib
import shutil
import subprocess
import sys

SCENE = """
import bpy, math
scene = bpy.context.scene
for thing in list(bpy.data.objects):
    bpy.data.objects.remove(thing)
bpy.ops.mesh.primitive_plane_add(size=20)
bpy.ops.mesh.primitive_cube_add(size=1, location=(1, 0, 1.5))
for name, kind in (("key", "SPOT"), ("sun", "SUN"), ("bulb", "POINT")):
    light = bpy.data.lights.new(name, kind)
    lamp = bpy.data.objects.new(name, light)
    lamp.location = (0, 0, 6)
    scene.collection.objects.link(lamp)
bpy.data.lights["key"].spot_size = math.radians(60)
scene.frame_start, scene.frame_end = 3, 4
bpy.ops.wm.save_as_mainfile(filepath=SHOT)
"""


def main(blender, tool, script, work):
    work = pathlib.Path(work).resolve()
    shot = str(work / "shot.blend")
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    (work / "scene.py").write_text(SCENE.replace("SHOT", repr(shot)))

    def run(*arguments):
        return subprocess.run([blender, "-b", *arguments], cwd=work, capture_output=True, text=True, timeout=300, check=False)

    def depth(name):
        info = subprocess.run([tool, "info", "--json", str(work / name)], capture_output=True, text=True, check=True)
        return json.loads(info.stdout)["depth"]

    made = run("--factory-startup", "-P", str(work / "scene.py"))
    assert (work / "shot.blend").exists(), made.stdout + made.stderr
    said = {}
    for lamp in ("key", "sun"):
        result = run(shot, "-P", script, "--", lamp, str(work / f"{lamp}.####.exr"), "64")
        lines = [line for line in result.stdout.splitlines() if line.startswith("shadow ")]
        assert len(lines) == 1, result.stdout + result.stderr
        said[lamp] = json.loads(lines[0].removeprefix("shadow "))
    # The spot is 6 m above the floor, and 4 m above the cube.
    for frame in ("0003", "0004"):
        found = depth(f"key.{frame}.exr")
        assert abs(found["nearest"] - 4) < 1e-4 and abs(found["farthest"] - 6) < 1e-4, found
    assert abs(said["key"]["vertical_fov"] - 62) < 1e-3 and said["key"]["camera_to_world"][2] == [0, 0, 1, 6], said
    # The sun's map spans the floor, from above the cube.
    found, sun = depth("sun.0003.exr"), said["sun"]
    assert abs(sun["orthographic_width"] - 20.4) < 1e-3 and abs(found["farthest"] - found["nearest"] - 2) < 1e-4, (found, sun)
    assert abs(sun["camera_to_world"][2][3] - found["farthest"]) < 1e-4, (found, sun)
    # What it says is an entry of a scene file.
    scene = {"brume": 1, "camera": {"vertical_fov": 50, "camera_to_world": said["key"]["camera_to_world"]},
             "medium": {"scattering": 0.05},
             "lights": [{"type": "spot", "position": [0, 0, 6], "direction": [0, 0, -1], "angle": 60, "intensity": 100,
                         "shadow": said["key"]}]}
    (work / "fog.json").write_text(json.dumps(scene))
    subprocess.run([tool, "run", str(work / "fog.json"), str(work / "key.####.exr"), "-o", str(work / "fog.####.exr"), "--backend", "cpu"],
                   check=True, capture_output=True)
    assert (work / "fog.0004.exr").exists()
    for name, words in (("bulb", "bulb: point; expected the name of a spot or a sun"), ("nobody", "nobody: no such object")):
        assert words in run(shot, "-P", script, "--", name, "x.####.exr").stderr
    assert "expected the frame's number as ####" in run(shot, "-P", script, "--", "key", "x.exr").stderr


main(*sys.argv[1:])
