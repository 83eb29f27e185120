//! The minimum of a function over a box: on a grid, then around the best grid point.

/// The number of times that the steps around the minimum are halved.
const HALVINGS: usize = 10;
/// The number of steps of each length.
const MOVES: usize = 8;

/// A minimum, and the fractions where it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Least {
    /// The least sampled value.
    pub value: f64,
    /// The fractions.
    pub at: Vec<f64>,
}

/// The minimum of a function over the unit box, first on a grid with these numbers of points along the sides, ends included,
/// the last side fastest; then by steps along the sides, halved if none leads lower. `None` if the function has no value on the
/// grid.
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
