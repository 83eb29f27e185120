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

/// What a hypothesis explains, its size mended until its effect need not be scaled. `make` says the error that it makes
/// with a size.
pub fn explain<const D: usize>(
    index: usize,
    hypothesis: &Hypothesis<D>,
    error: &Error,
    make: &dyn Fn(&Hypothesis<D>, &[f64]) -> Vec<f64>,
) -> Option<Explained> {
    let (right, first) = match &hypothesis.size {
        Size::Fixed => (vec![], vec![]),
        Size::Any { right, first, .. } => (right.clone(), first.clone()),
    };
    if right.len() > 1 {
        let along = |axis: usize| {
            let mut at = right.clone();
            at[axis] = first[axis];
            make(hypothesis, &at)
        };
        let responses: Vec<_> = (0..right.len()).map(along).collect();
        let (scales, remains) = error.explain(&responses, &[]);
        let found: Vec<f64> =
            right.iter().zip(&first).zip(&scales).map(|((r, f), s)| r + s * (f - r)).collect();
        let response = less(&error.all, 1.0, &remains);
        let margin = size(&remains) / size(&response).max(f64::MIN_POSITIVE) * size(&found);
        let share = error.share(&remains);
        return Some(Explained {
            hypothesis: index,
            size: found,
            margin,
            scale: 1.0,
            share,
            response,
        });
    }
    let mut at = first.first().copied();
    let mut best: Option<Explained> = None;
    for _ in 0..MENDS {
        let sizes: Vec<f64> = at.into_iter().collect();
        let response = [make(hypothesis, &sizes)];
        if response[0].iter().any(|it| !it.is_finite()) {
            break;
        }
        let (scale, remains) = error.explain(&response, &[]);
        let (scale, [response]) = (scale[0], response);
        let share = error.share(&remains);
        let relative = size(&remains) / size(&response).max(f64::MIN_POSITIVE);
        let step = right.first().zip(at).map_or(1.0, |(right, at)| at - right);
        let found = right.first().zip(at).map(|(right, at)| hypothesis.rescaled(*right, at, scale));
        let explained = Explained {
            hypothesis: index,
            size: found.into_iter().collect(),
            margin: relative * step.abs(),
            scale,
            share,
            response,
        };
        if best.as_ref().is_none_or(|best| share >= best.share - SAME) {
            best = Some(explained);
        }
        if found.is_none() || (scale - 1.0).abs() < 1e-6 {
            break;
        }
        at = found.filter(|it| it.is_finite());
        if at.is_none() {
            break;
        }
    }
    best
}

/// Shares that differ by less are alike: the later size is the better one.
pub const SAME: f64 = 1e-3;
/// How often the size of a hypothesis is mended.
const MENDS: usize = 8;
