"""Light from all around, of an image."""
from typing import Any, Iterator, Tuple

import numpy as np

from ._images import as_image_array
from .context import chosen

_ORDER = 6  # degrees 0 to 5
_LEAST_COLUMNS = 512  # into which an image is divided, so that the middle of a cell stands for it


def _harmonics(x: np.ndarray, y: np.ndarray, z: np.ndarray) -> Iterator[Tuple[int, np.ndarray]]:
    """Real spherical harmonics without the Condon-Shortley phase: index and values."""
    around, power, first = x + 1j * y, np.ones_like(x, dtype=complex), np.full_like(x, 0.5 / np.sqrt(np.pi))
    for m in range(_ORDER):
        if m > 0:
            power, first = power * around, first * np.sqrt((2 * m + 1) / (2 * m))
        p, before, factor_before = first, np.zeros_like(x), 0.0
        for l in range(m, _ORDER):
            if l > m:
                factor = np.sqrt((4 * l * l - 1) / (l * l - m * m))
                p, before, factor_before = factor * (z * p - factor_before * before), p, 1 / factor
            yield l * (l + 1) + m, (1 if m == 0 else np.sqrt(2)) * p * power.real
            if m > 0:
                yield l * (l + 1) - m, np.sqrt(2) * p * power.imag


def project_environment(image: Any, up: str = "y") -> np.ndarray:
    """Spherical harmonics of a lat-long image, for Scene.set_environment() or a scene's "environment": {"sh": ...}.

    image: radiance from all around, of shape (height, width, 3 or 4), float32 or float16; the top row is up.
    up: world axis of the image's top. "y": its centre is toward -z; "z": toward +y; +x is to the right of it.

    Returns coefficients of shape (36, 3), as `brume run` makes them of "environment": {"file": ...}.
    """
    z_up = chosen(up, {"y": 0, "z": 1}, "up") == 1
    radiance = as_image_array(image, "image", (3, 4))[:, :, :3].astype(np.float64)
    radiance = np.where(np.isfinite(radiance), np.maximum(radiance, 0), 0)
    height, width = radiance.shape[:2]
    cells = max(1, -(-_LEAST_COLUMNS // width))
    longitude = 2 * np.pi * ((np.arange(width * cells) + 0.5) / (width * cells) - 0.5)
    sums = np.zeros((_ORDER * _ORDER, 3))
    for row in range(height * cells):
        upper, lower = np.cos(np.pi * row / (height * cells)), np.cos(np.pi * (row + 1) / (height * cells))
        top = (upper + lower) / 2  # halves the cell's area
        beside = np.sqrt(1 - top * top)
        right, forward = beside * np.sin(longitude), beside * np.cos(longitude)
        tops = np.full_like(right, top)
        share = np.repeat(radiance[row // cells], cells, axis=0) * (2 * np.pi / (width * cells) * (upper - lower))
        for index, values in _harmonics(right, *((forward, tops) if z_up else (tops, -forward))):
            sums[index] += values @ share
    return sums
