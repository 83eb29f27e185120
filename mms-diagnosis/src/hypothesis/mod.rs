//! Hypotheses: mistakes that people make, each as a change of what a solver is given or computes.
//!
//! Each family is a file; its list is `all`. A [`Hypothesis`] has a size, one number for most: a factor, a time, a
//! part of a vector ([`Size`]); one of them is that of a right solver. Sizes with names of their own are [`Known`].

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

/// Where a hypothesis is evaluated: X, and H where that is known.
pub struct Given<'a, const D: usize> {
    /// The exact solution.
    pub exact: &'a Exact<'a, D>,
    /// The size of the mistake.
    pub size: &'a [f64],
    /// The time.
    pub time: f64,
    /// X.
    pub reference: &'a [Vector<f64, D>],
    /// H of the solver; none where only X matters.
    pub gradient: &'a [Matrix<f64, D>],
}

/// A part of a motion, at the start or of walls.
pub enum MotionPart<'a, const D: usize> {
    /// u.
    Displacement(&'a mut [Vector<f64, D>]),
    /// v.
    Velocity(&'a mut [Vector<f64, D>]),
    /// a, of walls alone.
    Acceleration(&'a mut [Vector<f64, D>]),
    /// H.
    Gradient(&'a mut [Matrix<f64, D>]),
}

/// Changes b, from what is right.
pub type OfForce<const D: usize> = fn(&Given<'_, D>, &mut [Vector<f64, D>]);

/// Changes stresses, from what is right.
pub type OfStress<const D: usize> = fn(&Given<'_, D>, &mut [Matrix<f64, D>]);

/// Changes stresses whose tractions act on a face, from what is right.
pub type OfTraction<const D: usize> = fn(&Given<'_, D>, Face, &mut [Matrix<f64, D>]);

/// Changes a motion, from what is right.
pub type OfMotion<const D: usize> = fn(&Given<'_, D>, MotionPart<'_, D>);

/// What a tangent of this size makes of a symmetric rate of deformation, from how tau changes with F there and at F = I.
pub type OfTangent<const D: usize> = fn([&Slopes<D>; 2], &[f64], &Matrix<f64, D>) -> Matrix<f64, D>;

/// What a mistake in the stress is of, for one who sees the law alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Of {
    /// The law: its stress shows it, and its tangent.
    Law,
    /// The stress alone: its tangent is one of another mistake, or there is none, for the law is not objective.
    Stress,
    /// The measure: this one stands for P, whatever the stress is said to be.
    Measure,
    /// The motion besides F: no law shows it.
    Motion,
}

/// What a hypothesis changes. The functions are given what is right.
pub enum Change<const D: usize> {
    /// b.
    Force(OfForce<D>),
    /// tau in the body.
    Stress(Of, OfStress<D>),
    /// tau whose tractions act on the face.
    Surface(OfTraction<D>),
    /// b, and tau whose tractions act on all loaded faces.
    Loads(OfForce<D>, OfTraction<D>),
    /// rho0, by the size as a factor.
    Density,
    /// The mass, by the size as a factor, and no force: neither that of the stress nor b.
    Mass,
    /// The initial state.
    Start(OfMotion<D>),
    /// The motion that is prescribed on faces, and at the start that of the body.
    Wall(OfMotion<D>),
    /// What holds on the face.
    Condition(Condition),
    /// Nothing that is computed: what is written of a quantity.
    Output(fn(&Given<'_, D>, Quantity) -> Vec<f64>),
    /// b, stresses or tractions of an axisymmetric field, in space: the mistake has the components R, Z and theta.
    InSpace(Box<Hypothesis<3>>),
    /// The body that a solver takes for a ring.
    Ring(Ring),
    /// The tangent of the law, that no explicit solver has.
    Tangent(OfTangent<D>),
    /// Nothing that is computed: the shear components 12, 13, 23 of what a law gives are these of the right ones.
    Order([usize; 3]),
}

impl<const D: usize> Change<D> {
    /// What is changed, in a word.
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
    /// What it is.
    pub says: String,
}

impl Known {
    fn new(size: f64, name: &'static str, says: impl Into<String>) -> Self {
        Known { size, name, says: says.into() }
    }
}

/// Whether somebody made a mistake, or chose something else.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// A mistake.
    Mistake,
    /// A choice that is right elsewhere.
    Choice,
}

impl Kind {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Mistake => "mistake",
            Kind::Choice => "choice",
        }
    }
}

/// By how many steps what belongs to another time may be off.
const STEPS: f64 = 8.0;

/// Factors that people forget or add.
const FACTORS: [f64; 5] = [-1.0, 0.0, 0.5, 2.0 / 3.0, 2.0];

/// The sizes that a hypothesis may have.
#[derive(Clone, Debug, PartialEq)]
pub enum Size {
    /// None but the one that it is.
    Fixed,
    /// Any; the response to it is found at this one first.
    Any {
        /// The size of a right solver.
        right: Vec<f64>,
        /// The size at which the response is found first.
        first: Vec<f64>,
        /// Sizes that may be.
        range: [f64; 2],
    },
}

/// A mistake that a solver may make.
pub struct Hypothesis<const D: usize> {
    /// Its identifier.
    pub name: &'static str,
    /// What it is, in a sentence.
    pub says: &'static str,
    /// Whether it is a mistake.
    pub kind: Kind,
    /// What it changes.
    pub change: Change<D>,
    /// Its size.
    pub size: Size,
    /// Other sizes at which the response is found first, where what is large is not linear.
    pub also: Vec<f64>,
    /// Sizes with names of their own, of this field.
    pub known: fn(&Exact<'_, D>) -> Vec<Known>,
    /// The name below the right size, where that has one.
    pub below: Option<&'static str>,
    /// The face that it is on.
    pub face: Option<Face>,
    /// Which of several it is.
    pub which: Option<Cow<'static, str>>,
    /// The one quantity whose output it changes.
    pub only: Option<Quantity>,
    /// Whether it is a mistake of its own only beside other quantities that are right.
    pub is_beside: bool,
    /// Whether its size is a part of a time step or of a cell, and so is smaller on a finer mesh.
    pub is_of_mesh: bool,
}

impl<const D: usize> Hypothesis<D> {
    /// A mistake without a size.
    fn fixed(name: &'static str, says: &'static str, change: Change<D>) -> Self {
        Hypothesis {
            name,
            says,
            kind: Kind::Mistake,
            change,
            size: Size::Fixed,
            also: Vec::new(),
            known: |_| Vec::new(),
            below: None,
            face: None,
            which: None,
            only: None,
            is_beside: false,
            is_of_mesh: false,
        }
    }

    /// A mistake with a factor, of 1 in a right solver.
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

    /// A mistake with an amount of something, of 0 in a right solver.
    fn amount(name: &'static str, says: &'static str, first: Vec<f64>, change: Change<D>) -> Self {
        let size = Size::Any { right: vec![0.0; first.len()], first, range: [f64::MIN, f64::MAX] };
        Hypothesis { size, ..Self::fixed(name, says, change) }
    }

    /// Something of an earlier time, by some steps at most; the second name is that of a later time.
    fn delay(
        exact: &Exact<'_, D>,
        [late, early]: [&'static str; 2],
        says: &'static str,
        change: Change<D>,
    ) -> Self {
        let late = Self::amount(late, says, vec![exact.time_step], change).of_steps(exact);
        Hypothesis { below: Some(early), ..late }
    }

    /// The same, where sizes beyond these are another mistake.
    fn within(mut self, range: [f64; 2]) -> Self {
        if let Size::Any { range: all, .. } = &mut self.size {
            *all = range;
        }
        self
    }

    /// P in place of another measure, where a law is asked for that.
    pub fn first_piola() -> Self {
        let says = "P in place of the measure that it is said to be";
        Self::fixed("stress_first_piola", says, Change::Stress(Of::Measure, |_, _| {}))
    }

    /// The same, with a size that is a part of a time step or of a cell: smaller on a finer mesh.
    fn of_mesh(self) -> Self {
        Hypothesis { is_of_mesh: true, ..self }
    }

    /// The same, with a size that is a time: more than some steps is another mistake.
    fn of_steps(self, exact: &Exact<'_, D>) -> Self {
        let most = STEPS * exact.time_step;
        self.within([-most, most]).of_mesh()
    }

    fn choice(self) -> Self {
        Hypothesis { kind: Kind::Choice, ..self }
    }

    /// The same, as one of several.
    fn of(self, which: impl Into<Cow<'static, str>>) -> Self {
        Hypothesis { which: Some(which.into()), ..self }
    }

    fn on(self, face: Face) -> Self {
        Hypothesis { face: Some(face), ..self }
    }

    /// The size whose effect is that of this one, scaled: as if it grew with the distance from the right size, or of a
    /// density or mass with that of its inverse.
    pub fn rescaled(&self, right: f64, size: f64, scale: f64) -> f64 {
        match self.change {
            Change::Density | Change::Mass => {
                1.0 / (1.0 / right + scale * (1.0 / size - 1.0 / right))
            }
            _ => right + scale * (size - right),
        }
    }

    /// The name, with which it is and the face.
    pub fn title(&self) -> String {
        title(self.name, self.which.as_deref(), self.face)
    }

    /// Whether results of these quantities show it as a mistake of its own.
    pub fn is_of(&self, quantities: &[Quantity]) -> bool {
        let is_there = self.only.is_none_or(|it| quantities.contains(&it));
        is_there && (quantities.len() > 1 || !self.is_beside)
    }

    /// Sizes with names of their own, of a field.
    pub fn known(&self, exact: &Exact<'_, D>) -> Vec<Known> {
        match (&self.change, exact.space) {
            (Change::InSpace(it), Some(space)) => (it.known)(space),
            _ => (self.known)(exact),
        }
    }

    /// The sizes that people make mistakes of: those with names, and of a factor some more.
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

    /// How far from the right size a mistake is looked for: of a factor of any size where a term is missing, or there twice.
    pub fn farthest(&self) -> f64 {
        let Size::Any { right, range: [least, most], .. } = &self.size else { return 0.0 };
        match right.as_slice() {
            [right] if *right != 0.0 && *most == f64::MAX => right.abs(),
            right => right.iter().map(|it| (it - least).max(most - it)).fold(0.0, f64::max),
        }
    }

    /// Whether a size may be.
    pub fn allows(&self, size: &[f64]) -> bool {
        match self.size {
            Size::Fixed => true,
            Size::Any { range: [least, most], .. } => {
                size.iter().all(|it| (least..=most).contains(it))
            }
        }
    }
}

/// All hypotheses about a field that a solver shows; of a law alone there are [`of_tangent`] and [`voigt_orders`] besides.
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

/// The mistakes of a swap of two components, given for the pairs 0 and 1, 1 and 2, 0 and 2: as many as there are pairs.
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

/// The name of a mistake, with which of several it is, and the face that it is on.
pub fn title(name: &str, which: Option<&str>, face: Option<Face>) -> String {
    let which = which.map_or(String::new(), |it| format!(" [{it}]"));
    let face = face.map_or(String::new(), |it| format!(" on {it}"));
    format!("{name}{which}{face}")
}

/// Replaces each tau by what a function makes of F and P.
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

/// The inverse; of a singular F what is not finite, which a solver refuses.
fn inverse<const D: usize>(f: &Matrix<f64, D>) -> Matrix<f64, D> {
    tensor::inverse(f).unwrap_or(Matrix::repeat(f64::NAN))
}
