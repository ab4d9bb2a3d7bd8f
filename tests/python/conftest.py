import os
import sys

import numpy as np
import pytest

import brume

sys.path.insert(0, os.path.dirname(__file__))

HEIGHT, WIDTH = 36, 64


@pytest.fixture(scope="session")
def context():
    with brume.Context("cpu") as made:
        yield made


def _backends():
    try:
        brume.Context("gl").close()
    except brume.Error:
        return ["cpu"]
    return ["cpu", "gl"]


@pytest.fixture(scope="session", params=_backends())
def any_context(request):
    """One of each backend that works here."""
    with brume.Context(request.param) as made:
        yield made


@pytest.fixture
def scene():
    return {"camera": {"vertical_fov": 50, "camera_to_world": np.eye(4)},
            "medium": {"scattering": [0.02, 0.02, 0.025], "absorption": 0.002, "g": 0.8}}


@pytest.fixture
def lit(scene):
    """The same with two lamps."""
    return {**scene, "lights": [{"type": "point", "position": [1, 2, -10], "intensity": [30, 20, 10], "radius": 0.1},
                                {"type": "spot", "position": [-2, 4, -12], "direction": [0, -1, 0], "intensity": 40}]}


@pytest.fixture
def color():
    """RGB: a ramp and two lamps in it."""
    y, x = np.mgrid[0:HEIGHT, 0:WIDTH].astype(np.float32)
    picture = np.stack((x / WIDTH, y / HEIGHT, (x + y) / (WIDTH + HEIGHT)), axis=2).astype(np.float32)
    picture[10, 20] = (50, 40, 30)
    picture[25, 50] = (5, 60, 5)
    return picture


@pytest.fixture
def depth():
    y, x = np.mgrid[0:HEIGHT, 0:WIDTH].astype(np.float32)
    distances = 10 + 0.5 * x + y
    distances[:5] = np.inf
    return distances


@pytest.fixture(scope="session")
def tool():
    """The command that was built with the library."""
    return os.environ["BRUME_TOOL"]


@pytest.fixture(scope="session")
def source():
    return os.environ["BRUME_SOURCE"]
