//! Finds which hypotheses explain an error, with which size, and which explain it as well.

use crate::answer::Explained;
use crate::hypothesis::{Hypothesis, Size};
use crate::smooth::{less, nearest, size};

/// The error to be explained.
pub struct Error {
    /// The coefficients of a user's error.
    pub all: Vec<f64>,
    /// The errors of right methods. The user's method may make about as much as one of them, or nothing.
    pub methods: Vec<Vec<f64>>,
    /// Directions of which results may contain any multiple without a mistake.
    pub free: Vec<Vec<f64>>,
    /// The size of the additional error that a right method may make.
    pub floor: f64,
    /// The part of the error that no method explains.
    pub beyond: Vec<f64>,
}

/// The relative difference between the user's method and one of ours, and between the responses of two methods.
const DOUBT: f64 = 0.4;

/// A least-squares fit of some directions to an error.
struct Fit {
    found: Vec<f64>,
    remains: Vec<f64>,
    /// The square of the remainder, plus the penalty for the doubts used.
    cost: f64,
}

impl Error {
    /// The error with these coefficients.
    pub fn new(all: Vec<f64>, methods: Vec<Vec<f64>>, free: Vec<Vec<f64>>, floor: f64) -> Self {
        let mut error = Error { all, methods, free, floor, beyond: Vec::new() };
        error.beyond = error.explain(&[], &[]).1;
        error
    }

    /// The size of the error that methods do not explain, divided by the additional error that they may make.
    pub fn excess(&self) -> f64 {
        let beyond = size(&self.beyond);
        if self.floor > 0.0 {
            beyond / self.floor
        } else if beyond > 0.0 {
            f64::INFINITY
        } else {
            0.0
        }
    }

    /// Finds the coefficients with which some directions, the error of a method, and the differences `doubtful` between methods
    /// come nearest to the error; and the remainder. Uses the method that needs the least doubt.
    pub fn explain(&self, directions: &[Vec<f64>], doubtful: &[Vec<f64>]) -> (Vec<f64>, Vec<f64>) {
        let none = vec![0.0; self.all.len()];
        let fits = self.methods.iter().chain([&none]).map(|it| self.fit(directions, doubtful, it));
        let best = fits.min_by(|a, b| a.cost.total_cmp(&b.cost));
        best.map_or((vec![0.0; directions.len()], self.all.clone()), |it| (it.found, it.remains))
    }

    fn fit(&self, directions: &[Vec<f64>], doubtful: &[Vec<f64>], method: &Vec<f64>) -> Fit {
        // A row for each doubt pulls the factor of the method's error to 1, and the factors of differences between methods to
        // 0.
        let rows = 1 + doubtful.len();
        let row = |column: &[f64], place: Option<usize>| {
            let weight = (DOUBT * size(column)).max(self.floor);
            let rows = (0..rows).map(|row| if place == Some(row) { weight } else { 0.0 });
            column.iter().copied().chain(rows).collect::<Vec<f64>>()
        };
        let known = directions.iter().chain(&self.free);
        let mut columns: Vec<_> = known.map(|it| row(it, None)).collect();
        let doubts = std::iter::once(method).chain(doubtful).enumerate();
        columns.extend(doubts.map(|(place, it)| row(it, Some(place))));
        let mut to = row(&self.all, None);
        to[self.all.len()] = columns[directions.len() + self.free.len()][self.all.len()];
        let mut found = nearest(&columns, &to);
        let mut remains = to;
        for (column, factor) in columns.iter().zip(&found) {
            remains = less(&remains, *factor, column);
        }
        let cost = remains.iter().map(|it| it * it).sum();
        remains.truncate(self.all.len());
        found.truncate(directions.len());
        Fit { found, remains, cost }
    }

    /// The explained part of the squared error beyond the methods' errors, from this remainder.
    pub fn share(&self, remains: &[f64]) -> f64 {
        1.0 - (size(remains) / size(&self.beyond)).powi(2)
    }
}

/// The errors that hypotheses make.
pub trait Effect<const D: usize> {
    /// The error that a hypothesis of this size makes, less the error of a right solver; `None` if it cannot be computed.
    fn response(&self, hypothesis: &Hypothesis<D>, size: &[f64]) -> Option<Vec<f64>>;

    /// The differences between methods in such errors, where they are known.
    fn method_differences(
        &self,
        _: &Hypothesis<D>,
        _: &[Vec<f64>],
        _: &[Vec<f64>],
    ) -> Vec<Vec<f64>> {
        Vec::new()
    }
}

impl<const D: usize, F: Fn(&Hypothesis<D>, &[f64]) -> Vec<f64>> Effect<D> for F {
    fn response(&self, hypothesis: &Hypothesis<D>, size: &[f64]) -> Option<Vec<f64>> {
        Some(self(hypothesis, size))
    }
}

/// Finds the part of the error that a hypothesis explains. Refines the size until the scale is 1; a vector is assumed to
/// act linearly.
pub fn explain<const D: usize>(
    index: usize,
    hypothesis: &Hypothesis<D>,
    error: &Error,
    effect: &dyn Effect<D>,
) -> Option<Explained> {
    match &hypothesis.size {
        Size::Fixed => sized(index, hypothesis, error, effect, 0.0, &[1.0]),
        Size::Any { right, first, .. } => match (right.as_slice(), first.as_slice()) {
            // Large mistakes act nonlinearly, so the search also starts from the other side.
            ([right], [first]) => {
                let starts = [&[*first, 2.0 * right - first], hypothesis.also.as_slice()].concat();
                sized(index, hypothesis, error, effect, *right, &starts)
            }
            (right, first) => vector(index, hypothesis, error, effect, [right, first]),
        },
    }
}

/// Finds the part of an error that a hypothesis explains by its responses at usual sizes; `None` if it has no size.
pub fn explain_usual<const D: usize>(
    index: usize,
    hypothesis: &Hypothesis<D>,
    error: &Error,
    effect: &dyn Effect<D>,
    usual: &[f64],
) -> Option<Explained> {
    match &hypothesis.size {
        Size::Any { right, .. } if right.len() == 1 => {
            sized(index, hypothesis, error, effect, right[0], usual)
        }
        _ => None,
    }
}

/// Explains an error by a hypothesis with one number or none, by its responses at the sizes `starts`.
fn sized<const D: usize>(
    index: usize,
    hypothesis: &Hypothesis<D>,
    error: &Error,
    effect: &dyn Effect<D>,
    right: f64,
    starts: &[f64],
) -> Option<Explained> {
    let is_fixed = hypothesis.size == Size::Fixed;
    let at = |at: f64| one(index, hypothesis, error, effect, [right, at]);
    let allowed = starts.iter().filter(|it| is_fixed || hypothesis.allows(&[**it]));
    let tried = allowed.filter_map(|it| Some((*it, at(*it)?)));
    let (mut place, mut last) = tried.max_by(|a, b| a.1.share.total_cmp(&b.1.share))?;
    let (mut best, mut before) = (last.clone(), None);
    for _ in 0..MENDS {
        let &[first] = last.size.as_slice() else { break };
        if last.share < WORTH || !first.is_finite() {
            break;
        }
        if (last.scale - 1.0).abs() < FOUND {
            return Some(last);
        }
        // The inverse of the scale is linear in the size, where the effect is.
        let own = [place, 1.0 / last.scale];
        let next = before.map_or(first, |before| secant(before, own));
        let next = if next.is_finite() && hypothesis.allows(&[next]) { next } else { first };
        let Some(found) = at(next) else { break };
        if found.share > best.share - SAME {
            best = found.clone();
        }
        (before, place, last) = (Some(own), next, found);
    }
    Some(best)
}

/// The size at which a line through two points of [size, inverse of the scale] has the scale 1.
fn secant([a, of_a]: [f64; 2], [b, of_b]: [f64; 2]) -> f64 {
    b + (1.0 - of_b) * (b - a) / (of_b - of_a)
}

/// Explains an error by the response at one size, scaled.
fn one<const D: usize>(
    index: usize,
    hypothesis: &Hypothesis<D>,
    error: &Error,
    effect: &dyn Effect<D>,
    [right, at]: [f64; 2],
) -> Option<Explained> {
    let found = effect.response(hypothesis, &[at]);
    let response = [found.filter(|it| it.iter().all(|it| it.is_finite()))?];
    let doubts = effect.method_differences(hypothesis, &[vec![at]], &response);
    let (scale, remains) = error.explain(&response, &doubts);
    let ([response], scale) = (response, scale[0]);
    let share = error.share(&remains);
    let relative = size(&remains) / size(&response).max(f64::MIN_POSITIVE);
    let size = match hypothesis.size {
        Size::Fixed => Vec::new(),
        Size::Any { .. } => vec![hypothesis.rescaled(right, at, scale)],
    };
    let margin = relative * (at - right).abs();
    Some(Explained { hypothesis: index, size, margin, scale, share, response })
}

/// Explains an error by a hypothesis with a vector.
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
    let doubts = effect.method_differences(hypothesis, &sizes, &responses);
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

/// Shares that differ by less are equal: the later size is the better one.
const SAME: f64 = 1e-3;
/// The most refinements of a size.
const MENDS: usize = 8;
/// The least share with which a hypothesis is refined.
const WORTH: f64 = 0.3;
/// A size is found if the response has to be scaled by no more than this.
const FOUND: f64 = 1e-3;
