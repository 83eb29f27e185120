//! The answer to a diagnosis: a finding, and the hypotheses ordered by the part of the error that they explain.

use std::borrow::Cow;

use mms_runtime::Face;

use crate::exact::Exact;
use crate::falls::{Falls, OfOrder};
use crate::hypothesis::{Hypothesis, HypothesisKind, Size, title};
use crate::smooth::{less, size};

/// The outcome of a diagnosis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DiagnosisFinding {
    /// The error is no larger than the error of a right method.
    Nothing,
    /// A hypothesis explains the error.
    Named,
    /// No hypothesis explains the error.
    Unexplained,
}

impl DiagnosisFinding {
    /// The name of the finding in a document.
    pub fn name(self) -> &'static str {
        match self {
            DiagnosisFinding::Nothing => "nothing",
            DiagnosisFinding::Named => "named",
            DiagnosisFinding::Unexplained => "unexplained",
        }
    }
}

/// A hypothesis, and the part of the error that it explains.
#[derive(Clone, Debug)]
pub struct Ranked {
    /// The index of the hypothesis in the list.
    pub hypothesis: usize,
    /// The name of the mistake; if the size has a name, that name.
    pub name: &'static str,
    /// The description of the mistake.
    pub says: String,
    /// Whether it is a mistake or a choice.
    pub kind: HypothesisKind,
    /// The face that it is on.
    pub face: Option<Face>,
    /// Which of several variants it is.
    pub which: Option<Cow<'static, str>>,
    /// The size: a factor, an amount, or the components of a vector. If the mistake has no size, the factor by which its effect
    /// would have to be scaled.
    pub factor: Vec<f64>,
    /// The uncertainty of each number of the size.
    pub margin: f64,
    /// The part of the squared error that it explains.
    pub explained: f64,
    /// Whether the mistake can have this size.
    pub is_plausible: bool,
    /// Whether it explains the same part of the error as the first hypothesis of the list.
    pub acts_as_first: bool,
    /// Whether its size was fitted, and so may merely fit best.
    pub is_sized: bool,
    /// Whether the size is a known one.
    pub is_known: bool,
    /// The mistakes that have the same effect on such results of every field.
    pub equivalent_always: Vec<String>,
    /// The mistakes that explain this error as well.
    pub equivalent_here: Vec<String>,
    /// The number of these mistakes that are as simple.
    pub rivals: usize,
    /// The evidence that would separate these mistakes.
    pub needs: Vec<String>,
}

impl Ranked {
    /// The name, with the face and the variant.
    pub fn title(&self) -> String {
        title(self.name, self.which.as_deref(), self.face)
    }

    /// Whether the size was fitted and is not a known one.
    pub fn is_free(&self) -> bool {
        self.is_sized && !self.is_known
    }
}

/// The quantity that a solver computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Computed {
    /// a.
    Acceleration,
    /// r = rho0 a - Div P - rho0 b per reference volume.
    Residual,
    /// The residual at nodes, as forces: integrated with the shape function of each node, tractions included.
    NodalResidual,
}

/// A step of the ladder: each step checks what the next step assumes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rung {
    /// Stresses at given F, without a solver.
    Law,
    /// Accelerations or residuals at an exact state, without a step.
    State(Computed),
    /// Velocities after one small step from an exact state.
    Step,
    /// Ordinary results.
    Results,
}

impl Rung {
    /// Names the evidence in words.
    pub fn says(self) -> &'static str {
        match self {
            Rung::Law => "the law alone",
            Rung::State(Computed::Acceleration) => "accelerations at an exact state",
            Rung::State(Computed::Residual) => "residuals at an exact state",
            Rung::State(Computed::NodalResidual) => "residuals at nodes at an exact state",
            Rung::Step => "one step from an exact state",
            Rung::Results => "results",
        }
    }

    /// Advises what to run next after this finding.
    pub fn next(self, finding: DiagnosisFinding) -> &'static str {
        match (self, finding) {
            (_, DiagnosisFinding::Named) => "fix it, run your code again, and diagnose it again",
            (Rung::Law, DiagnosisFinding::Nothing) => {
                "the law is right for these F; look at accelerations or residuals at an exact state, which `mms state` writes"
            }
            (Rung::Law, DiagnosisFinding::Unexplained) => {
                "stresses at F with only a volume change, and at F with only one shear, to see which is wrong"
            }
            (Rung::State(_), DiagnosisFinding::Nothing) => {
                "force, stress, mass and loads are right at this state; look at velocities after one small step from it"
            }
            (Rung::State(_), DiagnosisFinding::Unexplained) => {
                "the same without a term (`--without body_force`, stress, traction), and a table of the law alone"
            }
            (Rung::Step, DiagnosisFinding::Nothing) => {
                "one step is right; look at results at later times, of two meshes"
            }
            (Rung::Step, DiagnosisFinding::Unexplained) => {
                "accelerations at the exact state from which it starts"
            }
            (Rung::Results, DiagnosisFinding::Nothing) => {
                "a finer mesh, or another field, would show more"
            }
            (Rung::Results, DiagnosisFinding::Unexplained) => {
                "accelerations at an exact state, or a table of F and stress (`--quantity stress`)"
            }
        }
    }
}

/// A right method of this project's own solver, and how near its error on such a grid is to the user's error.
#[derive(Clone, Debug, PartialEq)]
pub struct Like {
    /// The method, as `--like` takes it.
    pub method: String,
    /// The user's error, as a multiple of the method's error.
    pub factor: f64,
    /// The size of the difference of both errors, divided by the user's error.
    pub apart: f64,
}

/// Two hypotheses that explain an error together.
#[derive(Clone, Debug, PartialEq)]
pub struct Pair {
    /// The names of both, with faces and variants.
    pub hypotheses: [String; 2],
    /// The part of the squared error that both explain.
    pub explained: f64,
}

/// The place where an error is concentrated.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorPlace {
    /// X of the point with the largest error.
    pub at: Vec<f64>,
    /// The time.
    pub time: f64,
    /// The face near which more than half of the squared error is.
    pub face: Option<Face>,
    /// The axis and the coordinate of a plane that is no face, near which more than half of the squared error is.
    pub plane: Option<(usize, f64)>,
    /// The observed order from the second finest mesh to the finest one.
    pub order: Option<f64>,
    /// The smooth part of the squared error. The rest is noise: of particles that cross cells, of iterations that stop early,
    /// of single precision.
    pub smooth: f64,
}

/// Errors at points over the body, each a vector of the components of one quantity: their smooth part.
#[derive(Clone, Debug, PartialEq)]
pub struct Fields {
    /// The quantity.
    pub quantity: &'static str,
    /// The time.
    pub time: f64,
    /// X of the points.
    pub points: Vec<Vec<f64>>,
    /// The user's error.
    pub error: Vec<Vec<f64>>,
    /// The error that the named hypothesis makes.
    pub named: Option<Vec<Vec<f64>>>,
}

/// The result of a diagnosis.
#[derive(Clone, Debug)]
pub struct Diagnosis {
    /// The outcome.
    pub finding: DiagnosisFinding,
    /// The kind of evidence that was diagnosed.
    pub rung: Rung,
    /// Hypotheses, the best one first.
    pub ranked: Vec<Ranked>,
    /// Mistakes that such results of this field cannot show.
    pub cannot_be_seen: Vec<String>,
    /// The size of the error divided by the size of the exact solution.
    pub error: f64,
    /// The least error of a right solver, and the largest error that counts as one of a right solver.
    pub expected: [f64; 2],
    /// The decrease of the error from mesh to mesh, for results of two or more meshes.
    pub falls: Option<Falls>,
    /// A right method whose error falls with this order, if the order is not the expected one.
    pub of_order: Option<OfOrder>,
    /// Two hypotheses that together explain what no single one explains.
    pub pair: Option<Pair>,
    /// A right method with such an error.
    pub like: Option<Like>,
    /// The concentration of the error, for results.
    pub place: Option<ErrorPlace>,
    /// The errors of results, for plots.
    pub fields: Option<Fields>,
}

/// The part of an error that one hypothesis explains.
#[derive(Clone, Debug)]
pub struct Explained {
    /// The index of the hypothesis in the list.
    pub hypothesis: usize,
    /// The size; empty if the hypothesis has none.
    pub size: Vec<f64>,
    /// The uncertainty of each number of the size.
    pub margin: f64,
    /// The factor by which the response has to be scaled.
    pub scale: f64,
    /// The part of the squared error that is explained.
    pub share: f64,
    /// The error that the hypothesis makes.
    pub response: Vec<f64>,
}

impl Explained {
    /// The explained error: the response, scaled.
    fn explains(&self) -> Vec<f64> {
        self.response.iter().map(|it| it * self.scale).collect()
    }
}

/// Groups of mistakes that have the same effect in every field, inside the body and with b per mass; each mistake with its
/// equivalent size.
const SAME: [&[(&str, Option<f64>)]; 2] = [
    &[("force_sign", None), ("moduli_factor", Some(3.0)), ("density_factor", Some(1.0 / 3.0))],
    &[("moduli_factor", None), ("density_factor", None)],
];

/// The most hypotheses that may explain an error as well as the best one. With more, the results do not separate them, and no
/// hypothesis is named.
const ALIKE: usize = 5;
/// Limits for |scale - 1| of a response that counts as plausible: the part by which methods differ, clamped between `SCALED`
/// and `MOST_SCALED`, plus `SCALED_BY_LEFT` times the part of the error that is left.
const SCALED: f64 = 0.03;
const MOST_SCALED: f64 = 0.08;
const SCALED_BY_LEFT: f64 = 0.5;
/// The constant c of the further part c/`excess` of the error that may be left, in addition to `Limits::left`. `excess` is the
/// error divided by the error of the method.
const LEFT_BY_METHOD: f64 = 0.1;
/// The part of the error that a mistake with several free numbers may leave at most: such mistakes explain much by chance.
const OF_VECTOR: f64 = 0.12;
/// A hypothesis explains an error as well as the best one if its unexplained part is at most `AS_WELL` times that part of the
/// best one, plus `UNSEEN`, a part of the squared error that is ignored.
const AS_WELL: f64 = 1.3;
const UNSEEN: f64 = 0.004;
/// Two explanations are the same if their difference is at most this part of the error left by the first.
const SAME_PART: f64 = 0.6;
/// A hypothesis that leaves at most this part of the error is named even if hypotheses of an impossible size leave less.
const CLEAR: f64 = 0.06;
/// A fitted size f counts as the known size k if |f - k| <= min(margin of the fit, SURE |f - r|), where r is the right size, or
/// if |f - k| <= KNOWN max(|k|, |f - r|).
const KNOWN: f64 = 0.03;
const SURE: f64 = 0.1;

/// The part of an error that is left if this share of its square is explained.
fn left(share: f64) -> f64 {
    (1.0 - share).max(0.0).sqrt()
}

/// Whether a hypothesis can have the size that was found, if methods differ by the part `apart` of what they compute.
fn is_plausible<const D: usize>(
    hypothesis: &Hypothesis<D>,
    explained: &Explained,
    apart: f64,
) -> bool {
    let most = apart.clamp(SCALED, MOST_SCALED) + SCALED_BY_LEFT * left(explained.share);
    let scaled = (explained.scale - 1.0).abs() <= most;
    scaled && explained.scale > 0.0 && hypothesis.allows(&explained.size)
}

/// The limits within which a mistake is named.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// The least ratio of the error to the methods' error: first for a mistake without a fitted size or with a known one, then
    /// for a mistake of any size.
    pub excess: [f64; 2],
    /// The largest part of the error that may be left if methods cause almost none of it: first for a mistake without a
    /// size, then for one whose size was fitted.
    pub left: [f64; 2],
    /// The largest ratio of the part that may be left to the part that a hypothesis of an impossible size leaves. If that
    /// hypothesis fits much better, something similar to it is the cause.
    pub nearer: [f64; 2],
}

impl Limits {
    /// Finds the outcome from ranked hypotheses and from `excess`, the error divided by the methods' error.
    pub fn finding(&self, ranked: &[Ranked], excess: f64) -> DiagnosisFinding {
        let others = ranked.iter().filter(|it| !it.is_plausible && !it.acts_as_first);
        let nearest = others.map(|it| left(it.explained)).fold(f64::INFINITY, f64::min);
        let names = |best: &Ranked| {
            let kind = usize::from(best.is_sized);
            let limit = if best.factor.len() > 1 {
                self.left[kind].min(OF_VECTOR)
            } else {
                self.left[kind]
            };
            let most = limit + LEFT_BY_METHOD / excess.max(1.0);
            let left = left(best.explained);
            excess > self.excess[usize::from(best.is_free())]
                && best.is_plausible
                && best.rivals <= ALIKE
                && left <= most
                && left <= (self.nearer[kind] * nearest).max(CLEAR)
        };
        match ranked.first() {
            Some(best) if names(best) => DiagnosisFinding::Named,
            _ if excess <= 1.0 => DiagnosisFinding::Nothing,
            _ => DiagnosisFinding::Unexplained,
        }
    }
}

/// Orders hypotheses by the part of the error that they explain, plausible ones first. `apart` is the part by which methods
/// differ in what they compute.
pub fn ranked<const D: usize>(
    exact: &Exact<'_, D>,
    hypotheses: &[Hypothesis<D>],
    mut all: Vec<Explained>,
    apart: f64,
    needs: &[&str],
) -> Vec<Ranked> {
    all.retain(|it| it.share.is_finite());
    let mut ranked: Vec<Ranked> =
        all.iter().map(|it| one(exact, &hypotheses[it.hypothesis], it, apart)).collect();
    // Where shares differ by rounding alone, mistakes precede choices, and then the order of the list decides.
    let share = |it: &Ranked| (it.explained * 1e6).round();
    let by_share = |a: &Ranked, b: &Ranked| share(b).total_cmp(&share(a)).then(a.kind.cmp(&b.kind));
    ranked.sort_by(|a, b| b.is_plausible.cmp(&a.is_plausible).then(by_share(a, b)));
    let Some(best) = ranked.first() else { return ranked };
    let remains = |share: f64| 1.0 - share;
    let most = AS_WELL * remains(best.explained) + UNSEEN;
    let is_as_good = |it: &Ranked| it.is_plausible && remains(it.explained) <= most;
    // A fit without a free size is the simpler explanation.
    if let Some(simpler) = ranked.iter().position(|it| is_as_good(it) && !it.is_free()) {
        ranked[..=simpler].rotate_right(1);
    }
    let best = &ranked[0];
    let as_well: Vec<&Ranked> = ranked[1..].iter().filter(|it| is_as_good(it)).collect();
    let names = hypotheses[best.hypothesis].name;
    let is_same = |other: &&Ranked| {
        SAME.iter().any(|group| {
            let has = |name: &str| group.iter().any(|(it, _)| *it == name);
            has(names) && has(hypotheses[other.hypothesis].name)
        })
    };
    let always: Vec<String> =
        as_well.iter().filter(|it| is_same(it)).map(|it| it.title()).collect();
    let here: Vec<String> = as_well.iter().filter(|it| !is_same(it)).map(|it| it.title()).collect();
    let needs =
        if here.is_empty() { Vec::new() } else { needs.iter().map(|it| (*it).into()).collect() };
    let rivals = as_well.iter().filter(|it| !is_same(it) && it.is_free() <= best.is_free());
    let rivals = rivals.count();
    let explains =
        |it: &Ranked| all.iter().find(|of| of.hypothesis == it.hypothesis).map(Explained::explains);
    let explained = explains(best).unwrap_or_default();
    let most = SAME_PART * left(best.explained) * size(&explained);
    let acts_as_first = |it: &Ranked| {
        explains(it).is_some_and(|other| size(&less(&explained, 1.0, &other)) <= most)
    };
    let same: Vec<bool> = ranked.iter().map(acts_as_first).collect();
    ranked.iter_mut().zip(same).for_each(|(it, same)| it.acts_as_first = same);
    let first = &mut ranked[0];
    (first.equivalent_always, first.equivalent_here, first.needs) = (always, here, needs);
    first.rivals = rivals;
    ranked
}

fn one<const D: usize>(
    exact: &Exact<'_, D>,
    hypothesis: &Hypothesis<D>,
    explained: &Explained,
    apart: f64,
) -> Ranked {
    let (mut name, mut is_known) = (hypothesis.name, false);
    let mut says = hypothesis.says.to_owned();
    let factor =
        if explained.size.is_empty() { vec![explained.scale] } else { explained.size.clone() };
    if let (Size::Any { right, .. }, [found]) = (&hypothesis.size, explained.size.as_slice()) {
        if let Some(below) = hypothesis.below.filter(|_| *found < right[0]) {
            name = below;
        }
        let near = |it: &crate::hypothesis::Known| {
            let step = (found - right[0]).abs();
            let most = explained.margin.min(SURE * step).max(KNOWN * it.size.abs().max(step));
            (it.size - found).abs() <= most
        };
        let known = hypothesis.known(exact);
        let away = |it: &&crate::hypothesis::Known| (it.size - found).abs();
        let nearest =
            known.iter().filter(|it| near(it)).map(|it| away(&it)).fold(f64::INFINITY, f64::min);
        // If the results do not separate several known sizes, the first of the list counts.
        let known = known.iter().find(|it| near(it) && away(it) <= nearest + explained.margin);
        // A size that is right within the margin has no name of its own.
        if let Some(known) = known.filter(|it| (it.size - right[0]).abs() > explained.margin) {
            is_known = true;
            name = known.name;
            let own = known.size;
            says = format!("{}: its size is {own:.3}; the fitted size is {found:.3}", known.says);
        }
    }
    Ranked {
        hypothesis: explained.hypothesis,
        name,
        says,
        kind: hypothesis.kind,
        face: hypothesis.face,
        which: hypothesis.which.clone(),
        factor,
        margin: explained.margin,
        explained: explained.share,
        is_plausible: is_plausible(hypothesis, explained, apart),
        acts_as_first: false,
        is_sized: hypothesis.size != Size::Fixed,
        is_known,
        equivalent_always: Vec::new(),
        equivalent_here: Vec::new(),
        rivals: 0,
        needs: Vec::new(),
    }
}

/// Hypotheses whose error is below the error of the method, so that the results cannot show them.
pub fn unseen<const D: usize>(
    hypotheses: &[Hypothesis<D>],
    all: &[Explained],
    method: f64,
) -> Vec<String> {
    let is_small = |it: &&Explained| size(&it.response) <= method;
    let title = |it: &Explained| hypotheses[it.hypothesis].title();
    let mut names: Vec<String> = all.iter().filter(is_small).map(title).collect();
    names.dedup();
    names
}
