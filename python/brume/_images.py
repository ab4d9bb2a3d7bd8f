"""Arrays as brume_image, without copies where brume.h can express them."""
from typing import Any, Optional, Tuple

import numpy as np

from . import _abi, _library
from .errors import ArgumentError

_PIXELS = {np.dtype(np.float32): _abi.PIXEL_F32, np.dtype(np.float16): _abi.PIXEL_F16}
_FARTHEST_PIXEL = 65536  # [bytes], as brume.h has it


def as_image_array(value: Any, name: str, channels: Tuple[int, ...]) -> np.ndarray:
    """Of shape (height, width, channels), float32 or float16; a view of what was given. One channel may be (height, width)."""
    array = np.asarray(value)
    expected = ("(height, width) or " if 1 in channels else "") + \
        "(height, width, %s)" % (channels[0] if len(channels) == 1 else "%d to %d" % (min(channels), max(channels)))
    if array.dtype not in _PIXELS:
        hint = f"; {name}.astype(numpy.float32) makes it so" if isinstance(value, np.ndarray) and \
            array.dtype.kind in "fiu" else ""
        raise ArgumentError(f"{name}.dtype: {array.dtype.str if array.dtype.kind in 'fiu' else array.dtype}; "
                            f"expected float32 or float16 in this machine's byte order{hint}")
    shape = array.shape
    if array.ndim == 2 and 1 in channels:
        array = array[:, :, np.newaxis]
    if array.ndim != 3 or array.shape[2] not in channels:
        raise ArgumentError(f"{name}.shape: {shape}; expected {expected}")
    if not 1 <= array.shape[0] <= 65536 or not 1 <= array.shape[1] <= 65536:
        raise ArgumentError(f"{name}.shape: {shape}; expected 1 to 65536 rows and columns")
    return array


def check_size(array: np.ndarray, name: str, size: Tuple[int, int], of: str) -> None:
    if array.shape[:2] != size:
        raise ArgumentError(f"{name}.shape: {array.shape[0]} x {array.shape[1]}; expected the {size[0]} x {size[1]} (height x width) "
                            f"of {of}")


def inexpressible(array: np.ndarray) -> Optional[str]:
    """Why brume_image cannot describe these strides; None where it can."""
    height, width, channels = array.shape
    rows, pixels, planes = array.strides
    sample = array.itemsize
    if not array.flags.aligned:
        return "not aligned"
    if (height > 1 and rows == 0) or (width > 1 and pixels == 0) or (channels > 1 and planes == 0):
        return "a stride of 0, which repeats values"
    if width > 1 and abs(pixels) > _FARTHEST_PIXEL:
        return f"pixels {abs(pixels)} bytes apart; at most {_FARTHEST_PIXEL} are possible"
    if width > 1 and abs(pixels) < (sample * channels if channels > 1 and planes == sample else sample):
        return f"pixels {abs(pixels)} bytes apart, which overlap"
    return None


def image_of(array: np.ndarray) -> _abi.brume_image:
    """The description of what as_image_array returned; it points to the array, which must outlive it."""
    height, width, channels = array.shape
    image = _library.new(_abi.brume_image)
    image.pixel = _PIXELS[array.dtype]
    image.height, image.width, image.channels = height, width, channels
    image.data = array.__array_interface__["data"][0]
    image.row_stride = array.strides[0] if height > 1 else 0
    image.pixel_stride = array.strides[1] if width > 1 else 0
    if channels > 1 and array.strides[2] != array.itemsize:
        image.plane_stride = array.strides[2]
    return image


def input_image(value: Any, name: str, channels: Tuple[int, ...]) -> Tuple[_abi.brume_image, np.ndarray]:
    """An input and the array that it points to: the one given or, where its strides cannot be expressed, a copy."""
    array = as_image_array(value, name, channels)
    if inexpressible(array):
        array = array.copy(order="C")
    return image_of(array), array


def output_image(value: Any, name: str, channels: Tuple[int, ...]) -> Tuple[_abi.brume_image, np.ndarray]:
    if not hasattr(value, "__array_interface__") and not hasattr(value, "__array__"):
        raise ArgumentError(f"{name}: {type(value).__name__}; expected an array to write to")
    array = as_image_array(value, name, channels)
    if not array.flags.writeable:
        raise ArgumentError(f"{name}: a read-only array; expected one that can be written")
    if not isinstance(value, np.ndarray) and not np.shares_memory(array, np.asarray(value)):
        raise ArgumentError(f"{name}: {type(value).__name__}, which gives copies of its memory; expected an array to write to")
    problem = inexpressible(array)
    if problem:
        raise ArgumentError(f"{name}.strides: {array.strides} ({problem}); expected an array of its own memory, "
                            f"such as numpy.empty({array.shape}, numpy.{array.dtype})")
    return image_of(array), array
