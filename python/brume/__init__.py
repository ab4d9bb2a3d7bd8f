"""Brume: fog for finished HDR pictures.

    fogged = brume.fog(color, depth, {"camera": {"vertical_fov": 50}, "medium": {"visibility": 150, "g": 0.8}})

color and depth are numpy arrays of shape (height, width, channels) and (height, width). docs/python.md has the rest.
"""
from . import testing
from ._library import load, version
from .context import Context, ContextInfo, Effect, Layer, Parameter, default_context
from .environment import project_environment
from .errors import (ArgumentError, CameraError, CancelledError, Error, FormatError, GLError, InternalError, LibraryError,
                     NotFoundError, OutOfMemoryError, PluginError, SceneError, UnsupportedError)
from .plan import Entry, Plan, PlanInfo, fog
from .scene import Scene, SceneInfo

__all__ = ["ArgumentError", "CameraError", "CancelledError", "Context", "ContextInfo", "Effect", "Entry", "Error",
           "FormatError", "GLError", "InternalError", "Layer", "LibraryError", "NotFoundError", "OutOfMemoryError", "Parameter",
           "Plan", "PlanInfo", "PluginError", "Scene", "SceneError", "SceneInfo", "UnsupportedError", "default_context", "fog",
           "load", "project_environment", "testing", "version"]
