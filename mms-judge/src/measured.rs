//! Measured errors of any solver, and the orders that they show.
//!
//! [`table`](crate::table) reads them from a file. Code that computes errors from results makes a [`Measured`], too.

use anyhow::bail;
use mms_convergence::{ExpectedOrder, Fit, Judgement, Sample, Sequence, Verdict, fit};
use mms_spec::foreign::Foreign;

/// Errors of some quantities in some runs.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// The runs, in any sequence; runs of one length are replicates.
    pub runs: Vec<RunSize>,
    /// The quantities, at least one.
    pub quantities: Vec<Quantity>,
}

/// The h and dt of one run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunSize {
    /// h.
    pub cell_size: f64,
    /// dt, if it is known.
    pub time_step: Option<f64>,
}

/// The errors of a quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantity {
    /// The name of the quantity.
    pub name: Foreign,
    /// The norms of the quantity, at least one.
    pub norms: Vec<Norm>,
}

/// The errors of a quantity in one norm.
#[derive(Clone, Debug, PartialEq)]
pub struct Norm {
    /// `l1`, `l2`, `linf`, `h1`, or the name of the column.
    pub name: Foreign,
    /// The expected orders of the norm in h and, for a grid of h and dt, in dt.
    pub expected: [ExpectedOrder; 2],
    /// The error in each run; `None` if the run stopped.
    pub errors: Vec<Option<f64>>,
    /// The error in each run below which it may be round-off alone; 0 if that is not known.
    pub floors: Vec<f64>,
    /// Half a unit of the last printed digit of the errors; 0 if they were not rounded.
    pub rounding: f64,
    /// Whether every error is known to be round-off alone.
    pub is_exact: bool,
}

/// The lengths that differ between runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refined {
    /// h, possibly with dt.
    Space,
    /// dt alone.
    Time,
    /// h and dt, each by itself.
    Grid,
}

impl Refined {
    /// The name in the document.
    pub fn name(self) -> &'static str {
        match self {
            Refined::Space => "space",
            Refined::Time => "time",
            Refined::Grid => "space and time",
        }
    }

    /// The symbol of the levels' length in formulas.
    pub fn symbol(self) -> &'static str {
        if self == Refined::Time { "dt" } else { "h" }
    }
}

/// The judgement of a quantity.
pub struct QuantityJudgement {
    /// The norms with their verdicts.
    pub judgement: Judgement,
    /// For a grid of h and dt, the fit in space and time in each norm.
    pub fits: Vec<Option<Fit>>,
    /// The reason why the quantity is no evidence, if there is one.
    pub objection: Option<Objection>,
}

/// The reason why results show nothing, or do not show that a solver is right.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Objection {
    /// The reason in a sentence.
    pub why: String,
    /// Whether the results do not show a mistake either.
    pub is_to_all: bool,
}

impl QuantityJudgement {
    /// Withdraws the findings to which there is an objection.
    pub fn object(&mut self, objection: Option<&Objection>) {
        let verdict = self.judgement.verdict();
        self.objection = objection.filter(|it| it.is_to_all || verdict.is_good()).cloned();
        if self.objection.is_some() {
            let findings = self.judgement.norms.iter_mut().map(|it| &mut it.finding);
            findings.for_each(|it| it.verdict = Verdict::NoEvidence);
        }
    }
}

/// The least number of runs of a grid of h and dt: four unknowns, and three more runs to measure the fit.
const GRID: usize = 7;

impl Measured {
    /// Finds which lengths differ between the runs.
    ///
    /// # Errors
    /// A grid of h and dt that is too small to separate the two.
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
                "{h} values of h and {dt} of dt in {both} pairs: to separate errors of space and time takes {GRID} \
                 pairs, with three values of each; else refine both together, or one alone"
            ),
        }
    }

    /// Judges all quantities, and withdraws the findings to which there is an objection.
    ///
    /// # Errors
    /// A grid of h and dt that is too small to separate the two.
    pub fn judged(
        &self,
        objection: Option<&Objection>,
    ) -> anyhow::Result<(Refined, Vec<QuantityJudgement>)> {
        let refined = self.refined()?;
        let judge = |quantity| self.judge(refined, quantity);
        let mut judged: Vec<QuantityJudgement> = self.quantities.iter().filter_map(judge).collect();
        judged.iter_mut().for_each(|it| it.object(objection));
        Ok((refined, judged))
    }

    /// The refined length of a run.
    pub fn length(&self, refined: Refined, run: &RunSize) -> f64 {
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
    pub fn judge(&self, refined: Refined, quantity: &Quantity) -> Option<QuantityJudgement> {
        let norms = || quantity.norms.iter().map(|norm| (norm.name.raw(), norm));
        if refined == Refined::Grid {
            let fits: Vec<_> = quantity.norms.iter().map(|norm| fit(&self.grid(norm))).collect();
            let fitted = norms().zip(&fits).map(|((name, norm), fit)| (name, *fit, norm.expected));
            let pairs = self.runs.iter().map(|it| [it.cell_size, it.time_step.unwrap_or(f64::NAN)]);
            let pairs: Vec<_> = pairs.collect();
            let judgement = Judgement::of_fits(&pairs, fitted)?;
            return Some(QuantityJudgement { judgement, fits, objection: None });
        }
        let sequences: Vec<_> =
            quantity.norms.iter().map(|norm| self.sequence(refined, norm)).collect();
        let judged = norms().zip(&sequences).map(|((name, norm), it)| (name, it, norm.expected[0]));
        Some(QuantityJudgement {
            judgement: Judgement::of(judged)?,
            fits: Vec::new(),
            objection: None,
        })
    }

    /// h, dt and e of each run; NaN for a run that stopped, so that nothing fits.
    fn grid(&self, norm: &Norm) -> Vec<[f64; 3]> {
        let runs = self.runs.iter().zip(&norm.errors);
        let number = |it: Option<f64>| it.unwrap_or(f64::NAN);
        runs.map(|(run, e)| [run.cell_size, number(run.time_step), number(*e)]).collect()
    }
}

/// The number of different pairs.
fn count(a: &[f64], b: &[f64]) -> usize {
    let mut pairs: Vec<_> = a.iter().zip(b).map(|(a, b)| [*a, *b]).collect();
    pairs.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let is_same = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-6;
    pairs.dedup_by(|a, b| is_same(a[0], b[0]) && is_same(a[1], b[1]));
    pairs.len()
}

/// The worst verdict of some quantities, and the position of the first quantity with it.
pub fn worst(judged: &[QuantityJudgement]) -> Option<(usize, Verdict)> {
    let verdicts = judged.iter().map(|it| it.judgement.verdict()).enumerate();
    verdicts.rev().max_by_key(|(_, verdict)| *verdict)
}
