//! The reasons why a solver cannot start ([`Refusal`]) and why a run stopped ([`Failure`]).

use crate::field::{Condition, Face};
use crate::real::{Real, Vector};
use crate::tensor::components;

/// The names of axes.
const AXES: [&str; 3] = ["x", "y", "z"];

/// The reason why a scene is not started. Nothing has run.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Refusal {
    /// A face has a condition that the solver does not support.
    #[error(
        "face {face} is `{condition}`, which this solver has on faces of boxes only: claim \
         `prescribed` there, or leave the face without a claim"
    )]
    UnsupportedCondition {
        /// The face.
        face: Face,
        /// The condition that the face asks for.
        condition: Condition,
    },
    /// A field without a body.
    #[error(
        "the field has no body (`shape = \"none\"`): there is nothing to fill with particles; give its [domain] a body"
    )]
    NoBody,
    /// No particle lies along a face that needs it.
    #[error(
        "face {face} is `{condition}`, but a Cartesian fill gives it a ragged edge; fill the body with \
         particles that are fitted to it (`--fill fitted`)"
    )]
    RaggedFace {
        /// The face.
        face: Face,
        /// The condition that the face asks for.
        condition: Condition,
    },
    /// A shape function whose domains follow the deformation, in a formulation where nothing moves.
    #[error(
        "shape function `{shape}` follows the deformation, but in the total formulation no particle's \
         domain moves; the nearest is `ugimp`, whose domains stay in the reference configuration"
    )]
    NothingToFollow {
        /// The name of the shape function.
        shape: &'static str,
    },
    /// A field that the solver has no particles for.
    #[error("the field is axisymmetric, and {what}")]
    NotOfRings {
        /// The reason, and what to do.
        what: &'static str,
    },
    /// An integrator that moves particles and deforms them by different velocities.
    #[error(
        "integrator `{integrator}` moves particles by one velocity and deforms them by another, so u and F would differ \
         after each halt of a relaxation: use `leapfrog`"
    )]
    PartsInRelaxation {
        /// The name of the integrator.
        integrator: &'static str,
    },
    /// The system cannot start the threads.
    #[error("cannot run on {threads} thread(s): {reason}; use fewer")]
    NoThreads {
        /// The requested number.
        threads: usize,
        /// The system's message.
        reason: String,
    },
    /// More memory than there is.
    #[error(
        "it takes about {needed} MB of memory, and {available} MB are free: use fewer cells, fewer \
         particles per cell, or single precision"
    )]
    TooLittleMemory {
        /// The memory that the scene needs, in 10^6 bytes.
        needed: u64,
        /// The memory that is free, in 10^6 bytes.
        available: u64,
    },
    /// A checkpoint of another scene, or none.
    #[error("the saved state does not fit: {reason}")]
    NoState {
        /// The reason why the state does not fit.
        reason: String,
    },
    /// Numbers for another dimension.
    #[error("{given} numbers of {what} for a body in {dimension} dimension(s)")]
    WrongDimension {
        /// `cells` or `particles per cell`.
        what: &'static str,
        /// The number of numbers.
        given: usize,
        /// The body's dimension.
        dimension: usize,
    },
    /// A particle so light that its contribution to the mass of nodes has no inverse.
    #[error(
        "a particle has a mass of {mass:e}, and needs {least:e} in this precision: use double precision, or a unit of \
         mass that is smaller"
    )]
    TooLight {
        /// The least mass of a particle.
        mass: f64,
        /// The least mass that is supported.
        least: f64,
    },
    /// A number outside its range.
    #[error("{what} is {value}, and has to be between {from} and {to}")]
    OutOfRange {
        /// The name of the number.
        what: &'static str,
        /// The value.
        value: f64,
        /// The least it may be.
        from: f64,
        /// The most it may be.
        to: f64,
    },
    /// An axis that cannot be periodic.
    #[error("axis {} cannot be periodic: {}", AXES[*axis], if *is_box {
        format!("the body is {cells} cells long there, and has to be a whole number of them")
    } else {
        "the body is no box".to_owned()
    })]
    NoPeriod {
        /// The axis.
        axis: usize,
        /// Whether the body is a box.
        is_box: bool,
        /// The length of the body in cells.
        cells: f64,
    },
    /// A field that does not repeat itself.
    #[error(
        "axis {} cannot be periodic: the field's displacement differs between its two faces",
        AXES[*axis]
    )]
    NotPeriodic {
        /// The axis.
        axis: usize,
    },
    /// The field names a face that the body does not have.
    #[error("the body, in {dimension} dimension(s), has no face {face}")]
    NoSuchFace {
        /// The face.
        face: Face,
        /// The number of dimensions.
        dimension: usize,
    },
    /// A wall does not lie on a plane of grid nodes, so that it has no mirror image on the grid.
    #[error(
        "face {face} is `{condition}` but lies between grid nodes, {cells} cells from one; choose a \
         number of cells, and an offset of the grid, that put it on nodes"
    )]
    WallBetweenNodes {
        /// The face.
        face: Face,
        /// The condition that the face asks for.
        condition: Condition,
        /// The distance of the face in cells from a plane of nodes or from the opposite face.
        cells: f64,
    },
    /// A value that has to be positive and finite is not.
    #[error("{what} is {value}, and has to be positive and finite")]
    NotPositive {
        /// The name of the value.
        what: &'static str,
        /// The value.
        value: f64,
    },
    /// A value of the field that is not finite inside the field's own time window.
    #[error("the field's {quantity} is not finite at time {time:e} and X = {reference_position:?}")]
    FieldNotFinite {
        /// The quantity.
        quantity: &'static str,
        /// The time.
        time: f64,
        /// The reference position.
        reference_position: Vec<f64>,
    },
    /// The scene does not fit in memory.
    #[error(
        "the scene has {} {what}, more than the {limit:e} this solver takes; {}",
        if count.is_finite() { format!("{count:e}") } else { "over 1e308".to_owned() },
        fewer(what)
    )]
    TooLarge {
        /// `particles`, `grid nodes` or `steps`.
        what: &'static str,
        /// The number that there would be.
        count: f64,
        /// The largest number that the solver accepts.
        limit: f64,
    },
}

/// Advice on how to make a scene smaller.
fn fewer(what: &str) -> &'static str {
    match what {
        "steps" => "use a larger Courant number or time step, or an earlier end",
        "particles" => "use fewer cells, or fewer particles per cell",
        _ => "use fewer cells",
    }
}

/// Three digits of a positive number, rounded down.
fn rounded_down(value: f64) -> f64 {
    let digits = (2.0 - value.log10().floor()).max(0.0);
    let scale = 10f64.powf(digits);
    (value * scale).floor() / scale
}

/// `value`, if it is positive and finite.
pub(crate) fn positive(what: &'static str, value: f64) -> Result<f64, Refusal> {
    let positive = value > 0.0 && value.is_finite();
    positive.then_some(value).ok_or(Refusal::NotPositive { what, value })
}

/// `count`, if it is at most `limit`.
pub(crate) fn at_most(what: &'static str, count: f64, limit: f64) -> Result<f64, Refusal> {
    let within = count <= limit; // false for NaN
    within.then_some(count).ok_or(Refusal::TooLarge { what, count, limit })
}

/// The reason, place and time of a run's stop.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}; {}", self.place(), cause.advice())]
pub struct Failure {
    /// The step that led to the bad state, counted from 1; 0 is the initial state.
    pub step: usize,
    /// The time at the end of that step.
    pub time: f64,
    /// The particle; `None` if the failure is at a grid node.
    pub particle: Option<usize>,
    /// Reference position of the particle or node, `D` components; empty if the failure concerns all of them.
    pub reference_position: Vec<f64>,
    /// The cause.
    pub cause: Cause,
}

impl Failure {
    /// The failure with its place and time, without advice.
    pub fn place(&self) -> String {
        let Failure { step, time, particle, reference_position: at, cause } = self;
        let particle = particle.map_or(String::new(), |it| format!(", particle {it}"));
        let at = if at.is_empty() { String::new() } else { format!(", X = {at:?}") };
        format!("stopped in step {step} at time {time:e}{particle}{at}: {cause}")
    }
}

/// The cause of a run's stop.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Cause {
    /// A time step in which a wave may cross a cell.
    #[error(
        "the time step {time_step:.3e} is above the stable one, {stable:.3e}, in which, as proved, no wave of \
         the field crosses a cell; that is a Courant number of {}", rounded_down(*courant)
    )]
    UnstableStep {
        /// The time step.
        time_step: f64,
        /// The largest one that is proved to be stable.
        stable: f64,
        /// The Courant number of the largest stable step.
        courant: f64,
    },
    /// J <= 0.
    #[error("the particle is inverted, J = {jacobian:e}")]
    Inverted {
        /// The Jacobian J = det F.
        jacobian: f64,
    },
    /// A value became infinite or not a number.
    #[error("the {quantity} is not finite")]
    NotFinite {
        /// The quantity.
        quantity: &'static str,
    },
    /// A number that the precision of the run does not have.
    #[error(
        "the {quantity} is {value:e}, outside the range of this precision, {least:.1e} to {most:.1e}"
    )]
    OutOfRange {
        /// The quantity; its value is the largest of all particles.
        quantity: &'static str,
        /// The size; infinite where the precision has no number for it.
        value: f64,
        /// The least positive number with all digits.
        least: f64,
        /// The greatest number.
        most: f64,
    },
    /// A particle, or a part of its domain, left the grid.
    #[error("the particle is lost: it left the grid, x = {position:?}")]
    Lost {
        /// The particle's position.
        position: Vec<f64>,
    },
    /// A particle, or a part of its domain, left the grid on the way to an equilibrium.
    #[error("the particle is lost: it left the grid on the way to equilibrium, x = {position:?}")]
    LostInRelaxation {
        /// The particle's position.
        position: Vec<f64>,
    },
    /// A particle's domain is too wide for the grid, or has collapsed.
    #[error(
        "the half width of the particle's domain is {half_width:e}, outside ]0, {cell_size:e}[ (one cell)"
    )]
    HalfWidth {
        /// The half width.
        half_width: f64,
        /// The grid spacing.
        cell_size: f64,
    },
    /// A ring that has shrunk to nothing.
    #[error("the particle has crossed the axis of revolution, r = {radius:e}")]
    BeyondAxis {
        /// The particle's distance from the axis.
        radius: f64,
    },
    /// A particle's domain is flat or not finite.
    #[error("the particle's domain is flat or not finite")]
    FlatDomain,
    /// No reference position was found for a node near a face whose motion is prescribed.
    #[error(
        "the field's motion could not be inverted at the grid node x = {position:?}, beside a face whose motion is given"
    )]
    NoReferencePosition {
        /// The node's position.
        position: Vec<f64>,
    },
    /// A body that does not come to equilibrium.
    #[error(
        "the body has not come to equilibrium: its residual is {residual:.2e}, and has to be below {tolerance:.2e}"
    )]
    NotRelaxed {
        /// The ratio of the forces out of balance to the forces of the stress.
        residual: f64,
        /// The residual below which the run ends.
        tolerance: f64,
    },
    /// An observer of the run failed.
    #[error("{reason}")]
    Stopped {
        /// The observer's reason.
        reason: String,
    },
}

impl Cause {
    /// The cause for a particle, or a corner of its domain, outside the grid.
    pub(crate) fn lost<T: Real, const D: usize>(position: &Vector<T, D>) -> Self {
        Cause::Lost { position: components(position) }
    }

    /// The likely reason, and what to try.
    pub fn advice(&self) -> &'static str {
        match self {
            Cause::UnstableStep { .. } => {
                "try a smaller Courant number, or run it anyway with `--allow-unstable`"
            }
            Cause::Inverted { .. } | Cause::NotFinite { .. } | Cause::FlatDomain => {
                "likely an unstable or too coarse run, or forcing and material that do not belong \
                 together: try a smaller Courant number or more cells"
            }
            Cause::OutOfRange { .. } => "use double precision, or units in which it is closer to 1",
            Cause::BeyondAxis { .. } => {
                "likely an unstable run, since the field's own motion keeps rings apart from the axis: try a smaller Courant \
                 number or more cells"
            }
            Cause::Lost { .. } => {
                "likely an unstable run, since the grid has room for the field's own motion: try a smaller Courant number \
                 or more cells"
            }
            Cause::LostInRelaxation { .. } => {
                "where a curved face cuts cells, some hold few particles, and a load tears them off: claim `prescribed` on that \
                 face, or try `--formulation total --shape quadratic_bspline --particles-per-cell 4`, which may lose its order there"
            }
            Cause::HalfWidth { .. } => {
                "the stretch is large for so few particles: try more particles per cell"
            }
            Cause::NoReferencePosition { .. } => {
                "the field may not continue smoothly beyond its body: use more cells, or claim `fixed`, \
                 `roller` or `free` on that face if it holds there and is not claimed yet"
            }
            Cause::NotRelaxed { .. } => {
                "the equilibrium may be unstable, which `mms check` reports, or low frequencies make the relaxation long: \
                 try fewer cells, another shape function or a smaller load"
            }
            Cause::Stopped { .. } => "files that were written before are complete",
        }
    }
}
