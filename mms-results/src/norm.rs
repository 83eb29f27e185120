//! Norms of errors over points.

/// The norms of an error. Means are over points, by their weights, or over the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Norms {
    /// The mean.
    pub l1: f64,
    /// The root mean square.
    pub l2: f64,
    /// The maximum.
    pub linf: f64,
    /// The point or cell of the maximum.
    pub at: usize,
}

/// Sums for the norms.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Sums {
    weight: f64,
    first: f64,
    /// Sums of squares of small, usual and large errors, each scaled by [`SCALES`] (J. L. Blue, ACM Trans. Math. Softw. 4,
    /// 1978, 15-23).
    second: [f64; 3],
    largest: f64,
    at: usize,
}

/// Errors between these have squares that neither underflow nor overflow.
const USUAL: [f64; 2] = [1e-140, 1e140];

/// Powers of two that scale errors below, between and above into that range.
const SCALES: [f64; 3] =
    [f64::from_bits((1023 + 600) << 52), 1.0, f64::from_bits((1023 - 600) << 52)];

impl Sums {
    pub(crate) fn add(&mut self, at: usize, weight: f64, error: f64) {
        self.weight += weight;
        self.first += weight * error;
        let size = usize::from(error >= USUAL[0]) + usize::from(error > USUAL[1]);
        let scaled = error * SCALES[size];
        self.second[size] += weight * scaled * scaled;
        if error > self.largest {
            (self.largest, self.at) = (error, at);
        }
    }

    pub(crate) fn norms(self) -> Norms {
        let Sums { weight, first, second, largest, at } = self;
        let size = second.iter().rposition(|it| *it > 0.0).unwrap_or(1);
        // A sum two sizes smaller does not count.
        let step = SCALES[2];
        let smaller = if size > 0 { second[size - 1] * step * step } else { 0.0 };
        let l2 = ((second[size] + smaller) / weight).sqrt() / SCALES[size];
        Norms { l1: first / weight, l2, linf: largest, at }
    }

    /// The norms; `None` without a weight above 0.
    pub(crate) fn if_any(self) -> Option<Norms> {
        (self.weight > 0.0 && self.weight.is_finite()).then(|| self.norms())
    }
}

/// The lengths of the differences, with `components` each: the Euclidean norm of vectors, the Frobenius norm of tensors.
pub fn lengths(computed: &[f64], exact: &[f64], components: usize) -> impl Iterator<Item = f64> {
    let pairs = computed.chunks_exact(components).zip(exact.chunks_exact(components));
    pairs.map(|(a, b)| length(a, b))
}

/// The length of a difference.
pub(crate) fn length(a: &[f64], b: &[f64]) -> f64 {
    let differences = || a.iter().zip(b).map(|(a, b)| (a - b).abs());
    let square: f64 = differences().map(|it| it * it).sum();
    if (USUAL[0]..USUAL[1]).contains(&square) {
        return square.sqrt();
    }
    let most = differences().fold(0.0, f64::max);
    if most == 0.0 || !most.is_finite() {
        return square.sqrt();
    }
    differences().map(|it| (it / most).powi(2)).sum::<f64>().sqrt() * most
}

/// The norms of errors at points, weighted or with equal weights. `None` without points or without a positive total weight.
pub fn over_points(
    errors: impl IntoIterator<Item = f64>,
    weights: Option<&[f64]>,
) -> Option<Norms> {
    let mut sums = Sums::default();
    for (at, error) in errors.into_iter().enumerate() {
        sums.add(at, weights.map_or(1.0, |weights| weights[at]), error);
    }
    sums.if_any()
}

/// The norms of the differences at points, as in [`over_points`].
pub fn of_differences(
    computed: &[f64],
    exact: &[f64],
    components: usize,
    weights: Option<&[f64]>,
) -> Option<Norms> {
    over_points(lengths(computed, exact, components), weights)
}

/// The largest absolute value; 0 if there are no numbers.
pub fn largest(of: &[f64]) -> f64 {
    of.iter().fold(0.0, |most: f64, it| most.max(it.abs()))
}

/// The least and the largest number; infinity and minus infinity if there are none.
pub fn range<'a>(of: impl IntoIterator<Item = &'a f64>) -> [f64; 2] {
    let none = [f64::INFINITY, f64::NEG_INFINITY];
    of.into_iter().fold(none, |[least, most], it| [least.min(*it), most.max(*it)])
}

/// The largest absolute value of finite numbers, in one pass; 0 if there are none.
///
/// # Errors
/// The first number that is not finite.
pub fn largest_if_finite(of: &[f64]) -> Result<f64, usize> {
    // Blocks of numbers, without a branch for each.
    const TOGETHER: usize = 1024;
    let mut most = 0.0_f64;
    for (block, numbers) in of.chunks(TOGETHER).enumerate() {
        if !numbers.iter().fold(true, |all, it| all & it.is_finite()) {
            let at = numbers.iter().position(|it| !it.is_finite());
            return Err(block * TOGETHER + at.unwrap_or_default());
        }
        most = most.max(largest(numbers));
    }
    Ok(most)
}
