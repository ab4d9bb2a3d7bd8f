"""Brume in Blender: fogs the frames that are rendered, by the `brume` command."""
bl_info = {
    "name": "Brume fog",
    "author": "The Brume authors",
    "version": (0, 2, 0),
    "blender": (3, 3, 0),
    "location": "Properties > Render > Fog",
    "description": "Fogs rendered frames, and exports shots' scene files",
    "doc_url": "",
    "category": "Render",
}

import importlib
import sys

# Blender enables an add-on that was disabled without importing its modules anew.
_NAMES = ("medium", "export", "shadows", "tool", "properties", "rendering", "operators", "panel")
for _name in _NAMES:
    if f"{__name__}.{_name}" in sys.modules:
        importlib.reload(sys.modules[f"{__name__}.{_name}"])

from . import operators, panel, properties, rendering  # noqa: E402


def register():
    properties.register()
    operators.register()
    panel.register()
    rendering.register()


def unregister():
    rendering.unregister()
    panel.unregister()
    operators.unregister()
    properties.unregister()
