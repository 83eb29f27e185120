"""The documents that the library returns. generate.py wrote this; change the types in mms-documents."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ._document import Document


@dataclass(frozen=True, kw_only=True)
class Judge(Document):
    """The document of `mms judge --errors TABLE` and `mms judge FIELD FILE...`."""

    source: str
    """The table, or the field."""
    refinement: str
    """The refined lengths: `space`, `time` or `space and time`."""
    levels: list[JudgeLevel]
    """The levels of the first quantity."""
    quantity: str | None
    """The quantity that decided."""
    norm: str | None
    """The norm that decided."""
    expected_order: float | None
    """The order that is expected of that norm."""
    tolerance: float | None
    """The tolerance of the order."""
    observed_order: float | None
    """The observed order."""
    order_interval: list[float] | None
    """The interval of `observed_order` at 95 %."""
    quantities: list[JudgedQuantity]
    """The quantities."""
    verdict: str
    """The worst verdict: `no evidence`, `exact to round-off`, `pass`, `not asymptotic` or `fail`."""
    rule: int
    """The version of the rule that decided."""
    notes: list[str]
    """Notes on the reading of the files: arrays that were recognised or left out, and why."""
    field: str | None = None
    """The name of the field, if results were judged. The same holds for the next five keys."""
    files: list[str] | None = None
    """The files."""
    times: list[float] | None = None
    """The times at which meshes are compared."""
    samplings: dict[str, str] | None = None
    """The sampling of each quantity: `points`, `weighted points`, `cells`, `middles of cells` or `points of
    faces`."""
    units: dict[str, str] | None = None
    """The units of h, dt and the quantities, if the field states units. The unit of a quantity is the unit of
    its errors in l1, l2 and linf."""
    warnings: list[str] | None = None
    """The warnings."""
    iterative_errors: dict[str, float] | None = None
    """With `--tighter`: the root mean square of the difference of each quantity."""
    excluded: list[Excluded] | None = None
    """The mistakes that results of u, v or F exclude if they pass; null if the project's own solver could not
    be run."""
    next_command: list[str] | None = None
    """The words of the command to type next, `mms` first; missing after a good verdict."""
    provenance: Provenance
    """How the document was made."""


@dataclass(frozen=True, kw_only=True)
class Diagnose(Document):
    """The document of `mms diagnose FIELD FILE...`."""

    field: str
    """The name of the field."""
    files: list[str]
    """The files."""
    evidence: str
    """`the law alone`, `accelerations at an exact state`, `residuals at an exact state`, `residuals at nodes
    at an exact state`, `one step from an exact state` or `results`."""
    finding: str
    """`nothing`, `named` or `unexplained`."""
    error: float
    """The error over the size of the solution."""
    least_expected_error: float
    """The least error of a right solver, if it is known."""
    expected_error: float
    """The largest error that a right solver may have."""
    order: ErrorOrder | None
    """The fall of the error from mesh to mesh, for results on two meshes or more."""
    ranked: list[Hypothesis]
    """The mistakes that explain the error, the best one first."""
    cannot_be_seen: list[str]
    """The mistakes that these results cannot show."""
    pair: Pair | None
    """Two mistakes that explain the error together, if none explains it alone."""
    like: Like | None
    """A right method of the project's own solver with such an error, or the method of `--like`."""
    place: Place | None
    """The place of the error of results."""
    units: dict[str, str] | None = None
    """The units of h, dt and the quantity of `fields`, if the field states units."""
    fields: ErrorFields | None
    """The errors of results at points."""
    question: str | None = None
    """A question about a parameter of the field; missing if no other value of one fits the results much
    better."""
    next: str
    """The next step to take."""
    next_command: list[str] | None = None
    """The words of the command to type next, `mms` first; missing if the finding is `nothing`."""
    provenance: Provenance
    """How the document was made."""


@dataclass(frozen=True, kw_only=True)
class Study(Document):
    """The document of `mms study FIELD`."""

    field: str
    """The name of the field."""
    method: Method
    """The method of the solver."""
    refinement: str
    """The refined lengths: `both`, `space` or `time`."""
    levels: list[Level]
    """The levels, from coarse to fine."""
    noise: list[bool]
    """True for each level whose error may be round-off alone."""
    quantities: StudyErrors
    """The quantities."""
    units: dict[str, str] | None = None
    """The units of h, dt and the quantities, if the field states units."""
    differences: list[LevelDifference] | None
    """The differences of successive levels, if only time is refined."""
    expected_order: float
    """The order that is expected."""
    observed_order: float | None
    """The observed order of `l2`."""
    order_uncertainty: float | None
    """The change that Richardson's extrapolation makes to the order of the finest pair."""
    order_interval: list[float] | None
    """The interval of the observed order."""
    norm: str | None
    """The norm that decided."""
    norms: list[JudgedNorm]
    """The finding of each norm."""
    rule: int
    """The version of the rule that decided."""
    error_constant: float | None
    """The constant C of `l2` = C h^p."""
    expected_error_constant: float | None
    """The value of `error_constant` that is expected."""
    fit: Fit | None
    """The fit in h and dt, with `--fit`."""
    phase: Phase | None
    """The errors of amplitude and phase, with `--periods`."""
    verdict: str
    """`pass`, `fail` or `not asymptotic`."""
    excluded: list[Excluded] | None = None
    """The mistakes that a pass excludes, with `--excluded`; null if the mistakes could not be run."""
    causes: list[str] | None = None
    """The likely causes of a verdict that is no pass, and errors of F or P that grow on finer meshes."""
    next_command: list[str] | None = None
    """The words of the command to type next, `mms` first; missing after a good verdict."""
    provenance: Provenance
    """How the document was made."""


@dataclass(frozen=True, kw_only=True)
class JudgeLevel(Document):
    """A level of the first quantity."""

    cell_size: float | None
    """The edge h of a cell."""
    time_step: float | None
    """The time step dt."""
    runs: int
    """The number of replicates."""
    l1: float | None
    """The mean of the error."""
    l2: float | None
    """The root mean square of the error."""
    linf: float | None
    """The maximum of the error."""
    order_l1: float | None
    """The order of `l1` against the level before."""
    order_l2: float | None
    """The order of `l2` against the level before."""
    order_linf: float | None
    """The order of `linf` against the level before."""


@dataclass(frozen=True, kw_only=True)
class JudgedQuantity(Document):
    """The verdict on a quantity."""

    name: str
    """The name of the quantity."""
    norm: str
    """The norm that decided."""
    verdict: str
    """The verdict, as in the document."""
    layer_order: float | None
    """The order q of a layer at a face."""
    superconvergent: bool
    """True if the order exceeds the one that theory promises everywhere, because of the places of the points."""
    norms: list[JudgedNorm]
    """The finding of each norm."""
    says: list[str]
    """The findings in sentences."""


@dataclass(frozen=True, kw_only=True)
class Excluded(Document):
    """A mistake, and the size from which a pass excludes it."""

    hypothesis: str
    """The name of the mistake, as `mms diagnose --list` prints it."""
    says: str
    """The mistake in a sentence."""
    kind: str
    """`mistake` or `choice`."""
    excluded: bool
    """True if the mistake would have made a larger error."""
    times: float | None
    """The error that the mistake adds, over the finest error; null if the mistake stops the solver, or if a
    size of it is excluded."""
    right: float | None
    """The size in a right solver, if the mistake has a size."""
    from_: float | None
    """The distance from that size, from which on the mistake is excluded."""


@dataclass(frozen=True, kw_only=True)
class Provenance(Document):
    """The origin of a document, and how to make it again."""

    kind: str
    """The name of the command."""
    version: str
    """The version of `mms`."""
    document_version: int
    """The version of the form of the document; 1 if the key is missing."""
    command: str
    """The command to type."""
    input: Input
    """The input."""
    machine: Machine | None
    """The machine; null if the document is the same on every machine."""


@dataclass(frozen=True, kw_only=True)
class ErrorOrder(Document):
    """The fall of the error from mesh to mesh."""

    quantity: str
    """The quantity that decides, as in `mms judge`."""
    norm: str
    """The norm that decides."""
    observed_order: float | None
    """The observed order; null if a run stopped."""
    expected_order: float
    """The least order of a right solver."""
    verdict: str
    """The verdict of `mms judge`."""
    says: str | None
    """The place to look for the cause; null if the order is right."""
    like: MethodOfOrder | None
    """A right method of the project's own solver with the observed order."""


@dataclass(frozen=True, kw_only=True)
class Hypothesis(Document):
    """A mistake, and the share of the error that it explains."""

    hypothesis: str
    """The name of the mistake, or the name of a size of it."""
    says: str
    """The mistake in a sentence."""
    kind: str
    """`mistake` or `choice`."""
    factor: float | None
    """The size of the mistake; for a mistake without a size, the factor that its effect would need."""
    interval: list[float] | None
    """The interval of the factor."""
    vector: list[float] | None
    """The size, if it is a vector."""
    explained: float
    """The share of the squared error."""
    plausible: bool
    """True if the mistake may have that size."""
    face: str | None
    """The name of the face."""
    which: str | None
    """The variant of the mistake, such as a law or a component; null if it has none."""
    equivalent_always: list[str]
    """Mistakes with the same formula, for such data on any field."""
    equivalent_here: list[str]
    """Mistakes that these results do not tell apart."""
    needs: list[str]
    """The data that tell them apart."""


@dataclass(frozen=True, kw_only=True)
class Pair(Document):
    """Two mistakes that explain the error together."""

    hypotheses: list[str]
    """The names of both."""
    explained: float
    """The share of the squared error."""


@dataclass(frozen=True, kw_only=True)
class Like(Document):
    """A method of the solver of this project whose error is similar."""

    method: str
    """The method, as `--like` takes it."""
    factor: float
    """The error over the method's error."""
    apart: float
    """The difference between the two errors, over the error."""


@dataclass(frozen=True, kw_only=True)
class Place(Document):
    """The place of the error."""

    at: list[float]
    """X of the largest error."""
    time: float
    """The time t."""
    face: str | None
    """The face that has more than half of the squared error beside it."""
    plane: Plane | None
    """A plane inside the body that has more than half of the squared error beside it."""
    order: float | None
    """The order from the second finest mesh to the finest one."""
    smooth: float
    """The smooth part of the squared error."""


@dataclass(frozen=True, kw_only=True)
class ErrorFields(Document):
    """The errors at points."""

    quantity: str
    """The name of the quantity."""
    time: float
    """The time t."""
    points: list[list[float]]
    """The points X."""
    error: list[list[float]]
    """The smooth part of the error."""
    named: list[list[float]] | None
    """The error of the named hypothesis; null if none is named."""


@dataclass(frozen=True, kw_only=True)
class Method(Document):
    """A method of the solver of this project."""

    shape: str
    """The shape function."""
    integrator: str
    """The time integrator."""
    formulation: str
    """The formulation: `updated` or `total`."""
    transfer: str
    """The transfer between particles and grid."""
    flip_fraction: float | None
    """The fraction of FLIP; null for other transfers."""
    precision: str
    """The precision: `f32` or `f64`."""
    form: str
    """The form of the code: `stable` or `fast`."""
    particles_per_cell: int | str
    """The number of particles along an edge of a cell, or a text such as `2x3`."""
    fill: str | None
    """The arrangement of the particles."""
    jitter: float
    """The random shift of the particles, in their spacing."""
    seed: int
    """The seed of the random shifts."""
    offset: list[float]
    """The offset of the grid, in cells."""
    periodic: list[str]
    """The periodic axes."""
    courant: float
    """The Courant number."""
    time_step: float | None
    """The time step, with `--time-step`."""
    end_time: float | None
    """The end of the run, with `--time`."""
    relax: bool
    """True if the run goes to an equilibrium, with `--relax`. Older documents do not have it."""


@dataclass(frozen=True, kw_only=True)
class Level(Document):
    """A level of a study."""

    cells: int | str
    """The number of cells along the longest edge, or a text such as `32x16`."""
    cell_size: float | None
    """The edge h of a cell."""
    time_step: float | None
    """The time step dt."""
    steps: int | None
    """The number of time steps."""
    particles: int | None
    """The number of particles."""
    l1: float | None
    """The mean of the error."""
    l2: float | None
    """The root mean square of the error."""
    linf: float | None
    """The maximum of the error."""
    order_l1: float | None
    """The order of `l1` against the level before."""
    order_l2: float | None
    """The order of `l2` against the level before."""
    order_linf: float | None
    """The order of `linf` against the level before."""
    seconds: float | None
    """The seconds on the clock."""
    failure: str | None
    """The reason why the run stopped; null if it reached its end."""
    round_off: float | None = None
    """The part of `l2` that round-off may cause, and with `--relax` the forces out of balance. Absent in a row
    of the matrix."""
    residual_ratio: float | None = None
    """With `--relax`: the forces out of balance at the end, over the forces of the stress. Absent in a row of
    the matrix."""


@dataclass(frozen=True, kw_only=True)
class StudyErrors(Document):
    """The errors of a study by quantity, level by level."""

    displacement: list[LevelErrors]
    """The error of u."""
    velocity: list[LevelErrors]
    """The error of v."""
    deformation_gradient: list[LevelErrors]
    """The error of F."""
    first_piola_kirchhoff: list[LevelErrors]
    """The error of P."""


@dataclass(frozen=True, kw_only=True)
class LevelDifference(Document):
    """The difference of two successive levels."""

    time_step: float
    """The longer time step of both."""
    l1: float | None
    """The mean of the error."""
    l2: float | None
    """The root mean square of the error."""
    linf: float | None
    """The maximum of the error."""
    order_l1: float | None
    """The order of `l1` against the level before."""
    order_l2: float | None
    """The order of `l2` against the level before."""
    order_linf: float | None
    """The order of `linf` against the level before."""


@dataclass(frozen=True, kw_only=True)
class JudgedNorm(Document):
    """The orders of a norm: see the verdict."""

    norm: str
    """The name of the norm."""
    expected_order: float
    """The least order that a right method may show."""
    highest_order: float | None = None
    """The highest such order, if theory leaves a range."""
    verdict: str
    """`pass`, `fail` or `not asymptotic`; from `mms judge` also `exact to round-off` or `no evidence`."""
    observed_order: float | None
    """The observed order."""
    order_interval: list[float] | None
    """The interval of `observed_order` at 95 %."""
    interval_from: str | None
    """The source of the interval: `drift`, `scatter`, `digits` or `nothing`."""
    decided_by: list[float]
    """h or dt of the levels that decided."""
    lower_order: LowerOrder | None
    """The share of a term of lower order in the finest error, from three levels or more. It decides."""
    second_term: SecondTerm | None
    """The term that explains the drift of the order best."""
    limit: Limit | None
    """The limit e0 of e0 + C h^p, from four levels or more."""
    levels: list[JudgedLevel] | None = None
    """The errors on each level, from `mms judge`; null for a grid of h and dt."""


@dataclass(frozen=True, kw_only=True)
class Fit(Document):
    """The fit C_h h^p + C_t dt^q of the errors."""

    space_constant: float
    """The constant C_h."""
    space_order: float
    """The order p."""
    time_constant: float
    """The constant C_t."""
    time_order: float
    """The order q."""
    residual: float
    """The relative residual of the fit."""


@dataclass(frozen=True, kw_only=True)
class Phase(Document):
    """The errors of amplitude and phase."""

    period: float
    """The period of the motion."""
    measured: list[Period]
    """The measured periods."""


@dataclass(frozen=True, kw_only=True)
class Input(Document):
    """The input of a command."""

    field: str | None
    """The field as it was given; null for several fields."""
    rigid: str | None
    """The rigid motion; empty for the standard one, null for none."""
    window: list[str] | None
    """The first and last time, if they were given in place of the file's."""
    set: list[str]
    """The parameters that were set."""
    hash: str
    """A hash of the texts of field and material."""


@dataclass(frozen=True, kw_only=True)
class Machine(Document):
    """The machine."""

    processor: str
    """The name of the processor."""
    cores: int
    """The number of cores."""


@dataclass(frozen=True, kw_only=True)
class MethodOfOrder(Document):
    """A method of the solver of this project, and the order of its error."""

    method: str
    """The method, as `--like` takes it."""
    order: float
    """The order of its error on this field."""


@dataclass(frozen=True, kw_only=True)
class Plane(Document):
    """A plane through the body."""

    axis: str
    """`X`, `Y` or `Z`."""
    at: float
    """The coordinate of the plane."""


@dataclass(frozen=True, kw_only=True)
class LevelErrors(Document):
    """The errors on a level, and their orders."""

    l1: float | None
    """The mean of the error."""
    l2: float | None
    """The root mean square of the error."""
    linf: float | None
    """The maximum of the error."""
    order_l1: float | None
    """The order of `l1` against the level before."""
    order_l2: float | None
    """The order of `l2` against the level before."""
    order_linf: float | None
    """The order of `linf` against the level before."""


@dataclass(frozen=True, kw_only=True)
class LowerOrder(Document):
    """The share of a term of lower order in the finest error, from three levels or more."""

    order: float
    """The order q of D h^q."""
    share: float
    """D h^q over the finest error."""
    share_interval: list[float]
    """The interval of `share` at 95 %."""


@dataclass(frozen=True, kw_only=True)
class SecondTerm(Document):
    """The term that explains the drift of the order best."""

    kind: str
    """`plateau`, `lower order` or `pre-asymptotic`."""
    order: float
    """The order q of D h^q."""
    share: float
    """D h^q over the finest error."""
    share_interval: list[float]
    """The interval of `share` at 95 %."""
    takes_over: float
    """The length at which both terms are equal."""


@dataclass(frozen=True, kw_only=True)
class Limit(Document):
    """The limit e0 of e0 + C h^p, from four levels or more."""

    error: float
    """The limit e0."""
    interval: list[float]
    """The interval of e0."""
    order: float
    """The order p."""


@dataclass(frozen=True, kw_only=True)
class JudgedLevel(Document):
    """The errors on a mesh."""

    length: float
    """h or dt."""
    runs: list[float]
    """The errors of the runs."""
    error: float | None
    """The mean error; null if all runs stopped."""
    order: float | None
    """The order against the level before."""


@dataclass(frozen=True, kw_only=True)
class Period(Document):
    """The errors of a period."""

    number: int
    """The number of the period, from 1 on."""
    levels: list[PhaseLevel]
    """The levels, from coarse to fine."""


@dataclass(frozen=True, kw_only=True)
class PhaseLevel(Document):
    """The errors of amplitude and phase on a level."""

    amplitude_error: float | None
    """The computed amplitude over the exact one, minus 1."""
    order_amplitude: float | None
    """The order of `amplitude_error`."""
    phase_lag: float | None
    """The phase lag in radians; negative if the run is ahead."""
    order_phase: float | None
    """The order of `phase_lag`."""
