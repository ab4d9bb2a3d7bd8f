"""The add-on in a real Blender: blender -b --factory-startup -P addon_test.py -- [TEST...]"""
import json
import math
import os
import signal
import subprocess
import sys
import tempfile
import time
import types
import unittest

import bpy
import numpy as np

here = os.path.dirname(os.path.abspath(__file__))
sys.path += [here, os.path.join(here, "..", "python")]

import exr
import shots

TOOL = os.environ["BRUME_TOOL"]


def module(name):
    return sys.modules[f"brume_fog.{name}"]


class AddonTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(dir=os.environ.get("BRUME_WORK"))

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def scene(self, width=16, height=9):
        scene = shots.empty(width, height)
        bpy.context.preferences.addons["brume_fog"].preferences.tool = TOOL
        scene.render.filepath = self.path("clear", "shot.####")
        return scene

    def render(self, scene, name="still"):
        scene.render.filepath = self.path(name)
        bpy.ops.render.render(write_still=True)
        return exr.read(self.path(name + ".exr"))

    def snapshot(self, scene):
        return module("export").snapshot(scene, bpy.context.evaluated_depsgraph_get())


def rgb(channels, layer="ViewLayer.Combined"):
    return np.stack([channels[f"{layer}.{name}"] for name in "RGB"], axis=2)


class Lamps(AddonTest):
    """What is exported lights a white floor as Cycles does."""

    def check(self, scene, expected_irradiance):
        found = rgb(self.render(scene))[4, 8] * math.pi
        np.testing.assert_allclose(found, expected_irradiance, rtol=0.02)

    def start(self, kind, watts, **placing):
        scene = self.scene()
        shots.camera(scene)
        shots.plane(scene)
        lamp = shots.lamp(scene, kind, watts, **placing)
        lamp.data.color = (1, 0.5, 0.25)
        # The middle of pixel (8, 4) is a little aside of the axis.
        scene.camera.data.angle = 0.05
        return scene, lamp

    def test_point(self):
        for units in (1, 0.01):
            scene, lamp = self.start("POINT", 100)
            lamp.data.shadow_soft_size = 0.2
            scene.unit_settings.scale_length = units
            light = self.snapshot(scene)["lights"]["lamp"]
            self.assertEqual((light["type"], list(light["position"]), round(light["radius"], 6)), ("point", [0, 0, 4], 0.2))
            self.check(scene, np.array(light["intensity"]) / (4 * units) ** 2)

    def test_spot(self):
        scene, lamp = self.start("SPOT", 100)
        lamp.data.spot_size, lamp.data.spot_blend, lamp.data.shadow_soft_size = math.radians(60), 0.5, 0.01
        light = self.snapshot(scene)["lights"]["lamp"]
        self.assertEqual((light["type"], light["direction"]), ("spot", [0, 0, -1]))
        self.assertAlmostEqual(light["angle"], 60, 4)
        self.check(scene, np.array(light["intensity"]) / 16)

    def test_flux_of_spots(self):
        for angle, blend in ((60, 0), (60, 0.5), (60, 1), (120, 0.2), (120, 1)):
            scene, lamp = self.start("SPOT", 100)
            scene.render.resolution_x = scene.render.resolution_y = 64
            scene.cycles.samples, lamp.data.shadow_soft_size = 8, 0.01
            lamp.data.spot_size, lamp.data.spot_blend = math.radians(angle), blend
            scene.camera.data.angle = 2 * math.atan(8 / 5)  # 16 m of the floor
            light = self.snapshot(scene)["lights"]["lamp"]
            seen = self.render(scene)["ViewLayer.Combined.R"] * math.pi
            at = (np.arange(64) + 0.5) / 4 - 8
            cosine = 4 / np.sqrt(at[:, None] ** 2 + at**2 + 16)
            half = math.radians(light["angle"]) / 2
            rim, inner = math.cos(half), math.cos(half * (1 - light["penumbra"]))
            step = np.clip((cosine - rim) / max(inner - rim, 1e-9), 0, 1)
            exported = light["intensity"][0] / 16 * cosine**3 * step * step * (3 - 2 * step)
            self.assertLess(abs(seen.sum() / exported.sum() - 1), 0.03, (angle, blend))

    def test_sun(self):
        scene, lamp = self.start("SUN", 3, rotation=(math.radians(60), 0, 0))
        light = self.snapshot(scene)["lights"]["lamp"]
        np.testing.assert_allclose(light["direction"], (0, math.sin(math.radians(60)), -0.5), atol=1e-6)
        self.assertEqual((light["type"], light["distance"]), ("directional", scene.brume.sun_distance))
        self.check(scene, np.array(light["intensity"]) / 2)

    def test_area(self):
        for shape, size, size_y, area in (("SQUARE", 0.2, 0, 0.04), ("RECTANGLE", 0.4, 0.1, 0.04), ("DISK", 0.3, 0, 0.0706858),
                                          ("ELLIPSE", 0.4, 0.2, 0.0628319)):
            scene, lamp = self.start("AREA", 100)
            lamp.data.shape, lamp.data.size = shape, size
            if size_y:
                lamp.data.size_y = size_y
            scene.cycles.samples = 64
            light = self.snapshot(scene)["lights"]["lamp"]
            self.assertEqual((light["type"], light["angle"], light["penumbra"]), ("spot", 180, 1))
            self.assertAlmostEqual(math.pi * light["radius"] ** 2, area, 5)
            self.check(scene, np.array(light["intensity"]) / 16)

    def test_strength_of_the_node(self):
        scene, lamp = self.start("POINT", 100)
        lamp.data.use_nodes = True
        emission = lamp.data.node_tree.nodes["Emission"]
        emission.inputs["Strength"].default_value, emission.inputs["Color"].default_value = 3, (0.5, 1, 1, 1)
        self.check(scene, np.array(self.snapshot(scene)["lights"]["lamp"]["intensity"]) / 16)

    def test_hidden_and_dark_lamps(self):
        scene, lamp = self.start("POINT", 100)
        shots.lamp(scene, "POINT", 0, name="dark")
        shots.lamp(scene, "POINT", 10, name="hidden").hide_render = True
        self.assertEqual(list(self.snapshot(scene)["lights"]), ["lamp"])
        scene.brume.use_lights = False
        self.assertNotIn("lights", self.snapshot(scene))


class Cameras(AddonTest):
    """Depth and the exported camera give the positions that Cycles says pixels show."""

    def check(self, scene):
        scene.view_layers[0].use_pass_position = True
        scene.cycles.samples, scene.cycles.filter_width = 1, 0.01
        channels = self.render(scene)
        depth = channels["ViewLayer.Depth.Z"]
        position = np.stack([channels[f"ViewLayer.Position.{axis}"] for axis in "XYZ"], axis=2)
        camera = self.snapshot(scene)["camera"]
        height, width = depth.shape
        y, x = np.mgrid[0:height, 0:width] + 0.5
        tan = math.tan(math.radians(camera["vertical_fov"]) / 2)
        down = (y / height - camera["center"][1]) * 2 * tan
        across = (x / width - camera["center"][0]) * 2 * tan * width * camera["pixel_aspect"] / height
        seen = np.stack((across * depth, -down * depth, -depth, np.ones_like(depth)), axis=2)
        np.testing.assert_allclose((seen @ np.array(camera["camera_to_world"]).T)[:, :, :3], position, atol=0.02)
        return depth

    def start(self, width=16, height=9):
        scene = self.scene(width, height)
        shots.plane(scene)
        return scene, shots.camera(scene, (1, 2, 6), (0.4, 0.1, 0.3))

    def test_lens(self):
        for lens in (20, 85):
            scene, camera = self.start()
            camera.data.lens = lens
            self.check(scene)

    def test_sensor_fit(self):
        for fit in ("AUTO", "HORIZONTAL", "VERTICAL"):
            for width, height in ((16, 9), (9, 16)):
                scene, camera = self.start(width, height)
                camera.data.sensor_fit, camera.data.sensor_width, camera.data.sensor_height = fit, 30, 10
                self.check(scene)

    def test_shift(self):
        for size in ((16, 9), (9, 16)):
            scene, camera = self.start(*size)
            camera.data.shift_x, camera.data.shift_y = 0.1, -0.15
            self.check(scene)

    def test_scale_of_pixels_of_the_picture_and_of_the_object(self):
        scene, camera = self.start(32, 18)
        scene.render.resolution_percentage = 50
        scene.render.pixel_aspect_x, camera.scale = 2, (2, 2, 2)
        camera.data.shift_x = 0.2
        self.assertEqual(self.check(scene).shape, (9, 16))
        scene.render.pixel_aspect_x, scene.render.pixel_aspect_y = 1, 1.5
        self.check(scene)

    def test_border(self):
        scene, camera = self.start(32, 18)
        camera.data.shift_y = 0.1
        render = scene.render
        render.use_border, render.use_crop_to_border = True, True
        render.border_min_x, render.border_max_x, render.border_min_y, render.border_max_y = 0.25, 0.75, 0.5, 1
        self.assertEqual(self.check(scene).shape, (9, 16))

    def test_others_are_refused(self):
        scene, camera = self.start()
        camera.data.type = "ORTHO"
        with self.assertRaisesRegex(module("export").ExportError, "camera camera: ortho; expected a perspective camera"):
            self.snapshot(scene)
        scene.camera = None
        with self.assertRaisesRegex(module("export").ExportError, "the scene has no camera"):
            self.snapshot(scene)


class Media(AddonTest):
    def start(self, kind, **inputs):
        scene = self.scene()
        shots.camera(scene)
        tree = scene.world.node_tree
        node = tree.nodes.new(kind)
        for name, value in inputs.items():
            node.inputs[name.replace("_", " ")].default_value = value
        tree.links.new(node.outputs[0], tree.nodes["World Output"].inputs["Volume"])
        return scene

    def test_absorbing_volumes_take_what_cycles_takes(self):
        for kind, inputs in (("ShaderNodeVolumeAbsorption", {"Color": (0.2, 0.5, 0.9, 1), "Density": 0.2}),
                             ("ShaderNodeVolumePrincipled", {"Color": (0, 0, 0, 1), "Density": 0.3,
                                                             "Absorption_Color": (0.1, 0.3, 0.6, 1)})):
            scene = self.start(kind, **inputs)
            shots.plane(scene, strength=1, size=20)
            scene.camera.data.angle, scene.camera.data.clip_start = 0.05, 0.001  # volumes begin at the clip
            through = rgb(self.render(scene))[4, 8]
            bpy.ops.brume.take_volume()
            medium = module("medium").block(scene.brume)
            np.testing.assert_allclose(np.exp(-5 * np.array(medium["absorption"])), through, rtol=0.01)
            np.testing.assert_allclose(medium["scattering"], 0, atol=1e-6)
            np.testing.assert_allclose(rgb(self.render(scene))[4, 8], 1, rtol=1e-3)  # it is not rendered any more

    def test_scattering_volumes(self):
        scene = self.start("ShaderNodeVolumeScatter", Color=(0.5, 0.25, 1, 1), Density=0.1, Anisotropy=0.6)
        scene.unit_settings.scale_length = 0.5
        bpy.ops.brume.take_volume()
        medium = module("medium").block(scene.brume)
        np.testing.assert_allclose(medium["scattering"], (0.1, 0.05, 0.2), rtol=1e-5)
        np.testing.assert_allclose((medium["g"], scene.brume.visibility), (0.6, 3.912 / 0.2), rtol=1e-5)
        self.assertNotIn("density", medium)

    def test_mist_and_height(self):
        scene = self.scene()
        scene.world.mist_settings.start, scene.world.mist_settings.depth = 5, 45
        scene.unit_settings.scale_length = 2
        bpy.ops.brume.take_mist()
        self.assertEqual(scene.brume.visibility, 100)
        scene.brume.falloff, scene.brume.ground = 0.1, 3
        term, = module("medium").block(scene.brume)["density"]
        np.testing.assert_allclose(term.pop("falloff"), 0.1)
        self.assertEqual(term, {"type": "exponential", "value": 1, "direction": [0, 0, 1], "origin": [0, 0, 3]})

    def test_what_cannot_be_taken(self):
        scene = self.start("ShaderNodeVolumeScatter", Density=0.0)
        for prepare, message in ((lambda: None, "its density is 0; expected a medium"),
                                 (lambda: scene.world.node_tree.links.remove(scene.world.node_tree.nodes["World Output"].inputs["Volume"].links[0]),
                                  "the world has no volume"),
                                 (lambda: setattr(scene, "world", None), "the world has no volume")):
            prepare()
            with self.assertRaisesRegex(RuntimeError, message):
                bpy.ops.brume.take_volume()
        with self.assertRaisesRegex(RuntimeError, "the scene has no world"):
            bpy.ops.brume.take_mist()


class ShadowMaps(AddonTest):
    """Maps that come with an export, of a spot that shines across the view and a board in its way."""

    def start(self):
        scene = self.scene(48, 27)
        shots.camera(scene, (0, -12, 0), (math.radians(90), 0, 0))
        spot = shots.lamp(scene, "SPOT", 20000, (-6, 0, 0), (0, math.radians(-90), 0), name="key")
        spot.data.spot_size, spot.data.shadow_soft_size = math.radians(40), 0.01
        board = shots.plane(scene, size=3, location=(-2, 0, 0))
        board.rotation_euler = (0, math.radians(90), 0)
        bpy.ops.brume.setup()
        scene.brume.visibility, scene.brume.shadow_size = 60, 64
        bpy.ops.render.render(animation=True)
        return scene, spot, board

    def fog(self, name):
        """Exports; what the scene file says, and the fogged frames."""
        bpy.ops.brume.export(filepath=self.path(name + ".json"))
        subprocess.run([TOOL, "run", self.path(name + ".json"), self.path("clear", "shot.####.exr"), "-o", self.path(name + ".####.exr"),
                        "--backend", "cpu", "--quiet"], check=True)
        with open(self.path(name + ".json"), encoding="utf-8") as file:
            made = json.load(file)
        return made, [rgb(exr.read(self.path(f"{name}.{number:04}.exr")))[..., 1] for number in (1, 2)]

    def test_behind_an_occluder_the_fog_is_darker(self):
        scene, _, board = self.start()
        _, plain = self.fog("plain")
        scene.brume.shadow_maps = True
        made, mapped = self.fog("mapped")
        self.assertEqual(made["lights"][0]["shadow"]["file"], "mapped_shadows/key.exr")
        self.assertEqual(os.listdir(self.path("mapped_shadows")), ["key.exr"])
        for before, after in zip(plain, mapped):
            # The board is at column 13, the spot left of the picture.
            self.assertTrue((after[12:15, 28:40] < 0.8 * before[12:15, 28:40]).all())
            np.testing.assert_allclose(after[12:15, 9:12], before[12:15, 9:12], rtol=0.01)
        # The board goes away in the second frame.
        for frame, z in ((1, 0), (2, 40)):
            board.location.z = z
            board.keyframe_insert("location", frame=frame)
        made, moved = self.fog("moved")
        self.assertEqual(made["lights"][0]["shadow"]["file"], "moved_shadows/key.####.exr")
        self.assertEqual(sorted(os.listdir(self.path("moved_shadows"))), ["key.0001.exr", "key.0002.exr"])
        np.testing.assert_allclose(moved[0][12:15, 28:40], mapped[0][12:15, 28:40], rtol=0.05)
        np.testing.assert_allclose(moved[1][12:15, 28:40], plain[1][12:15, 28:40], rtol=0.05)

    def state(self, scene):
        """What an export must leave as it was."""
        render, image = scene.render, scene.render.image_settings
        return (scene.camera, scene.frame_current, scene.frame_subframe, render.filepath, render.engine, render.resolution_x, render.resolution_y,
                image.file_format, image.color_depth, image.exr_codec, scene.cycles.samples, scene.world, scene.brume.enabled,
                scene.frame_start, scene.frame_end, bpy.context.scene, [layer.use for layer in scene.view_layers],
                *(sorted(thing.name for thing in things) for things in (bpy.data.scenes, bpy.data.objects, bpy.data.cameras)))

    def test_moving_lamps_suns_and_what_gets_no_map(self):
        scene, spot, _ = self.start()
        shots.lamp(scene, "SUN", 1, (0, 0, 9), name="sun")
        shots.lamp(scene, "POINT", 10, name="bulb")
        shots.lamp(scene, "AREA", 10, name="panel")
        for frame, y in ((1, 0), (2, 30)):
            spot.location.y = y
            spot.keyframe_insert("location", frame=frame)
        scene.brume.shadow_maps, scene.brume.enabled = True, True
        scene.frame_set(1, subframe=0.25)
        before = self.state(scene)
        made, _ = self.fog("fog")
        self.assertEqual(self.state(scene), before)
        self.assertEqual(module("shadows").without(scene), ["bulb", "panel"])
        self.assertEqual([light["type"] for light in made["lights"] if "shadow" in light], ["spot", "directional"])
        key, sun = (light["shadow"] for light in made["lights"] if "shadow" in light)
        self.assertEqual((key["file"], sun["file"]), ("fog_shadows/key.####.exr", "fog_shadows/sun.exr"))
        np.testing.assert_allclose([pair[1] for pair in key["camera_to_world"][1][3]["keys"]], [0, 30])
        # The board is 4 m before the lamp, which sees nothing from where it goes.
        depths = [json.loads(subprocess.run([TOOL, "info", "--json", self.path("fog_shadows", f"key.000{number}.exr")], check=True,
                                            capture_output=True).stdout)["depth"] for number in (1, 2)]
        self.assertAlmostEqual(depths[0]["nearest"], 4, 3)
        self.assertEqual((depths[0]["far_pixels"] < 64 * 64, depths[1]["far_pixels"]), (True, 64 * 64))
        self.assertEqual(os.listdir(self.path("clear")).count("fogged"), 0)

    def test_cancelled_maps_leave_all_as_it_was(self):
        scene, _, board = self.start()
        for frame, z in ((1, 0), (2, 40)):
            board.location.z = z
            board.keyframe_insert("location", frame=frame)
        scene.brume.shadow_maps = True
        scene.frame_set(2)
        before = self.state(scene)

        # A cancelled render leaves no file; Blender takes one SIGINT only, which another test sends.
        def cancel(copy, *_):
            if copy.frame_current == 2:
                os.unlink(copy.render.frame_path(frame=2))

        bpy.app.handlers.render_write.append(cancel)
        try:
            with self.assertRaisesRegex(RuntimeError, "key.0002.exr: the shadow map was not rendered: it was cancelled"):
                bpy.ops.brume.export(filepath=self.path("fog.json"))
        finally:
            bpy.app.handlers.render_write.remove(cancel)
        self.assertEqual(self.state(scene), before)
        self.assertEqual(os.listdir(self.folder), ["clear"])


class Frames(AddonTest):
    """Two frames, rendered and fogged."""

    def start(self):
        scene = self.scene(64, 36)
        shots.street(scene)
        bpy.ops.brume.setup()
        scene.brume.enabled, scene.brume.visibility = True, 40
        return scene

    def clear_and_foggy(self, number, folder="fogged"):
        name = f"shot.{number:04}.exr"
        return exr.read(self.path("clear", name)), exr.read(self.path("clear", folder, name))

    def test_frames_are_fogged_as_they_are_written(self):
        scene = self.start()
        bpy.ops.render.render(animation=True)
        self.assertEqual((module("rendering").state.problem, module("rendering").state.done), ("", 2))
        for number in (1, 2):
            clear, foggy = self.clear_and_foggy(number)
            self.assertTrue({"ViewLayer.Normal.X", "ViewLayer.DiffCol.R", "ViewLayer.Depth.Z"} <= set(clear))
            self.assertEqual(set(clear), set(foggy))
            for channel in clear:
                if "Combined" not in channel:
                    np.testing.assert_array_equal(clear[channel], foggy[channel])
            before, after = rgb(clear), rgb(foggy)
            sky = clear["ViewLayer.Depth.Z"] > 1e9
            # The black sky glows around the lamps, more at their height than far above; near ground loses contrast only.
            sky[6:] = False  # pixels at edges show some of the ground or the wall
            self.assertGreater(sky.sum(), 100)
            self.assertTrue((before[sky] == 0).all() and (after[sky] > 0).all())
            lamp = scene.objects["lamp"]
            scene.frame_set(number)
            column = self.column_of(scene, lamp)
            glow = after[:18, :, 1].sum(axis=0)
            self.assertLess(abs(int(np.argmax(np.convolve(glow, np.ones(5), "same"))) - column), 8)
        # A folder afterwards: the keyed scene file gives the same frames.
        written = {number: self.clear_and_foggy(number)[1] for number in (1, 2)}
        scene.brume.output = "again"
        bpy.ops.brume.fog_frames()
        run = module("tool").Run([TOOL, "run", self.path("clear", "again", "fog.json"), self.path("clear", "shot.####.exr"), "-o",
                                  self.path("third.####.exr")])
        self.assertEqual((run.wait(), run.done, run.total, run.messages), (0, 2, 2, []))
        for number in (1, 2):
            again = self.clear_and_foggy(number, "again")[1]
            for channel, values in written[number].items():
                np.testing.assert_allclose(again[channel], values, rtol=1e-5, atol=1e-7)
        self.assertEqual(scene.frame_current, 2)
        with open(self.path("clear", "again", "fog.json"), encoding="utf-8") as file:
            made = json.load(file)
        self.assertEqual([key[0] for key in made["lights"][0]["position"][0]["keys"]], [1, 2])
        self.assertEqual(made["camera"]["camera_to_world"][3], [0, 0, 0, 1])

    @staticmethod
    def column_of(scene, lamp):
        from bpy_extras.object_utils import world_to_camera_view
        return int(world_to_camera_view(scene, scene.camera, lamp.matrix_world.translation).x * scene.render.resolution_x)

    def test_a_still_is_fogged(self):
        scene = self.start()
        scene.frame_set(2)
        before = self.render(scene, "still")
        foggy = exr.read(self.path("fogged", "still.exr"))
        self.assertFalse(np.array_equal(rgb(before), rgb(foggy)))
        # As it is without the add-on's handlers, from the exported file.
        bpy.ops.brume.export(filepath=self.path("fog.json"))
        os.rename(self.path("still.exr"), self.path("still.0002.exr"))
        subprocess.run([TOOL, "run", self.path("fog.json"), self.path("still.####.exr"), "-o", self.path("by_hand.####.exr")], check=True)
        np.testing.assert_allclose(rgb(exr.read(self.path("by_hand.0002.exr"))), rgb(foggy), rtol=1e-5, atol=1e-7)

    def test_light_groups(self):
        scene = self.start()
        bpy.ops.brume.setup(light_groups=True)
        clear = self.render(scene, "still")
        both = rgb(clear, "ViewLayer.Combined_lamp") + rgb(clear, "ViewLayer.Combined_spot")
        np.testing.assert_allclose(both, rgb(clear), rtol=1e-3, atol=1e-5)
        self.assertTrue(os.path.exists(self.path("fogged", "still.exr")))
        self.assertEqual(self.snapshot(scene)["lights"]["spot"]["group"], "ViewLayer.Combined_spot")

    def test_preview(self):
        scene = self.start()
        with self.assertRaisesRegex(RuntimeError, "nothing was rendered"):
            bpy.ops.brume.preview()
        scene.brume.enabled = False
        self.render(scene, "still")
        self.assertFalse(os.path.exists(self.path("fogged")))
        scene.render.image_settings.file_format = "PNG"
        for _ in range(2):
            bpy.ops.brume.preview()
            image = bpy.data.images["Brume preview"]
            self.assertEqual(len(image.pixels), 0)  # Blender reads it now
            self.assertEqual((image.type, scene.render.image_settings.file_format), ("MULTILAYER", "PNG"))
            self.assertEqual(set(exr.read(bpy.path.abspath(image.filepath))), set(exr.read(self.path("still.exr"))))

    def test_two_view_layers_and_a_compositor(self):
        scene = self.start()
        scene.view_layers.new("second").use_pass_z = True
        self.render(scene, "still")
        self.assertEqual(module("rendering").state.problem, "")
        foggy = exr.read(self.path("fogged", "still.exr"))
        self.assertFalse(np.array_equal(rgb(foggy), rgb(exr.read(self.path("still.exr")))))
        np.testing.assert_array_equal(rgb(foggy, "second.Combined"), rgb(exr.read(self.path("still.exr")), "second.Combined"))

    def test_animated_fog_and_hidden_lamps_are_keyed(self):
        scene = self.start()
        scene.brume.visibility = 100
        scene.brume.keyframe_insert("visibility", frame=1)
        scene.brume.visibility = 20
        scene.brume.keyframe_insert("visibility", frame=2)
        spot = scene.objects["spot"]
        spot.hide_render = False
        spot.keyframe_insert("hide_render", frame=1)
        spot.hide_render = True
        spot.keyframe_insert("hide_render", frame=2)
        bpy.ops.render.render(animation=True)
        bpy.ops.brume.export(filepath=self.path("fog.json"))
        with open(self.path("fog.json"), encoding="utf-8") as file:
            made = json.load(file)
        np.testing.assert_allclose(made["medium"]["scattering"][0]["keys"], [[1, 0.03912], [2, 0.1956]], rtol=1e-5)
        by_type = {light["type"]: light for light in made["lights"]}
        self.assertEqual(by_type["spot"]["intensity"][0]["keys"][1], [2, 0])
        subprocess.run([TOOL, "run", self.path("fog.json"), self.path("clear", "shot.####.exr"), "-o", self.path("hand.####.exr")],
                       check=True)
        for number in (1, 2):
            np.testing.assert_allclose(rgb(exr.read(self.path(f"hand.{number:04}.exr"))), rgb(self.clear_and_foggy(number)[1]),
                                       rtol=1e-5, atol=1e-7)


class Troubles(AddonTest):
    start = Frames.start

    def handlers(self):
        return [handler.__name__ for name in ("render_init", "frame_change_post", "render_write", "render_complete", "render_cancel",
                                              "load_post")
                for handler in getattr(bpy.app.handlers, name) if handler.__module__.startswith("brume_fog")]

    def test_a_missing_command(self):
        scene = self.start()
        preferences = bpy.context.preferences.addons["brume_fog"].preferences
        preferences.tool = "/nowhere/brume"
        self.assertEqual(self.render(scene, "still")["ViewLayer.Depth.Z"].shape, (36, 64))
        self.assertIn("frames stay without fog: /nowhere/brume: no such command; the add-on's preferences name it",
                      module("rendering").state.problem)
        for operator in (bpy.ops.brume.fog_frames, bpy.ops.brume.preview):
            with self.assertRaisesRegex(RuntimeError, "no such command"):
                operator()
        preferences.tool = ""
        path = os.environ["PATH"]
        try:
            os.environ["PATH"] = self.folder
            with self.assertRaisesRegex(RuntimeError, "the command brume was not found; the add-on's preferences say where"):
                bpy.ops.brume.fog_frames()
            os.environ["PATH"] = os.path.dirname(TOOL)
            self.assertEqual(module("tool").path(), TOOL)
        finally:
            os.environ["PATH"] = path
        preferences.tool = os.path.dirname(TOOL)
        self.assertEqual(module("tool").path(), TOOL)

    def test_frames_that_cannot_be_fogged(self):
        scene = self.start()
        scene.view_layers[0].use_pass_z = False
        self.render(scene, "still")
        self.assertIn("view layer ViewLayer has no Z pass", module("rendering").state.problem)
        scene.view_layers[0].use_pass_z = True
        scene.camera.data.type = "ORTHO"
        self.render(scene, "still")
        self.assertIn("frame 1: camera camera: ortho; expected a perspective camera", module("rendering").state.problem)
        scene.camera.data.type = "PERSP"
        with open(self.path("fogged"), "w", encoding="utf-8"):
            pass
        self.render(scene, "still")
        self.assertIn("frame 1: ", module("rendering").state.problem)
        os.unlink(self.path("fogged"))
        self.render(scene, "still")
        self.assertEqual((module("rendering").state.problem, module("rendering").state.done), ("", 1))
        scene.render.image_settings.file_format = "PNG"
        bpy.ops.render.render(write_still=True)
        self.assertIn("frames are PNG; expected OPEN_EXR_MULTILAYER", module("rendering").state.problem)

    def test_messages_of_the_command(self):
        scene = self.start()
        with self.assertRaisesRegex(RuntimeError, "shot"):
            bpy.ops.brume.fog_frames()  # nothing was rendered

    def test_a_cancelled_render(self):
        scene = self.start()
        scene.frame_end = 4

        def cancel(*_):
            if scene.frame_current == 2:
                os.kill(os.getpid(), signal.SIGINT)

        bpy.app.handlers.render_pre.append(cancel)
        try:
            bpy.ops.render.render(animation=True)
        except RuntimeError:
            pass
        finally:
            bpy.app.handlers.render_pre.remove(cancel)
        state = module("rendering").state
        self.assertFalse(state.rendering)
        self.assertEqual(os.listdir(self.path("clear", "fogged")), ["shot.0001.exr"])
        scene.frame_set(2)
        self.render(scene, "still")
        self.assertEqual((state.problem, state.done), ("", 1))

    def test_reload(self):
        scene = self.start()
        expected = ["on_init", "on_frame", "on_write", "on_end", "on_end", "on_load"]
        self.assertEqual(self.handlers(), expected)
        scene.brume.visibility = 77
        bpy.ops.wm.save_as_mainfile(filepath=self.path("shot.blend"))
        bpy.ops.wm.open_mainfile(filepath=self.path("shot.blend"))
        scene = bpy.context.scene
        self.assertEqual((self.handlers(), scene.brume.visibility, scene.brume.enabled), (expected, 77, True))
        for _ in range(2):
            bpy.ops.preferences.addon_disable(module="brume_fog")
            self.assertEqual(self.handlers(), [])
            self.assertFalse(hasattr(bpy.types.Scene, "brume"))
            bpy.ops.preferences.addon_enable(module="brume_fog")
            self.assertEqual(self.handlers(), expected)
        bpy.context.preferences.addons["brume_fog"].preferences.tool = TOOL
        self.assertEqual(scene.brume.visibility, 77)
        self.render(scene, "still")
        self.assertEqual((module("rendering").state.problem, module("rendering").state.done), ("", 1))

    def follow(self, command, events):
        """What the modal operator answers to events and, at its end, to the clock; and what it says."""
        operator = module("operators").FogFrames
        said, told = [], []
        manager = types.SimpleNamespace(progress_update=told.append, progress_end=lambda: None, event_timer_remove=lambda _: None)
        held = types.SimpleNamespace(_run=module("tool").Run(command), _timer=None, report=lambda kind, text: said.append((kind, text)))
        held._ended = lambda status: operator._ended(held, status)
        answers = []
        for event in events + ["TIMER"] * 600:
            answers.append(operator.modal(held, types.SimpleNamespace(window_manager=manager), types.SimpleNamespace(type=event)))
            if answers[-1] in ({"FINISHED"}, {"CANCELLED"}):
                return answers, said, told
            time.sleep(0.1)
        self.fail("it does not end")

    def test_frames_are_fogged_beside_the_interface(self):
        scene = self.start()
        scene.brume.enabled = False
        bpy.ops.render.render(animation=True)
        bpy.ops.brume.export(filepath=self.path("fog.json"))
        command = [TOOL, "run", self.path("fog.json"), self.path("clear", "shot.####.exr"), "-o", self.path("out", "shot.####.exr")]
        answers, said, told = self.follow(command, ["MOUSEMOVE"])
        self.assertEqual((answers[0], answers[-1], said, told[-1]), ({"PASS_THROUGH"}, {"FINISHED"}, [({"INFO"}, "2 frames in fog")], 1))

    def test_escape(self):
        with open(self.path("slow"), "w", encoding="utf-8") as file:
            file.write("#!/bin/bash\ntrap 'echo brume: ended by hand >&2; exit 1' INT\necho '[1/9] a.exr 0.1 s' >&2\nfor i in {1..300}; do sleep 0.1; done\n")
        os.chmod(self.path("slow"), 0o755)
        start = time.monotonic()
        answers, said, told = self.follow([self.path("slow")], ["TIMER"] * 3 + ["ESC"])
        self.assertEqual((answers[-1], said[-1]), ({"CANCELLED"}, ({"ERROR"}, "ended by hand")))
        self.assertLess(time.monotonic() - start, 20)
        self.assertTrue(all(abs(fraction - 1 / 9) < 1e-6 for fraction in told))

    def test_the_panel_draws(self):
        scene = self.start()
        scene.brume.falloff, scene.brume.sky = 1, "DISTANCE"
        scene.brume.shadow_maps = True

        class Layout:
            """Takes what panels say, and checks that there is such a thing."""

            def __init__(self):
                self.said = []

            def prop(self, owner, name, **_):
                getattr(owner, name)

            def operator(self, name):
                getattr(bpy.ops.brume, name.split(".")[1]).get_rna_type()

            def label(self, text, icon):
                self.said.append(text)

            def column(self):
                return self

            row = column

        panel = type("Drawn", (), {"layout": Layout()})()
        module("rendering").state.fail("a problem")
        module("panel").BrumePanel.draw(panel, bpy.context)
        module("panel").BrumePanel.draw_header(panel, bpy.context)
        self.assertEqual(panel.layout.said, ["No shadow maps, being points or areas: lamp", "a problem"])


def main():
    if "BRUME_ADDON" in os.environ:
        bpy.ops.preferences.addon_install(filepath=os.environ["BRUME_ADDON"])
    names = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    loader = unittest.defaultTestLoader
    this = sys.modules[__name__]
    suite = loader.loadTestsFromNames(names, this) if names else loader.loadTestsFromModule(this)
    result = unittest.TextTestRunner(verbosity=2).run(suite)
    # Blender's own exit status says nothing of the script.
    sys.stdout.flush()
    os._exit(0 if result.wasSuccessful() and result.testsRun else 1)


main()
