"""The helper for golden images."""
import os
import struct
import zlib

import numpy as np
import pytest

import brume
from brume.testing import assert_matches, compare, write_png


def png_pixels(path):
    data = path.read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    width, height = struct.unpack(">II", data[16:24])
    length, = struct.unpack(">I", data[33:37])
    assert data[37:41] == b"IDAT"
    rows = np.frombuffer(zlib.decompress(data[41:41 + length]), np.uint8).reshape(height, 1 + 3 * width)
    return rows[:, 1:].reshape(height, width, 3)


def test_what_is_equal_passes(color, tmp_path):
    assert assert_matches(color, color.copy(), directory=tmp_path / "none").different_pixels == 0
    with_nan = color.copy()
    with_nan[0, 0, 0] = np.nan
    assert_matches(with_nan, with_nan.copy(), directory=tmp_path / "none")
    assert not (tmp_path / "none").exists()


def test_limits(color, tmp_path):
    near = color * np.float32(1.001)
    found = assert_matches(near, color, max_relmse=1e-5, max_difference=0.1, max_log2_rms=0.01, energy=(0.99, 1.01),
                           directory=tmp_path)
    assert 0 < found.relmse < 1e-5 and found.energy == pytest.approx(1.001)
    for limits, message in (({}, "different_pixels: 2303; expected 0"), ({"max_relmse": 1e-9}, r"relmse: 9\..*e-07; expected at most 1e-09"),
                            ({"max_difference": 0.01}, "max_difference: 0.0600014; expected at most 0.01.*at row 25, column 50"),
                            ({"max_log2_rms": 1e-6}, "log2_rms: .*expected at most 1e-06"),
                            ({"energy": (1.01, 2)}, "energy: 1.001; expected 1.01 to 2"),
                            ({"max_relmse": 1e-9, "energy": (2, 3)}, "relmse: .*; energy: ")):
        with pytest.raises(AssertionError, match=message):
            assert_matches(near, color, directory=tmp_path, **limits)
    broken = color.copy()
    broken[3, 3, 1] = np.nan
    with pytest.raises(AssertionError, match="not_finite_mismatch: 1; expected 0"):
        assert_matches(broken, color, max_relmse=100, directory=tmp_path)


def test_a_failure_leaves_a_picture(color, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    moved = np.roll(color, 3, axis=1)
    moved[0, 0] = np.inf
    with pytest.raises(AssertionError, match=r"brume-differences/test_a_failure_leaves_a_picture\.png shows picture, reference and"):
        assert_matches(moved, color, max_relmse=1e-6)
    height, width = color.shape[:2]
    pixels = png_pixels(tmp_path / "brume-differences" / "test_a_failure_leaves_a_picture.png")
    assert pixels.shape == (height, 3 * width + 8, 3)
    assert tuple(pixels[0, 0]) == (255, 0, 255)
    reference, difference = pixels[:, width + 4:2 * width + 4], pixels[:, 2 * width + 8:]
    assert tuple(reference[10, 20]) == (255, 255, 255) and difference.max() == 255 and difference[10, 20].max() > 200 and (difference[30, 5:60] < 60).all()


def test_names_of_pictures(color, tmp_path):
    with pytest.raises(AssertionError):
        assert_matches(color, color + 1, directory=tmp_path, name="night/street 1")
    assert os.listdir(tmp_path) == ["night_street_1.png"]


def test_refusals(color):
    with pytest.raises(brume.ArgumentError, match=r"picture\.shape: \(36, 64, 3\); expected the reference's \(35, 64, 3\)"):
        compare(color, color[:-1])
    with pytest.raises(brume.ArgumentError, match=r"picture\.dtype: <f8; expected"):
        compare(color.astype(np.float64), color)


def test_png(tmp_path):
    pixels = np.arange(2 * 3 * 3, dtype=np.uint8).reshape(2, 3, 3)
    write_png(tmp_path / "a.png", pixels)
    np.testing.assert_array_equal(png_pixels(tmp_path / "a.png"), pixels)
