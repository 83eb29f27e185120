//! Hypotheses: mistakes that people make, each as a change of the input of a solver or of what it computes.
//!
//! Each family of hypotheses is a file, whose function `all` lists them. A [`Hypothesis`] has a size, for most a single number:
//! a factor, a time, a component of a vector ([`Size`]). One of the sizes is the size of a right solver. Sizes with names of
//! their own are [`Known`].

mod density;
mod face;
mod force;
mod law;
mod output;
mod parameter;
mod ring;
mod start;
mod stress;
mod tangent;
mod wall;

use std::borrow::Cow;

use mms_runtime::{Condition, Face, Matrix, Vector, tensor};

use crate::exact::{Exact, Quantity};
use crate::slopes::Slopes;

pub use output::earlier_velocity;
pub use ring::Ring;
pub use stress::over_jacobian;
pub use tangent::{of_tangent, voigt_orders};

/// The arguments of a change: the exact solution, the size of the mistake, the time, X, and H if the change needs it.
pub struct Given<'a, const D: usize> {
    /// The exact solution.
    pub exact: &'a Exact<'a, D>,
    /// The size of the mistake.
    pub size: &'a [f64],
    /// The time.
    pub time: f64,
    /// X.
    pub reference: &'a [Vector<f64, D>],
    /// H of the solver; empty where only X matters.
    pub gradient: &'a [Matrix<f64, D>],
}

/// A part of a motion, at the start or on walls.
pub enum MotionPart<'a, const D: usize> {
    /// u.
    Displacement(&'a mut [Vector<f64, D>]),
    /// v.
    Velocity(&'a mut [Vector<f64, D>]),
    /// a, on walls alone.
    Acceleration(&'a mut [Vector<f64, D>]),
    /// H.
    Gradient(&'a mut [Matrix<f64, D>]),
}

/// Changes b, starting from the right one.
pub type OfForce<const D: usize> = fn(&Given<'_, D>, &mut [Vector<f64, D>]);

/// Changes stresses, starting from the right ones.
pub type OfStress<const D: usize> = fn(&Given<'_, D>, &mut [Matrix<f64, D>]);

/// Changes stresses whose tractions act on a face, starting from the right ones.
pub type OfTraction<const D: usize> = fn(&Given<'_, D>, Face, &mut [Matrix<f64, D>]);

/// Changes a motion, starting from the right one.
pub type OfMotion<const D: usize> = fn(&Given<'_, D>, MotionPart<'_, D>);

/// The stress rate that a tangent with a mistake of this size gives for a symmetric rate of deformation, from the slopes of tau
/// there and at F = I.
pub type OfTangent<const D: usize> = fn([&Slopes<D>; 2], &[f64], &Matrix<f64, D>) -> Matrix<f64, D>;

/// The part of a material model that a mistake in the stress changes, as seen from the law alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Of {
    /// The law: both its stress and its tangent show it.
    Law,
    /// The stress alone: the mistake has no tangent of its own, because another mistake has the same tangent, or because the
    /// law is not objective.
    Stress,
    /// The measure: another stress replaces P or, in a table of a law, the declared measure.
    Measure,
    /// The motion besides F: a law alone does not show it.
    Motion,
}

/// The part of a problem that a hypothesis changes. The functions get the right values.
pub enum Change<const D: usize> {
    /// b.
    Force(OfForce<D>),
    /// tau in the body.
    Stress(Of, OfStress<D>),
    /// tau whose tractions act on the face.
    Surface(OfTraction<D>),
    /// b, and tau whose tractions act on all loaded faces.
    Loads(OfForce<D>, OfTraction<D>),
    /// rho0, times the size.
    Density,
    /// The mass, times the size. Forces are right: both the force of the stress and b.
    Mass,
    /// The initial state.
    Start(OfMotion<D>),
    /// The motion that is prescribed on faces, and the motion of the body at the start.
    Wall(OfMotion<D>),
    /// The condition on the face.
    Condition(Condition),
    /// The values that are written of a quantity. Nothing that is computed changes.
    Output(fn(&Given<'_, D>, Quantity) -> Vec<f64>),
    /// A change of b, stresses or tractions of an axisymmetric field, made on the field of three dimensions with the components
    /// R, Z and theta.
    InSpace(Box<Hypothesis<3>>),
    /// The body that a solver uses in place of a ring.
    Ring(Ring),
    /// The tangent of the law, which no explicit solver has.
    Tangent(OfTangent<D>),
    /// The order of components: the k-th number is the place, in the right order 12, 13, 23, of the shear component that the
    /// wrong result has in place k.
    Order([usize; 3]),
}

impl<const D: usize> Change<D> {
    /// The changed part, in a word or two.
    pub fn name(&self) -> &'static str {
        match self {
            Change::Force(_) => "body force",
            Change::Stress(..) => "stress",
            Change::Surface(_) => "traction",
            Change::Loads(..) => "loads",
            Change::Density | Change::Mass => "mass",
            Change::Start(_) => "start",
            Change::Wall(_) => "prescribed motion",
            Change::Condition(_) => "boundary condition",
            Change::Output(_) | Change::Order(_) => "output",
            Change::Tangent(_) => "tangent",
            Change::InSpace(it) => it.change.name(),
            Change::Ring(_) => "ring",
        }
    }
}

/// A size with a name of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct Known {
    /// The size.
    pub size: f64,
    /// The name of the mistake.
    pub name: &'static str,
    /// The description of the mistake.
    pub says: String,
}

impl Known {
    fn new(size: f64, name: &'static str, says: impl Into<String>) -> Self {
        Known { size, name, says: says.into() }
    }
}

/// Whether a hypothesis is a mistake or a choice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum HypothesisKind {
    /// A mistake.
    Mistake,
    /// A choice that is right elsewhere.
    Choice,
}

impl HypothesisKind {
    /// The name of the kind.
    pub fn name(self) -> &'static str {
        match self {
            HypothesisKind::Mistake => "mistake",
            HypothesisKind::Choice => "choice",
        }
    }
}

/// The largest number of time steps by which a hypothesis may shift the time of a value.
const STEPS: f64 = 8.0;

/// Factors that people often forget or add.
const FACTORS: [f64; 5] = [-1.0, 0.0, 0.5, 2.0 / 3.0, 2.0];

/// The sizes that a hypothesis may have.
#[derive(Clone, Debug, PartialEq)]
pub enum Size {
    /// No size: the mistake is made or not.
    Fixed,
    /// A size; the response is first computed at `first`.
    Any {
        /// The size of a right solver.
        right: Vec<f64>,
        /// The size at which the response is computed first.
        first: Vec<f64>,
        /// The possible sizes.
        range: [f64; 2],
    },
}

/// A mistake that a solver may make.
pub struct Hypothesis<const D: usize> {
    /// The identifier.
    pub name: &'static str,
    /// A description in a sentence.
    pub says: &'static str,
    /// Whether it is a mistake.
    pub kind: HypothesisKind,
    /// The part of the problem that it changes.
    pub change: Change<D>,
    /// The possible sizes.
    pub size: Size,
    /// Other sizes at which the response is computed first, for mistakes whose large sizes act nonlinearly.
    pub also: Vec<f64>,
    /// The sizes of this field that have names of their own.
    pub known: fn(&Exact<'_, D>) -> Vec<Known>,
    /// The name for sizes below the right one, if there is one.
    pub below: Option<&'static str>,
    /// The face that it is on.
    pub face: Option<Face>,
    /// The variant, if there are several.
    pub which: Option<Cow<'static, str>>,
    /// The one quantity whose output it changes.
    pub only: Option<Quantity>,
    /// Whether results show the mistake as one of its own only if they also contain other quantities, which are right.
    pub needs_other_quantities_right: bool,
    /// Whether its size is proportional to a time step or a cell, and so is smaller on a finer mesh.
    pub is_of_mesh: bool,
}

impl<const D: usize> Hypothesis<D> {
    /// A mistake without a size.
    fn fixed(name: &'static str, says: &'static str, change: Change<D>) -> Self {
        Hypothesis {
            name,
            says,
            kind: HypothesisKind::Mistake,
            change,
            size: Size::Fixed,
            also: Vec::new(),
            known: |_| Vec::new(),
            below: None,
            face: None,
            which: None,
            only: None,
            needs_other_quantities_right: false,
            is_of_mesh: false,
        }
    }

    /// A mistake with a factor, which is 1 in a right solver.
    fn factor(
        name: &'static str,
        says: &'static str,
        first: f64,
        change: Change<D>,
        known: fn(&Exact<'_, D>) -> Vec<Known>,
    ) -> Self {
        let size = Size::Any { right: vec![1.0], first: vec![first], range: [f64::MIN, f64::MAX] };
        Hypothesis { size, known, ..Self::fixed(name, says, change) }
    }

    /// A mistake with an amount of something, which is 0 in a right solver.
    fn amount(name: &'static str, says: &'static str, first: Vec<f64>, change: Change<D>) -> Self {
        let size = Size::Any { right: vec![0.0; first.len()], first, range: [f64::MIN, f64::MAX] };
        Hypothesis { size, ..Self::fixed(name, says, change) }
    }

    /// A mistake that uses a value of another time, at most a few steps away: `late` names it for an earlier time, `early` for
    /// a later one.
    fn delay(
        exact: &Exact<'_, D>,
        [late, early]: [&'static str; 2],
        says: &'static str,
        change: Change<D>,
    ) -> Self {
        let late = Self::amount(late, says, vec![exact.time_step], change).of_steps(exact);
        Hypothesis { below: Some(early), ..late }
    }

    /// Limits the sizes to a range; sizes beyond it are another mistake.
    fn within(mut self, range: [f64; 2]) -> Self {
        if let Size::Any { range: all, .. } = &mut self.size {
            *all = range;
        }
        self
    }

    /// P in place of another measure, in a table of that measure.
    pub fn first_piola() -> Self {
        let says = "P in place of the declared measure";
        Self::fixed("stress_first_piola", says, Change::Stress(Of::Measure, |_, _| {}))
    }

    /// Marks the size as proportional to a time step or a cell: smaller on a finer mesh.
    fn of_mesh(self) -> Self {
        Hypothesis { is_of_mesh: true, ..self }
    }

    /// Limits a size that is a time to a few steps; more is another mistake.
    fn of_steps(self, exact: &Exact<'_, D>) -> Self {
        let most = STEPS * exact.time_step;
        self.within([-most, most]).of_mesh()
    }

    fn choice(self) -> Self {
        Hypothesis { kind: HypothesisKind::Choice, ..self }
    }

    /// Marks the hypothesis as one of several variants.
    fn of(self, which: impl Into<Cow<'static, str>>) -> Self {
        Hypothesis { which: Some(which.into()), ..self }
    }

    fn on(self, face: Face) -> Self {
        Hypothesis { face: Some(face), ..self }
    }

    /// The size whose effect is `scale` times the effect of `size`, if effects are proportional to the distance from the right
    /// size or, for a density or mass, to the distance of the inverses.
    pub fn rescaled(&self, right: f64, size: f64, scale: f64) -> f64 {
        match self.change {
            Change::Density | Change::Mass => {
                1.0 / (1.0 / right + scale * (1.0 / size - 1.0 / right))
            }
            _ => right + scale * (size - right),
        }
    }

    /// The name, with the variant and the face.
    pub fn title(&self) -> String {
        title(self.name, self.which.as_deref(), self.face)
    }

    /// Whether results of these quantities show it as a mistake of its own.
    pub fn is_of(&self, quantities: &[Quantity]) -> bool {
        let is_there = self.only.is_none_or(|it| quantities.contains(&it));
        is_there && (quantities.len() > 1 || !self.needs_other_quantities_right)
    }

    /// The sizes of a field that have names of their own.
    pub fn known(&self, exact: &Exact<'_, D>) -> Vec<Known> {
        match (&self.change, exact.space) {
            (Change::InSpace(it), Some(space)) => (it.known)(space),
            _ => (self.known)(exact),
        }
    }

    /// The usual sizes of the mistake: the named ones, and for a factor some more.
    pub fn usual(&self, exact: &Exact<'_, D>) -> Vec<f64> {
        let Size::Any { right, range: [_, most], .. } = &self.size else { return Vec::new() };
        let known = self.known(exact).into_iter().map(|it| it.size);
        let factors = if right == &[1.0] && *most == f64::MAX { &FACTORS[..] } else { &[] };
        let all = known.chain(factors.iter().copied());
        let mut all: Vec<f64> = all.filter(|it| it.is_finite() && right != &[*it]).collect();
        all.sort_by(f64::total_cmp);
        all.dedup();
        all
    }

    /// The largest searched difference from the right size; for an unlimited factor, the difference of a missing or doubled
    /// term.
    pub fn farthest(&self) -> f64 {
        let Size::Any { right, range: [least, most], .. } = &self.size else { return 0.0 };
        match right.as_slice() {
            [right] if *right != 0.0 && *most == f64::MAX => right.abs(),
            right => right.iter().map(|it| (it - least).max(most - it)).fold(0.0, f64::max),
        }
    }

    /// Whether a size is possible.
    pub fn allows(&self, size: &[f64]) -> bool {
        match self.size {
            Size::Fixed => true,
            Size::Any { range: [least, most], .. } => {
                size.iter().all(|it| (least..=most).contains(it))
            }
        }
    }
}

/// All hypotheses about a field that a solver can show; for a law alone [`of_tangent`] and [`voigt_orders`] list more.
pub fn all<const D: usize>(exact: &Exact<'_, D>) -> Vec<Hypothesis<D>> {
    if let Some(space) = exact.space {
        let in_space = [force::all(space), stress::all(space), law::all(space), face::all(space)];
        let forces = [force::all(exact), face::all(exact), density::all()];
        let others = [start::all(exact), wall::all(exact), output::all(exact)];
        let in_meridian = forces.into_iter().chain(others).flatten();
        return ring::all(exact, space, in_space.into_iter().flatten(), in_meridian);
    }
    let families = [
        force::all(exact),
        stress::all(exact),
        law::all(exact),
        parameter::all(exact),
        density::all(),
        face::all(exact),
        start::all(exact),
        wall::all(exact),
        output::all(exact),
    ];
    families.into_iter().flatten().collect()
}

/// The mistakes of a swap of two components, given for the pairs 0 and 1, 1 and 2, 0 and 2; keeps as many as there are pairs.
fn of_swaps<const D: usize>(all: [Hypothesis<D>; 3]) -> Vec<Hypothesis<D>> {
    match D {
        2 => all.into_iter().take(1).collect(),
        3 => all
            .into_iter()
            .zip(["x and y", "y and z", "x and z"])
            .map(|(it, of)| it.of(of))
            .collect(),
        _ => Vec::new(),
    }
}

/// The name of a mistake, with its variant and its face.
pub fn title(name: &str, which: Option<&str>, face: Option<Face>) -> String {
    let which = which.map_or(String::new(), |it| format!(" [{it}]"));
    let face = face.map_or(String::new(), |it| format!(" on {it}"));
    format!("{name}{which}{face}")
}

/// Replaces each tau by the value of a function of F and P.
fn of_first<const D: usize>(
    at: &Given<'_, D>,
    tau: &mut [Matrix<f64, D>],
    made: impl Fn(&Matrix<f64, D>, Matrix<f64, D>) -> Matrix<f64, D>,
) {
    for (tau, h) in tau.iter_mut().zip(at.gradient) {
        let f = h + Matrix::identity();
        *tau = made(&f, *tau * inverse(&f.transpose()));
    }
}

/// The inverse; for a singular F a matrix of NaN, which a solver refuses.
fn inverse<const D: usize>(f: &Matrix<f64, D>) -> Matrix<f64, D> {
    tensor::inverse(f).unwrap_or(Matrix::repeat(f64::NAN))
}
