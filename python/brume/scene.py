"""What there is: medium, lights, camera, effects."""
import ctypes
import dataclasses
import json
import math
import os
from typing import Any, Dict, Mapping, Optional, Sequence, Tuple, Union

import numpy as np

from . import _abi, _library
from .context import Child, Context, chosen, default_context
from .errors import ArgumentError

SceneSource = Union[Mapping[str, Any], str, "os.PathLike[str]"]

_TERMS = {"constant": _abi.DENSITY_CONSTANT, "exponential": _abi.DENSITY_EXPONENTIAL}
_PRESETS = {"draft": _abi.PRESET_DRAFT, "standard": _abi.PRESET_STANDARD, "final": _abi.PRESET_FINAL,
            "reference": _abi.PRESET_REFERENCE}


@dataclasses.dataclass(frozen=True)
class SceneInfo:
    """What a scene has."""

    lights: int
    gaussians: int  #: without those of files that are read at each frame
    environment: int  #: spherical-harmonic coefficients
    field_of_view: bool  #: the camera has one
    pose: bool  #: the camera has one


def _plain(value: Any) -> Any:
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    if isinstance(value, Mapping):
        return dict(value)
    raise ArgumentError(f"scene: {value!r} of type {type(value).__name__}; expected numbers, strings, lists, dicts and arrays")


def scene_text(source: SceneSource) -> Tuple[str, str]:
    """A scene's text, and the name that stands for it in messages and in whose folder its files are."""
    if isinstance(source, Mapping):
        # "brume" is the version of the format, which a dict need not say. A line a key, for the lines in messages.
        return json.dumps({"brume": 1, **source}, indent=1, default=_plain), "scene"
    if isinstance(source, str) and source.lstrip().startswith("{"):
        return source, "scene"
    if not isinstance(source, (str, os.PathLike)):
        raise ArgumentError(f"scene: {type(source).__name__}; expected a dict, a scene file's path or its text")
    try:
        with open(source, encoding="utf-8") as file:
            return file.read(), os.fspath(source)
    except OSError as error:
        raise ArgumentError(f"scene: {os.fspath(source)!r}: {error.strerror}; expected a scene file") from None


def numbers(value: Any, name: str, count: int) -> Sequence[float]:
    """A number for all, or `count` of them."""
    try:
        array = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError):
        array = np.empty(0)
    if array.shape == ():
        array = np.repeat(array, count)
    if array.shape != (count,):
        raise ArgumentError(f"{name}: {value!r}; expected a number or {count} of them")
    return array.tolist()


def number(value: Any, name: str) -> float:
    if isinstance(value, (bool, str, bytes)):
        raise ArgumentError(f"{name}: {value!r}; expected a number")
    try:
        return float(value)
    except (TypeError, ValueError):
        raise ArgumentError(f"{name}: {value!r}; expected a number") from None


class Scene(Child):
    """What there is, as a scene file says it (docs/sequences.md): lengths in scene units, densities in 1/m, angles in degrees.

    source: a dict as a scene file has it (arrays may stand for lists, and "brume": 1 may be left out), the file's path, or its
        text. None: an empty scene.
    name: stands for the scene in messages; files that it names are relative to the folder of this name.
    """

    def __init__(self, source: Optional[SceneSource] = None, *, context: Optional[Context] = None,
                 name: Optional[str] = None) -> None:
        lib = _library.library()
        super().__init__(default_context() if context is None else context, lib.brume_scene_destroy)
        handle = ctypes.c_void_p()
        with self._session.entered() as owner:
            if source is None:
                _library.check(owner, lib.brume_scene_create(owner, ctypes.byref(handle)))
            else:
                text, named = scene_text(source)
                data = _library.encoded(text, "scene")
                _library.check(owner, lib.brume_scene_create_from_text(owner, data, len(data), os.fsencode(name or named),
                                                                       ctypes.byref(handle)))
            self._hold(handle)

    def set(self, effect: str, parameter: Optional[str] = None, value: Union[str, float, bool, None] = None) -> None:
        """Adds an effect with its defaults if it is not there, and sets one parameter; without `parameter` none."""
        lib, name = _library.library(), _library.encoded(effect, "effect")
        if parameter is None:
            return self._session.call(lib.brume_scene_set_text, self.handle(), name, None, None)
        field = _library.encoded(parameter, "parameter")
        if isinstance(value, str):
            return self._session.call(lib.brume_scene_set_text, self.handle(), name, field, _library.encoded(value, "value"))
        numeric = float(value) if isinstance(value, (bool, np.bool_)) else number(value, f"{effect}.{parameter}")
        return self._session.call(lib.brume_scene_set_number, self.handle(), name, field, numeric)

    def set_medium(self, *, terms: Sequence[Mapping[str, Any]] = (), gaussians: Any = None, **values: Any) -> None:
        """Replaces the medium: for many Gaussians, which arrays say faster than text.

        terms: of the density, as in a scene file: {"type": "constant" or "exponential", "value", "falloff", "direction", "origin"}.
        gaussians: of shape (count, 5) or (count, 8): center x, y, z [scene units], scale [1/scene unit], amplitude, and the share of
            R, G, B that is scattered.
        values: scattering, absorption, emission [1/m; a number or three], g, visibility [m], droplet_diameter [um], noise_seed,
            noise_strength, noise_scale, noise_offset: brume_medium of brume.h.
        """
        medium = _library.new(_abi.brume_medium)
        _fill(medium, values, "medium", without=("terms", "term_count", "gaussians", "gaussian_count"))
        made = (_abi.brume_density_term * len(terms))()
        for index, term in enumerate(terms):
            fields, name = dict(term), f"terms[{index}]"
            made[index] = _library.new(_abi.brume_density_term)
            made[index].type = chosen(fields.pop("type", "constant"), _TERMS, f"{name}.type")
            _fill(made[index], fields, name)
        medium.terms, medium.term_count = made, len(terms)
        many = _gaussians(gaussians)
        medium.gaussians = many.ctypes.data_as(ctypes.POINTER(_abi.brume_gaussian))
        medium.gaussian_count = len(many)
        self._session.call(_library.library().brume_scene_set_medium, self.handle(), ctypes.byref(medium))

    def set_environment(self, coefficients: Any) -> None:
        """Light from all around, as real spherical harmonics in world axes: of shape (count, 3), where count is 0 (none), 1, 4, 9,
        16, 25 or 36. project_environment() makes them of an image."""
        try:
            array = np.ascontiguousarray(coefficients, dtype=np.float64)
        except (TypeError, ValueError):
            array = np.empty(0)
        if array.ndim != 2 or array.shape[1] != 3:
            raise ArgumentError(f"coefficients.shape: {array.shape}; expected (count, 3)")
        pointer = array.ctypes.data_as(ctypes.POINTER(ctypes.c_double))
        self._session.call(_library.library().brume_scene_set_environment, self.handle(), pointer, len(array))

    def set_camera(self, camera: Mapping[str, Any]) -> None:
        """Replaces the camera, by a scene file's camera block: vertical_fov [degrees], camera_to_world, pixel_aspect, center."""
        struct = camera_struct(camera, "camera")
        self._session.call(_library.library().brume_scene_set_camera, self.handle(), ctypes.byref(struct))

    def set_metres_per_unit(self, metres: float) -> None:
        """Length of a scene unit [m]."""
        self._session.call(_library.library().brume_scene_set_metres_per_unit, self.handle(), number(metres, "metres"))

    def set_luminance_weights(self, weights: Sequence[float]) -> None:
        """Of the working colour space's R, G, B; their sum is 1."""
        values = (ctypes.c_double * 3)(*numbers(weights, "weights", 3))
        self._session.call(_library.library().brume_scene_set_luminance_weights, self.handle(), values)

    def set_quality(self, preset: Optional[str] = None, *, max_error: float = 0, budget_ms: float = 0,
                    transmittance: float = 0, detail: float = 0) -> None:
        """Asks for an error or for a time instead of parameters: a preset ("draft", "standard", "final", "reference"), the largest
        error, or the largest time of a frame [ms]. transmittance and detail say what frames show (brume_quality of brume.h)."""
        quality = _library.new(_abi.brume_quality)
        quality.preset = _abi.PRESET_NONE if preset is None else chosen(preset, _PRESETS, "preset")
        for name, value in (("max_error", max_error), ("budget_ms", budget_ms), ("transmittance", transmittance),
                            ("detail", detail)):
            setattr(quality, name, number(value, name))
        self._session.call(_library.library().brume_scene_set_quality, self.handle(), ctypes.byref(quality))

    def info(self) -> SceneInfo:
        lib, info, given = _library.library(), _library.new(_abi.brume_scene_info), ctypes.c_uint32()
        self._session.call(lib.brume_scene_get_info, self.handle(), ctypes.byref(info))
        self._session.call(lib.brume_scene_get_camera_given, self.handle(), ctypes.byref(given))
        return SceneInfo(info.light_count, info.gaussian_count, info.environment_count,
                         bool(given.value & _abi.CAMERA_FIELD_OF_VIEW), bool(given.value & _abi.CAMERA_POSE))

    def __repr__(self) -> str:
        if self._handle is None:
            return "<brume.Scene, closed>"
        info = self.info()
        return f"<brume.Scene of {info.lights} lights, {info.gaussians} Gaussians>"


def _fill(struct: Any, values: Mapping[str, Any], name: str, without: Sequence[str] = ()) -> None:
    known = {field: kind for field, kind in struct._fields_ if field not in ("struct_size", "reserved", "type", *without)}
    for field, value in values.items():
        if field not in known:
            raise ArgumentError(f"{name}.{field}: unknown; expected one of {', '.join(known)}")
        if issubclass(known[field], ctypes.Array):
            setattr(struct, field, known[field](*numbers(value, f"{name}.{field}", known[field]._length_)))
        elif known[field] is ctypes.c_uint32:
            if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or not 0 <= value < 2**32:
                raise ArgumentError(f"{name}.{field}: {value!r}; expected a whole number of 0 or more")
            setattr(struct, field, int(value))
        else:
            setattr(struct, field, number(value, f"{name}.{field}"))


def _gaussians(values: Any) -> np.ndarray:
    try:
        array = np.empty((0, 5)) if values is None else np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        array = np.empty(0)
    if array.ndim != 2 or array.shape[1] not in (5, 8):
        raise ArgumentError(f"gaussians.shape: {array.shape}; expected (count, 5) or (count, 8)")
    made = np.zeros(len(array), dtype=np.dtype(_abi.brume_gaussian))
    made["struct_size"] = ctypes.sizeof(_abi.brume_gaussian)
    made["center"], made["scale"], made["amplitude"] = array[:, :3], array[:, 3], array[:, 4]
    made["color"] = array[:, 5:] if array.shape[1] == 8 else 1.0
    return made


def camera_struct(camera: Mapping[str, Any], name: str, height_per_width: Optional[float] = None) -> _abi.brume_camera:
    """Of a scene file's camera block. height_per_width: of the display window in pixels, where horizontal_fov may be given."""
    if not isinstance(camera, Mapping):
        raise ArgumentError(f"{name}: {type(camera).__name__}; expected a dict such as a scene file's camera block")
    struct, fields = _library.new(_abi.brume_camera), dict(camera)
    if "pixel_aspect" in fields:
        struct.pixel_aspect = number(fields.pop("pixel_aspect"), f"{name}.pixel_aspect")
    if "center" in fields:
        struct.center = (ctypes.c_double * 2)(*numbers(fields.pop("center"), f"{name}.center", 2))
    if "vertical_fov" in fields and "horizontal_fov" in fields:
        raise ArgumentError(f"{name}: vertical_fov and horizontal_fov; expected one of them")
    if "vertical_fov" in fields:
        struct.vertical_fov = math.radians(number(fields.pop("vertical_fov"), f"{name}.vertical_fov"))
        struct.given |= _abi.CAMERA_FIELD_OF_VIEW
    elif "horizontal_fov" in fields and height_per_width is not None:
        half = math.radians(number(fields.pop("horizontal_fov"), f"{name}.horizontal_fov")) / 2
        if not 0 < half < math.pi / 2:
            raise ArgumentError(f"{name}.horizontal_fov: {camera['horizontal_fov']!r}; expected more than 0 and less than 180 degrees")
        struct.vertical_fov = 2 * math.atan(math.tan(half) * height_per_width / struct.pixel_aspect)
        struct.given |= _abi.CAMERA_FIELD_OF_VIEW
    if "camera_to_world" in fields:
        matrix = np.asarray(fields.pop("camera_to_world"), dtype=np.float64)
        if matrix.shape != (4, 4):
            raise ArgumentError(f"{name}.camera_to_world.shape: {matrix.shape}; expected (4, 4)")
        struct.camera_to_world = (ctypes.c_double * 16)(*matrix.ravel())
        struct.given |= _abi.CAMERA_POSE
    if fields:
        known = "vertical_fov, camera_to_world, pixel_aspect, center" + ("" if height_per_width is None else ", horizontal_fov")
        raise ArgumentError(f"{name}.{next(iter(fields))}: unknown; expected one of {known}")
    return struct
