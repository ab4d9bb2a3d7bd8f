"""What must be done for a scene and an image format, and doing it frame by frame."""
import ctypes
import dataclasses
from typing import Any, Dict, Iterable, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np

from . import _abi, _library
from ._images import as_image_array, check_size, input_image, output_image
from ._session import Progress
from .context import Child, chosen, default_context
from .errors import ArgumentError
from .scene import Scene, SceneSource, camera_struct, number, numbers

#: "transmittance", or ("light_airlight", 2) for one of light number 2.
LayerKey = Union[str, Tuple[str, int]]

_DEPTHS = {"planar": _abi.DEPTH_PLANAR, "ray": _abi.DEPTH_RAY, "inverse": _abi.DEPTH_INVERSE,
           "normalized": _abi.DEPTH_NORMALIZED, "device": _abi.DEPTH_DEVICE}
_SKIES = {"fog": _abi.SKY_FOG, "keep": _abi.SKY_KEEP}
_NONPOSITIVE = {"far": _abi.NONPOSITIVE_FAR, "near": _abi.NONPOSITIVE_NEAR}
_NORMALS = {"world": _abi.LAYER_WORLD, "camera": _abi.LAYER_CAMERA}


@dataclasses.dataclass(frozen=True)
class Entry:
    """A pass of a plan, or something that was dropped."""

    runs: bool
    effect: str
    name: str
    reason: str  #: why it runs, or why not
    bytes: int  #: the least that it reads and writes in a frame
    operations: int  #: arithmetic in a frame, about
    predicted_ms: float
    measured_ms: Optional[float]  #: of the last frame; None before one


@dataclasses.dataclass(frozen=True)
class PlanInfo:
    """What a plan takes."""

    does_nothing: bool  #: frames are copied, bit for bit
    needs_field_of_view: bool
    needs_pose: bool
    camera_reason: str  #: what needs the camera, and why
    image_bytes: int  #: memory of the plan's own images
    predicted_ms: float  #: of a frame
    predicted_error: Optional[float]  #: that 95 of 100 frames keep below, as the quality's max_error counts; None: unknown
    quality: str  #: what was chosen for the quality asked, and why
    clamped_values: Optional[int]  #: of the last frame's half outputs, beyond 65504; None where they are not counted


def _name_and_light(key: LayerKey, name: str) -> Tuple[str, Optional[int]]:
    if isinstance(key, str):
        return key, None
    if isinstance(key, tuple) and len(key) == 2 and isinstance(key[0], str) and isinstance(key[1], (int, np.integer)) \
            and 0 <= key[1] < 2**32:
        return key[0], int(key[1])
    raise ArgumentError(f"{name}: {key!r}; expected a layer's name, or (name, number of a light)")


class _Layers:
    """brume_layers with what they point to."""

    def __init__(self) -> None:
        self.structs: List[Any] = []
        self.kept: List[Any] = []

    def add(self, name: str, light: Optional[int] = None, image: Optional[_abi.brume_image] = None, kind: int = 0) -> None:
        layer = _library.new(_abi.brume_layer)
        layer.name, layer.kind, layer.light = name.encode("utf-8"), kind, light or 0
        if image is not None:
            layer.image = ctypes.pointer(image)
        self.structs.append(layer)

    def array(self) -> Any:
        return (_abi.brume_layer * len(self.structs))(*self.structs) if self.structs else None


class Plan(Child):
    """Made once for a scene and an image format, executed for each frame.

    scene: a Scene, or what one is made of.
    height, width: of the images [pixels].
    depth_kind: what depth means: "planar" (along the optical axis, what EXR's Z is), "ray" (along the pixel's ray), "inverse",
        "normalized" or "device" (docs/depth.md).
    depth_range: of "normalized" and "device", two distances in scene units.
    far: planar or ray distances from which on a pixel is far, in scene units.
    sky: what far pixels are: "fog" (at infinity), "keep" (returned without fog), or a distance in scene units.
    nonpositive: what planar and ray depths of 0 and less are: "far" or "near".
    display: display window x, y, width, height in pixels, relative to the image's top left pixel; None: the image.
    inputs: names of the layers that every frame brings.
    normals: axes of the input "normal", "world" or "camera".
    layers: names of the layers that frames may ask for.
    """

    def __init__(self, scene: Union[Scene, SceneSource], height: int, width: int, *, depth_kind: str = "planar",
                 depth_range: Sequence[float] = (0.0, 1.0), far: float = 1e9, sky: Union[str, float] = "fog",
                 nonpositive: str = "far", display: Optional[Sequence[int]] = None, inputs: Iterable[str] = (),
                 normals: str = "world", layers: Iterable[str] = ()) -> None:
        lib = _library.library()
        scene = scene if isinstance(scene, Scene) else Scene(scene)
        super().__init__(scene.context, lib.brume_plan_destroy)
        fmt = _library.new(_abi.brume_format)
        for name, value in (("height", height), ("width", width)):
            if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or not 1 <= value <= 65536:
                raise ArgumentError(f"{name}: {value!r}; expected 1 to 65536 pixels")
            setattr(fmt, name, int(value))
        fmt.depth_kind = chosen(depth_kind, _DEPTHS, "depth_kind")
        fmt.depth_range = (ctypes.c_double * 2)(*numbers(depth_range, "depth_range", 2))
        fmt.far_distance = number(far, "far")
        fmt.nonpositive = chosen(nonpositive, _NONPOSITIVE, "nonpositive")
        if isinstance(sky, str):
            fmt.sky = chosen(sky, _SKIES, "sky")
        else:
            fmt.sky, fmt.sky_distance = _abi.SKY_CLAMP, number(sky, "sky")
        if display is not None:
            window = numbers(display, "display", 4)
            if any(value != int(value) or abs(value) >= 2**31 for value in window):
                raise ArgumentError(f"display: {display!r}; expected whole numbers of pixels: x, y, width, height")
            fmt.display_x, fmt.display_y, fmt.display_width, fmt.display_height = (int(value) for value in window)
        self._size = (int(height), int(width))
        self._display = (fmt.display_height or fmt.height, fmt.display_width or fmt.width)
        given, wanted = _Layers(), _Layers()
        for name in self._names(inputs, "inputs"):
            given.add(name, kind=chosen(normals, _NORMALS, "normals") if name == "normal" else 0)
        for name in self._names(layers, "layers"):
            wanted.add(name)
        fmt.input_count, fmt.inputs = len(given.structs), given.array()
        fmt.output_count, fmt.outputs = len(wanted.structs), wanted.array()
        known = [layer for effect in self._context.effects().values() for layer in effect.layers] \
            if given.structs or wanted.structs else []
        self._channels = {layer.name: layer.channels for layer in known if layer.output}
        self._any_size = {layer.name for layer in known if layer.any_size}
        handle = ctypes.c_void_p()
        self._session.call(lib.brume_plan_create, scene.handle(), ctypes.byref(fmt), ctypes.byref(handle))
        self._hold(handle)
        self._kinds = {layer.name.decode(): layer.kind for layer in given.structs}

    @staticmethod
    def _names(names: Iterable[str], argument: str) -> List[str]:
        if isinstance(names, str):
            raise ArgumentError(f"{argument}: {names!r}; expected a list of names, such as [{names!r}]")
        listed = list(names)
        for index, name in enumerate(listed):
            _library.encoded(name, f"{argument}[{index}]")
        return listed

    def update(self, scene: Union[Scene, SceneSource]) -> None:
        """Another scene of the same structure, for the frames from now on: other values of the medium, other lights and Gaussians,
        another camera. FormatError where the structure is another, and the plan is as it was."""
        made = scene if isinstance(scene, Scene) else Scene(scene, context=self._context)
        self._session.call(_library.library().brume_plan_update, self.handle(), made.handle(), None)
        if made is not scene:
            made.close()

    def execute(self, color: Any, depth: Any, output: Any = None, *, inputs: Optional[Mapping[LayerKey, Any]] = None,
                layers: Union[Mapping[LayerKey, Any], Iterable[LayerKey], None] = None,
                camera: Optional[Mapping[str, Any]] = None, frame: float = 0.0,
                progress: Optional[Progress] = None) -> Any:
        """Fogs a frame, and returns it; with `layers` it and a dict of them.

        color: linear radiance, of shape (height, width, 1 to 4) or (height, width): grey, grey and premultiplied alpha, RGB, RGBA.
        depth: distances in scene units, of shape (height, width), or larger or smaller by one factor, such as half of it: each pixel
            takes the depth in which its centre lies.
        output: the array to write to, of color's channels; color itself is possible. None: a new one like color.
        inputs: arrays by the names that the plan has, by (name, number) where there is one for each light.
        layers: the layers wanted, or a dict of arrays to write them to. New ones are float32, (height, width, 3) or (height, width).
        camera: goes before the scene's; a scene file's camera block, with angles in degrees.
        frame: number, for the scene's keyed values.
        progress: called with how far the frame has come, 0 to 1; an answer that is true ends it with CancelledError.

        Arrays are float32 or float16. No array is copied but inputs that repeat or overlap themselves, are not aligned, or have pixels
        more than 64 KiB apart. After CancelledError or KeyboardInterrupt the outputs are undefined, and the plan is as before.
        """
        call = _library.new(_abi.brume_frame)
        color_image, color_array = input_image(color, "color", (1, 2, 3, 4))
        depth_image, depth_array = input_image(depth, "depth", (1,))
        check_size(color_array, "color", self._size, "the plan")
        if output is None:
            output = np.empty(np.shape(color), color_array.dtype)
        output_struct, output_array = output_image(output, "output", (1, 2, 3, 4))
        check_size(output_array, "output", self._size, "the plan")
        call.color, call.depth, call.output = (ctypes.pointer(image) for image in (color_image, depth_image, output_struct))
        given, filled, returned = _Layers(), _Layers(), {}
        for key, value in self._items(inputs, "inputs").items():
            name, light = _name_and_light(key, "inputs")
            image, array = input_image(value, f"inputs[{key!r}]", (1, 2, 3, 4))
            if name not in self._any_size:
                check_size(array, f"inputs[{key!r}]", self._size, "the plan")
            given.kept.append(array)
            given.add(name, light, image, self._kinds.get(name, 0))
        for key, value in self._items(layers, "layers").items():
            name, light = _name_and_light(key, "layers")
            channels = self._channels.get(name, 3)
            if value is None:
                value = np.empty(self._size if channels == 1 else (*self._size, channels), np.float32)
            image, array = output_image(value, f"layers[{key!r}]", (1,) if channels == 1 else (3, 4))
            check_size(array, f"layers[{key!r}]", self._size, "the plan")
            filled.kept.append(array)
            filled.add(name, light, image)
            returned[key] = value
        call.input_count, call.inputs = len(given.structs), given.array()
        call.output_count, call.outputs = len(filled.structs), filled.array()
        if camera is not None:
            call.camera = ctypes.pointer(camera_struct(camera, "camera", self._display[0] / self._display[1]))
        call.frame = number(frame, "frame")
        self._session.long_call(progress, _library.library().brume_plan_execute, self.handle(), ctypes.byref(call),
                                keep=(color_array, depth_array, output_array, given, filled))
        return output if layers is None else (output, returned)

    __call__ = execute

    @staticmethod
    def _items(given: Any, name: str) -> Dict[Any, Any]:
        if given is None:
            return {}
        if isinstance(given, str):
            raise ArgumentError(f"{name}: {given!r}; expected a list of names, such as [{given!r}]")
        if name == "inputs" and not isinstance(given, Mapping):
            raise ArgumentError(f"inputs: {type(given).__name__}; expected a dict of arrays by name")
        return dict(given) if isinstance(given, Mapping) else dict.fromkeys(given)

    def info(self) -> PlanInfo:
        info = _library.new(_abi.brume_plan_info)
        with self._session.entered() as owner:
            _library.check(owner, _library.library().brume_plan_get_info(self.handle(), ctypes.byref(info)))
            return PlanInfo(bool(info.does_nothing), bool(info.camera_needs & _abi.CAMERA_FIELD_OF_VIEW),
                            bool(info.camera_needs & _abi.CAMERA_POSE), _library.text(info.camera_reason), info.image_bytes,
                            info.predicted_ms, info.predicted_error if info.predicted_error >= 0 else None,
                            _library.text(info.quality), info.clamped_values if info.clamped_values >= 0 else None)

    def entries(self) -> List[Entry]:
        """The passes, and what was dropped."""
        lib, info, found = _library.library(), _library.new(_abi.brume_plan_info), []
        with self._session.entered() as owner:
            _library.check(owner, lib.brume_plan_get_info(self.handle(), ctypes.byref(info)))
            for index in range(info.entry_count):
                entry = _library.new(_abi.brume_plan_entry)
                _library.check(owner, lib.brume_plan_get_entry(self.handle(), index, ctypes.byref(entry)))
                found.append(Entry(bool(entry.runs), _library.text(entry.effect), _library.text(entry.name),
                                   _library.text(entry.reason), entry.bytes, entry.operations, entry.predicted_ms,
                                   entry.measured_ms if entry.measured_ms >= 0 else None))
        return found

    def __str__(self) -> str:
        info, lines = self.info(), [f"{self._size[1]} x {self._size[0]} pixels"]
        for entry in self.entries():
            cost = f"{entry.predicted_ms:9.3f} ms" if entry.runs else "    dropped "
            lines.append(f"  {entry.effect + '/' + entry.name:<38} {cost}  {entry.reason}")
        needs = [name for name, needed in (("field of view", info.needs_field_of_view), ("pose", info.needs_pose)) if needed]
        if needs:
            lines.append(f"camera: needs {' and '.join(needs)}: {info.camera_reason}")
        if info.quality:
            lines.append(f"quality: {info.quality}")
        lines.append("does nothing: frames are copied" if info.does_nothing else
                     f"predicted {info.predicted_ms:.3f} ms a frame; {info.image_bytes / 2**20:.1f} MiB of images")
        return "\n".join(lines)

    def __repr__(self) -> str:
        return "<brume.Plan, closed>" if self._handle is None else \
            f"<brume.Plan of {self._size[1]} x {self._size[0]} pixels>"


def fog(color: Any, depth: Any, scene: Union[Scene, SceneSource], output: Any = None, *, backend: str = "auto",
        inputs: Optional[Mapping[LayerKey, Any]] = None,
        layers: Union[Mapping[LayerKey, Any], Iterable[LayerKey], None] = None,
        camera: Optional[Mapping[str, Any]] = None, frame: float = 0.0, progress: Optional[Progress] = None,
        **format: Any) -> Any:
    """Puts fog into one picture, and returns it; with `layers` it and a dict of them.

    color: linear radiance, of shape (height, width, 1 to 4) or (height, width), float32 or float16.
    depth: distances in scene units, of shape (height, width), float32 or float16.
    scene: a dict as a scene file has it, its path or text, or a Scene.
    backend: "auto", "cpu" or "gl", where the scene is no Scene, which has its own.
    format: further arguments of Plan, such as depth_kind and sky; the other ones are those of Plan.execute().

    A plan is made for it and given back. Sequences are faster with a Plan of their own.
    """
    made_scene = None if isinstance(scene, Scene) else Scene(scene, context=default_context(backend))
    shape = as_image_array(color, "color", (1, 2, 3, 4)).shape
    wanted = Plan._items(layers, "layers")
    try:
        with Plan(scene if made_scene is None else made_scene, shape[0], shape[1],
                  inputs=dict.fromkeys(_name_and_light(key, "inputs")[0] for key in Plan._items(inputs, "inputs")),
                  layers=dict.fromkeys(_name_and_light(key, "layers")[0] for key in wanted), **format) as plan:
            return plan.execute(color, depth, output, inputs=inputs, layers=None if layers is None else wanted, camera=camera,
                                frame=frame, progress=progress)
    finally:
        if made_scene is not None:
            made_scene.close()
