//! Which hypotheses explain an error, with which size, and which do so as well.

use crate::answer::Explained;
use crate::hypothesis::{Hypothesis, Size};
use crate::smooth::{less, nearest, size};

/// What is to be explained.
pub struct Error {
    /// The coefficients of a user's error.
    pub all: Vec<f64>,
    /// What the method makes of it, as far as is known: it may be there once, or not, or a few times.
    pub method: Vec<f64>,
    /// The size of what the method may make besides, of which no more is known.
    pub floor: f64,
}

impl Error {
    /// The size of what the method does not explain, over that of what it does.
    pub fn excess(&self) -> f64 {
        let method = size(&self.method).max(self.floor);
        let beyond = size(&less(&self.all, 1.0, &self.method));
        if method > 0.0 {
            beyond / method
        } else if beyond > 0.0 {
            f64::INFINITY
        } else {
            0.0
        }
    }

    /// Coefficients of some directions with which they, the method's error, and what methods make of `doubtful` come
    /// nearest; and what remains.
    pub fn explain(&self, directions: &[Vec<f64>], doubtful: &[Vec<f64>]) -> (Vec<f64>, Vec<f64>) {
        let rows = 1 + doubtful.len();
        let row = |column: &[f64], at: Option<(usize, f64)>| {
            let mut column = column.to_vec();
            column.extend((0..rows).map(|row| match at {
                Some((place, weight)) if place == row => weight,
                _ => 0.0,
            }));
            column
        };
        // That the method's error is there once is known about as well as the method is.
        let weight = |column: &[f64]| DOUBT * size(column);
        let mut columns: Vec<_> = directions.iter().map(|it| row(it, None)).collect();
        columns.push(row(&self.method, Some((0, weight(&self.method)))));
        let doubts = doubtful.iter().enumerate();
        columns.extend(doubts.map(|(at, it)| row(it, Some((1 + at, weight(it))))));
        let to = row(&self.all, Some((0, weight(&self.method))));
        let mut found = nearest(&columns, &to);
        let mut remains = to;
        for (column, factor) in columns.iter().zip(&found) {
            remains = less(&remains, *factor, column);
        }
        remains.truncate(self.all.len());
        found.truncate(directions.len());
        (found, remains)
    }

    /// Which part of the square of what the method does not explain is explained with this remainder.
    pub fn share(&self, remains: &[f64]) -> f64 {
        let beyond = size(&less(&self.all, 1.0, &self.method));
        1.0 - (size(remains) / beyond).powi(2)
    }
}

/// How much the method's error may vary from what is known of it, over itself.
const DOUBT: f64 = 0.5;

/// The errors that hypotheses make.
pub trait Effect<const D: usize> {
    /// The error that a hypothesis of this size makes, less that of a right solver; `None` where it cannot be found.
    fn response(&self, hypothesis: &Hypothesis<D>, size: &[f64]) -> Option<Vec<f64>>;

    /// By how much methods differ in such errors, where that is known.
    fn doubts(&self, _: &Hypothesis<D>, _: &[Vec<f64>], _: &[Vec<f64>]) -> Vec<Vec<f64>> {
        Vec::new()
    }
}

impl<const D: usize, F: Fn(&Hypothesis<D>, &[f64]) -> Vec<f64>> Effect<D> for F {
    fn response(&self, hypothesis: &Hypothesis<D>, size: &[f64]) -> Option<Vec<f64>> {
        Some(self(hypothesis, size))
    }
}

/// What a hypothesis explains. Its size is mended until the effect need not be scaled; a vector is taken as linear.
pub fn explain<const D: usize>(
    index: usize,
    hypothesis: &Hypothesis<D>,
    error: &Error,
    effect: &dyn Effect<D>,
) -> Option<Explained> {
    match &hypothesis.size {
        Size::Fixed => sized(index, hypothesis, error, effect, [0.0, 1.0]),
        Size::Any { right, first, .. } => match (right.as_slice(), first.as_slice()) {
            ([right], [first]) => sized(index, hypothesis, error, effect, [*right, *first]),
            (right, first) => vector(index, hypothesis, error, effect, [right, first]),
        },
    }
}

/// A hypothesis with one number, or none.
fn sized<const D: usize>(
    index: usize,
    hypothesis: &Hypothesis<D>,
    error: &Error,
    effect: &dyn Effect<D>,
    [right, first]: [f64; 2],
) -> Option<Explained> {
    let is_fixed = hypothesis.size == Size::Fixed;
    let mut at = first;
    let mut best: Option<Explained> = None;
    for _ in 0..MENDS {
        let found = effect.response(hypothesis, &[at]);
        let Some(response) = found.filter(|it| it.iter().all(|it| it.is_finite())) else { break };
        let response = [response];
        let doubts = effect.doubts(hypothesis, &[vec![at]], &response);
        let (scale, remains) = error.explain(&response, &doubts);
        let ([response], scale) = (response, scale[0]);
        let share = error.share(&remains);
        let relative = size(&remains) / size(&response).max(f64::MIN_POSITIVE);
        let found = hypothesis.rescaled(right, at, scale);
        let margin = relative * (at - right).abs();
        let size = if is_fixed { Vec::new() } else { vec![found] };
        if best.as_ref().is_none_or(|best| share > best.share - SAME) {
            best = Some(Explained { hypothesis: index, size, margin, scale, share, response });
        }
        if is_fixed || share < WORTH || (scale - 1.0).abs() < FOUND || !found.is_finite() {
            break;
        }
        at = found;
    }
    best
}

/// A hypothesis with a vector.
fn vector<const D: usize>(
    index: usize,
    hypothesis: &Hypothesis<D>,
    error: &Error,
    effect: &dyn Effect<D>,
    [right, first]: [&[f64]; 2],
) -> Option<Explained> {
    let along = |axis: usize| {
        let mut at = right.to_vec();
        at[axis] = first[axis];
        at
    };
    let sizes: Vec<_> = (0..right.len()).map(along).collect();
    let responses = sizes.iter().map(|at| effect.response(hypothesis, at));
    let responses: Vec<_> = responses.collect::<Option<_>>()?;
    let doubts = effect.doubts(hypothesis, &sizes, &responses);
    let (scales, remains) = error.explain(&responses, &doubts);
    let share = error.share(&remains);
    let steps = right.iter().zip(first).zip(&scales);
    let found: Vec<f64> =
        steps.map(|((right, first), scale)| right + scale * (first - right)).collect();
    let mut response = vec![0.0; error.all.len()];
    for (column, scale) in responses.iter().zip(&scales) {
        response = less(&response, -scale, column);
    }
    let margin = size(&remains) / size(&response).max(f64::MIN_POSITIVE) * size(&found);
    Some(Explained { hypothesis: index, size: found, margin, scale: 1.0, share, response })
}

/// Shares that differ by less are alike: the later size is the better one.
const SAME: f64 = 1e-3;
/// How often the size of a hypothesis is mended.
const MENDS: usize = 8;
/// From this part of the error on a hypothesis is worth mending.
const WORTH: f64 = 0.5;
/// A size is found when the response has to be scaled by no more than this.
const FOUND: f64 = 1e-3;
