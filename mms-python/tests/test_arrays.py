"""Shapes, strides, precisions and orders of arrays; numbers that are none."""

import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

import manufactured as mf

from conftest import opened, time_of

FIELDS = ["bar_1d", "travelling_wave_2d", "axis_aligned_3d"]


def plain(field, quantity, x):
    """A quantity at points that lie in memory one after the other, one call for each."""
    rows = np.ascontiguousarray(x).reshape(-1, field.dimension)
    found = [field.evaluate(quantity, row.copy(), time_of(field)) for row in rows]
    return np.array(found, x.dtype)


def arranged(draw, x):
    """The same numbers in another order of memory."""
    way = draw(st.sampled_from(["as it is", "fortran", "reversed", "every other", "odd", "read-only"]))
    if way == "fortran":
        return np.asfortranarray(x)
    if way == "reversed":
        return np.ascontiguousarray(x[..., ::-1])[..., ::-1]
    if way == "every other":
        room = np.full((*x.shape[:-1], 2 * x.shape[-1]), np.nan, x.dtype)
        room[..., ::2] = x
        return room[..., ::2]
    if way == "odd":
        # Between the places where numbers of this size stand.
        room = np.zeros(x.nbytes + 1, np.uint8)[1:].view(x.dtype).reshape(x.shape)
        room[...] = x
        return room
    x = x.copy()
    x.flags.writeable = way == "as it is"
    return x


@st.composite
def points(draw, dimension):
    leading = draw(arrays.array_shapes(min_dims=0, max_dims=3, min_side=0, max_side=4))
    dtype = draw(st.sampled_from([np.float32, np.float64]))
    number = st.floats(0.0625, 0.9375, width=32)
    x = draw(arrays.arrays(dtype, (*leading, dimension), elements=number))
    x = arranged(draw, x)
    if draw(st.booleans()) and len(leading) > 1:
        x = np.swapaxes(x, 0, len(leading) - 1)
    return x


@pytest.mark.parametrize("name", FIELDS)
@settings(deadline=None, max_examples=150)
@given(data=st.data())
def test_any_arrangement(name, data):
    field = opened(name)
    d = field.dimension
    x = data.draw(points(d))
    before = x.tobytes()
    leading = x.shape[:-1]
    quantity, own = data.draw(
        st.sampled_from([("jacobian", ()), ("body_force", (d,)), ("first_piola_kirchhoff", (d, d))])
    )
    if d == 1 and x.ndim == 1:
        leading, own = x.shape, ()
    found = field.evaluate(quantity, x, time_of(field))
    assert found.dtype == x.dtype
    assert found.shape == (*leading, *own)
    assert found.flags.c_contiguous
    assert found.tobytes() == plain(field, quantity, x).tobytes()
    assert x.tobytes() == before


@pytest.mark.parametrize("name", FIELDS)
@settings(deadline=None, max_examples=50)
@given(data=st.data())
def test_a_number_that_is_none_is_named(name, data):
    field = opened(name)
    x = data.draw(points(field.dimension).filter(lambda x: x.size > 0 and x.ndim > 1)).copy()
    place = data.draw(st.tuples(*[st.integers(0, length - 1) for length in x.shape]))
    x[place] = data.draw(st.sampled_from([np.nan, np.inf, -np.inf]))
    written = str(tuple(int(it) for it in place[:-1]))
    with pytest.raises(mf.MmsError, match=re.escape(f"the point at {written} has a number")):
        field.body_force(x, time_of(field))


def test_points_of_one_number():
    bar = opened("bar_1d")
    time = time_of(bar)
    x = np.linspace(0.0, 1.0, 7)
    for quantity in ["body_force", "jacobian", "cauchy_stress"]:
        assert bar.evaluate(quantity, x, time).shape == (7,)
        assert bar.evaluate(quantity, x[3], time).shape == ()
    assert bar.b(x[:, None], time).shape == (7, 1)
    assert bar.J(x[:, None], time).shape == (7,)
    assert bar.F(x[:, None], time).shape == (7, 1, 1)
    assert bar.b(x.reshape(7, 1, 1), time).shape == (7, 1, 1)
    assert float(bar.u(0.5, time)) == bar.u(x, time)[3]


def test_an_axisymmetric_field_has_tensors_in_space():
    tube = opened("lame_tube")
    x = tube.sample(4)
    d = x.shape[-1]
    assert tube.F(x, time_of(tube)).shape in [(4, 3, 3), (4, d, d)]
    assert tube.J(x, time_of(tube)).shape == (4,)


def test_what_is_no_array_of_numbers_is_copied_or_refused():
    field = opened("travelling_wave_2d")
    time = time_of(field)
    expected = field.b(np.array([[0.25, 0.5]]), time)
    for given in [[[0.25, 0.5]], ((0.25, 0.5),), np.array([[0.25, 0.5]], ">f8"), np.array([[0.25, 0.5]], np.float16)]:
        found = field.b(given, time)
        assert found.dtype == np.float64
        assert found.tobytes() == expected.tobytes()
    assert field.b(np.array([[0.25, 0.5]], ">f4"), time).dtype == np.float32
    assert field.b(np.array([[0, 1]]), time).dtype == np.float64
    for given in ["x", [["a", "b"]], np.array([[1j, 0]]), None, [[0.1, None]]]:
        with pytest.raises((TypeError, ValueError)):
            field.b(given, time)
    with pytest.raises(TypeError, match="masked"):
        field.b(np.ma.masked_array([[0.25, 0.5]], mask=[[True, False]]), time)


def test_points_that_overlap():
    field = opened("travelling_wave_2d")
    line = np.linspace(0.1, 0.9, 9)
    x = np.lib.stride_tricks.sliding_window_view(line, 2)
    assert np.shares_memory(x[0], x[1])
    assert field.b(x, time_of(field)).tobytes() == field.b(x.copy(), time_of(field)).tobytes()
    wide = np.broadcast_to(np.array([0.25, 0.5]), (1000, 3, 2))
    assert (field.b(wide, time_of(field)) == field.b(wide[0, 0], time_of(field))).all()


@pytest.mark.parametrize("shape", [(3,), (4, 3), (2, 0), (0, 3), ()])
def test_a_shape_that_is_none(shape):
    with pytest.raises(mf.MmsError, match=re.escape(f"`X` has the shape {shape}: expected (..., 2)")):
        opened("travelling_wave_2d").b(np.zeros(shape), 0.0)


def test_long_arrays_are_read_in_stretches():
    """Arrays whose order in memory differs from the order of reading, and which are longer than a stretch."""
    field = opened("travelling_wave_2d")
    x = field.sample(300_000)
    time = time_of(field)
    expected = field.b(x, time)
    assert field.b(np.asfortranarray(x), time).tobytes() == expected.tobytes()
    blocks = np.asfortranarray(x.reshape(3, 100_000, 2))
    assert field.b(blocks, time).tobytes() == expected.tobytes()
    x[299_999, 1] = np.nan
    with pytest.raises(mf.MmsError, match=re.escape("the point at (299999,)")):
        field.b(x, time)


def test_what_is_not_defined_is_no_number_in_a_result():
    field = mf.field("uniform_stretch", stretch=-2)
    last = field.window[1]
    assert (field.J(field.sample(9), last) < 0).all()
    message = r"cauchy_stress of `uniform_stretch` is not finite at the point at \(0, 0\)"
    with pytest.raises(mf.MmsError, match=message):
        field.sigma(field.sample(9).reshape(3, 3, 1), last)


def test_points_are_copied_once():
    field = opened("bar_1d")
    x = np.linspace(0.0, 1.0, 9)
    cache = field.points(x)
    expected = field.b(x, 0.01)
    x[:] = 0.0
    assert cache.b(0.01).tobytes() == expected.tobytes()
