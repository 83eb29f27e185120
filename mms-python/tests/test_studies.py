"""Studies of the solver of this project, and campaigns of a function."""

import json
import sys

import numpy as np
import pytest

import manufactured as mf

CELLS = [8, 16, 32]


def timeless(document):
    """A document without what differs from run to run, and without the words of its command."""
    for level in document["levels"]:
        del level["seconds"]
    del document["provenance"]["command"]
    return document


def test_a_study_has_the_document_of_the_command(mms, tmp_path):
    lines = []
    study = mf.study(
        mf.field("bar_1d", amplitude=0.05), shape="cpgimp", cells=CELLS, integrator="leapfrog", fit=True, progress=lines.append
    )
    options = ["--shape=cpgimp", "--cells=8,16,32", "--integrator=leapfrog", "--fit", "--set=amplitude=0.05"]
    printed = json.loads(mms("study", "bar_1d", *options, "--json", "--output", str(tmp_path)))
    assert timeless(study.to_dict()) == timeless(printed)
    assert study.passed and study.verdict == "pass"
    assert study.levels[-1].l2 < study.levels[0].l2
    assert any(it.startswith("32 cells: step ") for it in lines)
    assert "<svg" in study._repr_html_() and "|" in study.to_markdown() and "tabular" in study.to_latex()


def test_a_field_of_a_text_is_studied():
    text = mf.field("travelling_wave_2d").text
    study = mf.study(mf.loads(text), cells=[(4, 4), "8x8"])
    assert [it.cells for it in study.levels] == ["4x4", "8x8"]
    assert repr(study).startswith("<study of text: ")


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ({"shape": "round"}, "invalid value 'round'"),
        ({"nonsense": 3}, "unexpected argument '--nonsense'"),
        ({"shape": ["linear", "cpgimp"]}, "one method"),
        ({"refine": "time", "cells": [8, 16]}, "a study in time has one grid"),
        ({"cells": ["4x4"]}, "--cells"),
    ],
)
def test_what_cannot_be_studied_is_said(options, says):
    with pytest.raises(mf.MmsError) as error:
        mf.study("bar_1d", **{"cells": [8], **options})
    assert says in str(error.value)
    assert "Usage" not in str(error.value)


def test_options_of_files_are_refused():
    with pytest.raises(TypeError, match="writes no file"):
        mf.study("bar_1d", output="here")


def test_an_interrupt_ends_a_study_and_nothing_else_runs():
    lines = []

    def interrupt(line):
        lines.append(line)
        if "step" in line and "cells:" in line:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        mf.study("bar_1d", cells=[4096, 8192], progress=interrupt)
    assert sum("cells: step" in it for it in lines) == 1
    assert mf.study("bar_1d", cells=[4, 8]).levels[0].cells == 4


def test_an_interrupt_ends_the_search_for_excluded_mistakes():
    def interrupt(line):
        if line.startswith("mistake to exclude: "):
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        mf.study("bar_1d", cells=CELLS, shape="cpgimp", excluded=True, progress=interrupt)


def test_progress_is_printed_to_stderr(capsys, monkeypatch):
    from manufactured import _progress

    monkeypatch.setattr(_progress.time, "monotonic", iter(range(0, 2000, 2)).__next__)
    mf.study("bar_1d", cells=[4, 8], progress=True)
    printed = capsys.readouterr()
    assert "\r8 cells: step" in printed.err and printed.out == ""


def test_a_campaign_judges_a_function():
    seen = []

    def solve(problem):
        seen.append(problem)
        error = 1 + 3 * problem.h**2
        return problem.results(problem.field.u(problem.X, problem.window[1]) * error)

    lines = []
    verdict = mf.campaign("bar_1d", solver=solve, cells=CELLS, expected_order=2, progress=lines.append)
    assert lines[2:4] == ["32 cells: level 3 of 3", "error of mesh 1 of 3"]
    assert verdict.passed and verdict.quantities[0].norms[1].observed_order == pytest.approx(2, abs=1e-6)
    first = seen[0]
    assert [it.cells for it in seen] == CELLS and [it.level for it in seen] == [1, 2, 3]
    assert (first.lower, first.upper) == ([0.0], [1.0])
    assert first.X.shape == (16, 1) and first.V0.sum() == pytest.approx(1)
    assert first.boundary == {"x_min": "fixed", "x_max": "free"}
    assert np.array_equal(first.b(first.X, 0.01), first.field.b(first.X, 0.01))
    assert first.traction("x_max", [[1.0]], 0.01).shape == (1, 1)
    assert [it.problem for it in verdict.runs] == seen and all(it.seconds > 0 for it in verdict.runs)
    assert isinstance(verdict, mf.Campaign) and verdict.to_dict()["verdict"] == "pass"
    assert verdict.diagnose().is_right


def test_a_campaign_in_two_dimensions_raises_what_the_solver_raises():
    def solve(problem):
        assert problem.X.shape == (6 * 16, 2)
        raise ZeroDivisionError

    lines = []
    with pytest.raises(ZeroDivisionError) as error:
        mf.campaign("travelling_wave_2d", solve, cells=["4x4"], particles_per_cell=(3, 2), progress=lines.append)
    assert lines == ["4x4 cells: level 1 of 1"]
    if sys.version_info >= (3, 11):
        assert error.value.__notes__ == ["in level 1 of 1: <travelling_wave_2d on 4x4 cells>"]
    with pytest.raises(mf.MmsError, match="cells"):
        mf.campaign("bar_1d", lambda problem: problem.X, cells=[(4, 4)])


def test_what_is_no_campaign_is_said():
    for cells in (8, "8x8"):
        with pytest.raises(TypeError, match=r"`cells`: expected a list with the cells of each mesh, such as \[8, 16, 32\]"):
            mf.campaign("bar_1d", lambda problem: problem.X, cells=cells)
    with pytest.raises(mf.MmsError, match="no results"):
        mf.campaign("bar_1d", lambda problem: problem.X, cells=[])
    seen = []
    with pytest.raises(TypeError, match="`problem.results\\(u\\)`, .* found NoneType"):
        mf.campaign("bar_1d", seen.append, cells=[8, 16])
    assert len(seen) == 1
