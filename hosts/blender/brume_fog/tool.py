"""The `brume` command."""
import os
import queue
import re
import shutil
import signal
import subprocess
import threading

import bpy

_PROGRESS = re.compile(r"\[(\d+)/(\d+)\] ")
_SUMMARY = re.compile(r"brume: \d+ done, ")


class ToolError(Exception):
    pass


def path():
    """Where the command is: in the preferences, else where the system looks for commands."""
    addon = bpy.context.preferences.addons.get(__package__)
    chosen = bpy.path.abspath(addon.preferences.tool) if addon and addon.preferences.tool else ""
    if chosen and os.path.isdir(chosen):
        chosen = os.path.join(chosen, "brume")
    if chosen and not os.access(chosen, os.X_OK):
        raise ToolError(f"{chosen}: no such command; the add-on's preferences name it")
    found = chosen or shutil.which("brume")
    if not found:
        raise ToolError("the command brume was not found; the add-on's preferences say where it is")
    return found


def arguments(scene, scene_file, frames, output):
    """Of a run over frames that Blender wrote."""
    fog, layer = scene.brume, scene.view_layers[0].name
    made = [path(), "run", scene_file, frames, "-o", output, "--color", f"{layer}.Combined", "--depth", f"{layer}.Depth.Z"]
    if fog.sky == "KEEP":
        made += ["--sky", "keep"]
    elif fog.sky == "DISTANCE":
        made += ["--sky", f"clamp:{fog.sky_distance:.9g}"]
    return made


class Run:
    """A run beside Blender; poll() until it has ended."""

    def __init__(self, command):
        self.done = self.total = 0
        self.messages = []
        self._lines = queue.SimpleQueue()
        try:
            self._process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        except OSError as error:
            raise ToolError(f"{command[0]}: {error.strerror}") from None
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self):
        for line in self._process.stderr:
            self._lines.put(line.rstrip())

    def poll(self):
        """The exit status, None while it runs. Reads what it has said: `[2/5] out.0002.exr 0.31 s` or a message."""
        status = self._process.poll()
        if status is not None:
            self._reader.join()
        while not self._lines.empty():
            line = self._lines.get()
            progress = _PROGRESS.match(line)
            if progress:
                self.done, self.total = map(int, progress.groups())
            elif line and not _SUMMARY.match(line):
                self.messages.append(line[len("brume: "):] if line.startswith("brume: ") else line)
        return status

    def wait(self):
        self._process.wait()
        return self.poll()

    def cancel(self):
        """The command finishes no further frame, and leaves none half written."""
        if self._process.poll() is None:
            self._process.send_signal(signal.SIGINT)
        self.wait()
