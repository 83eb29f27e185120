"""Verdicts and diagnoses: to the documents of the command."""

import contextlib
import json
import signal
import time
from types import SimpleNamespace

import numpy as np
import pytest

import manufactured as mf

from conftest import opened

TIME = 0.013
CELLS = [8, 16, 32]
# In two dimensions, where the search for excluded mistakes takes seconds on finer meshes.
FEW = [2, 4, 8]


def results(n, order=2, field="bar_1d"):
    """X and u of a solver of this order, two points in each of n cells."""
    x = (np.arange(2 * n) + 0.5) / (2 * n)
    return x, opened(field).u(x, TIME) * (1 + 3.0 / n**order)


def levels(order=2):
    return [mf.Level(1 / n, *results(n, order), t=TIME) for n in CELLS]


def without_origin(document):
    return {key: value for key, value in document.items() if key not in ("provenance", "files", "notes", "next_command")}


def table(path, header, columns):
    rows = [",".join(repr(float(it)) for it in row) for row in zip(*columns, strict=True)]
    path.write_text("\n".join([header, *rows]) + "\n")
    return str(path)


def test_files_have_the_document_of_the_command(mms, tmp_path):
    paths = [table(tmp_path / f"{n}.csv", "X,u", results(n)) for n in CELLS]
    printed = json.loads(mms("judge", "bar_1d", *paths, "--time", str(TIME), "--json"))
    found = mf.judge("bar_1d", paths, times=[TIME]).to_dict()
    printed["provenance"]["command"] = found["provenance"]["command"]
    assert found == printed


def test_arrays_have_the_verdict_of_files(mms, tmp_path):
    paths = [table(tmp_path / f"{n}.csv", "X,u", results(n)) for n in CELLS]
    h = ",".join(repr(1 / n) for n in CELLS)
    printed = json.loads(mms("judge", "bar_1d", *paths, "--time", str(TIME), "--h", h, "--json"))
    judgement = mf.judge("bar_1d", levels())
    assert without_origin(judgement.to_dict()) == without_origin(printed)
    for name, form in [("markdown", mf.Judgement.to_markdown), ("latex", mf.Judgement.to_latex), ("csv", mf.Judgement.to_csv)]:
        shown = mms("judge", "bar_1d", *paths, "--time", str(TIME), "--h", h, "--format", name)
        assert form(judgement).rstrip("\n") == shown.rstrip("\n")


def test_a_judgement_is_typed():
    judgement = mf.judge("bar_1d", levels())
    assert judgement.passed and judgement.verdict == "pass"
    assert judgement.observed_order == pytest.approx(2.0, abs=1e-3)
    [quantity] = judgement.quantities
    l2 = next(it for it in quantity.norms if it.norm == "l2")
    assert [level.length for level in l2.levels] == [1 / n for n in CELLS]
    assert judgement.excluded[0].from_ == judgement.to_dict()["excluded"][0]["from"]
    assert repr(judgement) == "<judgement of bar_1d: pass, order 2.00>"
    assert judgement.to_svg().startswith("<svg") and judgement.to_svg() in judgement._repr_html_()
    assert json.loads(judgement.to_json()) == judgement.to_dict()


def test_a_lower_order_fails():
    judgement = mf.judge("bar_1d", levels(order=1))
    assert not judgement.passed and judgement.verdict == "fail"
    assert mf.judge("bar_1d", levels(order=1), expected_order=1).passed
    assert mf.judge("bar_1d", levels(order=1), expected_order={"u": 1}).passed


def test_exact_results_in_single_precision():
    field = opened("bar_1d")
    given = []
    for n in CELLS:
        x = ((np.arange(2 * n) + 0.5) / (2 * n)).astype(np.float32)
        given.append(mf.Level(1 / n, x, field.u(x, TIME), t=TIME))
    with pytest.warns(UserWarning, match="exact to round-off on every mesh"):
        assert mf.judge(field, given).verdict == "exact to round-off"


def test_several_quantities_and_tensors():
    field = opened("travelling_wave_2d")

    def level(n):
        x = (np.arange(2 * n) + 0.5) / (2 * n)
        X = np.stack(np.meshgrid(x, x, indexing="ij"), -1)
        factor = 1 + 1 / n**2
        return mf.Level(1 / n, X, field.u(X, TIME) * factor, t=TIME, P=field.P(X, TIME) * factor)

    judgement = mf.judge(field, [level(n) for n in FEW])
    assert {it.name for it in judgement.quantities} == {"displacement", "first_piola_kirchhoff"}
    only = mf.judge(field, [level(n) for n in FEW], quantities=["u"])
    assert [it.name for it in only.quantities] == ["displacement"]


def square(n):
    """A mesh of squares, as meshio has one, with the interpolant of the exact u."""
    field = opened("travelling_wave_2d")
    x = np.linspace(0.0, 1.0, n + 1)
    points = np.stack(np.meshgrid(x, x, indexing="ij"), -1).reshape(-1, 2)
    corner = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    cells = np.stack([corner, corner + n + 1, corner + n + 2, corner + 1], -1)
    in_space = np.column_stack([points, np.zeros(len(points))])
    return points, in_space, cells, field.u(points, TIME)


def test_meshes_are_judged_over_cells():
    def mesh(n):
        _, points, cells, u = square(n)
        return SimpleNamespace(
            points=points,
            cells=[SimpleNamespace(type="quad", data=cells)],
            point_data={"u": u},
            field_data={"TimeValue": np.array([TIME])},
        )

    judgement = mf.judge("travelling_wave_2d", [mesh(n) for n in FEW])
    assert judgement.samplings == {"displacement": "cells"}
    assert judgement.passed, str(judgement)

    for kind in (9, "quad"):

        def arrays(n):
            points, _, cells, u = square(n)
            return mf.Level(None, points, u, t=TIME, cells=[(kind, cells)])

        other = mf.judge("travelling_wave_2d", [arrays(n) for n in FEW])
        assert other.observed_order == judgement.observed_order


def test_mistakes_in_results_are_named():
    x, u = results(8)
    with pytest.raises(mf.MmsError, match=r"`u` has the shape \(15,\), and `X` has points along \(16,\): expected a row for each"):
        mf.Level(1 / 8, x, u[:-1], t=TIME)
    with pytest.raises(mf.MmsError, match="no points"):
        mf.Level()
    with pytest.raises(mf.MmsError, match="expected a length"):
        mf.Level(0.0, x, u)
    with pytest.raises(mf.MmsError, match="all or none"):
        mf.judge("bar_1d", [mf.Level(1 / 8, x, u, t=TIME), mf.Level(None, x, u, t=TIME)])
    with pytest.raises(mf.MmsError, match="the point 99"):
        mf.Level(None, x, u, cells=[(3, np.array([[0, 99]]))])
    with pytest.raises(mf.MmsError, match="type `round` are not read; expected vertex, line"):
        mf.Level(None, x, u, cells=[("round", np.array([[0, 1]]))])
    with pytest.raises(TypeError, match="a path, or a mesh"):
        mf.judge("bar_1d", [1])
    with pytest.raises(mf.MmsError, match="points or cells"):
        mf.judge("bar_1d", levels(), over="faces")
    with pytest.raises(mf.MmsError, match="there_is_none.csv"):
        mf.judge("bar_1d", ["there_is_none.csv"])
    with pytest.raises(mf.MmsError, match="no results"):
        mf.judge("bar_1d", [])
    with pytest.raises(mf.MmsError, match="level 1 has no time: expected `t=`"):
        mf.judge("bar_1d", [mf.Level(1 / 8, x, u, t=TIME), mf.Level(1 / 16, x, u)])
    with pytest.raises(mf.MmsError) as error:
        mf.judge("bar_1d", [mf.Level(1 / 8, x, foo=u, t=TIME)])
    assert "`X`, `foo`; name them, as with `u=foo`" in str(error.value)
    with pytest.raises(TypeError, match="points alone"):
        mf.diagnose("bar_1d", x)


def deformations(count=40):
    return np.eye(2) + 0.1 * np.random.default_rng(0).normal(size=(count, 2, 2))


def test_a_law_is_compared_with_that_of_the_field(mms, tmp_path):
    field = opened("travelling_wave_2d")
    F = deformations()
    P = field.material.P(F - np.eye(2))
    right = mf.judge_law(field, F, P)
    assert right.is_right and right.named is None
    transposed = mf.judge_law(field, F, np.swapaxes(P, 1, 2))
    assert transposed.finding == "named" and transposed.named == "stress_transposed"
    names = [f"{it}_{row}{column}" for it in "FP" for row in "12" for column in "12"]
    columns = [*F.reshape(-1, 4).T, *np.swapaxes(P, 1, 2).reshape(-1, 4).T]
    path = table(tmp_path / "law.csv", ",".join(names), columns)
    # The command exits with 1 where a mistake is named.
    printed = json.loads(mms("diagnose", field.name, path, "--quantity", "stress", "--json", code=1))
    assert without_origin(transposed.to_dict()) == without_origin(printed)
    S = np.linalg.solve(F, P)
    assert mf.judge_law(field, F, S=S).is_right
    assert mf.judge_law(field, F, tau=P @ np.swapaxes(F, 1, 2)).is_right
    with pytest.raises(mf.MmsError, match="no stress"):
        mf.judge_law(field, F)
    with pytest.raises(mf.MmsError, match=r"`F` has the shape \(40, 2\): expected \(..., 2, 2\)"):
        mf.judge_law(field, F[:, 0], P)


def test_accelerations_at_an_exact_state():
    field = opened("travelling_wave_2d")
    x = (np.arange(24) + 0.5) / 24
    X = np.stack(np.meshgrid(x, x, indexing="ij"), -1)
    right = mf.diagnose(field, X, a=field.a(X, 0.01), t=0.01)
    assert right.is_right, str(right)
    wrong = mf.diagnose(field, X, a=field.a(X, 0.01) - 2 * field.b(X, 0.01), t=0.01)
    assert wrong.ranked[0].hypothesis == "force_reversed", str(wrong)


@contextlib.contextmanager
def interrupted_after(seconds):
    """An interrupt, as Ctrl-C makes one, so many seconds from now."""
    before = signal.signal(signal.SIGALRM, signal.default_int_handler)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        with pytest.raises(KeyboardInterrupt):
            yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)


def test_an_interrupt_ends_a_judgement_and_the_field_stays():
    field = mf.field("axis_aligned_3d")
    u = np.zeros((3_000_000, 3))
    with interrupted_after(0.05):
        mf.judge(field, [mf.Level(h, u, u, t=0.01) for h in (1, 1 / 2, 1 / 4)])
    few = field.sample(20)
    assert mf.judge(field, [mf.Level(h, few, field.u(few, 0.01) * (1 + h**2), t=0.01) for h in (1, 1 / 2, 1 / 4)]).passed


def wrong_waves():
    """Results of a wrong solver, whose diagnosis runs the solver of this project for seconds."""
    field, given = opened("travelling_wave_2d"), []
    for n in (8, 16):
        x = (np.arange(n) + 0.5) / n
        X = np.stack(np.meshgrid(x, x, indexing="ij"), -1)
        given.append(mf.Level(1 / n, X, 0.9 * field.u(X, TIME), t=TIME))
    return field, given


def test_an_interrupt_ends_a_diagnosis_in_the_middle():
    field, given = wrong_waves()
    start = time.perf_counter()
    mf.diagnose(field, given)
    whole = time.perf_counter() - start
    start = time.perf_counter()
    with interrupted_after(whole / 10):
        mf.diagnose(field, given)
    assert time.perf_counter() - start < whole / 2


def test_progress_is_given_to_a_function_and_ends_at_what_it_raises():
    lines = []
    mf.judge("bar_1d", levels(), progress=lines.append)
    assert lines[0] == "error of mesh 1 of 3"
    lines.clear()

    def progress(line):
        lines.append(line)
        if line.startswith("mistake: "):
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        mf.diagnose(*wrong_waves(), progress=progress)
    assert lines[0].startswith("right method on cells of ")
    assert sum(it.startswith("mistake: ") for it in lines) == 1


def test_progress_is_shown_on_a_terminal_alone(monkeypatch, capsys):
    from manufactured import _progress

    monkeypatch.setattr(_progress.time, "monotonic", iter(range(0, 2000, 2)).__next__)
    mf.judge("bar_1d", levels())
    assert capsys.readouterr().err == ""
    monkeypatch.setattr(_progress.sys.stderr, "isatty", lambda: True)
    mf.judge("bar_1d", levels())
    shown = capsys.readouterr().err
    assert shown.startswith("\rerror of mesh 1 of 3") and shown.endswith(" \r")
