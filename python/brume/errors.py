"""What can go wrong, a class for each status of brume.h. Messages are the library's: they name the argument, its value and what
was expected."""
from . import _abi


class Error(Exception):
    """Any failure of Brume. `status` is the BRUME_ERROR_... of brume.h."""

    status: int = _abi.ERROR_INTERNAL


class ArgumentError(Error, ValueError):
    """An argument of the wrong shape, type or range."""

    status = _abi.ERROR_ARGUMENT


class UnsupportedError(Error):
    """Valid, but not on this backend, format or build."""

    status = _abi.ERROR_UNSUPPORTED


class OutOfMemoryError(Error, MemoryError):
    """There is not enough memory."""

    status = _abi.ERROR_MEMORY


class NotFoundError(Error, LookupError):
    """No effect, parameter or layer of that name; the message names the nearest."""

    status = _abi.ERROR_NOT_FOUND


class SceneError(Error, ValueError):
    """The scene is wrong: the message has line and column of its text."""

    status = _abi.ERROR_SCENE


class CameraError(Error, ValueError):
    """Something needs a camera that nobody gave: the message says what and why."""

    status = _abi.ERROR_CAMERA


class FormatError(Error, ValueError):
    """An image or a scene does not fit the plan: make a new one."""

    status = _abi.ERROR_FORMAT


class GLError(Error):
    """OpenGL failed: the message names the step."""

    status = _abi.ERROR_GL


class PluginError(Error):
    """An effect failed."""

    status = _abi.ERROR_PLUGIN


class InternalError(Error):
    """A defect of the library."""

    status = _abi.ERROR_INTERNAL


class CancelledError(Error):
    """The progress function asked for it."""

    status = _abi.ERROR_CANCELLED


class LibraryError(Error, ImportError):
    """libbrume.so is missing, or is not the one that this package is for."""

    status = _abi.ERROR_UNSUPPORTED


_classes = {c.status: c for c in Error.__subclasses__() if c is not LibraryError}


def of_status(status: int, message: str) -> Error:
    """The exception for a status; of a later library's, which is unknown here, Error."""
    error = _classes.get(status, Error)(message)
    error.status = status
    return error
