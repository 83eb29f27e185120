//! Diagnosis of a law alone: stresses at given F, without a solver.

use mms_runtime::tensor::{determinant, inverse};
use mms_runtime::{Matrix, Vector};

use crate::answer::{Diagnosis, Limits, Ranked, Rung, ranked, unseen};
use crate::exact::Exact;
use crate::hypothesis::{Change, Given, Hypothesis, Of, over_jacobian, voigt_orders};
use crate::rank::{Error, explain};
use crate::smooth::{less, size};

/// A measure of stress.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// P.
    FirstPiola,
    /// S.
    SecondPiola,
    /// tau.
    Kirchhoff,
    /// sigma.
    Cauchy,
}

impl Measure {
    /// The measure of the field that this one corresponds to: at small strain there is one stress, P.
    fn known<const D: usize>(self, exact: &Exact<'_, D>) -> Self {
        if exact.field.is_small_strain() { Measure::FirstPiola } else { self }
    }

    /// Converts tau = P F^T at F to this measure; returns NaN if F is singular.
    pub fn of<const D: usize>(self, f: &Matrix<f64, D>, tau: &Matrix<f64, D>) -> Matrix<f64, D> {
        let inverse = inverse(f).unwrap_or(Matrix::repeat(f64::NAN));
        match self {
            Measure::FirstPiola => tau * inverse.transpose(),
            Measure::SecondPiola => inverse * tau * inverse.transpose(),
            Measure::Kirchhoff => *tau,
            Measure::Cauchy => tau / determinant(f),
        }
    }
}

/// Stresses that a law gave.
#[derive(Clone, Debug)]
pub struct StressTable<const D: usize> {
    /// X; only needed where moduli depend on it.
    pub reference: Vec<Vector<f64, D>>,
    /// H.
    pub gradient: Vec<Matrix<f64, D>>,
    /// The declared measure of the stresses.
    pub measure: Measure,
    /// The stresses.
    pub stress: Vec<Matrix<f64, D>>,
    /// The uncertainty of each stress, from how it was stored.
    pub rounding: f64,
    /// The uncertainty of each component of H at which the law was evaluated, from how it was stored.
    pub rounding_of_gradient: f64,
}

/// The error of a right law from rounding, relative to the largest stress.
pub const ARITHMETIC: f64 = 1e-11;
/// The least part of the squared error that a named mistake explains: it fits to round-off.
const EXPLAINED: f64 = 1.0 - 1e-6;

/// The largest ratio of the error left to the error that an impossible size leaves. In a table several mistakes may have the
/// same effect.
const NEARER: f64 = 1.3;

/// Diagnoses a law. `None` where an exact stress is not finite.
pub fn diagnose<const D: usize>(
    exact: &Exact<'_, D>,
    table: &StressTable<D>,
    mut hypotheses: Vec<Hypothesis<D>>,
) -> Option<Diagnosis> {
    let measure = table.measure.known(exact);
    if measure != Measure::FirstPiola {
        hypotheses.extend([Hypothesis::first_piola(), over_jacobian()]);
    }
    hypotheses.retain(|it| matches!(it.change, Change::Stress(of, _) if of != Of::Motion));
    // The measure P is not symmetric and has nine components.
    if table.measure != Measure::FirstPiola {
        hypotheses.extend(voigt_orders());
    }
    let deformation: Vec<_> = table.gradient.iter().map(|h| h + Matrix::identity()).collect();
    let flat = |deformation: &[Matrix<f64, D>], stress: &[Matrix<f64, D>], measure: Measure| {
        let pairs = deformation.iter().zip(stress);
        let all: Vec<f64> =
            pairs.flat_map(|(f, tau)| measure.of(f, tau).as_slice().to_vec()).collect();
        all
    };
    let tau = exact.stress(exact.domain.time[0], &table.reference, &table.gradient);
    let right = flat(&deformation, &tau, measure);
    let scale = size(&right).max(f64::MIN_POSITIVE);
    let given = table.stress.iter().flat_map(|it| it.as_slice().to_vec());
    let all: Vec<f64> = given.zip(&right).map(|(given, right)| (given - right) / scale).collect();
    if right.iter().any(|it| !it.is_finite()) {
        return None;
    }
    let largest = right.iter().fold(0.0, |most: f64, it| most.max(it.abs()));
    let count = (right.len() as f64).sqrt();
    // The stress error from rounding of F, by the tangent.
    let by_gradient = |entry: usize| {
        let mut moved = table.gradient.clone();
        moved.iter_mut().for_each(|h| h[entry] += table.rounding_of_gradient);
        let deformation: Vec<_> = moved.iter().map(|h| h + Matrix::identity()).collect();
        let tau = exact.stress(exact.domain.time[0], &table.reference, &moved);
        size(&less(&flat(&deformation, &tau, measure), 1.0, &right))
    };
    let of_gradient = match table.rounding_of_gradient > 0.0 {
        true => (0..D * D).map(by_gradient).fold(0.0, f64::hypot),
        false => 0.0,
    };
    let own = (table.rounding + ARITHMETIC * largest) * count;
    let floor = own.hypot(of_gradient) / scale;
    let wrong = |hypothesis: &Hypothesis<D>, at: &[f64]| {
        let mut wrong = tau.clone();
        let given = Given {
            exact,
            size: at,
            time: exact.domain.time[0],
            reference: &table.reference,
            gradient: &table.gradient,
        };
        if let Change::Stress(_, change) = hypothesis.change {
            change(&given, &mut wrong);
        }
        let measure = match hypothesis.change {
            Change::Stress(Of::Measure, _) => Measure::FirstPiola,
            _ => measure,
        };
        let mut wrong = flat(&deformation, &wrong, measure);
        if let Change::Order(order) = hypothesis.change {
            wrong.chunks_mut(D * D).for_each(|it| reorder(it, order));
        }
        wrong.iter().zip(&right).map(|(wrong, right)| (wrong - right) / scale).collect::<Vec<f64>>()
    };
    Some(to_round_off(exact, &hypotheses, all, floor, &wrong))
}

/// Permutes the shear components 12, 13, 23 of a symmetric tensor in space.
fn reorder(tensor: &mut [f64], order: [usize; 3]) {
    const PLACES: [[usize; 2]; 3] = [[1, 3], [2, 6], [5, 7]];
    let shears = PLACES.map(|[above, _]| tensor[above]);
    for (places, from) in PLACES.iter().zip(order) {
        places.iter().for_each(|place| tensor[*place] = shears[from]);
    }
}

/// Diagnoses numbers in which mistakes show to round-off, from their errors; errors up to `floor` count as none. `wrong`
/// computes the errors that a hypothesis makes.
pub fn to_round_off<const D: usize>(
    exact: &Exact<'_, D>,
    hypotheses: &[Hypothesis<D>],
    off: Vec<f64>,
    floor: f64,
    wrong: &impl Fn(&Hypothesis<D>, &[f64]) -> Vec<f64>,
) -> Diagnosis {
    let error = Error::new(off, Vec::new(), Vec::new(), floor);
    let one = |(index, hypothesis)| explain(index, hypothesis, &error, wrong);
    let mut explained: Vec<_> = hypotheses.iter().enumerate().filter_map(one).collect();
    let (found, excess) = (size(&error.all), error.excess());
    let cannot_be_seen = unseen(hypotheses, &explained, floor);
    explained.retain(|it| size(&it.response) > floor);
    let ranked =
        ranked(exact, hypotheses, explained, 0.0, &["other F: with shear, and of other sizes"]);
    let remains = |share: f64| (1.0 - share).max(0.0).sqrt() * found;
    let is_exact = |it: &Ranked| it.explained >= EXPLAINED || remains(it.explained) <= 2.0 * floor;
    let exact_ones = if ranked.first().is_some_and(is_exact) { ranked.as_slice() } else { &[] };
    let limits = Limits { excess: [1.0; 2], left: [1.0; 2], nearer: [NEARER; 2] };
    let finding = limits.finding(exact_ones, excess);
    Diagnosis {
        finding,
        rung: Rung::Law,
        ranked,
        cannot_be_seen,
        error: found,
        expected: [floor; 2],
        falls: None,
        of_order: None,
        pair: None,
        like: None,
        place: None,
        fields: None,
    }
}
