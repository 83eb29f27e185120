//! The norms of one quantity together.

use crate::finding::{Expected, Finding};
use crate::sequence::Sequence;
use crate::verdict::Verdict;

/// Judged norms, each under its name: mean, root mean square and maximum under `l1`, `l2` and `linf`.
#[derive(Clone, Debug, PartialEq)]
pub struct Judgement {
    /// The findings, one at least, in the sequence in which the norms were given.
    pub norms: Vec<Judged>,
    /// Which of them decided: the worst, and of those `l2` first.
    deciding: usize,
}

/// One norm, and what is found of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Judged {
    /// Its name.
    pub norm: String,
    /// What was expected of it.
    pub expected: Expected,
    /// What its levels say.
    pub finding: Finding,
}

/// How far an order may be from that of a layer.
const NEAR: f64 = 0.15;

impl Judgement {
    /// Judges each norm, the worst deciding. `None` without a norm.
    pub fn of<'a>(
        norms: impl IntoIterator<Item = (&'a str, &'a Sequence, Expected)>,
    ) -> Option<Self> {
        let judged = |(norm, sequence, expected): (&str, &Sequence, Expected)| Judged {
            norm: norm.to_owned(),
            expected,
            finding: Finding::of(sequence, expected),
        };
        let norms: Vec<_> = norms.into_iter().map(judged).collect();
        let worst = norms.iter().map(|it| it.finding.verdict).max()?;
        let is_worst = |it: &Judged| it.finding.verdict == worst;
        let of_l2 = norms.iter().position(|it| it.norm == "l2" && is_worst(it));
        let deciding = of_l2.or_else(|| norms.iter().position(is_worst))?;
        Some(Self { norms, deciding })
    }

    /// The norm that decided.
    pub fn deciding(&self) -> &Judged {
        &self.norms[self.deciding]
    }

    /// That of the norm that decided.
    pub fn verdict(&self) -> Verdict {
        self.deciding().finding.verdict
    }

    /// What is found of a norm.
    pub fn norm(&self, name: &str) -> Option<&Judged> {
        self.norms.iter().find(|it| it.norm == name)
    }

    /// The order q of a layer of one cell at a face, whose errors are of order q there: it covers a part h of the body,
    /// so that l1, l2 and linf show q + 1, q + 1/2 and q, or the expected order where that is lower. Told where l2
    /// shows it too.
    pub fn layer(&self) -> Option<f64> {
        let order = |norm: &str| {
            let judged = self.norm(norm)?;
            Some((judged.finding.estimate?.order, judged.expected.order))
        };
        let (linf, l1, l2) = (order("linf")?.0, order("l1")?, order("l2")?);
        let follows = |(found, expected): (f64, f64), more: f64| {
            (found - expected.min(linf + more)).abs() <= NEAR
        };
        let is_seen = linf + 0.5 + NEAR < l2.1;
        (is_seen && follows(l1, 1.0) && follows(l2, 0.5)).then_some(linf)
    }
}
