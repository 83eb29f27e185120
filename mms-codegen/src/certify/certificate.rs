//! All proofs about a field, and the cheaper search for contradictions.

use super::branches::{self, BranchViolation};
use super::claims::{self, ClaimVerdict};
use super::computed::{self, ComputedProof};
use super::ellipticity::{self, Ellipticity};
use super::finite::{self, Finite};
use super::message;
use super::motion::ChartMotion;
use super::rates::{self, Frame, Rates, Searches};
use super::reach;
use super::sign::{Positive, Sign};
use super::solid::{self, Part};
use crate::bounds::chart::Chart;
use crate::bounds::enclosure::Formulas;
use crate::bounds::witness::Witness;
use crate::compile::Compiled;
use mms_program::precision::Precision;
use mms_spec::BoundarySpec;
use mms_spec::diagnostic::Diagnostic;
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::{Graph, Rational};
use mms_symbolic::sorted::SortedMap;

/// The largest number of cells of each bound.
pub const CELLS: usize = 2000;

/// The largest number of cells of a rate: its bound is valid after any number of cells.
const CELLS_OF_RATES: usize = 500;

/// The budget of each part of a proof, in steps of [`mms_symbolic::work`]: the formulas, J, density and moduli, the rates,
/// bounds of x, finite values, branches, the program in two precisions, and all claims.
const FORMULAS: u64 = 50_000_000;
const VOLUME: u64 = 40_000_000;
const SOLID: u64 = 20_000_000;
const RATES: u64 = 300_000_000;
const REACH: u64 = 20_000_000;
const FINITE: u64 = 60_000_000;
const BRANCHES: u64 = 60_000_000;
const COMPUTED: u64 = 80_000_000;
const CLAIMS: u64 = 80_000_000;

/// The budget of a compilation for its search for contradictions.
const QUICK: u64 = 30_000_000;

/// The largest number of operations of all proofs about branches together.
const OPERATIONS_OF_BRANCHES: usize = 4_000_000;

/// The largest number of operations of a proof about a program in one precision.
const OPERATIONS_AS_COMPUTED: usize = 8_000_000;

/// The largest number of operations of a compilation's search for J <= 0.
const QUICK_OPERATIONS: usize = 100_000;
/// The largest number of cells of a compilation's search for J <= 0.
const QUICK_CELLS: usize = 128;

/// The largest number of nodes of a field that a compilation searches: it leaves larger fields to [`certify`].
const QUICK_NODES: usize = 2_000;

/// The number of points of each face where a compilation evaluates a claim.
const QUICK_POINTS: usize = 4;

/// The proofs, refutations and open questions of a field.
#[derive(Clone, Debug)]
pub struct Certificate {
    /// Every claim of the file, in its order.
    pub claims: Vec<(BoundarySpec, ClaimVerdict)>,
    /// Whether J > 0.
    pub jacobian: Sign,
    /// Whether the density and the moduli at F = I are positive; only those that vary.
    pub solid: Vec<(Part, Sign)>,
    /// The operations that are not proved to stay within one analytic branch.
    pub branch_violations: Vec<BranchViolation>,
    /// Whether all quantities exist.
    pub finite: Finite,
    /// Whether they can be computed in `f64`, and in `f32`.
    pub computed: [ComputedProof; 2],
    /// The largest stretch, strain rate and wave speed; only if J > 0.
    pub rates: Option<Rates>,
    /// Whether waves run in every direction; not examined unless J > 0.
    pub ellipticity: Ellipticity,
    /// Bounds of x by axis.
    pub reach: Vec<[f64; 2]>,
    /// The number of cells of all searches.
    pub boxes: usize,
    /// The parts that ended early, since their budget was spent.
    pub spent: Vec<String>,
}

/// Proves what it can of a compiled field.
pub fn certify(compiled: &Compiled) -> Certificate {
    let mut graph = room(compiled);
    let mut budget = Budget::default();
    budget.begin(&graph, FORMULAS);
    let chart = Chart::new(&mut graph, &compiled.field, &compiled.model, None);
    let motion = ChartMotion::new(&mut graph, &chart, compiled);
    let formulas = Formulas::new(&mut graph, &chart, &[motion.jacobian]);
    budget.end(&graph, "the formulas of J and the strain");
    // First search the points with J <= 0 that a compilation would report, so that `mms check` and the compiler report the same
    // one.
    let (jacobian, mut boxes) = budget.part(&mut graph, VOLUME, "J > 0", |graph| {
        match inversion(graph, &chart, compiled) {
            Some((witness, value)) => (Sign::Refuted(witness, value), 0),
            None => Positive::jacobian(&chart, &formulas).bound(CELLS),
        }
    });
    let (mut rates, mut ellipticity) = (None, Ellipticity::Unproved);
    let mut least = 0.0;
    let (solid, cells) = budget.part(&mut graph, SOLID, "density and moduli", |graph| {
        solid::bound(graph, &chart, compiled, CELLS)
    });
    boxes += cells;
    if let Sign::Positive(bounds) = jacobian {
        let part = "stretch, rate and wave speed";
        let searches = Searches::new(&chart, &motion, bounds, CELLS_OF_RATES);
        let (stretches, (bound, cells)) = budget.part(&mut graph, RATES, part, |graph| {
            let stretches = searches.stretches(graph);
            let found = rates::bound(graph, &searches, &stretches);
            (stretches, found)
        });
        (rates, boxes, least) = (Some(bound), boxes + stretches.cells + cells, bounds[0]);
        let (found, cells) = budget.part(&mut graph, RATES, "strong ellipticity", |graph| {
            ellipticity::bound(graph, compiled, &searches, &stretches)
        });
        (ellipticity, boxes) = (found, boxes + cells);
    }
    let positive = rates.is_some().then_some(&motion);
    let reach = budget.part(&mut graph, REACH, "where the motion leads", |graph| {
        reach::bound(graph, &chart, compiled)
    });
    let (exits, cells) = budget.part(&mut graph, BRANCHES, "branches of functions", |graph| {
        branches::violations(graph, &chart, compiled, positive, [CELLS, OPERATIONS_OF_BRANCHES])
    });
    boxes += cells;
    let limit = if rates.is_some() { CELLS } else { 0 };
    let (finite, cells) = budget.part(&mut graph, FINITE, "finite values", |graph| {
        finite::bound(graph, &chart, compiled, &motion, least, limit)
    });
    boxes += cells;
    let computed = budget.part(&mut graph, COMPUTED, "what is computed", |graph| match jacobian {
        Sign::Positive(bounds) if finite == Finite::Proved => {
            let known = (motion.jacobian, bounds);
            computed::bound(graph, &chart, compiled, known, OPERATIONS_AS_COMPUTED)
        }
        _ => [ComputedProof::NOT_APPLICABLE; 2],
    });
    boxes += computed[0].cells;
    let mut claims = Vec::new();
    for claim in &compiled.field.boundary {
        let steps = CLAIMS / compiled.field.boundary.len() as u64;
        let part = format!("the claim on {}", claim.face.value.name());
        let (finding, cells) = budget
            .part(&mut graph, steps, &part, |graph| claims::judge(graph, compiled, claim, CELLS));
        claims.push((claim.clone(), finding));
        boxes += cells;
    }
    let spent = budget.spent;
    Certificate {
        claims,
        jacobian,
        solid,
        branch_violations: exits,
        finite,
        computed,
        rates,
        ellipticity,
        reach,
        boxes,
        spent,
    }
}

/// The budgets of the parts, and those that were spent.
#[derive(Default)]
struct Budget {
    spent: Vec<String>,
}

impl Budget {
    fn begin(&self, graph: &Graph, steps: u64) {
        graph.work().allow(steps);
    }

    fn end(&mut self, graph: &Graph, part: &str) {
        if graph.work().is_over() {
            self.spent.push(part.into());
        }
    }

    /// Runs a part within `steps` steps, and returns its result. If it fills the graph, the next part gets the graph from
    /// before.
    fn part<R>(
        &mut self,
        graph: &mut Graph,
        steps: u64,
        part: &str,
        prove: impl FnOnce(&mut Graph) -> R,
    ) -> R {
        self.begin(graph, steps);
        let found = graph.restoring_if_full(prove);
        self.end(graph, part);
        found
    }
}

/// Bounds the speed of waves over the body and the time window of a field, in a frame, until the bound is at most `speed`.
/// Parameters have their defaults, or the values that are `set`, by position. `None` where J > 0 is not proved, or nothing
/// bounds the speed.
pub fn wave_speed(
    compiled: &Compiled,
    set: &SortedMap<usize, Rational>,
    frame: Frame,
    speed: f64,
) -> Option<f64> {
    let mut graph = room(compiled);
    graph.work().allow(4 * RATES);
    let chart = chart_of(&mut graph, compiled, set);
    let motion = ChartMotion::new(&mut graph, &chart, compiled);
    let formulas = Formulas::new(&mut graph, &chart, &[motion.jacobian]);
    let (Sign::Positive(bounds), _) = Positive::jacobian(&chart, &formulas).bound(CELLS) else {
        return None;
    };
    let wanted = (frame, speed);
    let bound = rates::wave_speed(&mut graph, &chart, &motion, bounds, CELLS, wanted);
    bound.is_finite().then_some(bound)
}

/// Bounds of x by axis over body, window and ranges; infinite where none is found.
pub fn reach(compiled: &Compiled) -> Vec<[f64; 2]> {
    reach_in(compiled, |graph| Chart::new(graph, &compiled.field, &compiled.model, None))
}

/// Bounds of x where parameters have their defaults, or the values that are `set`, by position.
pub fn reach_at(compiled: &Compiled, set: &SortedMap<usize, Rational>) -> Vec<[f64; 2]> {
    reach_in(compiled, |graph| chart_of(graph, compiled, set))
}

fn reach_in(compiled: &Compiled, chart: impl Fn(&mut Graph) -> Chart) -> Vec<[f64; 2]> {
    if compiled.field.domain.body.is_nothing() {
        return vec![[f64::NEG_INFINITY, f64::INFINITY]; compiled.field.dimension];
    }
    let mut graph = room(compiled);
    graph.work().allow(REACH);
    let chart = chart(&mut graph);
    reach::bound(&mut graph, &chart, compiled)
}

/// Finds a quantity that a precision does not compute at a corner or in the middle of the domain of a field, though it has a
/// value there. Parameters have their defaults, or the values that are `set`, by position.
pub fn not_computed(
    compiled: &Compiled,
    set: &SortedMap<usize, Rational>,
    precision: Precision,
) -> Option<Diagnostic> {
    let mut graph = room(compiled);
    graph.work().allow(QUICK);
    let chart = chart_of(&mut graph, compiled, set);
    let finding = computed::failure(compiled, &chart, precision)?;
    message::not_computed(compiled, precision.name(), &finding)
}

/// The body and the time window for one set of parameters.
pub(super) fn chart_of(
    graph: &mut Graph,
    compiled: &Compiled,
    set: &SortedMap<usize, Rational>,
) -> Chart {
    let mut model = compiled.model.clone();
    for (index, parameter) in model.parameters.iter_mut().enumerate() {
        parameter.range = None;
        if let Some(value) = set.get(&index) {
            parameter.default = graph.number(value.clone());
        }
    }
    Chart::new(graph, &compiled.field, &model, None)
}

impl Certificate {
    /// The refuted and the unproved parts, each at its place in the file.
    pub fn objections(&self, compiled: &Compiled) -> Vec<Diagnostic> {
        let mut objections: Vec<_> = self
            .branch_violations
            .iter()
            .map(|exit| message::leaves_branch(compiled, exit))
            .collect();
        match &self.finite {
            Finite::Proved => {}
            // If J is not proved to be positive, a quotient by J cannot be proved finite.
            Finite::Unproved(..) if !matches!(self.jacobian, Sign::Positive(_)) => {}
            // An inverted body is no state of any material.
            Finite::Undefined(quantity, _)
                if *quantity > Quantity::Jacobian && matches!(self.jacobian, Sign::Refuted(..)) => {
            }
            // If a quantity has no value where a function reaches the end of its domain, only the function is reported.
            Finite::Undefined(_, witness)
                if self
                    .branch_violations
                    .iter()
                    .any(|it| it.is_certain && it.witness == *witness) => {}
            Finite::Undefined(quantity, witness) => {
                objections.push(message::undefined(compiled, *quantity, witness));
            }
            Finite::Unproved(quantity, witness) => {
                objections.push(message::not_finite(compiled, *quantity, witness));
            }
        }
        match &self.jacobian {
            Sign::Positive(_) => {}
            Sign::Refuted(witness, value) => {
                objections.push(message::inverted(compiled, witness, *value));
            }
            Sign::Unproved(..) if matches!(self.finite, Finite::Undefined(..)) => {}
            Sign::Unproved(witness, value) if value.is_infinite() => {
                objections.push(message::not_finite(compiled, Quantity::Jacobian, witness));
            }
            Sign::Unproved(witness, value) => {
                objections.push(message::not_positive(compiled, witness, *value));
            }
        }
        let parts = self.solid.iter();
        objections
            .extend(parts.filter_map(|(part, sign)| message::not_solid(compiled, *part, sign)));
        let [double, _] = &self.computed;
        objections.extend(message::not_computed(compiled, "f64", &double.verdict));
        for (claim, finding) in &self.claims {
            match finding {
                ClaimVerdict::Proved | ClaimVerdict::Enclosed(_) => {}
                ClaimVerdict::Refuted(witness, value) => {
                    objections.push(message::refuted(compiled, claim, witness, *value));
                }
                ClaimVerdict::Unproved(interval) => {
                    objections.push(message::unproved(claim, *interval));
                }
            }
        }
        objections
    }
}

/// The contradictions of a compiled field that a short search finds: a claim that does not hold at one of a few points, and J,
/// density or moduli that are not positive within a few cells. An empty list proves nothing.
pub fn contradictions(compiled: &Compiled) -> Vec<Diagnostic> {
    if compiled.field.domain.body.is_nothing() {
        // Such a field claims nothing anywhere.
        return Vec::new();
    }
    let quantities = &compiled.derived.quantities;
    let gradient = &quantities[&Quantity::DisplacementGradient];
    if compiled.graph.reachable(gradient).len() > QUICK_NODES {
        return Vec::new();
    }
    let mut graph = room(compiled);
    graph.work().allow(QUICK);
    let mut found = Vec::new();
    let chart = Chart::new(&mut graph, &compiled.field, &compiled.model, None);
    found.extend(solid::refuted(&mut graph, &chart, compiled, QUICK_CELLS));
    if let Some((witness, value)) = inversion(&mut graph, &chart, compiled) {
        found.push(message::inverted(compiled, &witness, value));
    }
    let (exits, _) =
        branches::violations(&mut graph, &chart, compiled, None, [QUICK_CELLS, QUICK_OPERATIONS]);
    // At the end of the domain of a function, its values or derivatives are usually not finite, and their evaluation reports
    // that. Report a jump of values here, since it leaves all derivatives finite.
    let certain: Vec<_> = exits.iter().filter(|exit| exit.is_certain).collect();
    if certain.iter().any(|exit| exit.must.is_blind()) {
        found.extend(certain.iter().map(|exit| message::leaves_branch(compiled, exit)));
    }
    let failure = computed::failure(compiled, &chart, Precision::F64);
    found.extend(failure.and_then(|it| message::not_computed(compiled, "f64", &it)));
    for claim in &compiled.field.boundary {
        if let Some(ClaimVerdict::Refuted(witness, value)) =
            claims::refute(&mut graph, compiled, claim, QUICK_POINTS)
        {
            found.push(message::refuted(compiled, claim, &witness, value));
        }
    }
    found
}

/// A point where J <= 0, if a short search finds one.
fn inversion(graph: &mut Graph, chart: &Chart, compiled: &Compiled) -> Option<(Witness, f64)> {
    let jacobian = &compiled.derived.quantities[&Quantity::Jacobian];
    let jacobian = chart.pull_back(graph, jacobian);
    let formulas = Formulas::new(graph, chart, &jacobian);
    let cells = (QUICK_OPERATIONS / formulas.size().max(1)).clamp(1, QUICK_CELLS);
    match Positive::jacobian(chart, &formulas).least(cells) {
        (Sign::Refuted(witness, value), _) => Some((witness, value)),
        (Sign::Positive(_) | Sign::Unproved(..), _) => None,
    }
}

/// A copy of the field's graph, with more room for proofs.
fn room(compiled: &Compiled) -> Graph {
    let mut graph = compiled.graph.clone();
    graph.make_room();
    graph
}
