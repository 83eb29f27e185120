"""Opening fields, messages, threads, interrupts and memory."""

import gc
import pathlib
import pickle
import resource
import signal
import threading
from concurrent.futures import ThreadPoolExecutor
from fractions import Fraction

import numpy as np
import pytest

import manufactured as mf

from conftest import opened, time_of

TEXT = """
[field]
title     = "A line that is stretched"
dimension = 1

[parameters]
amplitude = { value = 0.1 }

[displacement]
u = ["amplitude*X*t"]

[material]
model   = "neo_hookean"
lambda  = 1000
mu      = 1000
density = 1

[domain]
shape = "box"
lower = [0]
upper = [1]
time  = [0, 1]
"""


def test_a_text_and_a_file_are_one(tmp_path):
    path = tmp_path / "line.toml"
    path.write_text(TEXT)
    for field in [mf.loads(TEXT), mf.load(path), mf.load(str(path))]:
        np.testing.assert_array_equal(field.u([0.5], 1.0), [0.05])
    assert mf.load(path).name == "line"


def test_a_mistake_has_its_place(tmp_path):
    wrong = TEXT.replace("amplitude*X*t", "amplitud*X*t")
    with pytest.raises(mf.FieldError, match="amplitud") as caught:
        mf.loads(wrong)
    line = next(at for at, it in enumerate(wrong.splitlines(), 1) if "amplitud*X" in it)
    assert (line, 7) in [place[1:3] for place in caught.value.places]
    assert f"text.toml:{line}:7" in str(caught.value)
    path = tmp_path / "line.toml"
    path.write_text(wrong)
    with pytest.raises(mf.FieldError, match=f"line.toml:{line}:7"):
        mf.load(path)


def test_exceptions_are_value_errors():
    assert issubclass(mf.MmsError, ValueError)
    assert issubclass(mf.FieldError, mf.MmsError)
    with pytest.raises(FileNotFoundError, match="cannot read `there_is_none.toml`"):
        mf.load("there_is_none.toml")
    with pytest.raises(mf.MmsError, match="did you mean `bar_1d`"):
        mf.field("bar1d")
    with pytest.raises(mf.MmsError, match="did you mean `amplitude`"):
        mf.field("bar_1d", amplitud=0.1)
    with pytest.raises(mf.FieldError, match="young"):
        mf.field("bar_1d", young=-1)
    with pytest.raises(mf.MmsError, match="give the time"):
        opened("bar_1d").b([0.5])
    with pytest.raises(mf.MmsError, match="expected a finite number"):
        opened("bar_1d").b([0.5], np.nan)
    with pytest.raises(mf.MmsError, match="did you mean `x_max`"):
        opened("bar_1d").traction("y_max", [1.0], 0.0)
    with pytest.raises(mf.MmsError, match="takes a normal"):
        opened("bar_1d").evaluate("traction", [1.0], 0.0)
    for of in (opened("bar_1d").b, lambda _, t: opened("bar_1d").points([0.5]).b(t)):
        with pytest.raises(TypeError, match="`t`: expected one number, found .*ndarray.*; call once for each"):
            of([0.5], np.array([0.0, 0.01]))
    with pytest.raises(TypeError, match="truth value"):
        mf.field("bar_1d", amplitude=True)
    with pytest.raises(AttributeError, match="has no `stres`; `bar_1d` defines no such"):
        opened("bar_1d").stres
    for of in (opened("bar_1d"), opened("bar_1d").at(0.0), opened("bar_1d").points([0.5])):
        with pytest.raises(AttributeError, match="did you mean `displacement`"):
            of.displacment


def test_numbers_are_taken_by_their_digits():
    for given in [0.1, "0.1", "1/10", Fraction(1, 10), np.float64(0.1)]:
        assert mf.field("bar_1d", amplitude=given).parameters["amplitude"] == 0.1
    assert mf.field("bar_1d", young=10**7).parameters["young"] == 1e7
    assert mf.field("bar_1d", young=1e17).parameters["young"] == 1e17


def test_set_keeps_what_was_set():
    one = mf.field("bar_1d", amplitude=0.2)
    other = one.set(young=2e6).set(young=3e6)
    assert other.parameters["amplitude"] == 0.2
    assert other.parameters["young"] == 3e6
    assert one.parameters["young"] == 1e6


def test_a_field_with_quantities_of_its_own():
    field = opened("given_pressure_2d")
    own = [it for it in field.quantities if it.startswith("p_")]
    assert own
    x, time = field.sample(4), time_of(field)
    for name in own:
        if not name.endswith("_normal_flux"):
            values = field.evaluate(name, x, time)
            for again in (getattr(field, name)(x, time), getattr(field.at(time), name)(x), getattr(field.points(x), name)(time)):
                np.testing.assert_array_equal(again, values)
    with pytest.raises(AttributeError, match="a field has no `q_flux`"):
        field.at(time).q_flux


def test_methods_are_documented():
    for name in ["body_force", "b", "F"]:
        doc = getattr(mf.Field, name).__doc__
        assert "The unit is" in doc and "Returns (..., D" in doc
    assert mf.Field.b is not None and mf.Field.b.__name__ == "body_force"


def test_threads_share_a_field():
    field = mf.field("axis_aligned_3d")
    x, time = field.sample(5000), time_of(field)
    times = [time * k / 16 for k in range(16)]
    expected = [opened("axis_aligned_3d").sigma(x, t).tobytes() for t in times]
    with ThreadPoolExecutor(8) as pool:
        found = list(pool.map(lambda t: field.sigma(x, t).tobytes(), times * 4))
    assert found == expected * 4


def test_a_field_is_dropped_by_the_thread_that_comes_last():
    field = mf.field("bar_1d")
    now = field.at(0.01)
    del field
    found = []
    thread = threading.Thread(target=lambda: found.append(now.u([0.5])))
    thread.start()
    thread.join()
    assert found[0].tobytes() == opened("bar_1d").u([0.5], 0.01).tobytes()


def test_an_interrupt_ends_long_work():
    field = opened("axis_aligned_3d")
    # Nothing of this is in memory but what has been evaluated.
    x = np.broadcast_to(np.array([0.25, 0.5, 0.75]), (100_000_000, 3))
    signal.setitimer(signal.ITIMER_REAL, 0.05)
    before = signal.signal(signal.SIGALRM, signal.default_int_handler)
    try:
        with pytest.raises(KeyboardInterrupt):
            field.b(x, 0.01)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)


def resident():
    """Bytes of memory that this process has now."""
    pages = int(pathlib.Path("/proc/self/statm").read_text().split()[1])
    return pages * resource.getpagesize()


@pytest.mark.skipif(not pathlib.Path("/proc/self/statm").exists(), reason="memory is read from /proc")
def test_nothing_leaks():
    field = opened("travelling_wave_2d")
    x = field.sample(10_000)

    def work(times):
        for k in range(times):
            field.b(x, 1e-6 * k)
            field.at(1e-6 * k).sigma(x[::2])
            field.traction("x_max", x[:8], 1e-6 * k)
            with pytest.raises(mf.MmsError):
                field.b(x[:, 0], 0.0)
            if k % 20 == 0:
                mf.field("bar_1d", amplitude=0.1).b([0.5], 0.0)

    work(100)
    gc.collect()
    before = resident()
    work(400)
    gc.collect()
    # One array of each call is 160 kB.
    assert resident() - before < 8 << 20


def test_a_field_is_not_pickled():
    with pytest.raises(TypeError):
        pickle.dumps(opened("bar_1d"))


LINE = {
    "parameters": {"amplitude": {"value": 0.1}},
    "material": {"model": "neo_hookean", "lambda": 1000, "mu": 1000, "density": 1},
    "domain": {"shape": "box", "lower": [0], "upper": [1], "time": [0, 1]},
}


def test_a_field_is_made_of_formulas(tmp_path):
    made = mf.Field(["amplitude*X*t"], **LINE)
    x = made.sample(9)
    assert made.b(x, 0.5).tobytes() == mf.loads(TEXT).b(x, 0.5).tobytes()
    made.save(tmp_path / "line.toml")
    assert mf.load(tmp_path / "line.toml").text == made.text
    with pytest.raises(mf.MmsError, match="amplitude=0.2 is set"):
        made.set(amplitude=0.2).save(tmp_path / "other.toml")
    assert not (tmp_path / "other.toml").exists()


def test_a_mistake_in_a_formula_is_shown_in_its_line():
    with pytest.raises(mf.FieldError, match=r"u = \[\"amplitud\*X\*t\"\]") as caught:
        mf.Field(["amplitud*X*t"], **LINE)
    [(path, line, column, _)] = caught.value.places
    text = 'u = ["'
    assert path == "text.toml" and column == len(text) + 1 and line > 1
    with pytest.raises(mf.FieldError, match=r"\[domain\]"):
        mf.Field(["X*t"])
    with pytest.raises(TypeError, match="expected a list"):
        mf.Field("X*t", **LINE)
    with pytest.raises(TypeError, match="`let`: expected a dictionary"):
        mf.Field(["X*t"], let=3, **LINE)


def test_a_field_is_made_of_expressions_of_sympy():
    sympy = pytest.importorskip("sympy")
    amplitude, x, t = sympy.symbols("amplitude X t")
    made = mf.Field([amplitude * sympy.sin(sympy.pi * x) ** 2 * t / 3], **LINE)
    points = made.sample(5)[:, 0]
    np.testing.assert_allclose(made.u(points, 0.5), 0.1 * np.sin(np.pi * points) ** 2 / 6, rtol=1e-14)


def test_every_field_of_the_gallery_is_saved_and_loaded(tmp_path):
    for name in mf.gallery():
        path = tmp_path / f"{name}.toml"
        opened(name).save(path)
        assert path.read_text() == opened(name).text
    for name in ["bar_1d", "plane_strain_gent"]:
        field = mf.load(tmp_path / f"{name}.toml")
        x, time = field.sample(9), time_of(field)
        assert field.P(x, time).tobytes() == opened(name).P(x, time).tobytes()


def test_the_derivation_is_that_of_the_command(mms):
    field = opened("travelling_wave_2d")
    for quantities in [["body_force"], ["u", "P"]]:
        wanted = ["--quantity", ",".join(quantities)]
        assert field.show(*quantities).rstrip("\n") == mms("show", field.name, *wanted).rstrip("\n")
        latex = mms("show", field.name, *wanted, "--format", "latex")
        assert field.show(*quantities, format="latex").rstrip("\n") == latex.rstrip("\n")
    with pytest.raises(mf.MmsError, match="text, latex or html"):
        field.show(format="pdf")


@pytest.mark.parametrize("name", ["bar_1d", "static_square", "lame_tube", "given_pressure_2d"])
def test_a_notebook_shows_the_derivation(name):
    shown = opened(name)._repr_html_()
    assert shown.startswith("<h3>") and "<math" in shown
    for parameter in opened(name).parameters:
        assert f"{parameter} = " in shown


def test_a_notebook_shows_no_markup_of_a_file():
    title = "<script>alert(1)</script> & more"
    shown = mf.Field(["amplitude*X*t"], field={"title": title}, **LINE)._repr_html_()
    assert "<script" not in shown and "&lt;script&gt;alert(1)&lt;/script&gt; &amp; more" in shown
