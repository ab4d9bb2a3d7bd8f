"""What Python fogs has the bits of what the command fogs, and comparisons have its figures."""
import json
import subprocess

import numpy as np
import pytest

import brume
import exr
from brume import testing


# A working space with the luminance weights that scenes have by default; the built-in one's differ in the fifth digit.
OCIO = """ocio_profile_version: 1
luma: [0.2126, 0.7152, 0.0722]
roles: {default: linear, scene_linear: linear}
displays: {screen: [!<View> {name: plain, colorspace: linear}]}
colorspaces: [!<ColorSpace> {name: linear}]
"""


@pytest.fixture(autouse=True)
def color_config(tmp_path, monkeypatch):
    (tmp_path / "config.ocio").write_text(OCIO)
    monkeypatch.setenv("OCIO", str(tmp_path / "config.ocio"))


def run(tool, *arguments):
    subprocess.run([tool, *map(str, arguments)], check=True, capture_output=True)


def write_frame(path, color, depth):
    channels = {name: color[:, :, place] for place, name in enumerate("RGBA"[:color.shape[2]])}
    exr.write(path, {**channels, "Z": depth})


def read_picture(path, layer="", names="RGB"):
    channels = exr.read(path)
    return np.stack([channels[layer + name] for name in names], axis=2)


SCENES = {
    "grey": {"camera": {"vertical_fov": 50}, "medium": {"visibility": 60, "g": 0.8}},
    "coloured": {"camera": {"vertical_fov": 50}, "medium": {"scattering": [0.02, 0.03, 0.05], "absorption": [0, 0.01, 0], "g": 0.5}},
    "paper": {"camera": {"vertical_fov": 50}, "medium": {"visibility": 60},
              "effects": {"multiscatter": {"kernel": "paper", "kernel_size": "6x6", "masking": False}}},
    "lamps": {"metres_per_unit": 0.5, "camera": {"horizontal_fov": 70, "camera_to_world": np.eye(4).tolist()},
              "medium": {"scattering": 0.03, "droplet_diameter": 8,
                         "density": [{"type": "exponential", "falloff": 0.1},
                                     {"type": "gaussian", "center": [0, 1, {"keys": [[1, -6], [9, -20]]}], "scale": 0.5}]},
              "lights": [{"type": "point", "position": [1, 2, -10], "intensity": [30, 20, 10], "radius": 0.1}]},
}


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("kind", [np.float32, np.float16])
def test_bits_of_the_command(tool, tmp_path, context, color, depth, name, kind):
    color = color.astype(kind)
    write_frame(tmp_path / "in.0004.exr", color, depth)
    (tmp_path / "fog.json").write_text(json.dumps({"brume": 1, **SCENES[name]}))
    run(tool, "run", tmp_path / "fog.json", tmp_path / "in.####.exr", "-o", tmp_path / "out.####.exr", "--backend", "cpu")
    for source in (SCENES[name], tmp_path / "fog.json", (tmp_path / "fog.json").read_text()):
        with brume.Scene(source, context=context) as scene:
            fogged = brume.fog(color, depth, scene, frame=4)
        np.testing.assert_array_equal(fogged, read_picture(tmp_path / "out.0004.exr"))


def test_bits_of_layers(tool, tmp_path, context, color, depth):
    write_frame(tmp_path / "in.exr", color, depth)
    (tmp_path / "fog.json").write_text(json.dumps({"brume": 1, **SCENES["lamps"]}))
    run(tool, "run", tmp_path / "fog.json", tmp_path / "in.exr", "-o", tmp_path / "out.exr", "--backend", "cpu", "--layers",
        "transmittance,airlight,light0", "--depth-kind", "ray", "--sky", "clamp:80", "--set", "airlight.max_error=0.1")
    with brume.Scene(SCENES["lamps"], context=context) as scene:
        scene.set("airlight", "max_error", 0.1)
        # A scene that names no effects has those that its content needs; setting one names it.
        scene.set("multiscatter")
        fogged, layers = brume.fog(color, depth, scene, depth_kind="ray", sky=80,
                                   layers=["transmittance", "airlight", ("light_airlight", 0)])
    np.testing.assert_array_equal(fogged, read_picture(tmp_path / "out.exr"))
    for key, layer in (("transmittance", "transmittance"), ("airlight", "airlight"), (("light_airlight", 0), "light0")):
        written = read_picture(tmp_path / "out.exr", f"brume.{layer}.")
        np.testing.assert_array_equal(layers[key].astype(written.dtype), written)


@pytest.mark.parametrize("case", ["noise", "lamp", "odd size", "black", "not finite", "alpha"])
def test_figures_of_the_command(tool, tmp_path, color, depth, case):
    random = np.random.default_rng(1)
    reference = color.copy()
    picture = color + random.normal(0, 0.02, color.shape).astype(np.float32)
    if case == "lamp":
        picture = np.roll(color, 2, axis=1)
    elif case == "odd size":
        picture, reference, depth = picture[:7, :13], reference[:7, :13], depth[:7, :13]
    elif case == "black":
        reference = np.zeros_like(color)
    elif case == "not finite":
        picture[3, 4, 1], picture[9, 9] = np.inf, np.nan
        reference[9, 9], reference[20:24, 20:24] = np.nan, np.inf
    elif case == "alpha":
        picture, reference = (np.concatenate((p, np.full((*p.shape[:2], 1), a, np.float32)), 2) for p, a in
                              ((color, 0.5), (color, 1)))
    write_frame(tmp_path / "a.exr", picture, depth)
    write_frame(tmp_path / "b.exr", reference, depth)
    said = json.loads(subprocess.run([tool, "compare", tmp_path / "a.exr", tmp_path / "b.exr", "--json"], capture_output=True,
                                     text=True, check=False).stdout)
    found = testing.compare(picture, reference)
    for value, key in ((found.relmse, "rel_mse"), (found.log2_rms, "log2_rms"), (found.energy, "energy_ratio")):
        assert (None if not np.isfinite(value) else pytest.approx(value, rel=1e-9)) == said[key]
    assert found.mean_difference == pytest.approx(said["mean_difference"], rel=1e-9, abs=1e-15)
    assert found.max_difference == pytest.approx(said["max_difference"]["value"], rel=1e-9)
    assert found.different_pixels == said["different_pixels"]
    assert found.not_finite_mismatch == said["not_finite"]["mismatched"]
    if found.max_difference:
        assert found.max_at == (said["max_difference"]["y"], said["max_difference"]["x"])


@pytest.mark.parametrize("up", ["y", "z"])
def test_environments_of_images(tool, tmp_path, context, color, depth, up):
    sky = np.random.default_rng(2).uniform(0, 2, (10, 20, 3)).astype(np.float32)
    sky[2, 5], sky[4, 4, 0], sky[7, 7, 1] = 100, np.nan, -5
    exr.write(tmp_path / "sky.exr", {name: sky[:, :, place] for place, name in enumerate("RGB")})
    write_frame(tmp_path / "in.exr", color, depth)
    medium = {"camera": {"vertical_fov": 50, "camera_to_world": np.eye(4).tolist()},
              "medium": {"scattering": 0.05, "density": [{"type": "gaussian", "center": [0, 0, -9], "scale": 0.2}]}}
    (tmp_path / "fog.json").write_text(json.dumps({"brume": 1, **medium, "environment": {"file": "sky.exr", "up": up}}))
    run(tool, "run", tmp_path / "fog.json", tmp_path / "in.exr", "-o", tmp_path / "out.exr", "--backend", "cpu")
    coefficients = brume.project_environment(sky, up)
    with brume.Scene(medium, context=context) as scene:
        scene.set_environment(coefficients)
        by_call = brume.fog(color, depth, scene)
    with brume.Scene({**medium, "environment": {"sh": coefficients}}, context=context) as scene:
        np.testing.assert_array_equal(brume.fog(color, depth, scene), by_call)
        assert scene.info().environment == 36
    np.testing.assert_allclose(by_call, read_picture(tmp_path / "out.exr"), rtol=1e-5)
    assert not np.allclose(by_call, brume.fog(color, depth, brume.Scene(medium, context=context)), rtol=1e-3)
