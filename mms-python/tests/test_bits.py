"""Values have the bits of `mms eval`, of every field and quantity, in both precisions."""

import json

import numpy as np
import pytest

import manufactured as mf

from conftest import opened, time_of

POINTS = 5


def evaluated(mms, name, dtype, quantities, points, options):
    """The output of `mms eval`: for each quantity, an array of a row for each point."""
    at = ["--at=" + ",".join(repr(float(it)) for it in point) for point in points]
    field = opened(name)
    time = [] if field.window is None else [f"--time={time_of(field)!r}"]
    precision = "f32" if dtype == np.float32 else "f64"
    wanted = ["--quantity", ",".join(quantities), "--precision", precision, "--json"]
    document = json.loads(mms("eval", name, *at, *time, *wanted, *options))
    return {it: np.array([one[it] for one in document["points"]], dtype) for it in quantities}


def same_bits(one, other):
    assert one.dtype == other.dtype
    assert one.shape == other.shape
    assert one.tobytes() == other.tobytes()


# In single precision the same programs are evaluated by other loops: a fourth of the fields has all of these.
ALL = [(name, np.float64) for name in mf.gallery()] + [(name, np.float32) for name in mf.gallery()[::4]]


@pytest.mark.parametrize(("name", "dtype"), ALL)
def test_every_quantity(mms, name, dtype):
    field = opened(name)
    points = field.sample(POINTS).astype(dtype)
    quantities = [it for it in field.quantities if it != "traction" and not it.endswith("_normal_flux")]
    expected = evaluated(mms, name, dtype, quantities, points, [])
    for quantity in quantities:
        found = field.evaluate(quantity, points, time_of(field))
        same_bits(found.reshape(POINTS, -1), expected[quantity])


@pytest.mark.parametrize("name", ["bar_1d", "expanding_ring", "axis_aligned_3d", "twisted_column"])
def test_tractions(mms, name):
    field = opened(name)
    points = field.sample(POINTS)
    for face in field.faces:
        expected = evaluated(mms, name, np.float64, ["traction"], points, ["--face", face])
        found = field.traction(face, points, time_of(field))
        same_bits(found.reshape(POINTS, -1), expected["traction"])


@pytest.mark.parametrize(
    ("given", "words"),
    [({"amplitude": 0.1}, "0.1"), ({"amplitude": "1/30"}, "1/30"), ({"amplitude": np.float64(1e-5)}, "1e-5")],
)
def test_parameters(mms, given, words):
    field = mf.field("bar_1d", **given)
    points = field.sample(POINTS)
    options = ["--set", f"amplitude={words}"]
    expected = evaluated(mms, "bar_1d", np.float64, ["body_force"], points, options)
    found = field.body_force(points, time_of(field))
    same_bits(found, expected["body_force"])


def test_many_points_have_the_bits_of_one():
    field = opened("axis_aligned_3d")
    points = field.sample(20011)
    time = time_of(field)
    together = field.body_force(points, time)
    alone = np.array([field.body_force(point, time) for point in points])
    same_bits(together, alone)


def test_the_ways_to_ask_are_one():
    field = opened("travelling_wave_2d")
    points, time = field.sample(64), time_of(field)
    expected = field.cauchy_stress(points, t=time)
    for found in [
        field.sigma(points, time),
        field.at(time).sigma(points),
        field.at(time).cauchy_stress(points),
        field.points(points).sigma(time),
        field.evaluate("sigma", points, time),
        field.evaluate("cauchy_stress", points, t=time),
    ]:
        same_bits(found, expected)
    field_points = field.points(points)
    same_bits(field.at(time).traction("x_max", points), field_points.traction("x_max", time))


def test_the_material_gives_the_stress_of_the_field():
    for name in ["bar_1d", "plane_strain_gent", "axis_aligned_3d", "graded_bar"]:
        field = opened(name)
        points, time = field.sample(100), time_of(field)
        found = field.material.P(field.H(points, time), X=points)
        np.testing.assert_allclose(found, field.P(points, time), rtol=1e-10, atol=1e-3)


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
@pytest.mark.parametrize("name", mf.gallery())
def test_what_is_kept_of_points_changes_no_bit(name, dtype):
    field = opened(name)
    points = field.sample(1500).astype(dtype)
    stay = field.points(points)
    first, last = field.window or (0.0, 0.0)
    named = ["displacement", "body_force_density", "cauchy_stress", "jacobian", "von_mises"]
    for time in [first, (first + last) / 3, last, first]:
        for quantity in named:
            same_bits(getattr(stay, quantity)(time), field.evaluate(quantity, points, time))


def test_what_is_kept_is_shared_by_threads():
    field = opened("axis_aligned_3d")
    points = field.sample(300_001)
    stay = field.points(points)
    for time in [0.0, time_of(field)]:
        same_bits(stay.b(time), field.b(points, time))
    points[299_000] = np.nan
    with pytest.raises(mf.MmsError, match=r"the point at \(299000,\)"):
        field.points(points).b(0.0)
