"""Finds and loads libbrume.so, and reads what it returns."""
import ctypes
import os
import threading
from typing import Any, Optional, Union

from . import _abi
from .errors import LibraryError, of_status

try:
    from ._location import LIBRARY
except ImportError:  # run from the source tree
    LIBRARY = ""

_SONAME = "libbrume.so.0"
_lock = threading.Lock()
_loaded: Optional[ctypes.CDLL] = None
_loaded_from = ""


def load(path: Union[str, "os.PathLike[str]", None] = None) -> str:
    """Loads the library, and returns the path that it was loaded from.

    path: of libbrume.so, or of the folder that has it. Without it: where the SDK was installed with this package, else where
    the system looks for libraries. Called before anything else is used; else the first use does it, without a path.
    """
    global _loaded, _loaded_from
    with _lock:
        wanted = None if path is None else os.fspath(path)
        if wanted is not None and os.path.isdir(wanted):
            wanted = os.path.join(wanted, _SONAME)
        if _loaded is not None:
            if wanted is not None and os.path.realpath(wanted) != os.path.realpath(_loaded_from):
                raise LibraryError(f"path: {wanted}; {_loaded_from} is loaded already, and stays until the process ends")
            return _loaded_from
        if wanted is None:
            beside = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), LIBRARY))
            wanted = beside if LIBRARY and os.path.exists(beside) else _SONAME
        try:
            library = ctypes.CDLL(wanted)
            for name, (result, *arguments) in _abi.FUNCTIONS.items():
                function = getattr(library, name)
                function.restype, function.argtypes = result, arguments
        except (OSError, AttributeError) as error:
            raise LibraryError(f"{wanted}: {error}; expected Brume's library, which brume.load(PATH) takes from elsewhere") from None
        _loaded, _loaded_from = library, wanted
        return wanted


def library() -> ctypes.CDLL:
    if _loaded is None:
        load()
    return _loaded  # type: ignore[return-value]


def version() -> str:
    """Version of the library that was loaded, as "0.2.0"."""
    number = library().brume_version()
    return f"{number // 10000}.{number // 100 % 100}.{number % 100}"


def new(struct: Any) -> Any:
    """A struct with the library's defaults."""
    made = struct()
    getattr(library(), struct.__name__ + "_init")(ctypes.byref(made), ctypes.sizeof(made))
    return made


def copied_text(function: Any, *arguments: Any) -> str:
    """Of a function that copies text out as brume_message does."""
    size = function(*arguments, None, 0)
    buffer = ctypes.create_string_buffer(size)
    function(*arguments, buffer, size)
    return buffer.value.decode("utf-8", "replace")


def check(context: Optional[ctypes.c_void_p], status: int) -> None:
    """Raises what a status stands for. On the thread of the call that returned it: messages are per thread."""
    if status != _abi.OK:
        lib = library()
        message = copied_text(lib.brume_message, context)
        raise of_status(status, message or lib.brume_status_name(status).decode())


def text(value: Optional[bytes]) -> str:
    return "" if value is None else value.decode("utf-8", "replace")


def encoded(value: Any, name: str) -> bytes:
    """A name as the library takes it."""
    if not isinstance(value, str):
        raise of_status(_abi.ERROR_ARGUMENT, f"{name}: {value!r}; expected a string")
    if "\0" in value:
        raise of_status(_abi.ERROR_ARGUMENT, f"{name}: {value!r}; expected no zero byte")
    return value.encode("utf-8")
