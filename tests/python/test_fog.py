"""One line, plans and layers; on either backend."""
import gc
import os

import numpy as np
import pytest

import brume
from conftest import HEIGHT, WIDTH


def test_one_line(color, depth, scene):
    before = color.copy()
    fogged = brume.fog(color, depth, scene, backend="cpu")
    assert fogged.shape == color.shape and fogged.dtype == np.float32
    np.testing.assert_array_equal(color, before)
    # Fog takes from the lamp, and contrast from the ramp.
    assert fogged[25, 50, 1] < 0.8 * color[25, 50, 1] and np.ptp(fogged[:, :40, 2]) < 0.9 * np.ptp(color[:, :40, 2])


def test_a_plan_gives_the_same(color, depth, scene, context):
    with brume.Scene(scene, context=context) as made, brume.Plan(made, HEIGHT, WIDTH) as plan:
        np.testing.assert_array_equal(plan(color, depth), brume.fog(color, depth, scene, backend="cpu"))


def test_layers_compose_to_the_picture(any_context, color, depth, lit):
    with brume.Scene(lit, context=any_context) as scene:
        fogged, layers = brume.fog(color, depth, scene, layers=["transmittance", "scattered", "blur_radius", "airlight",
                                                                ("light_airlight", 0), ("light_airlight", 1)])
    assert {key: value.shape for key, value in layers.items()} == {
        "transmittance": (HEIGHT, WIDTH, 3), "scattered": (HEIGHT, WIDTH, 3), "blur_radius": (HEIGHT, WIDTH),
        "airlight": (HEIGHT, WIDTH, 3), ("light_airlight", 0): (HEIGHT, WIDTH, 3), ("light_airlight", 1): (HEIGHT, WIDTH, 3)}
    np.testing.assert_allclose(layers["light_airlight", 0] + layers["light_airlight", 1], layers["airlight"], rtol=2e-2, atol=1e-6)
    np.testing.assert_allclose(color * layers["transmittance"] + layers["scattered"] + layers["airlight"], fogged, rtol=1e-3,
                               atol=1e-4)


def test_layers_go_where_they_are_wanted(context, color, depth, scene):
    wanted = np.zeros((HEIGHT, WIDTH, 4), np.float16)
    with brume.Scene(scene, context=context) as made, \
            brume.Plan(made, HEIGHT, WIDTH, layers=["transmittance", "blur_radius"]) as plan:
        _, layers = plan(color, depth, layers={"transmittance": wanted})
        assert layers["transmittance"] is wanted and (wanted[:, :, 3] == 1).all() and (wanted[10, :, :3] < 1).all()
        assert list(plan(color, depth, layers=())[1]) == []
        for bad, message in ((np.zeros((HEIGHT, WIDTH)), r"layers\['transmittance'\]\.dtype: <f8"),
                             (np.zeros((HEIGHT, WIDTH, 2), np.float32), r"layers\['transmittance'\]\.shape: .*expected \(height, width, 3 to 4\)"),
                             (np.zeros((HEIGHT, 3, 3), np.float32), r"layers\['transmittance'\]\.shape: 36 x 3; expected the 36 x 64")):
            with pytest.raises(brume.ArgumentError, match=message):
                plan(color, depth, layers={"transmittance": bad})
        with pytest.raises(brume.ArgumentError, match=r"layers: 'transmittance'; expected a list of names"):
            plan(color, depth, layers="transmittance")
        with pytest.raises(brume.ArgumentError, match=r"layers: 3; expected a layer's name, or \(name, number of a light\)"):
            plan(color, depth, layers=[3])
        with pytest.raises(brume.Error, match="airlight.*expected a layer of the plan"):
            plan(color, depth, layers=["airlight"])
    with pytest.raises(brume.UnsupportedError, match='did you mean "transmittance"'):
        brume.fog(color, depth, scene, layers=["transmitance"])


def test_given_fog_takes_the_place_of_the_scenes(any_context, color, depth, scene):
    with brume.Scene(scene, context=any_context) as made:
        fogged, layers = brume.fog(color, depth, made, layers=["optical_depth"])
        again = brume.fog(color, depth, made, inputs={"optical_depth": layers["optical_depth"]})
    np.testing.assert_allclose(again, fogged, rtol=1e-3, atol=1e-5)


def test_normals_and_light_groups(context, color, depth, lit):
    lit = {**lit, "effects": {"surface": {}}}
    normal = np.zeros((HEIGHT, WIDTH, 3), np.float32)
    normal[:, :, 1] = 1
    groups = {("light_group", 0): color * np.float32(0.7), ("light_group", 1): color * np.float32(0.2)}
    with brume.Scene(lit, context=context) as scene:
        world = brume.fog(color, depth, scene, inputs={"normal": normal, **groups})
        camera = brume.fog(color, depth, scene, inputs={"normal": normal, **groups}, normals="camera")
        # The camera stands upright here, so that its axes are the world's.
        np.testing.assert_array_equal(world, camera)
        assert not np.array_equal(world, brume.fog(color, depth, scene, inputs={"normal": normal}))
        turned = np.array([[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]])
        pose = {"camera_to_world": turned}
        assert not np.array_equal(brume.fog(color, depth, scene, inputs={"normal": normal}, camera=pose),
                                  brume.fog(color, depth, scene, inputs={"normal": normal}, camera=pose, normals="camera"))
        with pytest.raises(brume.ArgumentError, match=r"inputs\[\('light_group', 0\)\]\.shape: 36 x 3; expected"):
            brume.fog(color, depth, scene, inputs={("light_group", 0): color[:, :3]})
        with pytest.raises(brume.Error, match="light 7; expected an index below 2"):
            brume.fog(color, depth, scene, inputs={("light_group", 7): color})


def test_shadow_maps_have_their_own_size(context, color, depth, lit):
    shadowed = {**lit["lights"][1], "shadow": {"file": "unread.exr", "vertical_fov": 60, "camera_to_world":
                [[1, 0, 0, -2], [0, 0, 1, 4], [0, -1, 0, -12], [0, 0, 0, 1]]}}
    with brume.Scene({**lit, "lights": [lit["lights"][0], shadowed]}, context=context) as scene:
        with pytest.raises(brume.Error, match="shadow"):
            brume.fog(color, depth, scene)
        open_sky = brume.fog(color, depth, scene, inputs={("shadow", 1): np.full((20, 20), 1e9, np.float32)})
        closed = brume.fog(color, depth, scene, inputs={("shadow", 1): np.full((20, 20), 0.01, np.float32)})
    assert closed.sum() < open_sky.sum()


def test_formats(context, color, depth, scene):
    with brume.Scene(scene, context=context) as made:
        planar = brume.fog(color, depth, made)
        with np.errstate(divide="ignore"):
            inverse = brume.fog(color, 1 / depth, made, depth_kind="inverse")
        np.testing.assert_allclose(inverse, planar, rtol=1e-4)
        normalized = brume.fog(color, np.where(depth < 1e9, depth / 1000, 2).astype(np.float32), made, depth_kind="normalized",
                               depth_range=(0, 1000))
        np.testing.assert_allclose(normalized, planar, rtol=1e-4)
        kept, clamped = (brume.fog(color, depth, made, sky=sky) for sky in ("keep", 20))
        assert not np.array_equal(kept, planar) and not np.array_equal(clamped, kept)
        crop = brume.fog(color[:20, :30], depth[:20, :30], made, display=(0, 0, WIDTH, HEIGHT))
        assert not np.array_equal(crop, brume.fog(color[:20, :30], depth[:20, :30], made))
        for arguments, message in (({"depth_kind": "z"}, "depth_kind: 'z'; expected one of planar, ray, inverse, normalized, device"),
                                   ({"sky": "blue"}, "sky: 'blue'; expected one of fog, keep"),
                                   ({"sky": -1}, "sky_distance: -1; expected"), ({"far": "x"}, "far: 'x'; expected a number"),
                                   ({"display": (0, 0, 1.5, 2)}, "display: .*expected whole numbers"),
                                   ({"normals": "z", "inputs": {"normal": color}}, "normals: 'z'; expected one of world, camera")):
            with pytest.raises(brume.ArgumentError, match=message):
                brume.fog(color, depth, made, **arguments)


def test_cameras(context, color, depth, scene):
    with brume.Scene(scene, context=context) as made, brume.Plan(made, HEIGHT, WIDTH) as plan:
        vertical = plan(color, depth, camera={"vertical_fov": 30})
        half = np.tan(np.radians(15)) * WIDTH / HEIGHT
        horizontal = plan(color, depth, camera={"horizontal_fov": 2 * np.degrees(np.arctan(half))})
        np.testing.assert_allclose(horizontal, vertical, rtol=1e-5)
        assert not np.array_equal(vertical, plan(color, depth))
        np.testing.assert_array_equal(plan(color, depth, camera={"vertical_fov": 50}), plan(color, depth))
        for camera, message in (({"fov": 3}, r"camera\.fov: unknown; expected one of vertical_fov"),
                                ({"vertical_fov": 1, "horizontal_fov": 1}, "expected one of them"),
                                ({"horizontal_fov": 180}, r"camera\.horizontal_fov: 180; expected more than 0"),
                                ({"camera_to_world": np.eye(3)}, r"camera\.camera_to_world\.shape: \(3, 3\); expected \(4, 4\)"),
                                (50, "camera: int; expected a dict")):
            with pytest.raises(brume.ArgumentError, match=message):
                plan(color, depth, camera=camera)
    with brume.Scene({"medium": {"visibility": 100}}, context=context) as made, \
            pytest.raises(brume.CameraError, match="field of view"):
        brume.fog(color, depth, made)


def test_frames_of_a_sequence(context, color, depth, scene):
    keyed = {**scene, "medium": {"visibility": {"keys": [[1, 1000], [11, 50]]}}}
    with brume.Scene(keyed, context=context) as made, brume.Plan(made, HEIGHT, WIDTH) as plan:
        frames = [plan(color, depth, frame=number) for number in (1, 6, 11)]
        assert not np.array_equal(frames[0], frames[1]) and not np.array_equal(frames[1], frames[2])
        plan.update({**scene, "medium": {"visibility": {"keys": [[1, 1000], [21, 50]]}}})
        np.testing.assert_array_equal(plan(color, depth, frame=21), frames[2])
        with brume.Scene(keyed, context=context) as same:
            plan.update(same)
        np.testing.assert_array_equal(plan(color, depth, frame=11), frames[2])
        with pytest.raises(brume.FormatError, match="light"):
            plan.update({**keyed, "lights": [{"type": "point", "position": [0, 0, 0], "intensity": 1}]})
        np.testing.assert_array_equal(plan(color, depth, frame=11), frames[2])


def test_a_plan_tells_what_it_does(context, scene, color, depth):
    with brume.Scene(scene, context=context) as made, brume.Plan(made, HEIGHT, WIDTH) as plan:
        text = str(plan)
        assert "64 x 36 pixels" in text and "multiscatter/compose" in text and "dropped" in text and "needs field of view" in text
        entries = plan.entries()
        assert {entry.runs for entry in entries} == {True, False} and all(entry.reason for entry in entries)
        assert all(entry.measured_ms is None for entry in entries)
        plan(color, depth)
        assert sum(entry.measured_ms or 0 for entry in plan.entries()) > 0
        info = plan.info()
        assert info.needs_field_of_view and not info.needs_pose and not info.does_nothing and info.image_bytes > 0
        assert repr(plan) == "<brume.Plan of 64 x 36 pixels>"
    with brume.Plan(brume.Scene({}, context=context), HEIGHT, WIDTH) as plan:
        assert plan.info().does_nothing and "does nothing" in str(plan)
        np.testing.assert_array_equal(plan(color, depth), color)


def test_what_is_closed_says_so(color, depth, scene):
    context = brume.Context("cpu")
    made = brume.Scene(scene, context=context)
    plan = brume.Plan(made, HEIGHT, WIDTH)
    made.close()
    made.close()
    plan(color, depth)
    with pytest.raises(brume.ArgumentError, match="scene: closed"):
        brume.Plan(made, HEIGHT, WIDTH)
    context.close()
    for use, message in ((lambda: plan(color, depth), "plan: closed|context: closed"), (context.info, "context: closed"),
                         (lambda: brume.Scene(scene, context=context), "context: closed")):
        with pytest.raises(brume.ArgumentError, match=message):
            use()
    assert "closed" in repr(plan) and "closed" in repr(made) and "closed" in repr(context)
    plan.close()
    context.close()


def resident_bytes():
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def test_nothing_leaks(color, depth, scene):
    def once():
        with brume.Context("cpu", threads=1) as context:
            plan = brume.Plan(brume.Scene(scene, context=context), 4 * HEIGHT, 4 * WIDTH, layers=["transmittance"])
            plan(np.tile(color, (4, 4, 1)), np.tile(depth, (4, 4)), layers=["transmittance"])
            with pytest.raises(brume.SceneError):
                brume.Scene("{", context=context)

    for _ in range(10):
        once()
    gc.collect()
    before = resident_bytes()
    for _ in range(60):
        once()
    gc.collect()
    # A plan of this size has 2 MiB of images.
    assert resident_bytes() - before < 20 * 2**20


def test_objects_go_without_the_cyclic_collector(color, depth, scene):
    import weakref
    gc.disable()
    try:
        context = brume.Context("cpu")
        plan = brume.Plan(brume.Scene(scene, context=context), HEIGHT, WIDTH)
        plan(color, depth)
        gone = [weakref.ref(context), weakref.ref(plan), weakref.ref(context.session())]
        del context, plan
        assert [ref() for ref in gone] == [None] * 3
    finally:
        gc.enable()
