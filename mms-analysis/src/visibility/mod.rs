//! Term coverage: which terms of the equations a field tests.
//!
//! A solver may be wrong in a term that vanishes in a field, and still agree with the field. A term is called absent if its
//! expressions are 0 (for all parameters), or if they are below 1e-60 of their natural size at 32 points with 77 digits, for
//! the defaults; the result states which of the two; small values are no proof. The gallery as a whole tests all terms except
//! those that a test lists.

mod scale;
mod term;
mod vanish;

use mms_math::Scalar as _;

use mms_codegen::compile::Compiled;
use mms_mechanics::sample::{Sample, domain, samples};
use mms_mechanics::{Bound, Output};
use mms_mechanics::{Response, TooLarge};
use mms_program::interpret::{Interpreter, Point};
use mms_program::precise::Precise;
use mms_program::schedule::schedule_plainly;
use mms_symbolic::expr::{Expr, Graph};
use mms_symbolic::sorted::SortedMap;
pub use term::Term;

use scale::Sizes;

/// The number of points of the domain at which a term is evaluated.
pub const POINTS: usize = 32;

/// The fraction of its natural size up to which a value counts as 0 to all remaining digits.
pub const NEGLIGIBLE: f64 = 1e-60;

/// Whether a field has a term.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Status {
    /// The term is not 0 at some point.
    Present,
    /// The term is 0 as an expression: at every point and time, for all parameters.
    Zero,
    /// The term is negligible at [`POINTS`] points, for the default parameters.
    Negligible,
    /// The term has no value at any point that could decide.
    Undecided,
}

impl Status {
    /// Whether the term is called absent.
    pub fn is_absent(self) -> bool {
        matches!(self, Status::Zero | Status::Negligible)
    }
}

/// The shape functions that represent a displacement exactly.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Span {
    /// Polynomials of degree 1.
    Linear,
    /// Polynomials of degree 1 in each coordinate.
    Multilinear,
    /// Polynomials of degree 2.
    Quadratic,
}

impl Span {
    /// The name of the space.
    pub fn name(self) -> &'static str {
        match self {
            Span::Linear => "linear",
            Span::Multilinear => "multilinear",
            Span::Quadratic => "quadratic",
        }
    }
}

/// Every term that a field of its dimension may have, and its status.
#[derive(Clone, Debug)]
pub struct Visibility {
    /// The terms in a fixed order, with their status.
    pub findings: Vec<(Term, Status)>,
}

impl Visibility {
    /// Evaluates every term of a compiled field, with its default parameters. An error if the expressions exceed the graph.
    pub fn of(compiled: &Compiled) -> Result<Self, TooLarge> {
        let mut graph = compiled.graph.clone();
        graph.make_room();
        let terms = vanish::terms(&mut graph, compiled);
        if graph.is_exhausted() {
            return Err(TooLarge("terms of the equations"));
        }
        let parameters = compiled.parameters::<Precise>(&SortedMap::new());
        let points = samples(&compiled.program, &parameters, POINTS);
        let sizes = sizes(compiled, &parameters, &points);
        let statuses = statuses(&graph, &terms, &parameters, &points, &sizes);
        let mut findings: Vec<_> = terms.into_iter().map(|(term, _)| term).zip(statuses).collect();
        let kind = |term: &Term| Term::KINDS.iter().position(|kind| *kind == term.kind());
        findings.sort_by_key(|(term, _)| kind(term));
        Ok(Visibility { findings })
    }

    /// The terms with that status.
    pub fn with(&self, status: Status) -> impl Iterator<Item = &Term> {
        self.findings.iter().filter(move |(_, found)| *found == status).map(|(term, _)| term)
    }

    /// The absent terms that are not implied by other absent terms.
    pub fn telling(&self) -> impl Iterator<Item = &(Term, Status)> {
        let absent = || self.findings.iter().filter(|(_, status)| status.is_absent());
        absent().filter(move |(term, _)| !absent().any(|(other, _)| other.carries().contains(term)))
    }

    /// Whether a term is called absent.
    pub fn lacks(&self, term: &Term) -> bool {
        self.findings.iter().any(|(found, status)| found == term && status.is_absent())
    }

    /// The least space of polynomials that contains u at every time.
    pub fn span(&self) -> Option<Span> {
        let spaces = [
            (Term::Curvature, Span::Linear),
            (Term::CurvatureAlongAxes, Span::Multilinear),
            (Term::ThirdGradient, Span::Quadratic),
        ];
        spaces.into_iter().find(|(term, _)| self.lacks(term)).map(|(_, span)| span)
    }

    /// Whether u is at most quadratic in t.
    pub fn is_exact_in_time(&self) -> bool {
        self.lacks(&Term::Jerk)
    }

    /// Whether H is symmetric; in one dimension it is.
    pub fn has_symmetric_gradient(&self) -> bool {
        !self.findings.iter().any(|(term, status)| *term == Term::Rotation && !status.is_absent())
    }
}

/// The status of each term, in their order.
fn statuses(
    graph: &Graph,
    terms: &[(Term, Vec<Expr>)],
    parameters: &[Precise],
    points: &[Sample<Precise>],
    sizes: &Sizes,
) -> Vec<Status> {
    let is_zero = |exprs: &[Expr]| exprs.iter().all(|expr| graph.is_zero(*expr));
    let outputs = terms.iter().enumerate().filter(|(_, (_, exprs))| !is_zero(exprs));
    let outputs: SortedMap<usize, Vec<Expr>> =
        outputs.map(|(index, (_, exprs))| (index, exprs.clone())).collect();
    let program = schedule_plainly(graph, &outputs);
    let mut interpreter = Interpreter::new(&program, parameters);
    let plan = interpreter.plan(&outputs.keys().copied().collect::<Vec<_>>());
    let mut statuses = vec![Status::Undecided; terms.len()];
    for point in points {
        interpreter.set_time(&point.time);
        interpreter.set_point(&plan, Point::at(&point.coordinates));
        for (index, (term, exprs)) in terms.iter().enumerate() {
            if is_zero(exprs) {
                statuses[index] = Status::Zero;
                continue;
            }
            let allowed = sizes.of(term.scale()) * Precise::from_f64(NEGLIGIBLE);
            let values = interpreter.output(index);
            if !allowed.is_defined() || !values.iter().all(Precise::is_defined) {
                continue;
            }
            let is_negligible = values.into_iter().all(|value| value.magnitude().at_most(&allowed));
            statuses[index] = match statuses[index] {
                Status::Undecided | Status::Negligible if is_negligible => Status::Negligible,
                _ => Status::Present,
            };
        }
    }
    statuses
}

/// Length, time, modulus and density of a field.
fn sizes(compiled: &Compiled, parameters: &[Precise], points: &[Sample<Precise>]) -> Sizes {
    let mut interpreter = Interpreter::new(&compiled.program, parameters);
    let bound = |bound: Bound| interpreter.output(Output::Bound(bound));
    let length = |from: Vec<Precise>, to: Vec<Precise>| {
        let edges = from.into_iter().zip(to).map(|(from, to)| (to - from).magnitude());
        edges.reduce(larger)
    };
    let edge = length(bound(Bound::Lower), bound(Bound::Upper));
    let radius = || bound(Bound::Outer).pop();
    let undefined = || Precise::from_f64(f64::NAN);
    let (body, _) = domain(&compiled.program, parameters);
    let other = || Precise::from_f64(body.map(Precise::to_f64).size());
    let size = edge.or_else(radius).unwrap_or_else(other);
    let [first, last] = [0, 1].map(|end| bound(Bound::Time).get(end).cloned());
    let window = first.zip(last).map_or_else(undefined, |(first, last)| last - first);
    let outputs = [Output::Response(Response::Density), Output::Response(Response::WaveSpeed)];
    let plan = interpreter.plan(&outputs);
    let mut largest: Option<[Precise; 2]> = None;
    for point in points {
        interpreter.set_point(&plan, Point::at(&point.coordinates));
        let [Some(density), Some(speed)] = outputs.map(|output| interpreter.output(output).pop())
        else {
            continue;
        };
        let modulus = density.clone() * speed.clone() * speed;
        largest = Some(match largest {
            Some([m, r]) => [larger(m, modulus), larger(r, density)],
            None => [modulus, density],
        });
    }
    let [modulus, density] = largest.unwrap_or_else(|| [undefined(), undefined()]);
    Sizes([size, window, modulus, density])
}

/// The larger of two numbers; the defined one if there is only one.
fn larger(a: Precise, b: Precise) -> Precise {
    if a.at_most(&b) || !a.is_defined() { b } else { a }
}
