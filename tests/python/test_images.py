"""Arrays of any strides that the library takes give the same bits; others are refused, with the argument's name."""
import numpy as np
import pytest

import brume
from conftest import HEIGHT, WIDTH


@pytest.fixture
def plan(context, scene):
    with brume.Plan(brume.Scene(scene, context=context), HEIGHT, WIDTH) as made:
        yield made


def strided(array, kind):
    """The same values in other places of memory."""
    if kind == "wider rows":
        made = np.full((array.shape[0], array.shape[1] + 3, *array.shape[2:]), 7, array.dtype)[:, 1:-2]
    elif kind == "more channels":
        made = np.full((*array.shape[:2], array.shape[2] + 2), 7, array.dtype)[:, :, 1:-1]
    elif kind == "planes":
        made = np.moveaxis(np.empty((array.shape[2], *array.shape[:2]), array.dtype), 0, -1)
    elif kind == "columns":
        made = np.moveaxis(np.empty((array.shape[1], array.shape[0], *array.shape[2:]), array.dtype), 0, 1)
    elif kind == "upside down":
        made = np.empty_like(array)[::-1]
    elif kind == "mirrored":
        made = np.empty_like(array)[:, ::-1]
    elif kind == "BGR":
        made = np.empty_like(array)[:, :, ::-1]
    elif kind == "every second":
        made = np.full((2 * array.shape[0], 2 * array.shape[1], *array.shape[2:]), 7, array.dtype)[::2, 1::2]
    made[...] = array
    return made


@pytest.mark.parametrize("kind", ["wider rows", "more channels", "planes", "columns", "upside down", "mirrored", "BGR",
                                  "every second"])
def test_strides_change_no_bit(plan, color, depth, kind):
    expected = plan(color, depth)
    output = strided(np.zeros_like(color), kind)
    around = None if output.base is None else output.base.copy()
    far = depth if kind in ("more channels", "planes", "BGR") else strided(depth[:, :, None], kind)
    assert plan(strided(color, kind), far, output) is output
    np.testing.assert_array_equal(output, expected)
    if around is not None and kind in ("wider rows", "more channels", "every second"):
        # What lies between the pixels is left alone.
        assert (output.base == 7).sum() >= (around == 7).sum()


def test_nothing_is_copied(plan, color, depth):
    from brume import _images
    for kind in ("wider rows", "planes", "mirrored", "BGR"):
        given = strided(color, kind)
        image, kept = _images.input_image(given, "color", (3,))
        assert np.shares_memory(kept, given) and image.data == given.__array_interface__["data"][0]


def test_in_place(plan, color, depth):
    expected = plan(color, depth)
    assert plan.execute(color, depth, color) is color
    np.testing.assert_array_equal(color, expected)


@pytest.mark.parametrize("channels", [1, 2, 3, 4])
def test_channels(plan, color, depth, channels):
    picture = np.repeat(color, 2, axis=2)[:, :, :channels].copy()
    fogged = plan(picture, depth)
    assert fogged.shape == picture.shape and fogged.dtype == np.float32
    assert not np.array_equal(fogged, picture)
    if channels in (2, 4):
        np.testing.assert_array_equal(fogged[:, :, -1], picture[:, :, -1])


def test_grey_without_an_axis(plan, color, depth):
    grey = color[:, :, 0].copy()
    fogged = plan(grey, depth)
    assert fogged.shape == grey.shape
    np.testing.assert_array_equal(fogged, plan(grey[:, :, None], depth[:, :, None])[:, :, 0])


def test_half(plan, color, depth):
    half = color.astype(np.float16)
    fogged = plan(half, depth.astype(np.float16))
    assert fogged.dtype == np.float16
    np.testing.assert_array_equal(fogged, plan(half.astype(np.float32), depth.astype(np.float16).astype(np.float32)).astype(np.float16))
    half[3, 3] = 60000
    near = np.full_like(depth, 1)
    assert plan(half, near).max() > 50000 and plan.info().clamped_values == 0


def test_one_pixel(context, scene):
    with brume.Plan(brume.Scene(scene, context=context), 1, 1) as plan:
        assert plan(np.ones((1, 1, 3), np.float32), np.full((1, 1), 20, np.float32)).shape == (1, 1, 3)


def test_inputs_that_cannot_be_expressed_are_copied(plan, color, depth):
    expected = plan(np.broadcast_to(color[:1], color.shape).copy(), depth)
    np.testing.assert_array_equal(plan(np.broadcast_to(color[:1], color.shape), depth), expected)
    unaligned = np.frombuffer(b"\0" + color.tobytes(), np.uint8)[1:].view(np.float32).reshape(color.shape)
    np.testing.assert_array_equal(plan(unaligned, depth), plan(color, depth))


def test_lists_of_other_libraries(plan, color, depth):
    class Tensor:
        """What torch and others offer."""

        def __init__(self, array):
            self.array = array

        def __array__(self, dtype=None):
            return self.array

    output = np.empty_like(color)
    given = Tensor(output)
    assert plan(Tensor(color), Tensor(depth), given) is given
    np.testing.assert_array_equal(output, plan(color, depth))


@pytest.mark.parametrize("make, message", [
    (lambda c, d: (c.astype(np.float64), d), r"color\.dtype: <f8; expected float32 or float16 .*astype"),
    (lambda c, d: (c, np.zeros((36, 64), np.int32)), r"depth\.dtype: <i4; expected float32 or float16"),
    (lambda c, d: (c.astype(">f4"), d), r"color\.dtype: >f4; expected float32 or float16 in this machine's byte order"),
    (lambda c, d: ("picture", d), r"color\.dtype: <U7; expected float32"),
    (lambda c, d: (c[0, 0], d), r"color\.shape: \(3,\); expected \(height, width\) or \(height, width, 1 to 4\)"),
    (lambda c, d: (np.zeros((36, 64, 5), np.float32), d), r"color\.shape: \(36, 64, 5\); expected"),
    (lambda c, d: (np.zeros((36, 64, 0), np.float32), d), r"color\.shape: \(36, 64, 0\); expected"),
    (lambda c, d: (np.zeros((0, 64, 3), np.float32), d), r"color\.shape: \(0, 64, 3\); expected 1 to 65536 rows and columns"),
    (lambda c, d: (c, np.zeros((36, 0), np.float32)), r"depth\.shape: \(36, 0\); expected 1 to 65536"),
    (lambda c, d: (c, c), r"depth\.shape: \(36, 64, 3\); expected \(height, width\) or \(height, width, 1\)"),
    (lambda c, d: (c[:-1], d), r"color\.shape: 35 x 64; expected the 36 x 64 \(height x width\) of the plan"),
    (lambda c, d: (c, None), r"depth\.dtype: object; expected"),
    (lambda c, d: (c, d, c[:, :, :2]), r"output.*channels"),
    (lambda c, d: (c, d, c.astype(np.float64)), r"output\.dtype: <f8"),
    (lambda c, d: (c, d, [0.0]), r"output: list; expected an array to write to"),
    (lambda c, d: (c, d, np.broadcast_to(c[:1], c.shape).copy()[:, :5]), r"output\.shape: 36 x 5; expected"),
])
def test_refusals(plan, color, depth, make, message):
    with pytest.raises(brume.ArgumentError if "channels" not in message else brume.Error, match=message):
        plan(*make(color, depth))


def test_depth_of_another_size_is_nearest(plan, color, depth):
    half, twice = depth[::2, ::2], depth.repeat(2, axis=0).repeat(2, axis=1)
    np.testing.assert_array_equal(plan(color, half), plan(color, half.repeat(2, axis=0).repeat(2, axis=1)))
    np.testing.assert_array_equal(plan(color, twice), plan(color, depth))
    assert (plan(color, half) != plan(color, depth)).any()
    for other in (depth[:, 1:], depth[1:], depth.T):
        with pytest.raises(brume.FormatError, match=r"depth: \d+ x \d+; the plan was made for 64 x 36; expected that size, or"):
            plan(color, other)


def test_read_only_output(plan, color, depth):
    output = np.zeros_like(color)
    output.flags.writeable = False
    with pytest.raises(brume.ArgumentError, match="output: a read-only array; expected one that can be written"):
        plan(color, depth, output)
    color.flags.writeable = depth.flags.writeable = False
    plan(color, depth)


def test_outputs_are_never_copied(plan, color, depth):
    repeated = np.lib.stride_tricks.as_strided(np.zeros(3, np.float32), color.shape, (0, 0, 4))
    with pytest.raises(brume.ArgumentError, match=r"output\.strides: \(0, 0, 4\) \(a stride of 0, which repeats values\); expected an "
                                                  r"array of its own memory, such as numpy.empty\(\(36, 64, 3\), numpy.float32\)"):
        plan(color, depth, repeated)


def test_partial_overlap_is_refused(plan, color, depth):
    both = np.zeros((HEIGHT + 1, WIDTH, 3), np.float32)
    with pytest.raises(brume.Error, match="overlap"):
        plan(both[:-1], depth, both[1:])
