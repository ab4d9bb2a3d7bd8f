"""Fogs each frame as Blender has written it."""
import json
import os
import sys
import tempfile

import bpy
from bpy.app.handlers import persistent

from . import export, tool


class State:
    """Of the render that runs or ran last; what the panel tells."""

    def __init__(self):
        self.rendering = False
        self.snapshot = None  # (frame, what the scene file says of it)
        self.done = 0
        self.problem = ""

    def begin(self):
        self.__init__()

    def fail(self, message):
        self.problem = message
        print(f"Brume: {message}", file=sys.stderr, flush=True)


state = State()


def foggy_path(scene, frame):
    """Where the fogged twin of a frame (or pattern) goes."""
    folder = scene.brume.output or "fogged"
    folder = bpy.path.abspath(folder) if folder.startswith("//") else os.path.join(os.path.dirname(frame), folder)
    return os.path.join(os.path.normpath(folder), os.path.basename(frame))


def written_path(scene):
    """The file that was written last: a still's has no number."""
    still = bpy.path.abspath(scene.render.filepath)
    if scene.render.use_file_extension:
        still = bpy.path.ensure_ext(still, scene.render.file_extension)
    both = [path for path in {scene.render.frame_path(frame=scene.frame_current), still} if os.path.isfile(path)]
    return max(both, key=os.path.getmtime) if both else still


def check_settings(scene):
    """What Blender must write for fog to be put in; the operator `brume.setup` sees to it."""
    if scene.render.image_settings.file_format != "OPEN_EXR_MULTILAYER":
        raise export.ExportError(f"frames are {scene.render.image_settings.file_format}; expected OPEN_EXR_MULTILAYER, which 'Set up "
                                 "passes' chooses")
    if not scene.view_layers[0].use_pass_z:
        raise export.ExportError(f"view layer {scene.view_layers[0].name} has no Z pass; 'Set up passes' adds it")


def fog_frame(scene, snapshot, frame, source, output):
    """Fogs one file; the messages of the command."""
    os.makedirs(os.path.dirname(output), exist_ok=True)
    handle, name = tempfile.mkstemp(suffix=".json", prefix="brume")
    try:
        with os.fdopen(handle, "w", encoding="utf-8") as file:
            json.dump(export.scene_file(scene, {frame: snapshot}), file)
        run = tool.Run(tool.arguments(scene, name, source, output) + ["--quiet"])
        if run.wait() != 0:
            raise tool.ToolError("; ".join(run.messages).replace(name, "scene") or f"{source}: the command failed")
        return run.messages
    finally:
        os.unlink(name)


@persistent
def on_init(scene, _=None):
    state.begin()
    state.rendering = scene.brume.enabled
    if not state.rendering:
        return
    try:
        check_settings(scene)
        tool.path()
    except (export.ExportError, tool.ToolError) as error:
        state.fail(f"frames stay without fog: {error}")
        state.rendering = False


@persistent
def on_frame(scene, depsgraph=None):
    # The render has a depsgraph of its own; the scene's objects may be at another frame.
    if not state.rendering or depsgraph is None:
        return
    try:
        state.snapshot = (scene.frame_current, export.snapshot(scene, depsgraph))
    except export.ExportError as error:
        state.snapshot = None
        state.fail(f"frame {scene.frame_current}: {error}")


@persistent
def on_write(scene, _=None):
    if not state.rendering:
        return
    if state.snapshot is None or state.snapshot[0] != scene.frame_current:
        on_frame(scene, bpy.context.evaluated_depsgraph_get())
        if state.snapshot is None:
            return
    frame, snapshot = state.snapshot
    source = written_path(scene)
    try:
        fog_frame(scene, snapshot, frame, source, foggy_path(scene, source))
        state.done += 1
    except (export.ExportError, tool.ToolError, OSError) as error:
        state.fail(f"frame {frame}: {error}")


@persistent
def on_end(scene, _=None):
    state.rendering = False


@persistent
def on_load(*_):
    state.begin()


_HANDLERS = (("render_init", on_init), ("frame_change_post", on_frame), ("render_write", on_write), ("render_complete", on_end),
             ("render_cancel", on_end), ("load_post", on_load))


def register():
    for name, handler in _HANDLERS:
        getattr(bpy.app.handlers, name).append(handler)


def unregister():
    for name, handler in _HANDLERS:
        registered = getattr(bpy.app.handlers, name)
        if handler in registered:
            registered.remove(handler)
