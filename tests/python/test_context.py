"""Contexts, what effects tell, scenes, and the classes of failures."""
import json
import logging
import subprocess
import sys

import numpy as np
import pytest

import brume
from conftest import HEIGHT, WIDTH


def test_contexts():
    with brume.Context("cpu", threads=1) as context:
        info = context.info()
        assert (info.backend, info.device, info.threads) == ("cpu", "CPU", 1)
        assert "cpu" in repr(context)
        context.trim()
    for arguments, message in ((("vulkan",), "backend: 'vulkan'; expected one of auto, cpu, gl"),
                               ((b"cpu",), "backend: b'cpu'; expected one of")):
        with pytest.raises(brume.ArgumentError, match=message):
            brume.Context(*arguments)
    for arguments, message in (({"threads": -1}, "threads: -1; expected 0 to 1024"), ({"threads": 2000}, "threads: 2000"),
                               ({"log_level": "loud"}, "log_level: 'loud'; expected one of"),
                               ({"plugin_directory": "here"}, "plugin_directory.*here.*absolute")):
        with pytest.raises(brume.ArgumentError, match=message):
            brume.Context("cpu", **arguments)


def test_effects_tell_what_they_do(context):
    effects = context.effects()
    assert {"multiscatter", "airlight", "surface", "brume"} <= set(effects)
    assert all(effect.help and effect.refusal is None for effect in effects.values())
    parameters = context.parameters("multiscatter")
    assert parameters == effects["multiscatter"].parameters
    kernel, levels, masking = parameters["method"], parameters["levels"], parameters["masking"]
    assert kernel.type == "choice" and kernel.default in kernel.choices and "paper" in kernel.choices and kernel.minimum is None
    assert kernel.alias == "kernel" and levels.alias == ""
    assert (levels.type, levels.default, levels.minimum, levels.maximum) == ("integer", 0, 0, 16)
    assert (masking.type, masking.default) == ("boolean", True)
    assert parameters["separation_density"].unit == "m"
    shadow = next(layer for layer in effects["airlight"].layers if layer.name == "shadow")
    assert shadow.input and not shadow.output and shadow.of_light and shadow.any_size and shadow.channels == 1
    assert context.output_layers()["transmittance"].channels == 3
    with pytest.raises(brume.NotFoundError, match='did you mean "airlight"'):
        context.parameters("airligh")


def test_effects_are_the_commands(context, tool):
    said = json.loads(subprocess.run([tool, "effects", "--json"], check=True, capture_output=True, text=True).stdout)
    text = json.dumps(said)
    for name, effect in context.effects().items():
        assert name in text
        for parameter in effect.parameters.values():
            assert parameter.name in text and json.dumps(parameter.help) in text


def test_schema(context):
    schema = context.schema()
    assert "medium" in schema["properties"] and "multiscatter" in json.dumps(schema["properties"]["effects"])


def test_refused_plugins_are_listed(tmp_path):
    (tmp_path / "broken.so").write_text("no library")
    with brume.Context("cpu", plugin_directory=tmp_path) as context:
        broken = next(effect for effect in context.effects().values() if effect.refusal)
        assert "broken" in broken.name and broken.parameters == {} and broken.layers == ()


def test_parameters_are_set(context, scene, color, depth):
    with brume.Scene(scene, context=context) as made:
        plain = brume.fog(color, depth, made)
        made.set("multiscatter", "kernel", "paper")  # by its alias
        paper = brume.fog(color, depth, made)
        made.set("multiscatter", "method", "paper")
        assert np.array_equal(paper, brume.fog(color, depth, made))
        made.set("multiscatter", "masking", False)
        made.set("multiscatter", "levels", 3)
        made.set("multiscatter", "level_scale", np.float32(1))
        assert not np.array_equal(plain, paper) and not np.array_equal(paper, brume.fog(color, depth, made))
        for arguments, error, message in ((("multiscater",), brume.NotFoundError, 'did you mean "multiscatter"'),
                                          (("multiscatter", "methd", "paper"), brume.NotFoundError, 'did you mean "method"'),
                                          (("multiscatter", "kernel", "x"), brume.ArgumentError, "paper"),
                                          (("multiscatter", "levels", 99), brume.ArgumentError, "99.*0 to 16"),
                                          (("multiscatter", "levels", None), brume.ArgumentError, "multiscatter.levels: None; expected"),
                                          ((3,), brume.ArgumentError, "effect: 3; expected a string")):
            with pytest.raises(error, match=message):
                made.set(*arguments)


def test_quality(context, scene):
    with brume.Scene(scene, context=context) as made:
        made.set_quality(max_error=0.2, transmittance=0.5)
        with brume.Plan(made, HEIGHT, WIDTH) as plan:
            assert plan.info().quality and "quality:" in str(plan)
        made.set_quality("draft")
        with pytest.raises(brume.ArgumentError, match="preset: 'best'; expected one of draft, standard, final, reference"):
            made.set_quality("best")
        with pytest.raises(brume.ArgumentError, match="max_error"):
            made.set_quality(max_error=-1)


def test_scenes_of_dicts_texts_and_files(context, scene, color, depth, tmp_path):
    plain = json.loads(json.dumps(scene, default=lambda array: array.tolist()))
    path = tmp_path / "fog.json"
    path.write_text(json.dumps({"brume": 1, **plain}))
    expected = brume.fog(color, depth, brume.Scene(scene, context=context))
    numbers = {**scene, "medium": {**scene["medium"], "g": np.float64(0.8), "scattering": np.array([0.02, 0.02, 0.025])}}
    for source in (plain, numbers, path, str(path), path.read_text(), " " + path.read_text()):
        np.testing.assert_array_equal(brume.fog(color, depth, brume.Scene(source, context=context)), expected)
    info = brume.Scene(path, context=context).info()
    assert (info.lights, info.gaussians, info.field_of_view, info.pose) == (0, 0, True, True)
    assert brume.Scene(context=context).info().field_of_view is False


def test_scenes_name_their_mistakes(context, tmp_path):
    (tmp_path / "fog.json").write_text('{ "brume": 1,\n  "medum": {} }')
    for source, error, message in (
            ({"medium": {"visibilty": 3}}, brume.SceneError, r'scene:\d+:\d+.*"visibilty"; did you mean "visibility"'),
            ({"medium": {"g": float("nan")}}, brume.SceneError, r"scene:\d+:\d+"),
            ({"medium": {"g": 2}}, brume.SceneError, "2.*-1 to 1|-1.*1"),
            ('{"brume": 1', brume.SceneError, r"scene:1:"), (tmp_path / "fog.json", brume.SceneError, r"fog\.json:2:3.*medum"),
            (str(tmp_path / "none.json"), brume.ArgumentError, "none.json': No such file or directory; expected a scene file"),
            (3, brume.ArgumentError, "scene: int; expected a dict, a scene file's path or its text"),
            ({"medium": object()}, brume.ArgumentError, "scene: <object.*of type object; expected numbers"),
            ({"medium": {"density": [{"type": "gaussians", "file": "none.csv"}]}}, brume.Error, "none.csv")):
        with pytest.raises(error, match=message):
            brume.Scene(source, context=context)
    with pytest.raises(brume.SceneError, match="night.json:"):
        brume.Scene("{", context=context, name="night.json")


def test_files_beside_the_scene(context, tmp_path):
    (tmp_path / "puffs.csv").write_text("x,y,z,scale,amplitude\n0,0,-5,1,2\n")
    medium = {"medium": {"scattering": 0.1, "density": [{"type": "gaussians", "file": "puffs.csv"}]}}
    (tmp_path / "fog.json").write_text(json.dumps({"brume": 1, **medium}))
    assert brume.Scene(tmp_path / "fog.json", context=context).info().gaussians == 1
    assert brume.Scene(medium, context=context, name=str(tmp_path / "scene")).info().gaussians == 1


def test_gaussians_of_arrays(context, scene, lit, color, depth):
    random = np.random.default_rng(3)
    gaussians = np.column_stack((random.uniform(-5, 5, (50, 2)), random.uniform(-30, -8, 50), random.uniform(0.2, 0.6, 50),
                                 random.uniform(0, 1, 50), random.uniform(0, 1, (50, 3))))
    camera_and_lights = {"camera": scene["camera"], "lights": lit["lights"]}
    terms = [{"type": "exponential", "falloff": 0.1, "value": 0.5}]
    listed = [{"type": "gaussian", "center": g[:3], "scale": g[3], "amplitude": g[4], "colour": g[5:]} for g in gaussians]
    with brume.Scene(camera_and_lights, context=context) as by_arrays, \
            brume.Scene({**camera_and_lights, "medium": {"scattering": 0.02, "g": 0.7, "density": terms + listed}},
                        context=context) as by_text:
        by_arrays.set_medium(scattering=0.02, g=0.7, terms=terms, gaussians=gaussians)
        np.testing.assert_array_equal(brume.fog(color, depth, by_arrays), brume.fog(color, depth, by_text))
        assert by_arrays.info().gaussians == 50
        white = np.column_stack((gaussians[:, :5], np.ones((50, 3))))
        by_arrays.set_medium(scattering=0.02, gaussians=white)
        of_eight = brume.fog(color, depth, by_arrays)
        by_arrays.set_medium(scattering=0.02, gaussians=white[:, :5])
        np.testing.assert_array_equal(brume.fog(color, depth, by_arrays), of_eight)
        for arguments, message in (({"gaussians": np.zeros((3, 4))}, r"gaussians\.shape: \(3, 4\); expected \(count, 5\) or \(count, 8\)"),
                                   ({"gaussians": "x"}, "gaussians.shape"), ({"gaussians": np.zeros((1, 5))}, "scale"),
                                   ({"scatering": 1}, r"medium\.scatering: unknown; expected one of scattering"),
                                   ({"scattering": [1, 2]}, r"medium\.scattering: \[1, 2\]; expected a number or 3 of them"),
                                   ({"noise_seed": 1.5}, r"medium\.noise_seed: 1.5; expected a whole number"),
                                   ({"terms": [{"type": "fog"}]}, r"terms\[0\]\.type: 'fog'; expected one of constant, exponential"),
                                   ({"terms": [{"fall": 1}]}, r"terms\[0\]\.fall: unknown; expected one of value")):
            with pytest.raises(brume.ArgumentError, match=message):
                by_arrays.set_medium(**arguments)


def test_cameras_units_and_weights(context, scene, color, depth):
    expected = brume.fog(color, depth, brume.Scene({**scene, "metres_per_unit": 0.5}, context=context))
    with brume.Scene({"medium": scene["medium"]}, context=context) as made:
        made.set_camera(scene["camera"])
        made.set_metres_per_unit(0.5)
        made.set_luminance_weights([0.2126, 0.7152, 0.0722])
        np.testing.assert_array_equal(brume.fog(color, depth, made), expected)
        with pytest.raises(brume.ArgumentError, match=r"weights: \[1, 2\]; expected a number or 3 of them"):
            made.set_luminance_weights([1, 2])
        with pytest.raises(brume.ArgumentError, match=r"coefficients\.shape: \(3,\); expected \(count, 3\)"):
            made.set_environment([1, 2, 3])


def test_warnings_reach_logging(color, depth, caplog):
    with brume.Context("cpu") as context:
        bright = np.full((HEIGHT, WIDTH, 3), 60000, np.float16)
        medium = {"camera": {"vertical_fov": 50}, "medium": {"absorption": 0.001, "emission": 3000}}
        with caplog.at_level(logging.WARNING, "brume"):
            brume.fog(bright, depth, brume.Scene(medium, context=context))
        assert any("clamped" in record.getMessage() for record in caplog.records)
        caplog.clear()
        with caplog.at_level(logging.INFO, "brume"), pytest.raises(brume.SceneError):
            brume.Scene("{", context=context)
        assert caplog.records == []  # the exception says it


def test_the_library_is_found_and_named(tmp_path):
    assert brume.load() == brume.load(brume.load())
    assert brume.version().count(".") == 2
    with pytest.raises(brume.LibraryError, match="is loaded already"):
        brume.load("/nowhere/libbrume.so")
    (tmp_path / "libbrume.so.0").write_text("no library")
    said = subprocess.run([sys.executable, "-c", f"import brume\ntry:\n brume.load({str(tmp_path)!r})\nexcept ImportError as e: print(e)\n"
                           "print(brume.load())"], capture_output=True, text=True, check=True).stdout.splitlines()
    assert "libbrume.so.0" in said[0] and "brume.load(PATH)" in said[0] and said[1] == brume.load()
