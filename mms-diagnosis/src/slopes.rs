//! The change of the stress of any law with F, by differences.

use mms_runtime::Matrix;
use mms_runtime::tensor::determinant;

/// The derivatives of tau with respect to F at a point.
#[derive(Clone, Debug)]
pub struct Slopes<const D: usize> {
    /// F.
    pub f: Matrix<f64, D>,
    /// tau.
    pub tau: Matrix<f64, D>,
    along: Vec<Matrix<f64, D>>,
}

impl<const D: usize> Slopes<D> {
    /// The rate of tau if the rate of F is L F.
    pub fn rate(&self, l: &Matrix<f64, D>) -> Matrix<f64, D> {
        let entries = l.iter().zip(&self.along);
        entries.fold(Matrix::zeros(), |sum, (l, along)| sum + along * *l)
    }

    /// J.
    pub fn jacobian(&self) -> f64 {
        determinant(&self.f)
    }

    /// The stress rate that the tangent of Abaqus gives for a symmetric rate of deformation: the Jaumann rate of tau over J.
    /// Without spin it is the rate of tau itself, for every objective law.
    pub fn tangent(&self, rate: &Matrix<f64, D>) -> Matrix<f64, D> {
        self.rate(rate) / self.jacobian()
    }
}

/// The largest step of the central differences, as a part of F; each further step is half of the one before.
const STEP: f64 = 0.04;
/// The number of steps: each removes two more orders of the error (Richardson).
const STEPS: usize = 4;

/// The derivatives of tau at each point, from a function that computes tau of all points at their H.
pub fn slopes<const D: usize>(
    gradient: &[Matrix<f64, D>],
    stress: impl Fn(&[Matrix<f64, D>]) -> Vec<Matrix<f64, D>>,
) -> Vec<Slopes<D>> {
    let f: Vec<_> = gradient.iter().map(|h| h + Matrix::identity()).collect();
    let along = |entry: usize| {
        let at = |step: f64| {
            let mut changed = Matrix::identity();
            changed[entry] += step;
            stress(&f.iter().map(|f| changed * f - Matrix::identity()).collect::<Vec<_>>())
        };
        let central = |level: usize| -> Vec<Matrix<f64, D>> {
            let step = STEP / 2f64.powi(level as i32);
            let pairs = at(step).into_iter().zip(at(-step));
            pairs.map(|(above, below)| (above - below) / (2.0 * step)).collect()
        };
        let mut levels: Vec<_> = (0..STEPS).map(central).collect();
        for order in 1..STEPS {
            let gain = 4f64.powi(order as i32) - 1.0;
            for level in (order..STEPS).rev() {
                let coarser = levels[level - 1].clone();
                let pairs = levels[level].iter_mut().zip(coarser);
                pairs.for_each(|(fine, coarse)| *fine += (*fine - coarse) / gain);
            }
        }
        levels.pop().unwrap_or_default()
    };
    let along: Vec<_> = (0..D * D).map(along).collect();
    let each = f.into_iter().zip(stress(gradient)).enumerate();
    each.map(|(at, (f, tau))| Slopes { f, tau, along: along.iter().map(|it| it[at]).collect() })
        .collect()
}
