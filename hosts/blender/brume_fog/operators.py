"""What the panel's buttons do."""
import json
import os

import bpy
from bpy.props import BoolProperty, StringProperty

from . import export, medium, rendering, shadows, tool

_FAILURES = (export.ExportError, tool.ToolError, medium.MediumError, OSError)


def write_shot(scene, path):
    """The scene file of the scene's frames, keyed, and its shadow maps beside it. The scene is at its frame again afterwards."""
    frame, subframe, snapshots, moves = scene.frame_current, scene.frame_subframe, {}, {}
    mapped = scene.brume.use_lights and scene.brume.shadow_maps
    try:
        for number in range(scene.frame_start, scene.frame_end + 1, scene.frame_step):
            scene.frame_set(number)
            depsgraph = bpy.context.evaluated_depsgraph_get()
            snapshots[number] = export.snapshot(scene, depsgraph)
            if mapped:
                moves[number] = shadows.Frame(scene, depsgraph)
    finally:
        scene.frame_set(frame, subframe=subframe)
    if mapped:
        shadows.add(scene, snapshots, moves, os.path.splitext(os.path.abspath(path))[0] + "_shadows")
    made = export.scene_file(scene, snapshots)
    with open(path, "w", encoding="utf-8") as file:
        json.dump(made, file, indent=1)
        file.write("\n")


def frame_pattern(scene):
    """The scene's frames as the command names them."""
    path = bpy.path.abspath(scene.render.filepath)
    if "#" not in os.path.basename(path):
        path += "####"
    return bpy.path.ensure_ext(path, scene.render.file_extension) if scene.render.use_file_extension else path


class Reporting:
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        try:
            return self.run(context) or {"FINISHED"}
        except _FAILURES as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}


class Setup(Reporting, bpy.types.Operator):
    """Multilayer EXR, and the passes that fog needs"""
    bl_idname = "brume.setup"
    bl_label = "Set up passes"

    light_groups: BoolProperty(name="A light group for each lamp", default=False)

    def run(self, context):
        scene = context.scene
        scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
        # Half ends at 65504, and rounds distances to a two-thousandth.
        scene.render.image_settings.color_depth = "32"
        layer = scene.view_layers[0]
        layer.use_pass_z = layer.use_pass_normal = layer.use_pass_diffuse_color = True
        if self.light_groups and hasattr(layer, "lightgroups"):
            for lamp in scene.objects:
                if lamp.type == "LIGHT" and not lamp.lightgroup:
                    if lamp.name not in layer.lightgroups:
                        layer.lightgroups.add().name = lamp.name
                    lamp.lightgroup = lamp.name


class Export(Reporting, bpy.types.Operator):
    """Write the shot's scene file: camera, lamps and fog, keyed frame by frame"""
    bl_idname = "brume.export"
    bl_label = "Export scene file"

    filepath: StringProperty(subtype="FILE_PATH")
    filter_glob: StringProperty(default="*.json", options={"HIDDEN"})

    def invoke(self, context, _event):
        self.filepath = bpy.path.ensure_ext(self.filepath or bpy.data.filepath.rpartition(".")[0] or "fog", ".json")
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def run(self, context):
        scene = context.scene
        write_shot(scene, bpy.path.abspath(self.filepath))
        self.report({"INFO"}, f"wrote {self.filepath}")
        left_out = shadows.without(scene) if scene.brume.use_lights and scene.brume.shadow_maps else []
        if left_out:
            self.report({"INFO"}, f"no shadow maps, being points or areas: {', '.join(left_out)}")


class FogFrames(Reporting, bpy.types.Operator):
    """Fog the frames that were rendered, and write them to the folder of foggy frames"""
    bl_idname = "brume.fog_frames"
    bl_label = "Fog rendered frames"
    bl_options = {"REGISTER"}

    def run(self, context):
        scene = context.scene
        rendering.check_settings(scene)
        source = frame_pattern(scene)
        output = rendering.foggy_path(scene, source)
        os.makedirs(os.path.dirname(output), exist_ok=True)
        scene_file = os.path.join(os.path.dirname(output), "fog.json")
        write_shot(scene, scene_file)
        frames = f"{scene.frame_start}-{scene.frame_end}x{scene.frame_step}"
        self._run = tool.Run(tool.arguments(scene, scene_file, source, output) + ["--frames", frames, "--keep-going"])
        if bpy.app.background:
            return self._ended(self._run.wait())
        context.window_manager.progress_begin(0, 1)
        self._timer = context.window_manager.event_timer_add(0.2, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC":
            self._run.cancel()
        elif event.type != "TIMER":
            return {"PASS_THROUGH"}
        status = self._run.poll()
        if self._run.total:
            context.window_manager.progress_update(self._run.done / self._run.total)
        if status is None:
            return {"RUNNING_MODAL"}
        context.window_manager.event_timer_remove(self._timer)
        context.window_manager.progress_end()
        return self._ended(status)

    def _ended(self, status):
        for message in self._run.messages:
            self.report({"WARNING"} if status == 0 else {"ERROR"}, message)
        if status == 0:
            self.report({"INFO"}, f"{self._run.done} frames in fog")
        return {"FINISHED"} if status == 0 else {"CANCELLED"}


class Preview(Reporting, bpy.types.Operator):
    """Fog the picture that was rendered last, and show it"""
    bl_idname = "brume.preview"
    bl_label = "Preview"
    bl_options = {"REGISTER"}

    NAME = "Brume preview"

    def run(self, context):
        scene = context.scene
        result = bpy.data.images.get("Render Result")
        if result is None:
            raise export.ExportError("nothing was rendered; expected a render of this frame")
        # A file of its own for each: Blender keeps what it has read from a name.
        place = os.path.join(bpy.app.tempdir, "brume_clear.exr")
        foggy = os.path.join(bpy.app.tempdir, f"brume_foggy_{len(os.listdir(bpy.app.tempdir))}.exr")
        settings = scene.render.image_settings
        before = settings.file_format, settings.color_depth
        try:
            settings.file_format, settings.color_depth = "OPEN_EXR_MULTILAYER", "32"
            result.save_render(place, scene=scene)
        except RuntimeError as error:
            raise export.ExportError(f"nothing was rendered: {error}".strip()) from None
        finally:
            settings.file_format, settings.color_depth = before
        snapshot = export.snapshot(scene, context.evaluated_depsgraph_get())
        rendering.fog_frame(scene, snapshot, scene.frame_current, place, foggy)
        image = bpy.data.images.get(self.NAME)
        if image is None:
            image = bpy.data.images.load(foggy)
            image.name = self.NAME
        else:
            image.filepath = foggy
            image.reload()
        for area in context.screen.areas if context.screen else ():
            if area.type == "IMAGE_EDITOR":
                area.spaces.active.image = image


class TakeVolume(Reporting, bpy.types.Operator):
    """Take the values of the world's volume, and unlink it so that it is not rendered as well"""
    bl_idname = "brume.take_volume"
    bl_label = "From the world's volume"

    def run(self, context):
        medium.take_volume(context.scene, context.scene.brume)


class TakeMist(Reporting, bpy.types.Operator):
    """As much fog as the world's mist: its end is as far as one sees"""
    bl_idname = "brume.take_mist"
    bl_label = "From the mist"

    def run(self, context):
        medium.take_mist(context.scene, context.scene.brume)


_classes = (Setup, Export, FogFrames, Preview, TakeVolume, TakeMist)


def register():
    for made in _classes:
        bpy.utils.register_class(made)


def unregister():
    for made in reversed(_classes):
        bpy.utils.unregister_class(made)
