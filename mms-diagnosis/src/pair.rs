//! Two mistakes at once: finds the pair of hypotheses that explains an error that no single one explains.

use crate::answer::{Explained, Pair};
use crate::hypothesis::{Hypothesis, Size};
use crate::rank::Error;

/// One member of a pair is among this many hypotheses that explain most alone.
const LIKELY: usize = 5;
/// The part of the error that a pair may leave.
const LEFT: f64 = 0.15;
/// The largest |scale - 1| of a mistake without a size.
const SCALED: f64 = 0.15;

/// The pair that explains most, with sizes that both may have, if it leaves little.
pub fn best<const D: usize>(
    error: &Error,
    hypotheses: &[Hypothesis<D>],
    explained: &[Explained],
) -> Option<Pair> {
    let mut alone: Vec<&Explained> = explained.iter().filter(|it| it.share.is_finite()).collect();
    alone.sort_by(|a, b| b.share.total_cmp(&a.share));
    let name = |it: &Explained| hypotheses[it.hypothesis].name;
    let likely = alone.iter().take(LIKELY);
    let pairs = likely.flat_map(|a| alone.iter().map(move |b| [*a, *b]));
    let pairs = pairs.filter(|[a, b]| name(a) != name(b));
    let found = pairs.filter_map(|pair| {
        let responses = pair.map(|it| it.response.clone());
        let (scales, remains) = error.explain(&responses, &[]);
        let may_be = pair
            .iter()
            .zip(&scales)
            .all(|(it, scale)| is_plausible(&hypotheses[it.hypothesis], it, *scale));
        may_be.then(|| Pair {
            hypotheses: pair.map(|it| hypotheses[it.hypothesis].title()),
            explained: error.share(&remains),
        })
    });
    let best = found.max_by(|a, b| a.explained.total_cmp(&b.explained))?;
    ((1.0 - best.explained).max(0.0).sqrt() <= LEFT).then_some(best)
}

/// Whether a hypothesis can have the size at which its response is scaled by `scale`.
fn is_plausible<const D: usize>(it: &Hypothesis<D>, explained: &Explained, scale: f64) -> bool {
    match (&it.size, explained.size.as_slice()) {
        (Size::Fixed, _) => (scale - 1.0).abs() <= SCALED,
        (Size::Any { right, .. }, [size]) => it.allows(&[it.rescaled(right[0], *size, scale)]),
        (Size::Any { .. }, sizes) => {
            it.allows(&sizes.iter().map(|size| size * scale).collect::<Vec<_>>())
        }
    }
}
