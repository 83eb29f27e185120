"""The assertion that a solver has its order, for pytest.

    def test_my_solver(assert_order):
        assert_order("bar_1d", solve, cells=[8, 16, 32], order=2)

`solve(field, cells)` runs the solver on a mesh, and returns results as `manufactured.judge` takes them: a level, a path or a mesh.
The marker `slow_levels` adds meshes that are run with the option --slow-levels alone:

    @pytest.mark.slow_levels(64, 128)
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from ._native import Field
    from .verdicts import Judgement


def assert_order(
    field: Field | str,
    solver: Callable[[Field, Any], Any],
    *,
    cells: Iterable[Any],
    order: float | None = None,
    **options: Any,
) -> Judgement:
    """Fails unless the results of a solver on meshes of so many cells have the expected order; takes the options of `judge`.

    The message has the table, the norm that decided, and what the error acts as.
    """
    __tracebackhide__ = True
    from . import _native, verdicts

    of = _native.field(field) if isinstance(field, str) else field
    results = [solver(of, each) for each in cells]
    judgement = verdicts.judge(of, results, expected_order=order, **options)
    if not judgement.passed:
        pytest.fail(f"{judgement}\n{_acts_as(of, results)}", pytrace=False)
    return judgement


def _acts_as(field: Field, results: list[Any]) -> str:
    """The first line of what the error acts as."""
    from . import _native, verdicts

    try:
        diagnosis = verdicts.diagnose(field, results)
    except _native.MmsError as error:
        return f"no diagnosis: {error}"
    if diagnosis.finding == "named":
        best = diagnosis.ranked[0]
        return f"the error acts as {best.hypothesis}: {best.says}"
    return f"the diagnosis names no mistake; next: {diagnosis.next}"


def pytest_addoption(parser: pytest.Parser) -> None:
    """Adds the option."""
    parser.getgroup("manufactured").addoption(
        "--slow-levels", action="store_true", help="run the meshes of the marker slow_levels too"
    )


def pytest_configure(config: pytest.Config) -> None:
    """Adds the marker."""
    config.addinivalue_line("markers", "slow_levels(*cells): meshes that are run with --slow-levels alone")


@pytest.fixture(name="assert_order")
def _fixture(request: pytest.FixtureRequest) -> Callable[..., Judgement]:
    """`assert_order` with the meshes of the marker `slow_levels`, where --slow-levels is given."""
    marker = request.node.get_closest_marker("slow_levels")
    slow = list(marker.args) if marker and request.config.getoption("--slow-levels") else []

    def asserted(field: Field | str, solver: Callable[..., Any], *, cells: Iterable[Any], **options: Any) -> Judgement:
        __tracebackhide__ = True
        return assert_order(field, solver, cells=[*cells, *slow], **options)

    return asserted
