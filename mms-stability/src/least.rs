//! The least value of a function over a box: on a grid, then around the least of it.

/// How often the steps around the least value are halved, and how many are made of each length.
const HALVINGS: usize = 10;
const MOVES: usize = 8;

/// A value, and the fractions at which it was met.
#[derive(Clone, Debug, PartialEq)]
pub struct Least {
    /// The least value that was met.
    pub value: f64,
    /// Where.
    pub at: Vec<f64>,
}

/// The least value of a function over the unit box, first on a grid of so many points along each side, ends included,
/// the last side fastest; then by steps along the sides, halved where none leads lower. `None` where it has no value on
/// the grid.
pub fn least(counts: &[usize], mut value: impl FnMut(&[f64]) -> Option<f64>) -> Option<Least> {
    let mut best: Option<Least> = None;
    let points: usize = counts.iter().product();
    for index in 0..points {
        let at = fractions(counts, index);
        if let Some(value) = value(&at)
            && best.as_ref().is_none_or(|best| value < best.value)
        {
            best = Some(Least { value, at });
        }
    }
    let mut best = best?;
    let mut steps: Vec<f64> = counts.iter().map(|count| 0.5 / (*count as f64 - 1.0)).collect();
    for _ in 0..HALVINGS {
        for _ in 0..MOVES {
            let Some(lower) = lower_neighbour(&best, &steps, &mut value) else { break };
            best = lower;
        }
        steps.iter_mut().for_each(|step| *step /= 2.0);
    }
    Some(best)
}

fn fractions(counts: &[usize], mut index: usize) -> Vec<f64> {
    let mut at = vec![0.0; counts.len()];
    for (fraction, count) in at.iter_mut().zip(counts).rev() {
        *fraction = (index % count) as f64 / (*count as f64 - 1.0);
        index /= count;
    }
    at
}

/// The first neighbour that is lower.
fn lower_neighbour(
    best: &Least,
    steps: &[f64],
    value: &mut impl FnMut(&[f64]) -> Option<f64>,
) -> Option<Least> {
    let moves = (0..steps.len()).flat_map(|side| [(side, -1.0), (side, 1.0)]);
    moves.into_iter().find_map(|(side, sign)| {
        let mut at = best.at.clone();
        at[side] = (at[side] + sign * steps[side]).clamp(0.0, 1.0);
        let value = value(&at).filter(|value| *value < best.value)?;
        Some(Least { value, at })
    })
}
