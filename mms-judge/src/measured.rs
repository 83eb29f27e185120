//! Errors that somebody measured, of any solver: what they say of its order.
//!
//! [`table`](crate::table) reads them from a file. Whoever computes them from results makes a [`Measured`], too.

use anyhow::bail;
use mms_convergence::{Expected, Fit, Judgement, Sample, Sequence, Verdict, fit};
use mms_spec::foreign::Foreign;

/// Errors of some quantities in some runs.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// The runs, in any sequence; those of one length are replicates.
    pub runs: Vec<Run>,
    /// The quantities, one at least.
    pub quantities: Vec<Quantity>,
}

/// One run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Run {
    /// h.
    pub cell_size: f64,
    /// dt, where it is known.
    pub time_step: Option<f64>,
}

/// The errors of a quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantity {
    /// Its name.
    pub name: Foreign,
    /// Its norms, one at least.
    pub norms: Vec<Norm>,
}

/// The errors of a quantity in one norm.
#[derive(Clone, Debug, PartialEq)]
pub struct Norm {
    /// `l1`, `l2`, `linf`, `h1`, or what its column is called.
    pub name: Foreign,
    /// The orders that are expected of it in h, and of a grid of h and dt in dt.
    pub expected: [Expected; 2],
    /// The error in each run; none in one that stopped.
    pub errors: Vec<Option<f64>>,
    /// Below this an error in each run may be nothing but round-off; 0 where that is not known.
    pub floors: Vec<f64>,
    /// Half a unit of the last digit that was printed of the errors; 0 if they were not rounded.
    pub rounding: f64,
    /// Whether every error is known to be nothing but round-off.
    pub is_exact: bool,
}

/// What differs between runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refined {
    /// h, and dt with it or not.
    Space,
    /// dt alone.
    Time,
    /// Each by itself.
    Grid,
}

impl Refined {
    /// How the document calls it.
    pub fn name(self) -> &'static str {
        match self {
            Refined::Space => "space",
            Refined::Time => "time",
            Refined::Grid => "space and time",
        }
    }

    /// The lengths of levels, in formulas.
    pub fn symbol(self) -> &'static str {
        if self == Refined::Time { "dt" } else { "h" }
    }
}

/// What is said of a quantity.
pub struct Judged {
    /// Its norms with their verdicts.
    pub judgement: Judgement,
    /// Space and time in one formula, in each norm, of a grid of h and dt.
    pub fits: Vec<Option<Fit>>,
    /// Why it is no evidence, where that is so.
    pub objection: Option<Objection>,
}

/// Why results show nothing, or do not show that a solver is right.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Objection {
    /// In a sentence.
    pub why: String,
    /// Whether they show no mistake either.
    pub is_to_all: bool,
}

impl Judged {
    /// Takes back what an objection is to.
    pub fn object(&mut self, objection: Option<&Objection>) {
        let verdict = self.judgement.verdict();
        self.objection = objection.filter(|it| it.is_to_all || verdict.is_good()).cloned();
        if self.objection.is_some() {
            let findings = self.judgement.norms.iter_mut().map(|it| &mut it.finding);
            findings.for_each(|it| it.verdict = Verdict::NoEvidence);
        }
    }
}

/// How many runs a grid of h and dt takes: four unknowns, and three more to tell how well they fit.
const GRID: usize = 7;

impl Measured {
    /// What differs between the runs.
    ///
    /// # Errors
    /// A grid of h and dt that is too small to tell the two apart.
    pub fn refined(&self) -> anyhow::Result<Refined> {
        let steps: Option<Vec<f64>> = self.runs.iter().map(|run| run.time_step).collect();
        let Some(steps) = steps else { return Ok(Refined::Space) };
        let sizes: Vec<f64> = self.runs.iter().map(|run| run.cell_size).collect();
        let [h, dt, both] = [count(&sizes, &sizes), count(&steps, &steps), count(&sizes, &steps)];
        match (h, dt) {
            (1, 2..) => Ok(Refined::Time),
            _ if both == h => Ok(Refined::Space),
            (3.., 3..) if both >= GRID => Ok(Refined::Grid),
            _ => bail!(
                "{h} values of h and {dt} of dt in {both} pairs: to tell errors of space and of time apart takes {GRID} \
                 pairs, with three values of each; else refine both together, or one alone"
            ),
        }
    }

    /// Judges all quantities, and takes back what there is an objection to.
    ///
    /// # Errors
    /// A grid of h and dt that is too small to tell the two apart.
    pub fn judged(&self, objection: Option<&Objection>) -> anyhow::Result<(Refined, Vec<Judged>)> {
        let refined = self.refined()?;
        let judge = |quantity| self.judge(refined, quantity);
        let mut judged: Vec<Judged> = self.quantities.iter().filter_map(judge).collect();
        judged.iter_mut().for_each(|it| it.object(objection));
        Ok((refined, judged))
    }

    /// What is refined in a run.
    pub fn length(&self, refined: Refined, run: &Run) -> f64 {
        match refined {
            Refined::Time => run.time_step.unwrap_or(run.cell_size),
            Refined::Space | Refined::Grid => run.cell_size,
        }
    }

    /// The levels of a norm.
    pub fn sequence(&self, refined: Refined, norm: &Norm) -> Sequence {
        let samples = self.runs.iter().zip(&norm.errors).zip(&norm.floors);
        Sequence::new(samples.map(|((run, &error), &floor)| Sample {
            length: self.length(refined, run),
            error,
            is_noise: error.is_some_and(|error| error < floor),
            rounding: norm.rounding,
        }))
        .exact(norm.is_exact)
    }

    /// Judges a quantity; `None` without a norm.
    pub fn judge(&self, refined: Refined, quantity: &Quantity) -> Option<Judged> {
        let norms = || quantity.norms.iter().map(|norm| (norm.name.raw(), norm));
        if refined == Refined::Grid {
            let fits: Vec<_> = quantity.norms.iter().map(|norm| fit(&self.grid(norm))).collect();
            let fitted = norms().zip(&fits).map(|((name, norm), fit)| (name, *fit, norm.expected));
            let pairs = self.runs.iter().map(|it| [it.cell_size, it.time_step.unwrap_or(f64::NAN)]);
            let pairs: Vec<_> = pairs.collect();
            let judgement = Judgement::of_fits(&pairs, fitted)?;
            return Some(Judged { judgement, fits, objection: None });
        }
        let sequences: Vec<_> =
            quantity.norms.iter().map(|norm| self.sequence(refined, norm)).collect();
        let judged = norms().zip(&sequences).map(|((name, norm), it)| (name, it, norm.expected[0]));
        Some(Judged { judgement: Judgement::of(judged)?, fits: Vec::new(), objection: None })
    }

    /// h, dt and e of each run; of one that stopped no number, so that nothing fits.
    fn grid(&self, norm: &Norm) -> Vec<[f64; 3]> {
        let runs = self.runs.iter().zip(&norm.errors);
        let number = |it: Option<f64>| it.unwrap_or(f64::NAN);
        runs.map(|(run, e)| [run.cell_size, number(run.time_step), number(*e)]).collect()
    }
}

/// How many pairs of these there are.
fn count(a: &[f64], b: &[f64]) -> usize {
    let mut pairs: Vec<_> = a.iter().zip(b).map(|(a, b)| [*a, *b]).collect();
    pairs.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let is_same = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-6;
    pairs.dedup_by(|a, b| is_same(a[0], b[0]) && is_same(a[1], b[1]));
    pairs.len()
}

/// The worst verdict of some quantities, and which of them has it first.
pub fn worst(judged: &[Judged]) -> Option<(usize, Verdict)> {
    let verdicts = judged.iter().map(|it| it.judgement.verdict()).enumerate();
    verdicts.rev().max_by_key(|(_, verdict)| *verdict)
}
