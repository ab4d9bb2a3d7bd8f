"""Golden-image tests: the figures of `brume compare`, and an assertion that leaves a picture of what differs."""
import dataclasses
import os
import re
import struct
import zlib
from typing import Any, Optional, Tuple, Union

import numpy as np

from ._images import as_image_array
from .errors import ArgumentError

_LUMINANCE = np.array([0.2126, 0.7152, 0.0722])


@dataclasses.dataclass(frozen=True)
class Comparison:
    """How far a picture is from its reference. What is not finite in one of them counts in none of the figures."""

    relmse: float  #: after a 2 x 2 average and a 3 x 3 box filter, so that noise counts little
    log2_rms: float  #: the same, of logarithms
    energy: float  #: mean luminance over that of the reference
    max_difference: float  #: of any component, before averaging
    max_at: Tuple[int, int]  #: row and column of it
    mean_difference: float  #: with its sign
    different_pixels: int  #: that are not equal, alpha included
    not_finite_mismatch: int  #: components that are NaN or infinite in one only


def _rgb_and_alpha(picture: Any, name: str) -> Tuple[np.ndarray, np.ndarray]:
    array = as_image_array(picture, name, (1, 2, 3, 4)).astype(np.float64)
    channels = array.shape[2]
    rgb = np.repeat(array[:, :, :1], 3, axis=2) if channels < 3 else array[:, :, :3]
    return rgb, array[:, :, channels - 1:] if channels in (2, 4) else array[:, :, :0]


def _box(values: np.ndarray, step: int, reach: int) -> np.ndarray:
    """Means of what is no NaN, over step x step pixels or, with reach, over the neighbours inside the picture."""
    finite = ~np.isnan(values)
    sums, counts = np.where(finite, values, 0.0), finite.astype(np.float64)
    for axis in (0, 1):
        if reach:
            pad = [(reach, reach) if a == axis else (0, 0) for a in range(3)]
            sums, counts = (sum(np.take(np.pad(v, pad), range(k, k + v.shape[axis]), axis) for k in range(2 * reach + 1))
                            for v in (sums, counts))
        else:
            starts = range(0, values.shape[axis], step)
            sums, counts = (np.add.reduceat(v, starts, axis) for v in (sums, counts))
    return np.where(counts > 0, sums / np.maximum(counts, 1), np.nan)


def _mean(values: np.ndarray) -> float:
    kept = values[~np.isnan(values)]
    return float(kept.mean()) if kept.size else 0.0


def compare(picture: Any, reference: Any) -> Comparison:
    """Figures of two pictures of one shape, (height, width, 1 to 4) or (height, width), as `brume compare` has them."""
    if np.shape(picture) != np.shape(reference):
        raise ArgumentError(f"picture.shape: {np.shape(picture)}; expected the reference's {np.shape(reference)}")
    (a, a_alpha), (r, r_alpha) = _rgb_and_alpha(picture, "picture"), _rgb_and_alpha(reference, "reference")
    all_a, all_r = np.concatenate((a, a_alpha), 2), np.concatenate((r, r_alpha), 2)
    same = (all_a == all_r) | (np.isnan(all_a) & np.isnan(all_r))
    either = ~np.isfinite(all_a) | ~np.isfinite(all_r)
    both = np.isfinite(a) & np.isfinite(r)
    a, r = np.where(both, a, np.nan), np.where(both, r, np.nan)
    difference = a - r
    worst = np.unravel_index(np.argmax(np.nan_to_num(np.abs(difference), nan=-1.0)), difference.shape)
    fa, fr = (_box(_box(v, 2, 0), 1, 1) for v in (a, r))
    mean_r, light_a, light_r = _mean(fr), _mean(fa @ _LUMINANCE), _mean(fr @ _LUMINANCE)
    squared = (fa - fr) ** 2
    with np.errstate(divide="ignore", invalid="ignore"):
        relative = np.where(squared == 0, 0.0, squared / (fr * fr + (0.05 * mean_r) ** 2))
        logs = [np.log2((np.maximum(v, 0) / light_r if light_r > 0 else 0 * v) + 0.02) for v in (fa, fr)]
    energy = light_a / light_r if light_r != 0 else 1.0 if light_a == 0 else float("nan")
    return Comparison(_mean(np.where(np.isnan(squared), np.nan, relative)), float(np.sqrt(_mean((logs[0] - logs[1]) ** 2))),
                      energy, float(np.nan_to_num(np.abs(difference[worst]))), (int(worst[0]), int(worst[1])),
                      _mean(difference), int((~same).any(axis=2).sum()), int((either & ~same).sum()))


def assert_matches(picture: Any, reference: Any, *, max_relmse: Optional[float] = None, max_difference: Optional[float] = None,
                   max_log2_rms: Optional[float] = None, energy: Optional[Tuple[float, float]] = None,
                   directory: Union[str, "os.PathLike[str]"] = "brume-differences", name: Optional[str] = None) -> Comparison:
    """Fails where a picture is further from its reference than the limits allow; without limits it must be equal, bit for bit but
    for the kinds of NaN. Values that are NaN or infinite in one picture only always fail.

    energy: least and largest ratio of the mean luminances.
    directory, name: where a failure leaves NAME.png: picture, reference and difference side by side. The name is that of the
        running pytest test by default.
    """
    found = compare(picture, reference)
    problems = []
    for limit, value, what in ((max_relmse, found.relmse, "relmse"), (max_log2_rms, found.log2_rms, "log2_rms"),
                               (max_difference, found.max_difference, "max_difference")):
        if limit is not None and not value <= limit:
            problems.append(f"{what}: {value:.6g}; expected at most {limit:g}")
    if energy is not None and not energy[0] <= found.energy <= energy[1]:
        problems.append(f"energy: {found.energy:.6g}; expected {energy[0]:g} to {energy[1]:g}")
    if max_relmse is max_log2_rms is max_difference is energy is None and found.different_pixels:
        problems.append(f"different_pixels: {found.different_pixels}; expected 0")
    if found.not_finite_mismatch:
        problems.append(f"not_finite_mismatch: {found.not_finite_mismatch}; expected 0")
    if problems:
        if name is None:
            name = os.environ.get("PYTEST_CURRENT_TEST", "picture").split("::")[-1].split(" ")[0]
        os.makedirs(directory, exist_ok=True)
        path = os.path.join(directory, re.sub(r"[^\w.\[\]=-]", "_", name) + ".png")
        write_difference(path, picture, reference)
        row, column = found.max_at
        raise AssertionError("; ".join(problems) + f". The largest difference is {found.max_difference:.6g}, at row {row}, column "
                             f"{column}; {path} shows picture, reference and difference")
    return found


def write_difference(path: Union[str, "os.PathLike[str]"], picture: Any, reference: Any) -> None:
    """A PNG of picture, reference and difference side by side. The pictures' exposure brings the reference's mean to a fifth of
    white, the difference's its largest value to white; what is not finite is magenta."""
    (a, _), (r, _) = _rgb_and_alpha(picture, "picture"), _rgb_and_alpha(reference, "reference")
    mean = _mean(np.where(np.isfinite(r), r, np.nan))
    with np.errstate(invalid="ignore"):
        difference = np.abs(a - r)
    finite = difference[np.isfinite(difference)]
    largest = finite.max() if finite.size else 0.0
    panels = [_png_values(a, 0.2 / mean if mean > 0 else 1.0), _png_values(r, 0.2 / mean if mean > 0 else 1.0),
              _png_values(difference, 1 / largest if largest > 0 else 1.0)]
    gap = np.full((a.shape[0], 4, 3), 255, np.uint8)
    write_png(path, np.concatenate((panels[0], gap, panels[1], gap, panels[2]), axis=1))


def _png_values(linear: np.ndarray, exposure: float) -> np.ndarray:
    finite = np.isfinite(linear).all(axis=2, keepdims=True)
    x = np.clip(np.where(finite, linear, 0) * exposure, 0, 1)
    encoded = np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)
    return np.where(finite, np.rint(255 * encoded), (255, 0, 255)).astype(np.uint8)


def write_png(path: Union[str, "os.PathLike[str]"], pixels: np.ndarray) -> None:
    """Writes pixels of shape (height, width, 3) and type uint8."""
    height, width = pixels.shape[:2]

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = np.zeros((height, 1 + 3 * width), np.uint8)
    rows[:, 1:] = pixels.reshape(height, -1)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
                   chunk(b"IDAT", zlib.compress(rows.tobytes())) + chunk(b"IEND", b""))
