"""Backends, and the effects that were found."""
import ctypes
import dataclasses
import json
import os
import threading
import weakref
from typing import Any, Callable, Dict, Optional, Tuple, Union

from . import _abi, _library
from ._session import Progress, Session
from .errors import ArgumentError, NotFoundError

_BACKENDS = {"auto": _abi.BACKEND_AUTO, "cpu": _abi.BACKEND_CPU, "gl": _abi.BACKEND_GL}
_LOG_LEVELS = {"error": _abi.LOG_ERROR, "warning": _abi.LOG_WARNING, "info": _abi.LOG_INFO, "debug": _abi.LOG_DEBUG}
_TYPES = {_abi.PARAMETER_NUMBER: "number", _abi.PARAMETER_INTEGER: "integer", _abi.PARAMETER_BOOLEAN: "boolean",
          _abi.PARAMETER_CHOICE: "choice"}


def chosen(value: Any, choices: Dict[str, int], name: str) -> int:
    if not isinstance(value, str) or value not in choices:
        raise ArgumentError(f"{name}: {value!r}; expected one of {', '.join(choices)}")
    return choices[value]


@dataclasses.dataclass(frozen=True)
class ContextInfo:
    """What a context is and holds."""

    backend: str  #: in use: "cpu" or "gl"
    device: str  #: the GPU's name, or "CPU"
    threads: int  #: that work at most
    host_bytes: int  #: image memory held now, pools included
    device_bytes: int  #: the same on the GPU


@dataclasses.dataclass(frozen=True)
class Parameter:
    """A parameter of an effect."""

    name: str
    type: str  #: "number", "integer", "boolean" or "choice"
    default: Union[float, int, bool, str]
    minimum: Optional[float]  #: inclusive; of numbers and integers
    maximum: Optional[float]
    choices: Tuple[str, ...]
    unit: str
    help: str
    alias: str  #: another name by which it is taken; "" where there is none


@dataclasses.dataclass(frozen=True)
class Layer:
    """A layer that an effect reads or fills."""

    name: str
    input: bool  #: it is read
    output: bool  #: it is filled
    needed: bool  #: without it the effect does not run
    of_light: bool  #: there is one for each light: (name, index) where layers are given or asked for
    any_size: bool  #: it need not have the frame's size
    channels: int  #: 1 or 3
    help: str


@dataclasses.dataclass(frozen=True)
class Effect:
    """An effect, or a plugin that was refused."""

    name: str
    help: str
    file: str
    refusal: Optional[str]  #: why this plugin was not taken
    parameters: Dict[str, Parameter]
    layers: Tuple[Layer, ...]


def _parameter(info: _abi.brume_parameter_info) -> Parameter:
    kind = _TYPES.get(info.type, "number")
    choices = tuple(_library.text(info.choices).split("|")) if kind == "choice" else ()
    default: Union[float, int, bool, str] = info.default_number
    if kind == "choice":
        default = choices[int(info.default_number)]
    elif kind == "boolean":
        default = info.default_number != 0
    elif kind == "integer":
        default = int(info.default_number)
    ranged = kind in ("number", "integer")
    return Parameter(_library.text(info.name), kind, default, info.minimum if ranged else None,
                     info.maximum if ranged else None, choices, _library.text(info.unit), _library.text(info.help),
                     _library.text(info.alias))


class Context:
    """A backend with the effects that it found.

    backend: "auto" (OpenGL where there is a GPU, else the CPU), "cpu" or "gl", which fails where it cannot be had.
    threads: of the CPU; 0: all that the process may use. They never change a bit of the result.
    plugin_directory: absolute, of further effects.
    log_level: the chattiest of "error", "warning", "info", "debug" that reaches the logger "brume" of `logging`.

    Any thread may use it, its scenes and its plans; calls wait for each other. Contexts are independent of each other.
    """

    def __init__(self, backend: str = "auto", *, threads: int = 0,
                 plugin_directory: Union[str, "os.PathLike[str]", None] = None, log_level: str = "warning") -> None:
        self._session: Optional[Session] = None
        self._children: "weakref.WeakSet[Any]" = weakref.WeakSet()
        desc = _library.new(_abi.brume_context_desc)
        desc.backend = chosen(backend, _BACKENDS, "backend")
        desc.log_level = chosen(log_level, _LOG_LEVELS, "log_level")
        if isinstance(threads, bool) or not isinstance(threads, int) or not 0 <= threads <= 1024:
            raise ArgumentError(f"threads: {threads!r}; expected 0 to 1024")
        desc.threads = threads
        if plugin_directory is not None:
            desc.plugin_directory = os.fsencode(plugin_directory)
        self._session = Session(desc)

    def session(self) -> Session:
        if self._session is None:
            raise ArgumentError("context: closed; expected an open one")
        return self._session

    def close(self) -> None:
        """Gives everything back, its scenes and plans included."""
        session, self._session = self._session, None
        if session is not None:
            for child in list(self._children):
                child.close()
            session.close()

    def __enter__(self) -> "Context":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __del__(self) -> None:
        if getattr(self, "_session", None) is not None:
            self.close()

    def __repr__(self) -> str:
        if self._session is None:
            return "<brume.Context, closed>"
        info = self.info()
        return f"<brume.Context on {info.backend} ({info.device})>"

    def info(self) -> ContextInfo:
        info = _library.new(_abi.brume_context_info)
        session = self.session()
        with session.entered() as handle:
            _library.check(handle, _library.library().brume_context_get_info(handle, ctypes.byref(info)))
            return ContextInfo("gl" if info.backend == _abi.BACKEND_GL else "cpu", _library.text(info.device), info.threads,
                               info.host_bytes, info.device_bytes)

    def effects(self) -> Dict[str, Effect]:
        """Effects by name, plugins that were refused included, and "brume": what the library reads itself."""
        lib, found = _library.library(), {}
        with self.session().entered() as handle:
            for index in range(lib.brume_effect_count(handle)):
                info = _library.new(_abi.brume_effect_info)
                _library.check(handle, lib.brume_effect_get_info(handle, index, ctypes.byref(info)))
                parameters = {}
                for place in range(info.parameter_count):
                    parameter = _library.new(_abi.brume_parameter_info)
                    _library.check(handle, lib.brume_parameter_get_info(handle, info.name, place, ctypes.byref(parameter)))
                    parameters[_library.text(parameter.name)] = _parameter(parameter)
                refusal = None if info.refusal is None else _library.text(info.refusal)
                layers = () if refusal else self._layers(handle, info.name)
                found[_library.text(info.name)] = Effect(_library.text(info.name), _library.text(info.help),
                                                         _library.text(info.file), refusal, parameters, layers)
            found["brume"] = Effect("brume", "the library itself, for all effects", "", None, {}, self._layers(handle, None))
        return found

    @staticmethod
    def _layers(handle: Any, effect: Optional[bytes]) -> Tuple[Layer, ...]:
        lib, found = _library.library(), []
        for index in range(lib.brume_layer_count(handle, effect)):
            info = _library.new(_abi.brume_layer_info)
            _library.check(handle, lib.brume_layer_get_info(handle, effect, index, ctypes.byref(info)))
            found.append(Layer(_library.text(info.name), bool(info.flags & _abi.LAYER_INPUT),
                               bool(info.flags & _abi.LAYER_OUTPUT), bool(info.flags & _abi.LAYER_NEEDED),
                               bool(info.flags & _abi.LAYER_OF_LIGHT), bool(info.flags & _abi.LAYER_ANY_SIZE), info.channels,
                               _library.text(info.help)))
        return tuple(found)

    def output_layers(self) -> Dict[str, Layer]:
        """The layers that effects fill, by name."""
        return {layer.name: layer for effect in self.effects().values() for layer in effect.layers if layer.output}

    def parameters(self, effect: str) -> Dict[str, Parameter]:
        """An effect's parameters by name."""
        found = self.effects()
        if effect not in found or found[effect].refusal or effect == "brume":
            # The library knows the nearest name, and how to put it.
            name = _library.encoded(effect, "effect")
            info = _library.new(_abi.brume_parameter_info)
            self.session().call(_library.library().brume_parameter_get_info, self.session().handle, name, 0, ctypes.byref(info))
            raise NotFoundError(f"effect: {effect!r}; expected one with parameters")
        return found[effect].parameters

    def schema(self) -> Dict[str, Any]:
        """The JSON Schema of scenes, effects of this context included."""
        with self.session().entered() as handle:
            return json.loads(_library.copied_text(_library.library().brume_scene_schema, handle))

    def trim(self) -> None:
        """Gives back the image memory that no plan holds."""
        self.session().call(_library.library().brume_context_trim, self.session().handle)

    def calibrate(self, progress: Optional[Progress] = None) -> str:
        """Measures what effects take on this device, for at most 20 s, so that later plans predict and choose by it. Returns the
        rates as text, for set_calibration().

        progress: called with how far it has come, 0 to 1; an answer that is true ends it with CancelledError.
        """
        self.session().long_call(progress, _library.library().brume_context_calibrate, self.session().handle)
        return self.calibration()

    def calibration(self) -> str:
        """The measured rates, "" before there are any."""
        with self.session().entered() as handle:
            return _library.copied_text(_library.library().brume_context_calibration, handle)

    def set_calibration(self, text: str) -> None:
        """Rates that were measured before. They are refused where they are of another library or device."""
        data = _library.encoded(text, "text")
        self.session().call(_library.library().brume_context_set_calibration, self.session().handle, data, len(data))


_defaults: Dict[str, Context] = {}
_defaults_lock = threading.Lock()


def default_context(backend: str = "auto") -> Context:
    """The context that fog() and scenes use where none is named; made at the first use, one for each backend."""
    with _defaults_lock:
        context = _defaults.get(backend)
        if context is None or context._session is None:
            context = _defaults[backend] = Context(backend)
        return context


class Child:
    """A scene or a plan: it has a handle of its own and closes with its context."""

    def __init__(self, context: Context, destroy: Callable[[Any], None]) -> None:
        self._handle: Optional[ctypes.c_void_p] = None
        self._context = context
        self._session = context.session()
        self._destroy = destroy

    def _hold(self, handle: ctypes.c_void_p) -> None:
        self._handle = handle
        self._context._children.add(self)

    @property
    def context(self) -> Context:
        return self._context

    def handle(self) -> ctypes.c_void_p:
        if self._handle is None:
            raise ArgumentError(f"{type(self).__name__.lower()}: closed; expected an open one")
        return self._handle

    def close(self) -> None:
        """Gives back what it holds. Closing twice is nothing."""
        handle, self._handle = self._handle, None
        if handle is not None:
            self._session.release(self._destroy, handle)

    def __enter__(self) -> Any:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __del__(self) -> None:
        if getattr(self, "_handle", None) is not None:
            self.close()
